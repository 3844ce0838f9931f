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
#include <csgrun/engine/validate.h>
#include <csgrun/primitives/file_ending.h>
#include <csgrun/primitives/mesh_file.h>
#include <csgrun/primitives/model_file.h>
#include <csgrun/primitives/trig.h>

#include "primitives/files/face_colours.h"
#include "primitives/files/formats.h"
#include "primitives/files/text_scanner.h"
#include "primitives/files/unzip.h"

namespace csgrun {
namespace {

constexpr int kDeepest = 32;  // constellations in constellations beyond this contain themselves
/// Of points and triangles.
constexpr uint64_t kManyElements = 5'000'000, kMostCopies = 100;

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
  AmfReader(const pugi::xml_node& amf, std::vector<std::string>* notes, FileUnit unit)
      : amf_(amf), notes_(notes), unit_(unit == FileUnit::kNamed ? unit_of(amf) : 1) {}

  std::vector<ModelPart> read() {
    for (const pugi::xml_node& node : amf_.children("material"))
      materials_[node.attribute("id").value()] = colour_in(node);
    std::vector<Thing*> things;  // in the order of the file
    std::set<std::string> used;
    PassedOver passed_over;
    for (const pugi::xml_node& node : amf_.children()) {
      if (!is(node, "object") && !is(node, "constellation")) continue;
      const auto [entry, is_new] = things_.emplace(node.attribute("id").value(), Thing{node});
      if (!is_new)
        throw Fault{"two objects have the same id " + quoted(node.attribute("id").value())};
      things.push_back(&entry->second);
      if (is(node, "object") && node.child("instance")) passed_over.add(quoted(entry->first));
      for (const pugi::xml_node& instance : instances_of(node))
        used.insert(instance.attribute("objectid").value());
    }
    if (passed_over.count > 0) {
      notes_->push_back("instances of " + std::to_string(passed_over.count) +
                        (passed_over.count == 1 ? " object" : " objects") +
                        " are left out: only constellations have some (first: object " +
                        passed_over.first + ")");
    }
    // What no constellation has is a part of its own. All are counted: what contains itself is in
    // none that is.
    std::vector<pugi::xml_node> tops;
    uint64_t own = 0, all = 0;
    for (Thing* each : things) {
      count(*each, 0);
      own += each->own;
      if (used.count(each->node.attribute("id").value()) != 0) continue;
      all += each->with_instances;
      tops.push_back(each->node);
    }
    if (all > kManyElements && all / kMostCopies > own)
      throw Fault{"its constellations multiply to more than a model would", ErrorCode::kLimit};
    std::vector<ModelPart> parts;
    for (const pugi::xml_node& node : tops) append_part(node, parts);
    return parts;
  }

 private:
  struct Thing {
    pugi::xml_node node;
    uint64_t own = 0;             ///< points, triangles and instances of its own
    uint64_t with_instances = 0;  ///< with what they are made of; 0: not counted yet
    int height = 0;               ///< how deep constellations nest in it
  };

  static bool is(const pugi::xml_node& node, std::string_view kind) { return node.name() == kind; }

  /// Those of a constellation: others have none.
  static pugi::xml_object_range<pugi::xml_named_node_iterator> instances_of(
      const pugi::xml_node& node) {
    return node.children(is(node, "constellation") ? "instance" : "");
  }

  Thing& thing(const std::string& id) {
    const auto found = things_.find(id);
    if (found == things_.end()) throw Fault{"there is no object " + quoted(id) + ", which is used"};
    return found->second;
  }

  static uint64_t length_of(const pugi::xml_node& node, const char* kind) {
    const auto children = node.children(kind);
    return static_cast<uint64_t>(std::distance(children.begin(), children.end()));
  }

  /// Constellations multiply: how many points and triangles they come to is counted before any is
  /// made.
  void count(Thing& each, int depth) {
    if (each.with_instances == 0 && depth <= kDeepest) {
      const pugi::xml_node mesh = each.node.child("mesh");
      each.own = 1 + length_of(mesh.child("vertices"), "vertex");
      for (const pugi::xml_node& volume : mesh.children("volume"))
        each.own += length_of(volume, "triangle");
      uint64_t sum = each.own;
      for (const pugi::xml_node& instance : instances_of(each.node)) {
        Thing& inner = thing(instance.attribute("objectid").value());
        count(inner, depth + 1);
        sum = std::min<uint64_t>(sum + inner.with_instances, uint64_t{1} << 40);
        each.height = std::max(each.height, inner.height + 1);
        ++each.own;
      }
      each.with_instances = sum;
    }
    if (depth + each.height > kDeepest)
      throw Fault{"constellations nest too deep (does one contain itself?)"};
  }

  /// An object or constellation that is in no other.
  void append_part(const pugi::xml_node& node, std::vector<ModelPart>& parts) {
    Affine scaled;
    for (size_t i = 0; i < 3; ++i) scaled.m[i][i] = unit_;
    PolygonMesh mesh;
    FaceColours colours;
    volume_of_.clear();
    add(node.attribute("id").value(), scaled, mesh, colours);
    if (mesh.face_count() == 0) return;
    colours.apply(mesh, notes_);
    const uint32_t volumes = 1 + *std::max_element(volume_of_.begin(), volume_of_.end());
    std::vector<PolygonMesh> pieces;
    if (volumes > 1) pieces = split_mesh(mesh, volume_of_, volumes);
    // Writers that mean colours by volumes close all of them together only.
    const bool are_solids = std::all_of(pieces.begin(), pieces.end(), [](PolygonMesh piece) {
      weld_points(piece);
      const MeshReport report = check_mesh(piece);
      return report.open_edges == 0 && report.misoriented_edges == 0;
    });
    if (volumes == 1 || !are_solids) {
      parts.push_back({name_of(node), std::move(mesh)});
      return;
    }
    const size_t first = parts.size();
    for (PolygonMesh& piece : pieces) {
      if (piece.face_count() > 0)
        parts.push_back({name_of(node), std::move(piece), parts.size() > first});
    }
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
    for (const pugi::xml_node& instance : instances_of(node)) {
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
    uint32_t number = 0;
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
        volume_of_.push_back(number);
        std::optional<Rgba> shown = colour_in(triangle);
        if (!shown && !by_vertices) shown = colour;
        if (shown) colours.set_face(mesh.face_count() - 1, *shown);
      }
      ++number;
    }
  }

  pugi::xml_node amf_;
  std::vector<std::string>* notes_;
  double unit_;
  std::vector<uint32_t> volume_of_;  ///< by face of the part being made: which one of its object
  std::map<std::string, std::optional<Rgba>> materials_;
  std::map<std::string, Thing> things_;
};

}  // namespace

bool is_amf_path(const std::string& path) { return has_ending(path, ".amf"); }

Result<std::vector<ModelPart>> parse_amf(const std::string& name, std::string_view bytes,
                                         std::vector<std::string>* notes, FileUnit unit) {
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
    std::vector<std::string> own_notes;
    std::vector<ModelPart> parts = AmfReader(document.document_element(), &own_notes, unit).read();
    if (notes != nullptr) {
      for (const std::string& note : own_notes) notes->push_back(name + ": " + note);
    }
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
