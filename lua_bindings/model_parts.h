// Files with geometry, of any format that is read, as parts that are solids.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include <csgrun/engine/error.h>
#include <csgrun/engine/repair.h>
#include <csgrun/primitives/model_file.h>

namespace csgrun {

struct ModelPartOptions {
  FillRule fill = FillRule::kNonZero;
  std::optional<RepairOptions> repair;
  /// The bytes of a material file that an OBJ names; nothing, with a note of its own, when it
  /// cannot be read. Empty: colours of OBJ files are not asked for.
  std::function<std::optional<std::string>(const std::string&)> open_material_file;
};

/// The parts of a file, closed and oriented: one of a mesh file, those of a GLB, glTF or 3MF. Parts
/// have different names, or none. What was done to make solids of them is in the notes. Errors as
/// the readers have them, and kInvalidMesh.
Result<std::vector<ModelPart>> read_model_parts(const std::string& name, std::string_view bytes,
                                                const ModelPartOptions& options,
                                                std::vector<std::string>* notes);

/// "stl", "off", "obj", "ply", "glb", "gltf", "3mf", "amf" or empty: the ending of what can be read.
std::string model_file_format_of(const std::string& path);

}  // namespace csgrun
