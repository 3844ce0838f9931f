#include "lua_bindings/library_docs.h"

#include <algorithm>
#include <string_view>

#include <fmt/format.h>

#include "lua_bindings/shipped_modules.h"

namespace csgrun {
namespace {

constexpr std::string_view kForUsers = "---", kForEditors = "---@", kFunction = "function ",
                           kOnlyFunction = "return function(";

/// A line of a comment without its dashes. On a page an example is indented as code.
std::string comment_text(std::string_view line, bool markdown) {
  line.remove_prefix(kForUsers.size());
  if (!line.empty() && line[0] == ' ') line.remove_prefix(1);
  const bool is_example = line.starts_with("  ");
  return (markdown && is_example ? "  " : "") + std::string(line) + "\n";
}

std::string module_docs(const ShippedModule& module, bool markdown) {
  std::string docs = markdown ? fmt::format("\n## require \"{}\"\n\n", module.name)
                              : fmt::format("\nrequire \"{}\"\n\n", module.name);
  std::string comment;
  bool is_head = true;
  for (std::string_view rest = module.text; !rest.empty();) {
    const std::string_view line = rest.substr(0, rest.find('\n'));
    rest.remove_prefix(std::min(line.size() + 1, rest.size()));
    if (line.starts_with(kForEditors)) continue;
    if (line.starts_with(kForUsers)) {
      comment += comment_text(line, markdown);
      continue;
    }
    if (!comment.empty() && is_head) {
      docs += comment;
      is_head = false;
    } else if (!comment.empty() && line.starts_with(kFunction)) {
      const std::string_view call = line.substr(kFunction.size());
      docs += markdown ? fmt::format("\n**`{}`** {}", call, comment)
                       : fmt::format("\n{}\n{}", call, comment);
    }
    comment.clear();
  }
  return docs;
}

/// A module for the Lua language server: its comments, and its functions without what they do.
std::string module_definitions(const ShippedModule& module) {
  const std::string_view name = module.name.substr(module.name.rfind('.') + 1);
  std::string text = fmt::format(
      "---@meta {}\n-- From the library in csgrun; do not edit. `csgrun --init` puts it where the "
      "Lua\n"
      "-- language server finds it.\n\n",
      module.name);
  std::string comment;
  bool is_head = true;
  for (std::string_view rest = module.text; !rest.empty();) {
    const std::string_view line = rest.substr(0, rest.find('\n'));
    rest.remove_prefix(std::min(line.size() + 1, rest.size()));
    if (line.starts_with(kForUsers)) {
      comment += std::string(line) + "\n";
      continue;
    }
    if (!comment.empty() && is_head) {
      text += comment;
      if (module.text.find(kOnlyFunction) == std::string_view::npos)
        text += fmt::format("---@class {}\nlocal {} = {{}}\n", module.name, name);
      is_head = false;
    } else if (line.starts_with(kFunction) || line.starts_with(kOnlyFunction)) {
      text += "\n" + comment + std::string(line) + " end\n";
    } else if (comment.empty() && line == fmt::format("return {}", name)) {
      text += "\n" + std::string(line) + "\n";
    }
    comment.clear();
  }
  return text;
}

}  // namespace

std::vector<LibraryDefinitions> library_definitions() {
  std::vector<LibraryDefinitions> modules;
  for (const ShippedModule& module : shipped_modules()) {
    std::string file(module.name);
    std::replace(file.begin(), file.end(), '.', '/');
    modules.push_back({file + ".lua", module_definitions(module)});
  }
  return modules;
}

std::string library_docs(bool markdown) {
  std::string docs;
  for (const ShippedModule& module : shipped_modules()) docs += module_docs(module, markdown);
  return docs;
}

}  // namespace csgrun
