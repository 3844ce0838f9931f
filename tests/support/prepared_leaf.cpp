#include "tests/support/prepared_leaf.h"

#include "engine/csg/quantise.h"

namespace csgrun::test {

std::shared_ptr<const LeafGeometry> as_prepared(std::shared_ptr<const LeafGeometry> leaf) {
  PolygonMesh mesh;
  mesh.keep_facets = leaf->keeps_facets();
  for (const IVec3& p : leaf->vertices) {
    mesh.points.emplace_back(static_cast<double>(p[0]), static_cast<double>(p[1]),
                             static_cast<double>(p[2]));
  }
  for (size_t f = 0; f < leaf->face_count(); ++f) {
    mesh.add_face(std::vector(leaf->corners.begin() + leaf->face_starts[f],
                              leaf->corners.begin() + leaf->face_starts[f + 1]),
                  leaf->surface[f]);
  }
  const PreparedLeaf prepared = prepare_leaf(mesh, leaf->vertices, false, leaf->appearance);
  return prepared.status == PreparedLeaf::Status::kGood ? prepared.geometry : leaf;
}

}  // namespace csgrun::test
