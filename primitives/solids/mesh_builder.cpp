#include "primitives/solids/mesh_builder.h"

#include "primitives/base/text.h"

namespace csgrun {

void add_face_with_holes(PolygonMesh& mesh, std::span<const std::vector<uint32_t>> loops,
                         uint32_t surface_id) {
  for (const std::vector<uint32_t>& loop : loops) {
    mesh.corners.insert(mesh.corners.end(), loop.begin(), loop.end());
    mesh.loop_starts.push_back(static_cast<uint32_t>(mesh.corners.size()));
  }
  mesh.face_starts.push_back(static_cast<uint32_t>(mesh.loop_count()));
  mesh.surface.push_back(surface_id);
}

Error too_many_points(const std::string& function, double fragments, double points) {
  return Error{ErrorCode::kLimit,
               function + ": " + number_text(fragments) + " fragments make " + number_text(points) +
                   " points, the limit is " + number_text(kMostPoints),
               {}};
}

}  // namespace csgrun
