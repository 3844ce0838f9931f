// Files with geometry, of any format that is read, as parts that are solids.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include <csgrun/engine/csg_tree.h>
#include <csgrun/engine/error.h>
#include <csgrun/engine/repair.h>
#include <csgrun/primitives/model_file.h>

namespace csgrun {

struct ModelPartOptions {
  FillRule fill = FillRule::kNonZero;
  std::optional<RepairOptions> repair;
  /// The bytes of a file that the model names: an OBJ's materials, a glTF's buffer. Without the
  /// first there are no colours, and a note. Empty: no such file is read.
  std::function<Result<std::string>(const std::string&)> open;
};

/// The parts of a file, closed and oriented: one of a mesh file, those of a GLB, glTF or 3MF. Parts
/// have different names, or none. What was done to make solids of them is in the notes. Errors as
/// the readers have them, and kInvalidMesh.
Result<std::vector<ModelPart>> read_model_parts(const std::string& name, std::string_view bytes,
                                                const ModelPartOptions& options,
                                                std::vector<std::string>* notes);

struct SolidPart {
  std::string name;
  NodePtr node;
};

/// Parts as nodes, by `leaf`: what goes on is united with the part before it.
std::vector<SolidPart> solid_parts_of(std::vector<ModelPart> parts, const SourceRef& where,
                                      const std::function<NodePtr(PolygonMesh)>& leaf);

/// "stl", "off", "obj", "ply", "glb", "gltf", "3mf", "amf" or empty: the ending of what can be
/// read.
std::string model_file_format_of(const std::string& path);

}  // namespace csgrun
