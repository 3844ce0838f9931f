// A zip file in memory: the container of 3MF. The same entries give the same bytes.
#pragma once

#include <string>
#include <vector>

#include <csgrun/engine/error.h>

namespace csgrun {

struct ZipEntry {
  std::string name, bytes;
};

/// The entries as a zip file, deflated, all of the same date. Errors: kOutOfRange (4 GiB).
Result<std::string> zip_file(const std::vector<ZipEntry>& entries);

}  // namespace csgrun
