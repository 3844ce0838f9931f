// DXF as records: an entity with its group codes and values.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <csgrun/engine/error.h>

namespace csgrun {

/// What begins with a group code 0, up to the next.
struct DxfRecord {
  std::string kind;  ///< "LINE", "SECTION" ...
  size_t line = 0;   ///< in the file, from 1
  std::vector<std::pair<int, std::string_view>> values;

  /// The first value of a code; `otherwise` when there is none or it is no number.
  [[nodiscard]] double number(int code, double otherwise = 0) const;
  [[nodiscard]] std::string text(int code) const;
};

/// The entities of the drawing, and those of its blocks by name. Errors: kMalformedFile, kLimit.
struct DxfRecords {
  struct Block {
    double x = 0, y = 0;  ///< its base point
    std::vector<DxfRecord> entities;
  };
  std::vector<DxfRecord> entities;
  std::map<std::string, Block> blocks;
};
Result<DxfRecords> read_dxf_records(const std::string& name, std::string_view bytes);

}  // namespace csgrun
