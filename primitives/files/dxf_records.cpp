#include "primitives/files/dxf_records.h"

#include <algorithm>
#include <optional>

#include "primitives/files/dxf_groups.h"
#include "primitives/files/formats.h"
#include "primitives/files/text_scanner.h"

namespace csgrun {
namespace {

class DxfRecordReader {
 public:
  DxfRecordReader(const std::string& name, std::string_view text)
      : name_(name), groups_(name, text, TextScanner::line_end_of(text)), filer_(result_) {}

  Result<DxfRecords> read() {
    bool ended = false;
    while (!ended) {
      const Result<std::optional<DxfGroup>> group = groups_.next();
      if (!group) return group.error();
      if (*group && (*group)->code != 0) {
        record_.values.emplace_back((*group)->code, (*group)->value);
        continue;
      }
      if (auto error = file_record()) return *std::move(error);
      if (!*group) {
        if (auto error = check_end()) return *std::move(error);
        break;
      }
      record_ = DxfRecord();
      record_.kind = std::string((*group)->value);
      record_.line = (*group)->line;
      ended = record_.kind == "EOF";
    }
    if (ended) note_open_section();
    return std::move(result_);
  }

 private:
  std::optional<Error> file_record() {
    if (record_.kind.empty()) return std::nullopt;
    if (record_.kind == "SECTION") note_open_section();
    if (filer_.is_drawing()) {
      for (size_t i = 0; i < record_.values.size(); ++i) {
        const auto& [code, value] = record_.values[i];
        if (is_dxf_number(record_.kind, code) && !parse_finite(value))
          return not_a_dxf_number(name_, {code, value, record_.line_of(i)});
      }
      if (record_.kind == "LWPOLYLINE") {
        if (auto error = check_vertices()) return error;
      }
    }
    filer_.file(std::move(record_));
    return std::nullopt;
  }

  /// An X or Y alone, or another number of vertices than is said, is a sign of lost lines.
  [[nodiscard]] std::optional<Error> check_vertices() const {
    size_t xs = 0, ys = 0, said_line = 0;
    std::string_view said;
    for (size_t i = 0; i < record_.values.size(); ++i) {
      const auto& [code, value] = record_.values[i];
      if (code == 90) {
        said = value;
        said_line = record_.line_of(i);
      }
      if (code != 10 && code != 20) continue;
      if ((code == 10) != (xs == ys)) return no_pair(record_.line_of(i), code);
      ++(code == 10 ? xs : ys);
    }
    if (xs != ys) return no_pair(record_.line_of(record_.values.size() - 1), 0);
    if (said_line == 0 || parse_finite(said) == static_cast<double>(xs)) return std::nullopt;
    return malformed(name_, "line " + std::to_string(said_line),
                     "expected an LWPOLYLINE of " + quoted(said) + " vertices, got one of " +
                         std::to_string(xs));
  }

  /// `got` is what is there instead, 0 at the end of the entity.
  [[nodiscard]] Error no_pair(size_t line, int got) const {
    return malformed(name_, "line " + std::to_string(line),
                     std::string("expected group code ") + (got == 20 ? "10" : "20") +
                         " of a vertex of LWPOLYLINE, got " +
                         (got == 0 ? "its end" : std::to_string(got)));
  }

  /// That is one without ENDSEC before EOF or the next section: nothing need be missing.
  void note_open_section() {
    if (filer_.section_line() == 0 || has_open_section_) return;
    has_open_section_ = true;
    result_.notes.push_back(name_ + ":" + std::to_string(filer_.section_line()) + ": section " +
                            quoted(filer_.section()) + " has no ENDSEC");
  }

  /// Of a file without EOF: one that is cut off within a section has lost something.
  std::optional<Error> check_end() {
    const std::string place = "line " + std::to_string(groups_.line());
    if (filer_.section_line() != 0) {
      return malformed(name_, place,
                       "the file ends within section " + quoted(filer_.section()) +
                           ", which begins at line " + std::to_string(filer_.section_line()) +
                           "; expected ENDSEC");
    }
    result_.notes.push_back(malformed(name_, place, "the file has no EOF at its end").message);
    return std::nullopt;
  }

  const std::string& name_;
  DxfGroups groups_;
  DxfRecords result_;
  DxfFiler filer_;
  DxfRecord record_;
  bool has_open_section_ = false;
};

}  // namespace

double DxfRecord::number(int code, double otherwise) const {
  for (const auto& [key, value] : values) {
    if (key == code) return parse_finite(value).value_or(otherwise);
  }
  return otherwise;
}

std::string_view DxfRecord::value(int code) const {
  for (const auto& [key, value] : values) {
    if (key == code) return value;
  }
  return {};
}

Result<DxfRecords> read_dxf_records(const std::string& name, std::string_view bytes) {
  if (auto error = check_is_text_dxf(name, bytes)) return *std::move(error);
  if (bytes.starts_with(kByteOrderMark)) bytes.remove_prefix(kByteOrderMark.size());
  if (bytes.empty()) return malformed(name, "", "the file is empty");
  return DxfRecordReader(name, bytes).read();
}

}  // namespace csgrun
