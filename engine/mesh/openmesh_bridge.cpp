// OpenMesh 9 aborts on a face that repeats a vertex and reports complex vertices on standard error
// only; so the arrays are proved to be a manifold before it sees them.
#include <algorithm>
#include <string>
#include <utility>

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>

#include <csgrun/engine/topology.h>

#include "engine/base/none.h"

namespace csgrun {
namespace {

using Triangles = std::span<const std::array<uint32_t, 3>>;

struct BridgeTraits : OpenMesh::DefaultTraits {
  using Point = OpenMesh::Vec3d;
  using Normal = OpenMesh::Vec3d;
  VertexAttributes(0);
  FaceAttributes(0);
  EdgeAttributes(0);
  HalfedgeAttributes(OpenMesh::Attributes::PrevHalfedge);
};
using HalfEdgeMesh = OpenMesh::TriMesh_ArrayKernelT<BridgeTraits>;

Error invalid(const std::string& what) {
  return {ErrorCode::kInvalidMesh, "not an oriented manifold by index: " + what, {}};
}

/// A triangle seen from one of its corners: the next corner and the one before.
using Wedge = std::pair<uint32_t, uint32_t>;

/// Whether the wedges around a vertex, sorted, form one fan, closed or open.
bool one_fan(std::span<const Wedge> wedges) {
  const auto find = [&](uint32_t next) {
    const auto at = std::lower_bound(wedges.begin(), wedges.end(), Wedge{next, 0});
    return at != wedges.end() && at->first == next ? at : wedges.end();
  };
  // An open fan starts with the wedge that continues no other.
  std::vector<bool> continued(wedges.size());
  for (const Wedge& w : wedges) {
    const auto at = find(w.second);
    if (at != wedges.end()) continued[static_cast<size_t>(at - wedges.begin())] = true;
  }
  const size_t start =
      static_cast<size_t>(std::find(continued.begin(), continued.end(), false) - continued.begin());
  const auto first = wedges.begin() + static_cast<std::ptrdiff_t>(start % wedges.size());
  size_t count = 0;
  auto at = first;
  do {
    ++count;
    at = find(at->second);
  } while (at != wedges.end() && at != first && count <= wedges.size());
  return count == wedges.size();
}

Status check_manifold(Triangles triangles, size_t vertex_count) {
  std::vector<uint32_t> starts(vertex_count + 1, 0);
  for (size_t t = 0; t < triangles.size(); ++t) {
    const auto& [a, b, c] = triangles[t];
    if (std::max({a, b, c}) >= vertex_count) {
      return invalid("triangle " + std::to_string(t) + " has an index out of range");
    }
    if (a == b || b == c || c == a) {
      return invalid("triangle " + std::to_string(t) + " repeats a vertex");
    }
    for (uint32_t v : triangles[t]) ++starts[v + 1];
  }
  for (size_t v = 0; v < vertex_count; ++v) starts[v + 1] += starts[v];
  std::vector<Wedge> wedges(starts.back());
  std::vector<uint32_t> next = starts;
  for (const auto& t : triangles) {
    for (int k = 0; k < 3; ++k) wedges[next[t[k]]++] = {t[(k + 1) % 3], t[(k + 2) % 3]};
  }
  for (size_t v = 0; v < vertex_count; ++v) {
    const std::span<Wedge> around(wedges.data() + starts[v], wedges.data() + starts[v + 1]);
    if (around.empty()) continue;
    std::sort(around.begin(), around.end());
    for (size_t i = 0; i + 1 < around.size(); ++i) {
      if (around[i].first == around[i + 1].first) {
        return invalid("the edge from vertex " + std::to_string(v) + " to " +
                       std::to_string(around[i].first) + " occurs twice");
      }
    }
    if (!one_fan(around)) return invalid("vertex " + std::to_string(v) + " has several fans");
  }
  return std::monostate{};
}

Result<HalfEdgeMesh> to_openmesh(Triangles triangles, size_t vertex_count) {
  HalfEdgeMesh mesh;
  mesh.reserve(vertex_count, triangles.size() * 3 / 2 + vertex_count, triangles.size());
  for (size_t v = 0; v < vertex_count; ++v) mesh.new_vertex();
  for (const auto& t : triangles) {
    const auto handle = [](uint32_t v) { return OpenMesh::VertexHandle(static_cast<int>(v)); };
    if (!mesh.add_face(handle(t[0]), handle(t[1]), handle(t[2])).is_valid()) {
      return Error{ErrorCode::kInternal, "OpenMesh refused a triangle of a manifold", {}};
    }
  }
  return mesh;
}

/// Numbers the components by flooding over edges, in the order of their first triangles.
void flood(const HalfEdgeMesh& mesh, MeshTopology& topology) {
  topology.component_of_triangle.assign(mesh.n_faces(), kNone);
  std::vector<OpenMesh::FaceHandle> todo;
  const auto reach = [&](OpenMesh::FaceHandle face, uint32_t component) {
    uint32_t& number = topology.component_of_triangle[static_cast<size_t>(face.idx())];
    if (number != kNone) return;
    number = component;
    todo.push_back(face);
  };
  for (const OpenMesh::FaceHandle seed : mesh.faces()) {
    if (topology.component_of_triangle[static_cast<size_t>(seed.idx())] != kNone) continue;
    const uint32_t component = topology.components++;
    reach(seed, component);
    while (!todo.empty()) {
      const OpenMesh::FaceHandle face = todo.back();
      todo.pop_back();
      OpenMesh::HalfedgeHandle h = mesh.halfedge_handle(face);
      for (int k = 0; k < 3; ++k, h = mesh.next_halfedge_handle(h)) {
        const OpenMesh::FaceHandle other = mesh.face_handle(mesh.opposite_halfedge_handle(h));
        if (other.is_valid()) reach(other, component);
      }
    }
  }
}

}  // namespace

Result<MeshTopology> analyse_topology(Triangles triangles, size_t vertex_count) {
  if (const Status status = check_manifold(triangles, vertex_count); !status) return status.error();
  const Result<HalfEdgeMesh> built = to_openmesh(triangles, vertex_count);
  if (!built) return built.error();
  const HalfEdgeMesh& mesh = *built;

  MeshTopology topology;
  flood(mesh, topology);

  // Euler's characteristic of all components together; each boundary cycle counts as a face.
  int64_t euler = static_cast<int64_t>(mesh.n_faces()) - static_cast<int64_t>(mesh.n_edges());
  for (const OpenMesh::VertexHandle v : mesh.vertices()) {
    if (!mesh.is_isolated(v)) ++euler;
  }
  std::vector<bool> seen(mesh.n_halfedges());
  for (const OpenMesh::HalfedgeHandle start : mesh.halfedges()) {
    if (!mesh.is_boundary(start)) continue;
    ++topology.boundary_edges;
    if (seen[static_cast<size_t>(start.idx())]) continue;
    ++euler;
    for (OpenMesh::HalfedgeHandle h = start; !seen[static_cast<size_t>(h.idx())];
         h = mesh.next_halfedge_handle(h)) {
      seen[static_cast<size_t>(h.idx())] = true;
    }
  }
  topology.closed = topology.boundary_edges == 0;
  topology.genus = (2 * static_cast<int64_t>(topology.components) - euler) / 2;
  return topology;
}

}  // namespace csgrun
