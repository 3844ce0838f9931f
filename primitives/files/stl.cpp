// STL. Binary when the size is that of its count field (some binary files start with "solid"), else
// ASCII, else binary if there is more than its count says. Triangles are welded by equal
// coordinates; normals are ignored, the order of corners counts.
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <csgrun/engine/validate.h>

#include "primitives/files/byte_order.h"
#include "primitives/files/formats.h"
#include "primitives/files/text_scanner.h"

namespace csgrun {
namespace {

constexpr size_t kHeaderBytes = 84, kTriangleBytes = 50;

bool equals_ignoring_case(std::string_view word, std::string_view lower) {
  return std::equal(word.begin(), word.end(), lower.begin(), lower.end(),
                    [](char c, char d) { return lower_case(c) == d; });
}

/// Text without what some programs write behind it: NUL bytes, and the ^Z of old disks.
std::string_view without_padding(std::string_view text) {
  while (!text.empty() && (text.back() == '\0' || text.back() == '\x1a')) text.remove_suffix(1);
  return text;
}

void add_triangle(PolygonMesh& mesh) {
  const auto next = static_cast<uint32_t>(mesh.points.size());
  mesh.add_face(std::array<uint32_t, 3>{next - 3, next - 2, next - 1});
}

Result<PolygonMesh> parse_binary(const std::string& name, std::string_view bytes, uint64_t count) {
  PolygonMesh mesh;
  mesh.points.reserve(3 * count);
  for (uint64_t t = 0; t < count; ++t) {
    const size_t at = kHeaderBytes + kTriangleBytes * t;
    for (size_t corner = 0; corner < 3; ++corner) {
      glm::dvec3 p;
      for (int axis = 0; axis < 3; ++axis) {
        const size_t offset = at + 12 + 12 * corner + 4 * axis;
        p[axis] = read_float(bytes, offset, false);
        if (!std::isfinite(p[axis])) {
          return malformed(
              name, "byte " + std::to_string(offset),
              "triangle " + std::to_string(t) + " has a coordinate that is not finite");
        }
      }
      mesh.points.push_back(p);
    }
    add_triangle(mesh);
  }
  return mesh;
}

class AsciiReader {
 public:
  AsciiReader(const std::string& name, std::string_view text) : name_(name), scanner_(text) {}

  Result<PolygonMesh> read() {
    for (std::string_view word = scanner_.word_anywhere(); !word.empty();
         word = scanner_.word_anywhere()) {
      if (!equals_ignoring_case(word, "solid")) return unexpected("\"solid\"", word);
      scanner_.next_line();  // the rest of the line is a name
      if (auto error = read_solid()) return *error;
    }
    weld_points(mesh_);
    // A file that was cut off between two facets looks the same, but is open there.
    if (end_is_missing_ && check_mesh(mesh_).open_edges > 0) return *end_is_missing_;
    return std::move(mesh_);
  }

  /// Whether the last "endsolid" was not there.
  [[nodiscard]] bool end_is_missing() const { return end_is_missing_.has_value(); }

 private:
  Error unexpected(const std::string& wanted, std::string_view got) {
    if (got.empty()) {
      return malformed(name_, scanner_.place(), "the file ends where " + wanted + " should be");
    }
    return malformed(name_, scanner_.place(), "expected " + wanted + ", got " + quoted(got));
  }

  std::optional<Error> expect(std::string_view keyword) {
    const std::string_view word = scanner_.word_anywhere();
    if (equals_ignoring_case(word, keyword)) return std::nullopt;
    return unexpected(quoted(keyword), word);
  }

  /// Facets up to and with "endsolid".
  std::optional<Error> read_solid() {
    const size_t first = mesh_.face_count();
    for (;;) {
      const std::string_view word = scanner_.word_anywhere();
      if (equals_ignoring_case(word, "endsolid")) {
        scanner_.next_line();
        return std::nullopt;
      }
      if (!equals_ignoring_case(word, "facet")) {
        Error error = unexpected("\"facet\" or \"endsolid\"", word);
        if (!word.empty() || mesh_.face_count() == first) return error;
        end_is_missing_ = std::move(error);
        return std::nullopt;
      }
      if (auto error = read_facet()) return error;
    }
  }

  std::optional<Error> read_facet() {
    if (auto error = expect("normal")) return error;
    for (int i = 0; i < 3; ++i) {  // often 0 or nan: not used
      if (scanner_.word_anywhere().empty()) return unexpected("a number", {});
    }
    if (auto error = expect("outer")) return error;
    if (auto error = expect("loop")) return error;
    for (int corner = 0; corner < 3; ++corner) {
      if (auto error = expect("vertex")) return error;
      glm::dvec3 p;
      for (int axis = 0; axis < 3; ++axis) {
        const std::string_view word = scanner_.word_anywhere();
        const auto value = parse_finite(word);
        if (!value) return unexpected("a finite number", word);
        p[axis] = *value;
      }
      mesh_.points.push_back(p);
    }
    if (auto error = expect("endloop")) return error;
    if (auto error = expect("endfacet")) return error;
    add_triangle(mesh_);
    return std::nullopt;
  }

  const std::string& name_;
  TextScanner scanner_;
  PolygonMesh mesh_;
  std::optional<Error> end_is_missing_;  ///< what it is unless the mesh is closed
};

}  // namespace

Result<PolygonMesh> parse_stl(const std::string& name, std::string_view bytes,
                              std::vector<std::string>* notes) {
  const bool has_header = bytes.size() >= kHeaderBytes;
  const uint64_t count = has_header ? read_unsigned<4>(bytes, 80, false) : 0;
  const uint64_t binary_size = kHeaderBytes + kTriangleBytes * count;
  bool binary = has_header && bytes.size() == binary_size;
  std::string_view text = bytes;
  if (text.starts_with(kByteOrderMark)) text.remove_prefix(kByteOrderMark.size());
  const bool ascii = !binary && equals_ignoring_case(TextScanner(text).word_anywhere(), "solid") &&
                     bytes.substr(0, kHeaderBytes).find('\0') == std::string_view::npos;
  if (!binary && !ascii && has_header && count > 0 && bytes.size() > binary_size) {
    binary = true;
    if (notes != nullptr) {
      notes->push_back(std::to_string(bytes.size() - binary_size) +
                       " bytes after the last triangle passed over");
    }
  }
  if (!binary && !ascii) {
    if (!has_header) {
      return malformed(name, "byte 0",
                       "not an STL file: neither \"solid\" nor a header of 84 bytes");
    }
    Error error = malformed(name, "byte 80",
                            "not an STL file, or truncated: " + std::to_string(count) +
                                " triangles take " + std::to_string(binary_size) +
                                " bytes, the file has " + std::to_string(bytes.size()));
    if (bytes.size() < binary_size) error.code = ErrorCode::kLimit;
    return error;
  }
  if (binary) {
    Result<PolygonMesh> mesh = parse_binary(name, bytes, count);
    if (mesh) weld_points(*mesh);
    return mesh;
  }
  AsciiReader reader(name, without_padding(text));
  Result<PolygonMesh> mesh = reader.read();
  if (mesh && reader.end_is_missing() && notes != nullptr) {
    notes->push_back("ends without \"endsolid\"; solids behind it may be missing");
  }
  return mesh;
}

}  // namespace csgrun
