#include "primitives/files/dxf_groups.h"

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

#include "primitives/files/formats.h"
#include "primitives/files/text_scanner.h"

namespace csgrun {

std::string_view DxfGroups::take() {
  const auto is_blank = [](char c) { return c == ' ' || c == '\t' || c == '\r'; };
  const size_t end = std::min(text_.find(line_end_, at_), text_.size());
  std::string_view line = text_.substr(at_, end - at_);
  while (!line.empty() && is_blank(line.front())) line.remove_prefix(1);
  while (!line.empty() && is_blank(line.back())) line.remove_suffix(1);
  at_ = end + 1;
  ++line_;
  return line;
}

Result<std::optional<DxfGroup>> DxfGroups::next() {
  if (at_end()) return std::optional<DxfGroup>();
  const std::string_view code_text = take();
  if (code_text.empty() && at_end()) return std::optional<DxfGroup>();
  const std::string place = "line " + std::to_string(line_);
  const std::optional<int> code = parse_integer<int>(code_text);
  if (!code) return malformed(name_, place, "expected a group code, got " + quoted(code_text));
  if (at_end()) return malformed(name_, place, "the file ends within a group");
  const std::string_view value = take();
  return std::optional<DxfGroup>({*code, value, line_});
}

bool is_dxf_number(const std::string& kind, int code) {
  static const std::map<std::string, std::vector<int>> kUsed{
      {"LINE", {10, 20, 11, 21}},
      {"CIRCLE", {10, 20, 40, 210, 220, 230}},
      {"ARC", {10, 20, 40, 50, 51, 210, 220, 230}},
      {"ELLIPSE", {10, 20, 11, 21, 40, 41, 42, 210, 220, 230}},
      {"LWPOLYLINE", {10, 20, 42, 70, 90, 210, 220, 230}},
      {"POLYLINE", {70, 210, 220, 230}},
      {"VERTEX", {10, 20, 42, 70}},
      {"SPLINE", {10, 20, 40, 41, 71}},
      {"INSERT", {10, 20, 41, 42, 44, 45, 50, 70, 71, 210, 220, 230}},
      {"BLOCK", {10, 20}}};
  constexpr int kInvisible = 60, kInPaperSpace = 67;
  if (code == kInvisible || code == kInPaperSpace) return true;
  const auto used = kUsed.find(kind);
  return used != kUsed.end() &&
         std::find(used->second.begin(), used->second.end(), code) != used->second.end();
}

Error not_a_dxf_number(const std::string& name, const DxfGroup& group) {
  return malformed(name, "line " + std::to_string(group.line),
                   "expected a number for group code " + std::to_string(group.code) + ", got " +
                       quoted(group.value));
}

std::optional<Error> check_is_text_dxf(const std::string& name, std::string_view bytes) {
  if (!bytes.starts_with("AutoCAD Binary DXF")) return std::nullopt;
  return malformed(name, "", "this is a binary DXF, and only the text form is read");
}

void DxfFiler::file(DxfRecord record) {
  const std::string& kind = record.kind;
  if (kind == "SECTION") {
    section_ = record.text(2);
    section_line_ = record.line;
  } else if (kind == "ENDSEC") {
    section_.clear();
    section_line_ = 0;
    block_ = nullptr;
  } else if (section_ == "BLOCKS" && kind == "BLOCK") {
    block_ = &records_.blocks[record.text(2)];
    block_->x = record.number(10);
    block_->y = record.number(20);
  } else if (section_ == "BLOCKS" && kind == "ENDBLK") {
    block_ = nullptr;
  } else if (section_ == "BLOCKS" && block_ != nullptr) {
    block_->entities.push_back(std::move(record));
  } else if (section_ == "ENTITIES") {
    records_.entities.push_back(std::move(record));
  }
}

}  // namespace csgrun
