#include "primitives/files/threemf_model.h"

#include <algorithm>
#include <cstring>
#include <utility>

#include <csgrun/primitives/model_file.h>

#include "primitives/files/formats.h"
#include "primitives/files/text_scanner.h"
#include "primitives/files/threemf_xml.h"

namespace csgrun {
namespace {

double unit_of(const pugi::xml_node& model) {
  const std::string unit =
      find_attribute(model, "unit") ? find_attribute(model, "unit").value() : "millimeter";
  const std::pair<const char*, double> units[] = {{"micron", 0.001},  {"millimeter", 1},
                                                  {"centimeter", 10}, {"inch", 25.4},
                                                  {"foot", 304.8},    {"meter", 1000}};
  for (const auto& [name, millimetres] : units) {
    if (unit == name) return millimetres;
  }
  throw ModelFault{"there is no unit " + quoted(unit)};
}

/// #RRGGBB or #RRGGBBAA.
Appearance colour_of(const char* text) {
  const std::string_view digits = text[0] == '#' ? std::string_view(text + 1) : "";
  if (digits.size() != 6 && digits.size() != 8)
    throw ModelFault{"a colour must be #RRGGBB or #RRGGBBAA, got " + quoted(text)};
  Rgba channels{0, 0, 0, 1};
  for (size_t i = 0; i < digits.size(); ++i) {
    const char* place = std::strchr("0123456789abcdef", digits[i] | 0x20);
    if (place == nullptr || *place == '\0')
      throw ModelFault{"a colour must be #RRGGBB or #RRGGBBAA, got " + quoted(text)};
    const auto value = static_cast<float>(place - "0123456789abcdef");
    channels[i / 2] = i % 2 == 0 ? value * 16 : (channels[i / 2] + value) / 255;
  }
  return appearance_of(channels);
}

/// The extensions of which at least what solids are made of is read, by their namespaces.
constexpr std::string_view kNamespaces[] = {
    "http://schemas.microsoft.com/3dmanufacturing/core/2015/02",
    "http://schemas.microsoft.com/3dmanufacturing/material/2015/02",
    "http://schemas.microsoft.com/3dmanufacturing/production/2015/06",
    "http://schemas.microsoft.com/3dmanufacturing/slice/2015/07",
    "http://schemas.microsoft.com/3dmanufacturing/beamlattice/2017/02"};

/// A model says without which extensions it is another one.
void refuse_required_extensions(const pugi::xml_node& model) {
  TextScanner prefixes(find_attribute(model, "requiredextensions").value());
  for (std::string_view prefix = prefixes.word_anywhere(); !prefix.empty();
       prefix = prefixes.word_anywhere()) {
    const std::string declared = "xmlns:" + std::string(prefix);
    const std::string space = model.attribute(declared.c_str()).value();
    if (std::find(std::begin(kNamespaces), std::end(kNamespaces), space) != std::end(kNamespaces))
      continue;
    std::string address = space.substr(0, 100);
    for (char& c : address) c = c >= ' ' && c <= '~' ? c : '?';
    throw ModelFault{"the model needs the extension " + quoted(prefix) +
                     (address.empty() ? "" : " of " + address) + ", which is not read"};
  }
}

std::string label_of(uint32_t id, const std::string& name) {
  return "object " + std::to_string(id) + (name.empty() ? "" : " " + quoted(name));
}

}  // namespace

ModelDocument::ModelDocument(const pugi::xml_node& model) : unit_(unit_of(model)) {
  refuse_required_extensions(model);
  const pugi::xml_node resources = find_child(model, "resources");
  if (!resources) throw ModelFault{"the model has no resources"};
  for (const pugi::xml_node& node : resources.children()) {
    if (local_name(node.name()) == "pbmetallicdisplayproperties") read_metals(node);
  }
  for (const pugi::xml_node& node : resources.children()) {
    const std::string_view kind = local_name(node.name());
    if (kind == "basematerials" || kind == "colorgroup") read_looks(node);
    if (kind == "object") read_object(node);
  }
}

ModelObject& ModelDocument::object(uint32_t id) {
  const auto found = objects_.find(id);
  if (found == objects_.end())
    throw ModelFault{"there is no object " + std::to_string(id) + ", which is used"};
  return found->second;
}

void ModelDocument::read_metals(const pugi::xml_node& group) {
  auto& metals = metals_[index_of(group, "id")];
  for (const pugi::xml_node& node : group.children()) {
    if (local_name(node.name()) != "pbmetallic") continue;
    metals.push_back({static_cast<float>(std::clamp(number_of(node, "metallicness"), 0.0, 1.0)),
                      static_cast<float>(std::clamp(number_of(node, "roughness"), 0.0, 1.0))});
  }
}

void ModelDocument::read_looks(const pugi::xml_node& group) {
  auto& looks = looks_[index_of(group, "id")];
  const std::vector<std::array<float, 2>>* metals = nullptr;
  if (find_attribute(group, "displaypropertiesid")) {
    const auto found = metals_.find(index_of(group, "displaypropertiesid"));
    if (found != metals_.end()) metals = &found->second;
  }
  for (const pugi::xml_node& node : group.children()) {
    const bool is_base = local_name(node.name()) == "base";
    if (!is_base && local_name(node.name()) != "color") continue;
    Appearance look = colour_of(find_attribute(node, is_base ? "displaycolor" : "color").value());
    const std::string name = is_base ? find_attribute(node, "name").value() : "";
    // A name that only repeats the colour says nothing.
    if (!name.starts_with('#')) look.name = name;
    if (is_named_default(look)) look = Appearance{};
    if (metals != nullptr && looks.size() < metals->size()) {
      look.metallic = (*metals)[looks.size()][0];
      look.roughness = (*metals)[looks.size()][1];
    }
    looks.push_back(std::move(look));
  }
}

void ModelDocument::read_object(const pugi::xml_node& node) {
  const uint32_t id = index_of(node, "id");
  ModelObject& object = objects_[id];
  if (object.node) throw ModelFault{"two objects have the same id"};
  object.node = node;
  object.name = find_attribute(node, "name").value();
  object.mesh = find_child(node, "mesh");
  const auto count = [&](const char* list, std::string_view kind) {
    for (const pugi::xml_node& each : find_child(object.mesh, list).children())
      object.elements += local_name(each.name()) == kind ? 1 : 0;
  };
  count("vertices", "vertex");
  count("triangles", "triangle");
  for (const pugi::xml_node& component : find_child(node, "components").children()) {
    if (local_name(component.name()) == "component")
      object.components.push_back(reference_of(component));
  }
  object.elements += object.components.size();
  const std::string type = find_attribute(node, "type").value();
  // "solidsupport" is filled as a model is, but as little of what is made as "support".
  if (!type.empty() && type != "model") object.left_out = "it is of the type " + quoted(type);
}

void ModelDocument::note_what_is_left_out(ModelObject& object, std::vector<std::string>* notes) {
  if (object.is_noted) return;
  object.is_noted = true;
  const std::string label = label_of(index_of(object.node, "id"), object.name);
  if (!object.left_out.empty()) {
    notes->push_back(label + " is left out: " + object.left_out);
    return;
  }
  if (find_child(object.mesh, "beamlattice"))
    notes->push_back(label + ": its beams (beam lattice extension) are left out");
  if (object.mesh || find_child(object.node, "components")) return;
  for (const pugi::xml_node& shape : object.node.children()) {
    const std::string_view kind = local_name(shape.name());
    if (kind == "metadatagroup") continue;
    notes->push_back(label + " is left out: it is a " + quoted(kind) + ", which is not read");
  }
}

/// Nothing where no colour is given, or one of a kind that is not read.
const Appearance* ModelDocument::look_of(const pugi::xml_node& node, const pugi::xml_node& owner,
                                         const char* index) const {
  const pugi::xml_node& group_node = find_attribute(node, "pid") ? node : owner;
  if (!find_attribute(node, index) || !find_attribute(group_node, "pid"))
    return node == owner ? nullptr : look_of(owner, owner, "pindex");
  const auto group = looks_.find(index_of(group_node, "pid"));
  const uint32_t place = index_of(node, index);
  if (group == looks_.end()) return nullptr;
  if (place >= group->second.size())
    throw ModelFault{"there is no material " + std::to_string(place) + " in its group"};
  return &group->second[place];
}

void ModelDocument::add_mesh(const ModelObject& each, const Affine& map, PolygonMesh& mesh,
                             LookNumbers& numbers) const {
  const auto first = static_cast<uint32_t>(mesh.points.size());
  for (const pugi::xml_node& node : find_child(each.mesh, "vertices").children()) {
    if (local_name(node.name()) != "vertex") continue;
    mesh.points.push_back(
        map.apply({number_of(node, "x"), number_of(node, "y"), number_of(node, "z")}));
  }
  const auto& m = map.m;
  const double turn = m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
                      m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
                      m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
  const size_t count = mesh.points.size() - first;
  for (const pugi::xml_node& node : find_child(each.mesh, "triangles").children()) {
    if (local_name(node.name()) != "triangle") continue;
    std::array<uint32_t, 3> corners{index_of(node, "v1"), index_of(node, "v2"),
                                    index_of(node, "v3")};
    for (uint32_t& corner : corners) {
      if (corner >= count) {
        throw ModelFault{"a triangle has the corner " + std::to_string(corner) + ", there are " +
                         std::to_string(count) + " points"};
      }
      corner += first;
    }
    if (turn < 0) std::swap(corners[1], corners[2]);
    mesh.add_face(corners);
    const Appearance* look = look_of(node, each.node, "p1");
    const auto [known, is_new] = numbers.emplace(look == nullptr ? Appearance{} : *look,
                                                 static_cast<uint32_t>(mesh.appearances.size()));
    if (is_new) mesh.appearances.push_back(known->first);
    mesh.appearance_of.push_back(known->second);
  }
}

ModelReference reference_of(const pugi::xml_node& node) {
  return {index_of(node, "objectid"), find_attribute(node, "path").value(), map_of(node)};
}

}  // namespace csgrun
