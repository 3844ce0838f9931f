// Where the parts of a model are written to: -o FILE, or a pattern with %s for their names.
#pragma once

#include <string>
#include <vector>

namespace csgrun {

/// Whether each part gets a file of its own.
bool is_pattern(const std::string& output);

/// The file for the part of this name.
std::string path_of_part(const std::string& pattern, const std::string& name);

/// Two things that would be written to one file, the second over the first, as a message; empty if
/// there are none.
std::string find_clash(const std::vector<std::string>& outputs,
                       const std::vector<std::string>& part_names);

}  // namespace csgrun
