#include "tests/support/source_folder.h"

#include <cstdlib>

namespace csgrun::test {

std::filesystem::path source_folder() { return CSGRUN_SOURCE_FOLDER; }

std::filesystem::path shared_folder() {
  if (const char* given = std::getenv("CSGRUN_SHARED")) return given;
  return source_folder().parent_path() / "shared";
}

}  // namespace csgrun::test
