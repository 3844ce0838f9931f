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
  size_t line = 0;   ///< of the kind, in the file, from 1
  std::vector<std::pair<int, std::string_view>> values;

  /// The first value of a code; `otherwise` when there is none or it is no number.
  [[nodiscard]] double number(int code, double otherwise = 0) const;
  /// The first one, empty when there is none.
  [[nodiscard]] std::string_view value(int code) const;
  [[nodiscard]] std::string text(int code) const { return std::string(value(code)); }
  /// Where the i-th value is in the file: each group has two lines.
  [[nodiscard]] size_t line_of(size_t i) const { return line + 2 * (i + 1); }
};

/// The entities of the drawing, and those of its blocks by name.
struct DxfRecords {
  struct Block {
    double x = 0, y = 0;  ///< its base point
    std::vector<DxfRecord> entities;
  };
  std::vector<DxfRecord> entities;
  std::map<std::string, Block> blocks;
  std::vector<std::string> notes;
};

/// Errors: kMalformedFile, also for what is cut off, and for what is no number where what is drawn
/// depends on it.
Result<DxfRecords> read_dxf_records(const std::string& name, std::string_view bytes);

/// With what OpenSCAD makes of such files, and notes of it. Errors: kMalformedFile for the binary
/// form, kLimit.
Result<DxfRecords> read_dxf_records_as_openscad(const std::string& name, std::string_view bytes);

}  // namespace csgrun
