// OFF in ASCII: [ST][C][N]OFF, three counts, points, faces, each with a colour or without on the
// rest of its line; or all of them on one line, without colours. Normals and texture coordinates
// are passed over.
#include <algorithm>
#include <utility>
#include <vector>

#include "primitives/files/face_colours.h"
#include "primitives/files/formats.h"
#include "primitives/files/text_scanner.h"

namespace csgrun {
namespace {

/// What a first word says, one of OFF's names for three-dimensional meshes, of the lines of points.
struct Magic {
  bool has_texture = false, has_colours = false, has_normals = false;
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
  magic.has_texture = take("ST");
  magic.has_colours = take("C");
  magic.has_normals = take("N");
  if (!take("OFF") && !take("off")) return std::nullopt;
  magic.rest = word;
  if (!word.empty() && !parse_integer<uint64_t>(word)) return std::nullopt;
  return magic;
}

/// Whether a first word is one of OFF's names for points of other dimensions.
bool has_other_dimension(std::string_view word) {
  return word.ends_with("OFF") && word.find_first_of("4n") != std::string_view::npos &&
         word.find_first_not_of("STCN4n") == word.size() - 3;
}

class OffReader {
 public:
  OffReader(const std::string& name, std::string_view text, std::vector<std::string>* notes)
      : name_(name), scanner_(text, '#'), notes_(notes) {}

  Result<PolygonMesh> read() {
    const std::string_view magic = scanner_.word_anywhere();
    const std::optional<Magic> parsed = parse_magic(magic);
    if (has_other_dimension(magic)) {
      return here("OFF with points of other than three coordinates is not supported: " +
                  quoted(magic));
    }
    if (!parsed) return no_off(magic);
    magic_ = *parsed;
    uint64_t points = 0, faces = 0;
    if (auto error = read_counts(magic, points, faces)) return *error;
    // A point takes "0 0 0\n" at least, a face "0\n", without the line end of the last: faces
    // of fewer than three corners are passed over, but may be there.
    if (auto error = check("points", points, 5, scanner_.remaining())) return *error;
    if (auto error = check("faces", faces, 2, scanner_.remaining() + 1)) return *error;
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
  std::optional<Error> check(std::string_view what, uint64_t count, uint64_t bytes_each,
                             uint64_t present) {
    return check_count(
        name_, [&] { return scanner_.place(); }, what, count, bytes_each, present);
  }
  Error no_off(std::string_view magic) {
    return here("not an OFF file: it starts with " + quoted(magic));
  }

  /// The colour that the rest of the line holds, before so many other words.
  std::optional<Rgba> read_colour(size_t others = 0) {
    std::vector<std::string_view>& words = words_;
    words.clear();
    while (words.size() < 5 + others) {
      const std::string_view word = scanner_.word();
      if (word.empty()) break;
      words.push_back(word);
    }
    words.resize(words.size() - std::min(words.size(), others));
    return colour_of_words(words);
  }

  /// The counts, up to where points begin.
  std::optional<Error> read_counts(std::string_view magic, uint64_t& points, uint64_t& faces) {
    const bool is_joined = !magic_.rest.empty();
    const std::string_view first = is_joined ? magic_.rest : scanner_.word_anywhere();
    if (auto error = read_count("the number of points", first, points)) return error;
    const std::string_view second = is_joined ? scanner_.word() : scanner_.word_anywhere();
    if (is_joined && second.empty()) return no_off(magic);  // "OFF3", and the counts below
    if (auto error = read_count("the number of faces", second, faces)) return error;
    const std::string_view edges = scanner_.word();  // not used, and not always there
    if (is_joined && !scanner_.is_line_end()) return no_off(magic);
    is_one_line_ = ends_with_next_line(scanner_);
    if (!is_one_line_) {
      scanner_.next_line();
      return std::nullopt;
    }
    uint64_t edge_count = 0;
    if (!edges.empty()) {
      if (auto error = read_count("the number of edges", edges, edge_count)) return error;
    }
    if (magic_.has_colours) {  // which may be three numbers or four
      return here("one line follows the counts, but points with colours need one each");
    }
    return std::nullopt;
  }

  /// Whether a scanner has words left, all of them on one line.
  static bool ends_with_next_line(TextScanner ahead) {
    if (ahead.word_anywhere().empty()) return false;
    ahead.next_line();
    return ahead.word_anywhere().empty();
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
    for (int n = 0; magic_.has_normals && n < 3; ++n) scanner_.word();
    const size_t after = magic_.has_texture ? 2 : 0;
    if (magic_.has_colours) {
      if (const auto colour = read_colour(after)) {
        colours_.set_vertex(mesh_.points.size() - 1, *colour);
      }
    }
    if (is_one_line_) {
      for (size_t n = 0; n < after; ++n) scanner_.word();
    } else {
      scanner_.next_line();
    }
    return std::nullopt;
  }

  std::optional<Error> read_face(uint64_t i) {
    const auto which = [&] { return "face " + std::to_string(i); };
    const std::string_view word = scanner_.word_anywhere();
    const auto count = parse_integer<uint64_t>(word);
    if (!count) {
      return here(word.empty()
                      ? "the file ends before " + which()
                      : "expected the number of corners of " + which() + ", got " + quoted(word));
    }
    if (auto error = check("corners", *count, 2, scanner_.remaining())) return error;
    loop_.clear();
    for (uint64_t k = 0; k < *count; ++k) {
      const std::string_view index_word = scanner_.word_anywhere();
      const auto index = parse_integer<int64_t>(index_word);
      if (!index) {
        return here(index_word.empty()
                        ? "the file ends in " + which()
                        : "expected an index in " + which() + ", got " + quoted(index_word));
      }
      if (*index < 0 || static_cast<uint64_t>(*index) >= mesh_.points.size()) {
        return here("index " + std::to_string(*index) + " of " + which() +
                    " is out of range, there are " + std::to_string(mesh_.points.size()) +
                    " points");
      }
      loop_.push_back(static_cast<uint32_t>(*index));
    }
    if (loop_.size() < 3) {
      // Without lines to go by, a wrong number of points is seen by this.
      if (is_one_line_) return here(which() + " has fewer than three corners");
      small_faces_.add(which());
    } else {
      mesh_.add_face(loop_);
      if (is_one_line_) return std::nullopt;  // a colour cannot be told from the next face
      if (const auto colour = read_colour()) colours_.set_face(mesh_.face_count() - 1, *colour);
    }
    if (!is_one_line_) scanner_.next_line();
    return std::nullopt;
  }

  const std::string& name_;
  TextScanner scanner_;
  std::vector<std::string>* notes_;
  Magic magic_;
  bool is_one_line_ = false;  ///< all that follows the counts
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
