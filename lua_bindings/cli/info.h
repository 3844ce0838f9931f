// `csgrun info`: the measures of a mesh file on its own coordinates.
#pragma once

#include <string>
#include <vector>

#include "lua_bindings/cli/exit_codes.h"

namespace csgrun {

/// Whether info reads files of this ending.
bool is_info_path(const std::string& path);

/// Measures the file and appends what is printed to `output`; what of it was not read, or not as it
/// stands, to `notes`.
Failure run_info(const std::string& path, bool json, std::string& output,
                 std::vector<std::string>& notes);

}  // namespace csgrun
