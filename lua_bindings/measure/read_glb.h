// Reading the triangles of a GLB or glTF file, for measuring it.
#pragma once

#include <functional>
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

struct GltfOptions {
  GltfFrame frame = GltfFrame::kMeshes;
  /// The bytes of a file beside this one, or below, that it names as a buffer. Empty: only data in
  /// the file itself is read.
  std::function<Result<std::string>(const std::string&)> open;
  std::vector<std::string>* notes = nullptr;  ///< gets what is not read, though it is drawn
};

/// One mesh for each node that shows one, with all its primitives of triangles, where the nodes put
/// it, with the colours of its materials. kMeshes: where the nodes below the file's root put it;
/// the root's own turn and scale, which make glTF's axes and units, are left out. Points are one
/// where the file's EXT_mesh_manifold says so, or without it where their coordinates are equal. A
/// file that starts with a brace is glTF. A buffer whose address leads out of the file's folder is
/// an error. `name` stands in messages. Errors: kMalformedFile, and those of `open`.
Result<std::vector<TriangleMesh>> parse_glb(const std::string& name, std::string_view bytes,
                                            const GltfOptions& options = {});

}  // namespace csgrun
