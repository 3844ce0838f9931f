// The last step for meshes that were not built by construction: weld, check, orient.
#pragma once

#include <string>

#include <csgrun/engine/error.h>
#include <csgrun/engine/polygon_mesh.h>
#include <csgrun/engine/repair.h>

namespace csgrun {

/// Welds points of equal coordinates, drops corners that repeat their predecessor, checks that the
/// surface is closed and consistently oriented, and turns it over when it is inside out (then
/// `note` says so), unless its fill rule is kPositive. `name` starts every message. Errors:
/// kInvalidMesh, with counts and first places, and with what would repair the mesh, if anything: a
/// call of import for the file `name`, or what to do by hand.
/// Faces of four corners that are bent are cut (see bent_quads.h) before it is turned over; if
/// there are any, `uncut` gets the mesh as it was before both.
Result<PolygonMesh> finish_solid(PolygonMesh mesh, const std::string& name, std::string* note,
                                 bool is_file = false, PolygonMesh* uncut = nullptr);

/// Turns the faces over if they are inside out, and says whether they were.
bool turn_outside(PolygonMesh& mesh);

/// How a script has the file `name` repaired, if not by the options `wanted`: "; a script repairs
/// it by import(...)", or why not. Empty where that would repeat `refusal`.
std::string repair_hint(const PolygonMesh& mesh, const std::string& name,
                        const RepairOptions& wanted, const std::string& refusal);

}  // namespace csgrun
