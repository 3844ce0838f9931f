// Reading the triangles of a GLB file, for measuring it. Not for modelling: nodes are not placed.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <csgrun/engine/error.h>

#include "lua_bindings/measure/triangle_mesh.h"

namespace csgrun {

/// One mesh for each node that shows one, in its own coordinates, with all its primitives; points
/// of equal coordinates are one. `name` stands in messages. Errors: kMalformedFile.
Result<std::vector<TriangleMesh>> parse_glb(const std::string& name, std::string_view bytes);

}  // namespace csgrun
