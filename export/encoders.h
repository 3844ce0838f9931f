// One function for each format: parts in, the bytes of a file out.
//
// Each rounds every part to what its format can hold, fails with kInternal rather than write a mesh
// that is not closed, and appends to `report` what rounding did. The same parts give the same
// bytes.
#pragma once

#include <string>
#include <vector>

#include <csgrun/engine/error.h>
#include <csgrun/export/write.h>

namespace csgrun {

using Parts = std::vector<Part>;

/// Binary STL of one part: float32, millimetres.
Result<std::string> encode_stl(const Part& part, WriteReport& report);

/// OFF of one part: doubles, polygons kept, colours where one was asked for.
Result<std::string> encode_off(const Part& part, WriteReport& report);

struct ObjFiles {
  std::string obj, mtl;
};
/// OBJ: doubles, polygons kept, one object a part, comments that say which leaf made which faces.
/// `mtl_name` is what the OBJ calls its material file; when empty, materials are left out.
Result<ObjFiles> encode_obj(const Parts& parts, const std::string& mtl_name, WriteReport& report);

enum class GltfContainer { kBinary, kText };
/// glTF 2.0: one mesh per distinct solid, a node per part, materials, normals, EXT_mesh_manifold.
Result<std::string> encode_gltf(const Parts& parts, GltfContainer container, WriteReport& report);

}  // namespace csgrun
