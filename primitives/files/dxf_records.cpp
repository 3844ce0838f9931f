#include "primitives/files/dxf_records.h"

#include <algorithm>
#include <charconv>

#include "primitives/files/formats.h"
#include "primitives/files/text_scanner.h"

namespace csgrun {
namespace {

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && (text.front() == ' ' || text.front() == '\t')) text.remove_prefix(1);
  while (!text.empty() && (text.back() == ' ' || text.back() == '\t' || text.back() == '\r'))
    text.remove_suffix(1);
  return text;
}

class Lines {
 public:
  explicit Lines(std::string_view text) : text_(text) {}
  [[nodiscard]] bool at_end() const { return at_ >= text_.size(); }
  [[nodiscard]] size_t line() const { return line_; }
  std::string_view take() {
    const size_t end = std::min(text_.find('\n', at_), text_.size());
    const std::string_view line = trimmed(text_.substr(at_, end - at_));
    at_ = end + 1;
    ++line_;
    return line;
  }

 private:
  std::string_view text_;
  size_t at_ = 0, line_ = 0;
};

}  // namespace

double DxfRecord::number(int code, double otherwise) const {
  for (const auto& [key, value] : values) {
    if (key == code) return parse_finite(value).value_or(otherwise);
  }
  return otherwise;
}

std::string DxfRecord::text(int code) const {
  for (const auto& [key, value] : values) {
    if (key == code) return std::string(value);
  }
  return {};
}

Result<DxfRecords> read_dxf_records(const std::string& name, std::string_view bytes) {
  if (bytes.starts_with("AutoCAD Binary DXF"))
    return malformed(name, "", "this is a binary DXF, and only the text form is read");
  DxfRecords result;
  Lines lines(bytes);
  DxfRecord record;
  std::string section;
  DxfRecords::Block* block = nullptr;
  bool ended = false;
  // Files a record where it belongs, when the next one begins.
  const auto file_record = [&] {
    const std::string& kind = record.kind;
    if (kind == "SECTION") {
      section = record.text(2);
    } else if (kind == "ENDSEC") {
      section.clear();
      block = nullptr;
    } else if (kind == "EOF") {
      ended = true;
    } else if (section == "BLOCKS" && kind == "BLOCK") {
      block = &result.blocks[record.text(2)];
      block->x = record.number(10);
      block->y = record.number(20);
    } else if (section == "BLOCKS" && kind == "ENDBLK") {
      block = nullptr;
    } else if (section == "BLOCKS" && block != nullptr) {
      block->entities.push_back(std::move(record));
    } else if (section == "ENTITIES") {
      result.entities.push_back(std::move(record));
    }
    record = DxfRecord();
  };
  while (!lines.at_end() && !ended) {
    const std::string_view code_text = lines.take();
    if (code_text.empty() && lines.at_end()) break;
    int code = 0;
    const auto [rest, error] =
        std::from_chars(code_text.data(), code_text.data() + code_text.size(), code);
    if (error != std::errc() || rest != code_text.data() + code_text.size()) {
      return malformed(name, "line " + std::to_string(lines.line()),
                       "expected a group code, got " + csgrun::quoted(code_text));
    }
    if (lines.at_end()) {
      return malformed(name, "line " + std::to_string(lines.line()),
                       "the file ends within a group");
    }
    const std::string_view value = lines.take();
    if (code == 0) {
      if (!record.kind.empty()) file_record();
      record.kind = std::string(value);
      record.line = lines.line();
    } else {
      record.values.emplace_back(code, value);
    }
  }
  if (!record.kind.empty() && !ended) file_record();
  return result;
}

}  // namespace csgrun
