// AMF: an XML document of objects, by itself or as the one file of an archive.
//
// ISO/ASTM 52915. Objects and their volumes, units, colours of triangles, vertices, volumes,
// objects and materials as numbers, and constellations are read. Curved edges (normals) are
// straight, textures, lattices and mixed materials are passed over.
#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include <pugixml.hpp>

#include <csgrun/engine/csg_tree.h>
#include <csgrun/primitives/file_ending.h>
#include <csgrun/primitives/model_file.h>
#include <csgrun/primitives/trig.h>

#include "primitives/files/face_colours.h"
#include "primitives/files/formats.h"
#include "primitives/files/text_scanner.h"
#include "primitives/files/unzip.h"

namespace csgrun {
namespace {

constexpr int kDeepest = 32;  // constellations in constellations beyond this contain themselves
constexpr uint64_t kManyTriangles = 5'000'000, kMostCopies = 100;

/// What is wrong, without the file's name.
struct Fault {
  std::string what;
  ErrorCode code = ErrorCode::kMalformedFile;
};

std::string_view trimmed(std::string_view text) {
  const auto is_blank = [](char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; };
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  return text;
}

std::string_view text_of(const pugi::xml_node& node, const char* child) {
  return trimmed(node.child(child).child_value());
}

double number_of(const pugi::xml_node& node, const char* child) {
  const auto value = parse_finite(text_of(node, child));
  if (!value) {
    throw Fault{std::string("a ") + node.name() + " has no finite " + child + ": " +
                quoted(text_of(node, child))};
  }
  return *value;
}

uint32_t corner_of(const pugi::xml_node& triangle, const char* child, size_t points) {
  const auto value = parse_integer<uint32_t>(text_of(triangle, child));
  if (!value) {
    throw Fault{std::string("a triangle has no ") + child +
                " that is a whole number: " + quoted(text_of(triangle, child))};
  }
  if (*value >= points) {
    throw Fault{"a triangle has the corner " + std::to_string(*value) + ", there are " +
                std::to_string(points) + " points"};
  }
  return *value;
}

double unit_of(const pugi::xml_node& amf) {
  const std::string unit = amf.attribute("unit") ? amf.attribute("unit").value() : "millimeter";
  const std::pair<const char*, double> units[] = {
      {"millimeter", 1}, {"inch", 25.4},    {"feet", 304.8},      {"foot", 304.8},
      {"meter", 1000},   {"micron", 0.001}, {"micrometer", 0.001}};
  for (const auto& [name, millimetres] : units) {
    if (unit == name) return millimetres;
  }
  throw Fault{"there is no unit " + quoted(unit)};
}

/// A colour of numbers; nothing where there is none, or a formula of the place.
std::optional<Rgba> colour_in(const pugi::xml_node& node) {
  const pugi::xml_node colour = node.child("color");
  if (!colour) return std::nullopt;
  Rgba rgba{0, 0, 0, 1};
  const char* const names[] = {"r", "g", "b", "a"};
  for (size_t i = 0; i < 4; ++i) {
    if (i == 3 && !colour.child("a")) break;
    const auto value = parse_finite(text_of(colour, names[i]));
    if (!value) return std::nullopt;
    rgba[i] = static_cast<float>(std::clamp(*value, 0.0, 1.0));
  }
  return rgba;
}

std::string name_of(const pugi::xml_node& node) {
  for (const pugi::xml_node& metadata : node.children("metadata")) {
    if (std::string_view(metadata.attribute("type").value()) == "name")
      return std::string(trimmed(metadata.child_value()));
  }
  return {};
}

class AmfReader {
 public:
  AmfReader(const pugi::xml_node& amf, std::vector<std::string>* notes)
      : amf_(amf), notes_(notes), unit_(unit_of(amf)) {}

  std::vector<ModelPart> read() {
    for (const pugi::xml_node& node : amf_.children("material"))
      materials_[node.attribute("id").value()] = colour_in(node);
    std::set<std::string> used;
    for (const pugi::xml_node& node : amf_.children()) {
      const std::string kind = node.name();
      if (kind != "object" && kind != "constellation") continue;
      if (!things_.emplace(node.attribute("id").value(), Thing{node}).second)
        throw Fault{"two objects have the same id " + quoted(node.attribute("id").value())};
      for (const pugi::xml_node& instance : node.children("instance"))
        used.insert(instance.attribute("objectid").value());
    }
    // What no constellation has is a part of its own.
    std::vector<pugi::xml_node> tops;
    uint64_t own = 0, all = 0;
    for (const pugi::xml_node& node : amf_.children()) {
      const auto thing = things_.find(node.attribute("id").value());
      if (thing == things_.end() || thing->second.node != node) continue;
      if (std::string_view(node.name()) == "object") own += count(thing->first, 0);
      if (used.count(thing->first) == 0) tops.push_back(node);
    }
    if (tops.empty() && !things_.empty()) count(things_.begin()->first, 0);
    for (const pugi::xml_node& node : tops) {
      all += count(node.attribute("id").value(), 0);
      if (all > kManyTriangles && all / kMostCopies > own)
        throw Fault{"its constellations multiply to more than a model would", ErrorCode::kLimit};
    }
    Affine scaled;
    for (size_t i = 0; i < 3; ++i) scaled.m[i][i] = unit_;
    std::vector<ModelPart> parts;
    for (const pugi::xml_node& node : tops) {
      ModelPart part;
      part.name = name_of(node);
      FaceColours colours;
      add(node.attribute("id").value(), scaled, part.mesh, colours);
      if (part.mesh.face_count() == 0) continue;
      colours.apply(part.mesh, notes_);
      parts.push_back(std::move(part));
    }
    return parts;
  }

 private:
  struct Thing {
    pugi::xml_node node;
    uint64_t triangles = 0;  ///< with those of its instances; 0: not counted yet
  };

  Thing& thing(const std::string& id) {
    const auto found = things_.find(id);
    if (found == things_.end()) throw Fault{"there is no object " + quoted(id) + ", which is used"};
    return found->second;
  }

  /// Constellations multiply: how many triangles they come to is counted before any is made.
  uint64_t count(const std::string& id, int depth) {
    if (depth > kDeepest) throw Fault{"constellations nest too deep (does one contain itself?)"};
    Thing& each = thing(id);
    if (each.triangles > 0) return each.triangles;
    uint64_t sum = 1;
    for (const pugi::xml_node& volume : each.node.child("mesh").children("volume")) {
      const auto triangles = volume.children("triangle");
      sum += static_cast<uint64_t>(std::distance(triangles.begin(), triangles.end()));
    }
    for (const pugi::xml_node& instance : each.node.children("instance")) {
      sum = std::min<uint64_t>(sum + count(instance.attribute("objectid").value(), depth + 1),
                               uint64_t{1} << 40);
    }
    return each.triangles = sum;
  }

  /// Turned about X, then Y, then Z, and moved.
  static Affine place_of(const pugi::xml_node& instance) {
    const auto value = [&](const char* name) {
      return instance.child(name) ? number_of(instance, name) : 0.0;
    };
    Affine map;
    const char* const turns[] = {"rx", "ry", "rz"};
    for (size_t axis = 0; axis < 3; ++axis) {
      const double angle = value(turns[axis]), c = cos_deg(angle), s = sin_deg(angle);
      const size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
      Affine turn;
      turn.m[u][u] = turn.m[v][v] = c;
      turn.m[u][v] = -s;
      turn.m[v][u] = s;
      map = Affine::compose(turn, map);
    }
    map.m[0][3] = value("deltax");
    map.m[1][3] = value("deltay");
    map.m[2][3] = value("deltaz");
    return map;
  }

  /// The object or constellation under a map, appended.
  void add(const std::string& id, const Affine& map, PolygonMesh& mesh, FaceColours& colours) {
    const pugi::xml_node node = thing(id).node;
    for (const pugi::xml_node& instance : node.children("instance")) {
      add(instance.attribute("objectid").value(), Affine::compose(map, place_of(instance)), mesh,
          colours);
    }
    const pugi::xml_node given = node.child("mesh");
    if (!given) return;
    const size_t first = mesh.points.size();
    std::vector<bool> has_colour;  // per vertex of this mesh
    for (const pugi::xml_node& vertex : given.child("vertices").children("vertex")) {
      const pugi::xml_node at = vertex.child("coordinates");
      mesh.points.push_back(
          map.apply({number_of(at, "x"), number_of(at, "y"), number_of(at, "z")}));
      const std::optional<Rgba> colour = colour_in(vertex);
      if (colour) colours.set_vertex(mesh.points.size() - 1, *colour);
      has_colour.push_back(colour.has_value());
    }
    const size_t count = mesh.points.size() - first;
    for (const pugi::xml_node& volume : given.children("volume")) {
      std::optional<Rgba> colour = colour_in(volume);
      if (!colour) colour = colour_in(node);
      const auto material = materials_.find(volume.attribute("materialid").value());
      if (!colour && material != materials_.end()) colour = material->second;
      for (const pugi::xml_node& triangle : volume.children("triangle")) {
        std::array<uint32_t, 3> corners{};
        const char* const names[] = {"v1", "v2", "v3"};
        bool by_vertices = true;  // their colours come before those of larger parts
        for (size_t i = 0; i < 3; ++i) {
          corners[i] = corner_of(triangle, names[i], count);
          by_vertices = by_vertices && has_colour[corners[i]];
          corners[i] += static_cast<uint32_t>(first);
        }
        mesh.add_face(corners);
        std::optional<Rgba> shown = colour_in(triangle);
        if (!shown && !by_vertices) shown = colour;
        if (shown) colours.set_face(mesh.face_count() - 1, *shown);
      }
    }
  }

  pugi::xml_node amf_;
  std::vector<std::string>* notes_;
  double unit_;
  std::map<std::string, std::optional<Rgba>> materials_;
  std::map<std::string, Thing> things_;
};

}  // namespace

bool is_amf_path(const std::string& path) { return has_ending(path, ".amf"); }

Result<std::vector<ModelPart>> parse_amf(const std::string& name, std::string_view bytes,
                                         std::vector<std::string>* notes) {
  std::string text;
  if (bytes.starts_with("PK")) {
    auto archive = ZipArchive::open(name, bytes);
    if (!archive) return archive.error();
    auto unpacked = archive->first(".amf");
    if (!unpacked) return unpacked.error();
    if (!*unpacked) return malformed(name, "", "its archive has no file that ends in .amf");
    text = **std::move(unpacked);
  } else {
    text = bytes;
  }
  pugi::xml_document document;
  const pugi::xml_parse_result parsed = document.load_buffer_inplace(text.data(), text.size());
  if (!parsed) {
    return malformed(name, "",
                     std::string("malformed XML at byte ") + std::to_string(parsed.offset) + ": " +
                         parsed.description());
  }
  if (std::string_view(document.document_element().name()) != "amf")
    return malformed(name, "", "it is no AMF file");
  try {
    std::vector<ModelPart> parts = AmfReader(document.document_element(), notes).read();
    if (parts.empty()) return malformed(name, "", "has no faces");
    for (ModelPart& part : parts) {
      part.mesh.kind = name;
      part.mesh.keep_facets = true;
    }
    return parts;
  } catch (const Fault& fault) {
    Error error = malformed(name, "", fault.what);
    error.code = fault.code;
    return error;
  }
}

}  // namespace csgrun
