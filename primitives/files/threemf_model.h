// One model document of a 3MF file: its objects with their meshes, and its colours.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include <pugixml.hpp>

#include <csgrun/engine/csg_tree.h>
#include <csgrun/engine/polygon_mesh.h>

#include "primitives/files/face_colours.h"

namespace csgrun {

/// An object that stands in another one, or in what is built.
struct ModelReference {
  uint32_t object = 0;
  std::string path;  ///< of the document that has it; empty: this one
  Affine map;
};

struct ModelObject {
  pugi::xml_node node, mesh;
  std::string name;
  std::vector<ModelReference> components;
  std::string left_out;   ///< why it is no solid of the model; empty: it is
  uint64_t elements = 0;  ///< points and triangles of its own mesh, and components
  uint64_t expanded = 0;  ///< with those of its components; 0: not counted yet
  int height = 0;         ///< how deep components nest in it; known when `expanded` is
  bool is_noted = false;  ///< what of it is not read was told
};

/// Which number an appearance has in a mesh that is being made.
using LookNumbers = std::map<Appearance, uint32_t, LookOrder>;

/// What a document of 3MF says. All functions throw ModelFault.
class ModelDocument {
 public:
  /// Reads the resources of a <model>, whose document must outlive this.
  explicit ModelDocument(const pugi::xml_node& model);

  /// How many millimetres its unit is.
  [[nodiscard]] double unit() const { return unit_; }
  /// Tells what of an object is not read, though it may have been a solid: once.
  static void note_what_is_left_out(ModelObject& object, std::vector<std::string>* notes);
  ModelObject& object(uint32_t id);

  /// Appends an object's own mesh under a map, with its colours.
  void add_mesh(const ModelObject& each, const Affine& map, PolygonMesh& mesh,
                LookNumbers& numbers) const;

 private:
  void read_metals(const pugi::xml_node& group);
  void read_looks(const pugi::xml_node& group);
  void read_object(const pugi::xml_node& node);
  [[nodiscard]] const Appearance* look_of(const pugi::xml_node& node, const pugi::xml_node& owner,
                                          const char* index) const;

  double unit_;
  std::map<uint32_t, std::vector<std::array<float, 2>>> metals_;
  std::map<uint32_t, std::vector<Appearance>> looks_;
  std::map<uint32_t, ModelObject> objects_;
};

/// What an <item> or a <component> refers to.
ModelReference reference_of(const pugi::xml_node& node);

}  // namespace csgrun
