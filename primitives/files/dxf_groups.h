// DXF as groups, a code in one line and its value in the next, and where what they make up belongs.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include <csgrun/engine/error.h>

#include "primitives/files/dxf_records.h"

namespace csgrun {

struct DxfGroup {
  int code = 0;
  std::string_view value;
  size_t line = 0;  ///< of the value, from 1
};

class DxfGroups {
 public:
  DxfGroups(const std::string& name, std::string_view text, char line_end)
      : name_(name), text_(text), line_end_(line_end) {}

  /// Nothing at the end of the text. Errors: a code that is no number, or that has no value.
  Result<std::optional<DxfGroup>> next();
  /// The last one that was read, from 1.
  [[nodiscard]] size_t line() const { return line_; }

 private:
  [[nodiscard]] bool at_end() const { return at_ >= text_.size(); }
  std::string_view take();

  const std::string& name_;
  std::string_view text_;
  char line_end_;
  size_t at_ = 0, line_ = 0;
};

/// Whether what is drawn depends on the number that such an entity, or block, has by this code.
bool is_dxf_number(const std::string& kind, int code);

/// 'expected a number for group code 10, got "1O"'.
Error not_a_dxf_number(const std::string& name, const DxfGroup& group);

/// An error for the binary form.
std::optional<Error> check_is_text_dxf(const std::string& name, std::string_view bytes);

/// Puts entities into the drawing or one of its blocks, by the records of sections and blocks.
class DxfFiler {
 public:
  explicit DxfFiler(DxfRecords& records) : records_(records) {}

  void file(DxfRecord record);
  /// Whether a record that is no ENDSEC belongs to the drawing or its blocks.
  [[nodiscard]] bool is_drawing() const { return section_ == "ENTITIES" || section_ == "BLOCKS"; }
  [[nodiscard]] const std::string& section() const { return section_; }
  /// Where the section begins whose end has not come yet; 0 outside sections.
  [[nodiscard]] size_t section_line() const { return section_line_; }

 private:
  DxfRecords& records_;
  DxfRecords::Block* block_ = nullptr;
  std::string section_;
  size_t section_line_ = 0;
};

}  // namespace csgrun
