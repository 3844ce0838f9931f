// The bytes of a file that must be there.
#pragma once

#include <string>

#include <csgrun/engine/error.h>

namespace csgrun {

/// As read_whole_file; kCannotRead with a message that starts with the path.
Result<std::string> read_regular_file(const std::string& path);

}  // namespace csgrun
