// One function for each format: parts in, the bytes of a file out.
//
// Each has every part rounded to what its format can hold, fails with kInternal rather than write a
// mesh that is not closed, and reports what rounding did. The same parts give the same bytes.
#pragma once

#include <string>
#include <vector>

#include <csgrun/engine/error.h>
#include <csgrun/export/write.h>

#include "export/mesh_maker.h"

namespace csgrun {

using Parts = std::vector<Part>;

/// Binary STL of one part: float32, millimetres.
Result<std::string> encode_stl(const Part& part, MeshMaker& maker);

/// OFF of one part: doubles, polygons kept, colours where one was asked for.
Result<std::string> encode_off(const Part& part, MeshMaker& maker);

/// Binary PLY of one part: doubles, polygons kept, colours of faces where one was asked for.
Result<std::string> encode_ply(const Part& part, MeshMaker& maker);

/// 3MF: doubles, one object a part, base materials. A part that rounding left nothing of is left
/// out.
Result<std::string> encode_3mf(const Parts& parts, MeshMaker& maker);

struct ObjFiles {
  std::string obj, mtl;
};
/// OBJ: doubles, polygons kept, one object a part, comments that say which leaf made which faces.
/// `mtl_name` is what the OBJ calls its material file; when empty, materials are left out.
Result<ObjFiles> encode_obj(const Parts& parts, const std::string& mtl_name, MeshMaker& maker);

enum class GltfContainer { kBinary, kText };
/// glTF 2.0: one mesh per distinct solid, a node per part, materials, normals, EXT_mesh_manifold.
Result<std::string> encode_gltf(const Parts& parts, GltfContainer container, MeshMaker& maker);

/// JSON with exact coordinates and faces as polygons; nothing is rounded, so nothing is checked.
/// Errors: kInvalidArgument without Solid::exact_points, or with a placement.
Result<std::string> encode_exact(const Parts& parts);

}  // namespace csgrun
