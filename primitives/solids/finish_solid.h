// The last step for meshes that were not built by construction: weld, check, orient.
#pragma once

#include <string>

#include <csgrun/engine/error.h>
#include <csgrun/engine/polygon_mesh.h>

namespace csgrun {

/// Welds points of equal coordinates, drops corners that repeat their predecessor, checks that the
/// surface is closed and consistently oriented, and turns it over when it is inside out (then
/// `note` says so), unless its fill rule is kPositive. `name` starts every message. Errors:
/// kInvalidMesh, with counts and first places; with `hint` also what would repair the mesh, if
/// anything.
Result<PolygonMesh> finish_solid(PolygonMesh mesh, const std::string& name, std::string* note,
                                 bool hint = false);

}  // namespace csgrun
