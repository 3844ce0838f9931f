// Loop's subdivision, by OpenMesh.
#include <array>
#include <utility>
#include <vector>

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <OpenMesh/Tools/Subdivider/Uniform/LoopT.hh>

#include <csgrun/primitives/reshape.h>

#include "primitives/solids/finish_solid.h"
#include "primitives/solids/mesh_builder.h"

namespace csgrun {
namespace {

struct SubdivisionTraits : OpenMesh::DefaultTraits {
  using Point = OpenMesh::Vec3d;
  using Normal = OpenMesh::Vec3d;
};
using SubdivisionMesh = OpenMesh::TriMesh_ArrayKernelT<SubdivisionTraits>;

}  // namespace

MeshResult smooth_mesh(PolygonMesh mesh, int steps) {
  double points = static_cast<double>(mesh.points.size());
  for (int i = 0; i < steps; ++i) points *= 4;
  if (points > kMostPoints) {
    return Error{ErrorCode::kLimit, "smooth: so many steps make more than 16777216 points", {}};
  }
  SubdivisionMesh half_edges;
  std::vector<OpenMesh::VertexHandle> vertices;
  for (const glm::dvec3& p : mesh.points)
    vertices.push_back(half_edges.add_vertex({p.x, p.y, p.z}));
  for (size_t f = 0; f < mesh.face_count(); ++f) {
    const uint32_t* t = mesh.corners.data() + mesh.loop_starts[mesh.face_starts[f]];
    if (!half_edges.add_face(vertices[t[0]], vertices[t[1]], vertices[t[2]]).is_valid()) {
      return Error{ErrorCode::kInternal, "smooth: the surface is no manifold", {}};
    }
  }
  std::vector<size_t> parents(mesh.face_count());
  for (size_t f = 0; f < parents.size(); ++f) parents[f] = f;
  OpenMesh::Subdivider::Uniform::LoopT<SubdivisionMesh, double> subdivider;
  subdivider.attach(half_edges);
  for (int i = 0; i < steps; ++i) {
    const size_t before = parents.size();
    subdivider(1);
    // A triangle keeps its number in its middle; the three at its corners come after all, in order.
    for (size_t f = before; f < half_edges.n_faces(); ++f)
      parents.push_back(parents[(f - before) / 3]);
  }
  subdivider.detach();
  PolygonMesh result;
  result.appearances = mesh.appearances;
  for (const auto v : half_edges.vertices()) {
    const auto& p = half_edges.point(v);
    result.points.emplace_back(p[0], p[1], p[2]);
  }
  for (const auto face : half_edges.faces()) {
    std::array<uint32_t, 3> t{};
    size_t k = 0;
    for (const auto v : face.vertices()) t[k++] = static_cast<uint32_t>(v.idx());
    result.add_face(t, 1);
    result.appearance_of.push_back(mesh.appearance_of[parents[static_cast<size_t>(face.idx())]]);
  }
  result.kind = "smooth";
  std::string note;
  return finish_solid(std::move(result), "smooth", &note);
}

}  // namespace csgrun
