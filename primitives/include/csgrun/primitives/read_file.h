// The bytes of a regular file.
#pragma once

#include <string>

namespace csgrun {

struct FileText {
  std::string bytes;
  std::string error;  ///< why it was not read; empty: it was
};

/// Reads all of a file of less than 4 GB: indices of points and corners have 32 bits. Directories,
/// FIFOs and devices are refused before they are opened, so that nothing blocks.
FileText read_whole_file(const std::string& path);

}  // namespace csgrun
