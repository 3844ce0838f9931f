// `csgrun info`: the measures of a mesh file on its own coordinates.
#pragma once

#include <string>

#include "lua_bindings/cli/exit_codes.h"

namespace csgrun {

/// Whether info reads files of this ending.
bool is_info_path(const std::string& path);

/// Measures the file and appends what is printed to `output`.
Failure run_info(const std::string& path, bool json, std::string& output);

}  // namespace csgrun
