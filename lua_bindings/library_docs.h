// The functions of the shipped library, from the comments that stand in its modules.
#pragma once

#include <string>
#include <vector>

namespace csgrun {

/// Each module with what it is for and what its functions take: a section of the page of functions,
/// or plain text for --help-api. A comment of three dashes is for users; that before the code is
/// about the module, and the others are about the function that follows.
/// Lines of "---@" are for editors and left out.
std::string library_docs(bool markdown);

struct LibraryDefinitions {
  std::string file;  ///< "csg/gears.lua"
  std::string text;
};

/// Each module as the Lua language server reads it: comments, and functions without their insides.
std::vector<LibraryDefinitions> library_definitions();

}  // namespace csgrun
