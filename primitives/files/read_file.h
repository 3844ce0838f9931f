// The bytes of a regular file.
#pragma once

#include <string>

#include <csgrun/engine/error.h>

namespace csgrun {

/// Reads all of a regular file; a directory, a FIFO or a device is refused, and nothing blocks.
/// Errors: kCannotRead, kLimit beyond 4 GB. Messages start with the path.
Result<std::string> read_regular_file(const std::string& path);

}  // namespace csgrun
