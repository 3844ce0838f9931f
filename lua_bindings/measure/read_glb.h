// Reading the triangles of a GLB or glTF file, for measuring it.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <csgrun/engine/error.h>

#include "lua_bindings/measure/triangle_mesh.h"

namespace csgrun {

/// What lengths and axes are read as.
enum class GltfFrame {
  kMeshes,       ///< as the meshes have them: a file of ours holds millimetres, Z up
  kMillimetres,  ///< glTF's metres, Y up, made millimetres, Z up; for a file of ours the same
};

/// One mesh for each node that shows one, with all its primitives, where the nodes put it, with the
/// colours of its materials. kMeshes: where the nodes below the file's root put it; the root's own
/// turn and scale, which make glTF's axes and units, are left out.
/// Points are one where the file's EXT_mesh_manifold says so, or without it where their coordinates
/// are equal. A file that starts with a brace is glTF, whose buffer must
/// be in it: an address that leads out of the file is an error. `name` stands in messages. Errors:
/// kMalformedFile.
Result<std::vector<TriangleMesh>> parse_glb(const std::string& name, std::string_view bytes,
                                            GltfFrame frame = GltfFrame::kMeshes);

}  // namespace csgrun
