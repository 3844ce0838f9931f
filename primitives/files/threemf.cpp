// 3MF: an archive with an XML document of objects, and of what is built of them.
//
// 3MF Core Specification 1.3; of the Materials and Properties Extension 1.2 colour groups and
// metallic display properties. Textures, slices and beams are passed over; models in several files
// (the production extension) are refused, for they would be incomplete.
#include <algorithm>
#include <array>
#include <cstring>
#include <map>
#include <utility>

#include <pugixml.hpp>

#include <csgrun/engine/csg_tree.h>
#include <csgrun/primitives/model_file.h>

#include "primitives/files/face_colours.h"
#include "primitives/files/formats.h"
#include "primitives/files/text_scanner.h"
#include "primitives/files/unzip.h"

namespace csgrun {
namespace {

constexpr int kDeepest = 32;  // components in components beyond this contain themselves
constexpr uint64_t kManyTriangles = 5'000'000, kMostCopies = 100;

/// What is wrong, without the file's name.
struct Fault {
  std::string what;
  ErrorCode code = ErrorCode::kMalformedFile;
};

/// The name of an element or attribute without its namespace's prefix.
std::string_view local(const char* name) {
  const char* colon = std::strchr(name, ':');
  return colon == nullptr ? name : colon + 1;
}

pugi::xml_attribute find(const pugi::xml_node& node, std::string_view name) {
  for (const pugi::xml_attribute& attribute : node.attributes()) {
    if (local(attribute.name()) == name) return attribute;
  }
  return {};
}

uint32_t index_of(const pugi::xml_node& node, const char* name) {
  const pugi::xml_attribute attribute = find(node, name);
  const auto value = parse_integer<uint32_t>(attribute.value());
  if (!value) {
    throw Fault{std::string("a ") + node.name() + " has no " + name +
                " that is a whole number: " + quoted(attribute.value())};
  }
  return *value;
}

double number_of(const pugi::xml_node& node, const char* name) {
  const auto value = parse_finite(find(node, name).value());
  if (!value) {
    throw Fault{std::string("a ") + node.name() + " has no finite " + name + ": " +
                quoted(find(node, name).value())};
  }
  return *value;
}

/// Twelve numbers, the columns of the map and its translation.
Affine map_of(const pugi::xml_node& node) {
  Affine map;
  const pugi::xml_attribute attribute = find(node, "transform");
  if (!attribute) return map;
  TextScanner scanner(attribute.value());
  for (size_t column = 0; column < 4; ++column) {
    for (size_t row = 0; row < 3; ++row) {
      const auto value = parse_finite(scanner.word_anywhere());
      if (!value) throw Fault{"a transform must be twelve finite numbers"};
      map.m[row][column] = *value;
    }
  }
  if (!scanner.word_anywhere().empty()) throw Fault{"a transform must be twelve finite numbers"};
  return map;
}

double unit_of(const pugi::xml_node& model) {
  const std::string unit = find(model, "unit") ? find(model, "unit").value() : "millimeter";
  const std::pair<const char*, double> units[] = {{"micron", 0.001},  {"millimeter", 1},
                                                  {"centimeter", 10}, {"inch", 25.4},
                                                  {"foot", 304.8},    {"meter", 1000}};
  for (const auto& [name, millimetres] : units) {
    if (unit == name) return millimetres;
  }
  throw Fault{"there is no unit " + quoted(unit)};
}

/// #RRGGBB or #RRGGBBAA.
Appearance colour_of(const char* text) {
  const std::string_view digits = text[0] == '#' ? std::string_view(text + 1) : "";
  if (digits.size() != 6 && digits.size() != 8)
    throw Fault{"a colour must be #RRGGBB or #RRGGBBAA, got " + quoted(text)};
  Rgba channels{0, 0, 0, 1};
  for (size_t i = 0; i < digits.size(); ++i) {
    const char* place = std::strchr("0123456789abcdef", digits[i] | 0x20);
    if (place == nullptr || *place == '\0')
      throw Fault{"a colour must be #RRGGBB or #RRGGBBAA, got " + quoted(text)};
    const auto value = static_cast<float>(place - "0123456789abcdef");
    channels[i / 2] = i % 2 == 0 ? value * 16 : (channels[i / 2] + value) / 255;
  }
  return appearance_of(channels);
}

struct Object {
  pugi::xml_node node, mesh;
  std::string name;
  struct Component {
    uint32_t object;
    Affine map;
  };
  std::vector<Component> components;
  uint64_t triangles = 0;  ///< of its own mesh
  uint64_t expanded = 0;   ///< with those of its components; 0: not counted yet
};

class ModelReader {
 public:
  ModelReader(const pugi::xml_node& model, std::vector<std::string>& notes)
      : model_(model), unit_(unit_of(model)), notes_(notes) {}

  std::vector<ModelPart> read() {
    const pugi::xml_node resources = child(model_, "resources"), build = child(model_, "build");
    if (!resources || !build) throw Fault{"the model has no resources, or no build"};
    for (const pugi::xml_node& node : resources.children()) {
      if (local(node.name()) == "pbmetallicdisplayproperties") read_metals(node);
    }
    for (const pugi::xml_node& node : resources.children()) {
      const std::string_view kind = local(node.name());
      if (kind == "basematerials" || kind == "colorgroup") read_looks(node);
      if (kind == "object") read_object(node);
    }
    count_all(build);
    std::vector<ModelPart> parts;
    for (const pugi::xml_node& item : build.children()) {
      if (local(item.name()) != "item") continue;
      refuse_path(item);
      const uint32_t id = index_of(item, "objectid");
      ModelPart part;
      part.name = object(id).name;
      Affine map = map_of(item);
      for (auto& row : map.m) {
        for (double& entry : row) entry *= unit_;
      }
      numbers_.clear();
      add(id, map, part.mesh, 0);
      // What has no colour anywhere has no appearances either.
      if (part.mesh.appearances.size() == 1 && part.mesh.appearances[0].is_default) {
        part.mesh.appearances.clear();
        part.mesh.appearance_of.clear();
      }
      limit_appearances(part.mesh, &notes_);
      if (part.mesh.face_count() > 0) parts.push_back(std::move(part));
    }
    return parts;
  }

 private:
  static pugi::xml_node child(const pugi::xml_node& node, std::string_view name) {
    for (const pugi::xml_node& each : node.children()) {
      if (local(each.name()) == name) return each;
    }
    return {};
  }

  static void refuse_path(const pugi::xml_node& node) {
    if (find(node, "path"))
      throw Fault{"a part of it is in another file (production extension), which is not read"};
  }

  void read_metals(const pugi::xml_node& group) {
    auto& metals = metals_[index_of(group, "id")];
    for (const pugi::xml_node& node : group.children()) {
      if (local(node.name()) != "pbmetallic") continue;
      metals.push_back({static_cast<float>(std::clamp(number_of(node, "metallicness"), 0.0, 1.0)),
                        static_cast<float>(std::clamp(number_of(node, "roughness"), 0.0, 1.0))});
    }
  }

  void read_looks(const pugi::xml_node& group) {
    auto& looks = looks_[index_of(group, "id")];
    const std::vector<std::array<float, 2>>* metals = nullptr;
    if (find(group, "displaypropertiesid")) {
      const auto found = metals_.find(index_of(group, "displaypropertiesid"));
      if (found != metals_.end()) metals = &found->second;
    }
    for (const pugi::xml_node& node : group.children()) {
      const bool is_base = local(node.name()) == "base";
      if (!is_base && local(node.name()) != "color") continue;
      Appearance look = colour_of(find(node, is_base ? "displaycolor" : "color").value());
      const std::string name = is_base ? find(node, "name").value() : "";
      // A name that only repeats the colour says nothing.
      if (name == "default") look = Appearance{};
      if (name != "default" && !name.starts_with('#')) look.name = name;
      if (metals != nullptr && looks.size() < metals->size()) {
        look.metallic = (*metals)[looks.size()][0];
        look.roughness = (*metals)[looks.size()][1];
      }
      looks.push_back(std::move(look));
    }
  }

  void read_object(const pugi::xml_node& node) {
    Object& object = objects_[index_of(node, "id")];
    if (object.node) throw Fault{"two objects have the same id"};
    object.node = node;
    object.name = find(node, "name").value();
    object.mesh = child(node, "mesh");
    if (object.mesh) {
      for (const pugi::xml_node& triangle : child(object.mesh, "triangles").children())
        object.triangles += local(triangle.name()) == "triangle" ? 1 : 0;
    }
    for (const pugi::xml_node& component : child(node, "components").children()) {
      if (local(component.name()) != "component") continue;
      refuse_path(component);
      object.components.push_back({index_of(component, "objectid"), map_of(component)});
    }
  }

  Object& object(uint32_t id) {
    const auto found = objects_.find(id);
    if (found == objects_.end())
      throw Fault{"there is no object " + std::to_string(id) + ", which is used"};
    return found->second;
  }

  /// Components multiply: how many triangles they come to is counted before any is made.
  uint64_t count(uint32_t id, int depth) {
    Object& each = object(id);
    if (depth > kDeepest) throw Fault{"components nest too deep (does an object contain itself?)"};
    if (each.expanded > 0) return each.expanded;
    uint64_t sum = each.triangles + 1;
    for (const Object::Component& component : each.components) {
      sum = std::min<uint64_t>(sum + count(component.object, depth + 1), uint64_t{1} << 40);
    }
    return each.expanded = sum;
  }

  void count_all(const pugi::xml_node& build) {
    uint64_t own = 0, all = 0;
    for (const auto& [id, each] : objects_) own += each.triangles + 1;
    for (const pugi::xml_node& item : build.children()) {
      if (local(item.name()) == "item") all += count(index_of(item, "objectid"), 0);
      if (all > kManyTriangles && all / kMostCopies > own)
        throw Fault{"its components multiply to more than a model would", ErrorCode::kLimit};
    }
  }

  uint32_t look_number(PolygonMesh& mesh, const pugi::xml_node& node, const pugi::xml_node& owner,
                       const char* index) {
    const pugi::xml_node& group_node = find(node, "pid") ? node : owner;
    Appearance look;
    if (find(node, index) && find(group_node, "pid")) {
      const auto group = looks_.find(index_of(group_node, "pid"));
      const uint32_t place = index_of(node, index);
      if (group != looks_.end()) {
        if (place >= group->second.size())
          throw Fault{"there is no material " + std::to_string(place) + " in its group"};
        look = group->second[place];
      }
    } else if (&node != &owner && node != owner) {
      return look_number(mesh, owner, owner, "pindex");
    }
    const auto [known, is_new] =
        numbers_.emplace(look, static_cast<uint32_t>(mesh.appearances.size()));
    if (is_new) mesh.appearances.push_back(look);
    return known->second;
  }

  /// The object under a map, appended.
  void add(uint32_t id, const Affine& map, PolygonMesh& mesh, int depth) {
    const Object& each = object(id);
    if (each.mesh) add_mesh(each, map, mesh);
    for (const Object::Component& component : each.components)
      add(component.object, Affine::compose(map, component.map), mesh, depth + 1);
  }

  void add_mesh(const Object& each, const Affine& map, PolygonMesh& mesh) {
    const auto first = static_cast<uint32_t>(mesh.points.size());
    for (const pugi::xml_node& node : child(each.mesh, "vertices").children()) {
      if (local(node.name()) != "vertex") continue;
      mesh.points.push_back(
          map.apply({number_of(node, "x"), number_of(node, "y"), number_of(node, "z")}));
    }
    const auto& m = map.m;
    const double turn = m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
                        m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
                        m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
    const size_t count = mesh.points.size() - first;
    for (const pugi::xml_node& node : child(each.mesh, "triangles").children()) {
      if (local(node.name()) != "triangle") continue;
      std::array<uint32_t, 3> corners{index_of(node, "v1"), index_of(node, "v2"),
                                      index_of(node, "v3")};
      for (uint32_t& corner : corners) {
        if (corner >= count) {
          throw Fault{"a triangle has the corner " + std::to_string(corner) + ", there are " +
                      std::to_string(count) + " points"};
        }
        corner += first;
      }
      if (turn < 0) std::swap(corners[1], corners[2]);
      mesh.add_face(corners);
      mesh.appearance_of.push_back(look_number(mesh, node, each.node, "p1"));
    }
  }

  pugi::xml_node model_;
  double unit_;
  std::vector<std::string>& notes_;
  std::map<uint32_t, std::vector<std::array<float, 2>>> metals_;
  std::map<uint32_t, std::vector<Appearance>> looks_;
  std::map<uint32_t, Object> objects_;
  std::map<Appearance, uint32_t, LookOrder> numbers_;  ///< of the part that is being made
};

/// The path of the model within the archive, without its first slash.
Result<std::string> model_path(const std::string& name, std::string_view bytes) {
  const auto relations = unzip_entry(name, bytes, "_rels/.rels");
  if (!relations) return relations.error();
  if (!*relations) return malformed(name, "", "it is no 3MF file: it has no _rels/.rels");
  pugi::xml_document document;
  if (!document.load_buffer((*relations)->data(), (*relations)->size()))
    return malformed(name, "_rels/.rels", "is malformed XML");
  for (const pugi::xml_node& node : document.document_element().children()) {
    const std::string type = find(node, "Type").value(), target = find(node, "Target").value();
    if (type.ends_with("/3dmodel") && !target.empty())
      return target[0] == '/' ? target.substr(1) : target;
  }
  return malformed(name, "_rels/.rels", "names no model");
}

}  // namespace

bool is_3mf_path(const std::string& path) {
  if (path.size() < 4) return false;
  std::string ending = path.substr(path.size() - 4);
  for (char& c : ending) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return ending == ".3mf";
}

Result<std::vector<ModelPart>> parse_3mf(const std::string& name, std::string_view bytes,
                                         std::vector<std::string>* notes) {
  const auto path = model_path(name, bytes);
  if (!path) return path.error();
  auto text = unzip_entry(name, bytes, *path);
  if (!text) return text.error();
  if (!*text) return malformed(name, "", "it has no " + quoted(*path));
  pugi::xml_document document;
  const pugi::xml_parse_result parsed =
      document.load_buffer_inplace((*text)->data(), (*text)->size());
  if (!parsed) {
    return malformed(name, *path,
                     std::string("malformed XML at byte ") + std::to_string(parsed.offset) + ": " +
                         parsed.description());
  }
  if (local(document.document_element().name()) != "model")
    return malformed(name, *path, "it is no 3MF model");
  try {
    std::vector<std::string> own_notes;
    std::vector<ModelPart> parts = ModelReader(document.document_element(), own_notes).read();
    for (const std::string& note : own_notes) {
      if (notes != nullptr) notes->push_back(name + ": " + note);
    }
    if (parts.empty()) return malformed(name, *path, "has no faces");
    for (ModelPart& part : parts) {
      part.mesh.kind = name;
      part.mesh.keep_facets = true;
    }
    return parts;
  } catch (const Fault& fault) {
    Error error = malformed(name, *path, fault.what);
    error.code = fault.code;
    return error;
  }
}

}  // namespace csgrun
