// Records of a DXF as OpenSCAD 2021 reads them where the file is damaged: what is no number is
// passed over, and an entity that lacks coordinates then waits for those of what follows.
#include <algorithm>
#include <array>
#include <map>
#include <optional>

#include "primitives/files/dxf_groups.h"
#include "primitives/files/dxf_records.h"
#include "primitives/files/flat_curves.h"
#include "primitives/files/formats.h"
#include "primitives/files/text_scanner.h"

namespace csgrun {
namespace {

class OpenScadRecordReader {
 public:
  OpenScadRecordReader(const std::string& name, std::string_view text)
      : name_(name), groups_(name, text, '\n'), filer_(result_) {}

  Result<DxfRecords> read() {
    for (;;) {
      const Result<std::optional<DxfGroup>> group = groups_.next();
      if (!group || !*group) {
        note_end(group ? "" : group.error().message);
        break;
      }
      if ((*group)->code != 0) {
        add(**group);
        continue;
      }
      if (auto error = end_record()) return *std::move(error);
      if ((*group)->value == "EOF") break;
      if (waits_) continue;
      record_ = DxfRecord();
      has_gap_ = false;
      x_.clear();
      y_.clear();
      record_.kind = std::string((*group)->value);
      record_.line = (*group)->line;
    }
    note_unreadable();
    return std::move(result_);
  }

 private:
  static bool is_x(int code) { return code == 10 || code == 11; }
  static bool is_y(int code) { return code == 20 || code == 21; }

  void add(const DxfGroup& group) {
    const bool counts = filer_.is_drawing() && (is_x(group.code) || is_y(group.code) ||
                                                is_dxf_number(record_.kind, group.code));
    if (!counts || parse_finite(group.value)) {
      if (is_x(group.code)) x_.push_back(group.value);
      if (is_y(group.code)) y_.push_back(group.value);
      if (waits_) {
        replace(group.code, group.value);
      } else {
        record_.values.emplace_back(group.code, group.value);
      }
      return;
    }
    if (unreadable_++ == 0) {
      first_unreadable_ = not_a_dxf_number(name_, group).message;
    }
    if (is_x(group.code) || is_y(group.code)) has_gap_ = true;
  }

  /// What waits has one value a code, the last, of those that matter.
  void replace(int code, std::string_view value) {
    constexpr int kName = 2, kLayer = 8;
    if (is_x(code) || is_y(code)) return;
    if (code != kName && code != kLayer && !is_dxf_number(record_.kind, code)) return;
    std::erase_if(record_.values, [&](const auto& v) { return v.first == code; });
    record_.values.emplace_back(code, value);
  }

  void begin_to_wait() {
    if (lacking_++ == 0) {
      result_.notes.push_back(
          name_ + ":" + std::to_string(record_.line) + ": this " + record_.kind +
          " lacks coordinates, and takes those of what follows, as in OpenSCAD");
    }
    std::map<int, std::string_view> last;
    for (const auto& [code, value] : record_.values) last[code] = value;
    record_.values.clear();
    for (const auto& [code, value] : last) replace(code, value);
  }

  /// Files a record, unless it lacks coordinates: then it stays and takes those of the next.
  std::optional<Error> end_record() {
    if (record_.kind.empty()) return std::nullopt;
    if (record_.kind == "ELLIPSE") add_missing_zeros();
    const bool waited = waits_;
    waits_ = filer_.is_drawing() && lacks_coordinates(x_.size(), y_.size());
    if (!waits_) {
      if (waited || (has_gap_ && is_drawn_by_openscad())) {
        if (auto error = put_coordinates()) return error;
      }
      if (!is_empty_ellipse()) filer_.file(std::move(record_));
      return std::nullopt;
    }
    if (!waited) begin_to_wait();
    // The lines up to the point that is not there are drawn, each time.
    const size_t points = std::min(x_.size(), y_.size());
    const std::string_view layer = record_.value(8);
    for (size_t i = 1; record_.kind == "LWPOLYLINE" && i < points; ++i) {
      DxfRecord line;
      line.kind = "LINE";
      line.line = record_.line;
      line.values = {{10, x_[i - 1]}, {20, y_[i - 1]}, {11, x_[i]}, {21, y_[i]}, {8, layer}};
      if (auto error = count_points(2)) return error;
      filer_.file(std::move(line));
    }
    return std::nullopt;
  }

  [[nodiscard]] bool is_drawn_by_openscad() const {
    constexpr std::array<std::string_view, 6> kDrawn{"LINE",    "CIRCLE",     "ARC",
                                                     "ELLIPSE", "LWPOLYLINE", "INSERT"};
    return std::find(kDrawn.begin(), kDrawn.end(), record_.kind) != kDrawn.end();
  }

  [[nodiscard]] bool lacks_coordinates(size_t xs, size_t ys) const {
    const std::string& kind = record_.kind;
    const size_t least = std::min(xs, ys), most = std::max(xs, ys);
    if (kind == "LINE" || kind == "ELLIPSE") return least < 2;
    if (kind == "CIRCLE" || kind == "ARC") return least < 1;
    if (kind == "INSERT") {
      const auto block = result_.blocks.find(record_.text(2));
      return least < 1 && block != result_.blocks.end() && !block->second.entities.empty();
    }
    if (kind != "LWPOLYLINE") return false;
    const bool closed = (static_cast<int>(std::clamp(record_.number(70), 0.0, 65535.0)) & 1) != 0;
    return most < 2 ? closed && least < 1 : least != most;
  }

  std::optional<Error> count_points(size_t count) {
    points_ += count;
    if (points_ <= kMostDrawingPoints) return std::nullopt;
    return Error{ErrorCode::kLimit,
                 name_ + ": unfolds to more than " + std::to_string(kMostDrawingPoints) + " points",
                 {}};
  }

  /// In pairs, in the order in which they come.
  std::optional<Error> put_coordinates() {
    const bool is_polyline = record_.kind == "LWPOLYLINE";
    const size_t points = std::min({x_.size(), y_.size(), is_polyline ? x_.size() : 2});
    if (auto error = count_points(points)) return error;
    std::erase_if(record_.values, [](const auto& v) { return is_x(v.first) || is_y(v.first); });
    for (size_t i = 0; i < points; ++i) {
      const int second = !is_polyline && i == 1 ? 1 : 0;
      record_.values.emplace_back(10 + second, x_[i]);
      record_.values.emplace_back(20 + second, y_[i]);
    }
    return std::nullopt;
  }

  /// Of an ellipse's ratio and last angle, whose defaults are others in the format.
  void add_missing_zeros() {
    for (const int code : {40, 42}) {
      if (record_.text(code).empty()) record_.values.emplace_back(code, "0");
    }
  }

  /// From 0 to 0 is no turn in OpenSCAD.
  [[nodiscard]] bool is_empty_ellipse() const {
    return record_.kind == "ELLIPSE" && record_.number(41) == 0 && record_.number(42) == 0;
  }

  /// The last record is read to its end only by the next one's beginning.
  void note_end(const std::string& error) {
    if (!error.empty()) result_.notes.push_back(error + "; the rest is left out, as in OpenSCAD");
    if (!filer_.is_drawing() || record_.kind.empty() || record_.kind == "ENDSEC") return;
    result_.notes.push_back(name_ + ":" + std::to_string(groups_.line()) +
                            ": the file ends without an EOF; " + record_.kind + " of line " +
                            std::to_string(record_.line) + " left out, as in OpenSCAD");
  }

  void note_unreadable() {
    if (unreadable_ == 0) return;
    result_.notes.push_back(first_unreadable_ + "; passed over, as in OpenSCAD (" +
                            std::to_string(unreadable_) + ")");
  }

  const std::string& name_;
  DxfGroups groups_;
  DxfRecords result_;
  DxfFiler filer_;
  DxfRecord record_;
  std::vector<std::string_view> x_, y_;  ///< of the record, where they can be read
  bool waits_ = false, has_gap_ = false;
  size_t unreadable_ = 0, lacking_ = 0, points_ = 0;
  std::string first_unreadable_;
};

}  // namespace

Result<DxfRecords> read_dxf_records_as_openscad(const std::string& name, std::string_view bytes) {
  if (auto error = check_is_text_dxf(name, bytes)) return *std::move(error);
  if (!bytes.empty() && TextScanner::line_end_of(bytes) == '\r') {
    DxfRecords nothing;
    if (bytes.find('\r') != std::string_view::npos)
      nothing.notes.push_back(name + ": its lines end in no line feed, so OpenSCAD reads nothing");
    return nothing;
  }
  return OpenScadRecordReader(name, bytes).read();
}

}  // namespace csgrun
