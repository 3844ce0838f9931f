// OFF in ASCII: [ST][C][N]OFF, three counts, points, faces, each with a colour or without on the
// rest of its line. Normals and texture coordinates are passed over.
#include <utility>
#include <vector>

#include "primitives/files/face_colours.h"
#include "primitives/files/formats.h"
#include "primitives/files/text_scanner.h"

namespace csgrun {
namespace {

/// What a first word says, one of OFF's names for three-dimensional meshes, of the lines of points.
struct Magic {
  bool has_colours = false, has_normals = false;
  /// What follows without a blank: data sets have "OFF12 20 0", the number of points.
  std::string_view rest;
};
std::optional<Magic> parse_magic(std::string_view word) {
  const auto take = [&](std::string_view part) {
    if (!word.starts_with(part)) return false;
    word.remove_prefix(part.size());
    return true;
  };
  Magic magic;
  take("ST");
  magic.has_colours = take("C");
  magic.has_normals = take("N");
  if (!take("OFF")) return std::nullopt;
  magic.rest = word;
  if (!word.empty() && !(word[0] >= '0' && word[0] <= '9')) return std::nullopt;
  return magic;
}

class OffReader {
 public:
  OffReader(const std::string& name, std::string_view text, std::vector<std::string>* notes)
      : name_(name), scanner_(text, '#'), notes_(notes) {}

  Result<PolygonMesh> read() {
    const std::string_view magic = scanner_.word_anywhere();
    const std::optional<Magic> parsed = parse_magic(magic);
    if (!parsed) return here("not an OFF file: it starts with " + quoted(magic));
    magic_ = *parsed;
    uint64_t points = 0, faces = 0;
    const std::string_view first = magic_.rest.empty() ? scanner_.word_anywhere() : magic_.rest;
    if (auto error = read_count("the number of points", first, points)) return *error;
    if (auto error = read_count("the number of faces", scanner_.word_anywhere(), faces))
      return *error;
    scanner_.next_line();  // the number of edges is not used, and not always there
    // A point takes "0 0 0\n" at least, a face "0\n", without the line end of the last: faces
    // of fewer than three corners are passed over, but may be there.
    if (auto error =
            check_count(name_, scanner_.place(), "points", points, 5, scanner_.remaining())) {
      return *error;
    }
    if (auto error =
            check_count(name_, scanner_.place(), "faces", faces, 2, scanner_.remaining() + 1)) {
      return *error;
    }
    mesh_.points.reserve(points);
    for (uint64_t i = 0; i < points; ++i) {
      if (auto error = read_point(i)) return *error;
    }
    mesh_.face_starts.reserve(faces + 1);
    mesh_.loop_starts.reserve(faces + 1);
    for (uint64_t i = 0; i < faces; ++i) {
      if (auto error = read_face(i)) return *error;
    }
    const std::string_view rest = scanner_.word_anywhere();
    if (!rest.empty()) return here("more data after the last face: " + quoted(rest));
    note_small_faces(small_faces_, notes_);
    colours_.apply(mesh_, notes_);
    return std::move(mesh_);
  }

 private:
  Error here(const std::string& what) { return malformed(name_, scanner_.place(), what); }

  /// The colour that the rest of the line holds.
  std::optional<Rgba> read_colour() {
    std::vector<std::string_view>& words = words_;
    words.clear();
    while (words.size() < 5) {
      const std::string_view word = scanner_.word();
      if (word.empty()) break;
      words.push_back(word);
    }
    return colour_of_words(words);
  }

  std::optional<Error> read_count(const std::string& what, std::string_view word, uint64_t& count) {
    const auto value = parse_integer<uint64_t>(word);
    if (!value) {
      if (word == "BINARY") return here("binary OFF is not supported");
      return here("expected " + what + ", got " + quoted(word));
    }
    count = *value;
    return std::nullopt;
  }

  std::optional<Error> read_point(uint64_t i) {
    glm::dvec3 p;
    std::string_view word = scanner_.word_anywhere();
    for (int axis = 0; axis < 3; ++axis) {
      const auto value = parse_finite(word);
      if (!value) {
        return here(word.empty() ? "the line ends in point " + std::to_string(i)
                                 : "expected a finite number in point " + std::to_string(i) +
                                       ", got " + quoted(word));
      }
      p[axis] = *value;
      if (axis < 2) word = scanner_.word();
    }
    mesh_.points.push_back(p);
    if (magic_.has_colours) {
      for (int n = 0; magic_.has_normals && n < 3; ++n) scanner_.word();
      if (const auto colour = read_colour()) {
        colours_.set_vertex(mesh_.points.size() - 1, *colour);
      }
    }
    scanner_.next_line();
    return std::nullopt;
  }

  std::optional<Error> read_face(uint64_t i) {
    const std::string which = "face " + std::to_string(i);
    const std::string_view word = scanner_.word_anywhere();
    const auto count = parse_integer<uint64_t>(word);
    if (!count) {
      return here(word.empty()
                      ? "the file ends before " + which
                      : "expected the number of corners of " + which + ", got " + quoted(word));
    }
    if (auto error =
            check_count(name_, scanner_.place(), "corners", *count, 2, scanner_.remaining())) {
      return error;
    }
    loop_.clear();
    for (uint64_t k = 0; k < *count; ++k) {
      const std::string_view index_word = scanner_.word_anywhere();
      const auto index = parse_integer<int64_t>(index_word);
      if (!index) {
        return here(index_word.empty()
                        ? "the file ends in " + which
                        : "expected an index in " + which + ", got " + quoted(index_word));
      }
      if (*index < 0 || static_cast<uint64_t>(*index) >= mesh_.points.size()) {
        return here("index " + std::to_string(*index) + " of " + which +
                    " is out of range, there are " + std::to_string(mesh_.points.size()) +
                    " points");
      }
      loop_.push_back(static_cast<uint32_t>(*index));
    }
    if (loop_.size() < 3) {
      small_faces_.add(which);
    } else {
      mesh_.add_face(loop_);
      if (const auto colour = read_colour()) colours_.set_face(mesh_.face_count() - 1, *colour);
    }
    scanner_.next_line();
    return std::nullopt;
  }

  const std::string& name_;
  TextScanner scanner_;
  std::vector<std::string>* notes_;
  Magic magic_;
  PolygonMesh mesh_;
  FaceColours colours_;
  PassedOver small_faces_;
  std::vector<uint32_t> loop_;
  std::vector<std::string_view> words_;
};

}  // namespace

Result<PolygonMesh> parse_off(const std::string& name, std::string_view bytes,
                              std::vector<std::string>* notes) {
  return OffReader(name, bytes, notes).read();
}

}  // namespace csgrun
