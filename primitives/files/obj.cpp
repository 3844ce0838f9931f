// Wavefront OBJ: points and polygons, and where objects begin. Texture coordinates, normals,
// groups, materials, lines and the like are passed over; so, with a note, are statements that OBJ
// does not know, since programs have some of their own. What is no word at all is an error.
#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include <csgrun/primitives/file_path.h>

#include "primitives/files/formats.h"
#include "primitives/files/text_scanner.h"

namespace csgrun {
namespace {

/// What is read of all that may start a line.
constexpr std::array<std::string_view, 6> kRead{"v", "f", "fo", "o", "mtllib", "usemtl"};

/// Everything else. Sorted.
constexpr std::array<std::string_view, 34> kPassedOver{
    "bevel", "bmat",      "c_interp", "call",   "con",  "csh",        "cstype", "ctech", "curv",
    "curv2", "d_interp",  "deg",      "end",    "g",    "hole",       "l",      "lod",   "maplib",
    "mg",    "p",         "parm",     "s",      "scrv", "shadow_obj", "sp",     "stech", "step",
    "surf",  "trace_obj", "trim",     "usemap", "vn",   "vp",         "vt"};

bool is_passed_over(std::string_view word) {
  return std::binary_search(kPassedOver.begin(), kPassedOver.end(), word);
}

bool is_known(std::string_view word) {
  return std::find(kRead.begin(), kRead.end(), word) != kRead.end() || is_passed_over(word);
}

/// Of names, the last character may be a backslash.
bool has_names(std::string_view word) {
  constexpr std::array<std::string_view, 10> kWithNames{
      "o", "g", "mtllib", "usemtl", "usemap", "maplib", "shadow_obj", "trace_obj", "call", "csh"};
  return std::find(kWithNames.begin(), kWithNames.end(), word) != kWithNames.end();
}

bool is_name(std::string_view word) {
  return std::all_of(word.begin(), word.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
  });
}

/// "C:\\models\\a.mtl", without a way upwards in it.
bool is_on_a_drive(std::string_view path) {
  const auto is_letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); };
  if (path.size() < 3 || !is_letter(path[0]) || path[1] != ':') return false;
  std::string rest(path.substr(2));
  std::replace(rest.begin(), rest.end(), '\\', '/');
  return rest[0] == '/' && !leads_out_of_folder(std::string_view(rest).substr(1));
}

std::string in_lower_case(std::string_view word) {
  std::string lower(word);
  std::transform(lower.begin(), lower.end(), lower.begin(), lower_case);
  return lower;
}

class ObjReader {
 public:
  ObjReader(const std::string& name, std::string_view text, std::vector<std::string>* notes)
      : name_(name), scanner_(text, '#'), notes_(notes) {}

  Result<PolygonMesh> read() {
    do {
      const std::string_view written = next();
      // Some programs write capitals, which are no statements of their own.
      const std::string lower = is_known(written) ? std::string() : in_lower_case(written);
      const std::string_view word = is_known(lower) ? lower : written;
      has_no_names_ = is_known(word) && !has_names(word);
      std::optional<Error> error;
      if (word == "v") {
        error = read_point();
      } else if (word == "f" || word == "fo") {
        error = read_face();
      } else if (word == "o") {
        begin_object();
      } else if (word == "mtllib") {
        error = read_material_file();
      } else if (word == "usemtl") {
        material_ = scanner_.rest_of_line();
      } else if (!word.empty() && !is_passed_over(word)) {
        if (!is_name(word)) return here("not an OBJ statement: " + quoted(word));
        unknown_.add(scanner_.place() + ": " + quoted(word));
      }
      if (error) return *error;
    } while (next_statement());
    for (const Forward& f : forward_) {
      if (f.index >= mesh_.points.size()) return out_of_range(f.line, f.index + 1);
    }
    note_what_was_passed_over();
    if (!objects_.empty() && objects_.back().first_face == mesh_.face_count()) objects_.pop_back();
    return std::move(mesh_);
  }

  std::vector<MeshObject> take_objects() { return std::move(objects_); }
  std::vector<std::string> take_material_files() { return std::move(material_files_); }

 private:
  /// An object that had no faces gives way to the next one.
  void begin_object() {
    const auto first = static_cast<uint32_t>(mesh_.face_count());
    if (objects_.empty() || objects_.back().first_face != first) objects_.emplace_back();
    objects_.back() = {rest_of_statement(), first};
  }

  std::string rest_of_statement() {
    std::string text;
    const auto next_word = [&] { return next(&TextScanner::word_of_name); };
    for (std::string_view word = next_word(); !word.empty(); word = next_word()) {
      text += (text.empty() ? "" : " ") + std::string(word);
    }
    return text;
  }

  void note_what_was_passed_over() {
    note_small_faces(small_faces_, notes_);
    if (unknown_.count > 0 && notes_ != nullptr) {
      notes_->push_back(
          (unknown_.count == 1 ? "1 line" : std::to_string(unknown_.count) + " lines") +
          " with statements that OBJ does not know passed over (first: " + unknown_.first + ")");
    }
  }

  /// A model from somewhere must not make us read what lies elsewhere. One that tries is refused;
  /// but a place on the disk of who wrote it ("C:\\models\\a.mtl") is what exporters write by
  /// habit: no colours.
  std::optional<Error> read_material_file() {
    const std::string path(scanner_.rest_of_line());
    if (path.empty()) return std::nullopt;
    if (!leads_out_of_folder(path)) {
      material_files_.push_back(path);
      return std::nullopt;
    }
    const std::string what = "mtllib " + quoted(path) + " leads out of the file's folder";
    if (!is_on_a_drive(path)) {
      return here(what +
                  ": put that file beside the mesh and name it without a path, or take the "
                  "line out");
    }
    if (notes_ != nullptr) notes_->push_back(scanner_.place() + ": no colours: " + what);
    return std::nullopt;
  }

  /// The number of the appearance that stands for the material in use.
  uint32_t appearance() {
    auto& looks = mesh_.appearances;
    const auto known = std::find_if(looks.begin(), looks.end(),
                                    [&](const Appearance& a) { return a.name == material_; });
    if (known != looks.end()) return static_cast<uint32_t>(known - looks.begin());
    looks.emplace_back().name = material_;
    return static_cast<uint32_t>(looks.size() - 1);
  }

  /// An index of a point that had not been read yet.
  struct Forward {
    uint32_t index;
    size_t line;
  };

  Error here(const std::string& what) { return malformed(name_, scanner_.place(), what); }

  Error out_of_range(size_t line, int64_t index) {
    return malformed(name_, "line " + std::to_string(line),
                     "face index " + std::to_string(index) + " is out of range, there are " +
                         std::to_string(mesh_.points.size()) + " points");
  }

  /// The next word of a statement, which goes on after a backslash at the end of a line; where it
  /// may be the last character of a name, after one that stands by itself.
  std::string_view next(std::string_view (TextScanner::*word_of)() = &TextScanner::word) {
    for (;;) {
      if (goes_on_ && !scanner_.next_line()) return {};
      std::string_view word = (scanner_.*word_of)();
      goes_on_ =
          word.ends_with('\\') && (has_no_names_ || word.size() == 1) && scanner_.is_line_end();
      if (!goes_on_) return word;
      word.remove_suffix(1);
      if (!word.empty()) return word;
    }
  }

  /// Goes to the line behind the statement; false at the end of the text.
  bool next_statement() {
    while (!next().empty()) continue;
    goes_on_ = false;
    has_no_names_ = true;
    return scanner_.next_line();
  }

  std::optional<Error> read_point() {
    glm::dvec3 p;
    for (int axis = 0; axis < 3; ++axis) {
      const std::string_view word = next();
      const auto value = parse_finite(word);
      if (!value) return here("expected a finite coordinate, got " + quoted(word));
      p[axis] = *value;
    }
    mesh_.points.push_back(p);  // a weight or a colour may follow
    return std::nullopt;
  }

  std::optional<Error> read_face() {
    loop_.clear();
    for (std::string_view word = next(); !word.empty(); word = next()) {
      const auto index = parse_integer<int64_t>(word.substr(0, word.find('/')));
      if (!index || *index == 0) return here("expected a face index, got " + quoted(word));
      const auto count = static_cast<int64_t>(mesh_.points.size());
      constexpr int64_t kMostPoints = 0xffffffff;
      const int64_t zero_based = *index > 0 ? *index - 1 : count + *index;
      if (zero_based < 0 || zero_based >= kMostPoints) return out_of_range(scanner_.line(), *index);
      if (zero_based >= count) {
        forward_.push_back({static_cast<uint32_t>(zero_based), scanner_.line()});
      }
      loop_.push_back(static_cast<uint32_t>(zero_based));
    }
    if (loop_.size() < 3) {
      small_faces_.add(scanner_.place());
      return std::nullopt;
    }
    mesh_.add_face(loop_);
    mesh_.appearance_of.push_back(appearance());
    return std::nullopt;
  }

  const std::string& name_;
  TextScanner scanner_;
  PolygonMesh mesh_;
  std::vector<uint32_t> loop_;
  std::vector<Forward> forward_;
  std::vector<MeshObject> objects_;
  std::vector<std::string> material_files_;
  std::string material_;
  std::vector<std::string>* notes_;
  PassedOver unknown_, small_faces_;
  bool goes_on_ = false;      ///< the statement, on the next line
  bool has_no_names_ = true;  ///< what is read of it next
};

}  // namespace

Result<PolygonMesh> parse_obj(const std::string& name, std::string_view bytes,
                              std::vector<MeshObject>* objects,
                              std::vector<std::string>* material_files,
                              std::vector<std::string>* notes) {
  ObjReader reader(name, bytes, notes);
  Result<PolygonMesh> mesh = reader.read();
  if (objects != nullptr) *objects = reader.take_objects();
  if (material_files != nullptr) *material_files = reader.take_material_files();
  if (mesh && (material_files == nullptr || material_files->empty())) {
    mesh->appearances.clear();
    mesh->appearance_of.clear();
  }
  return mesh;
}

}  // namespace csgrun
