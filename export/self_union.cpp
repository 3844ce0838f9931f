#include "export/self_union.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <memory>

#include <glm/geometric.hpp>

#include "export/defects.h"
#include "export/none.h"

namespace csgrun {
namespace {

/// The mesh as a leaf. Each face of the original solid is an appearance of its own, which the
/// engine keeps apart and hands on to what is left of it.
PolygonMesh leaf_of(const RoundedMesh& mesh, const MeshFaces& faces) {
  PolygonMesh leaf;
  leaf.kind = "rounded mesh";
  leaf.fill = FillRule::kPositive;
  const std::vector<uint32_t> place = number_places(mesh.positions);
  leaf.points = positions_of_places(mesh.positions, place);
  std::map<uint32_t, uint32_t> tags;  // original face -> appearance
  for (size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& [a, b, c] = mesh.triangles[t];
    leaf.add_face(Triangle{place[a], place[b], place[c]});
    const uint32_t face = faces.original[mesh.triangle_face[t]];
    const auto [tag, is_new] = tags.emplace(face, static_cast<uint32_t>(leaf.appearances.size()));
    if (is_new) {
      Appearance appearance;
      appearance.is_default = false;
      appearance.name = std::to_string(face);
      leaf.appearances.push_back(std::move(appearance));
    }
    leaf.appearance_of.push_back(tag->second);
  }
  return leaf;
}

/// How far the vertex that is farthest from the lattice is from it.
double farthest_from(const GridStep& lattice, const RoundedMesh& mesh) {
  const double step = std::ldexp(1.0, lattice.exponent);
  double farthest = 0;
  for (const glm::dvec3& p : mesh.positions) {
    glm::dvec3 rest;
    for (int k = 0; k < 3; ++k) rest[k] = p[k] - std::nearbyint(p[k] / step) * step;
    farthest = std::max(farthest, glm::length(rest));
  }
  return farthest;
}

/// The face of the original solid that an appearance of leaf_of() stands for.
uint32_t face_of(const Appearance& appearance) {
  uint32_t face = kNone;
  const std::string& name = appearance.name;
  std::from_chars(name.data(), name.data() + name.size(), face);
  return face;
}

}  // namespace

GridStep lattice_of(std::span<const glm::dvec3> points) {
  double largest = 0;
  for (const glm::dvec3& p : points)
    largest = std::max({largest, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
  int exponent = 0;  // largest < 2^exponent
  std::frexp(largest, &exponent);
  int step = exponent - kGridBits;
  // A double just below a power of two is rounded up to it, which is one step too many.
  if (std::nearbyint(std::ldexp(largest, -step)) >= std::ldexp(1.0, kGridBits)) ++step;
  return {1, 1, step};
}

Status unite_with_itself(RoundedMesh& mesh, MeshFaces& faces, Precision precision,
                         const WriteOptions& options, Moves& moves) {
  EvaluateOptions evaluate;
  evaluate.threads = options.threads;
  evaluate.cancel = options.cancel;
  evaluate.grid = lattice_of(mesh.positions);
  Evaluator evaluator(std::move(evaluate));
  auto solid = evaluator.evaluate(
      Node::leaf(std::make_shared<const PolygonMesh>(leaf_of(mesh, faces))), Measuring::kNothing);
  if (!solid) return solid.error();
  Result<RoundedMesh> rounded = round_part(**solid, {}, precision, false);
  if (!rounded) return rounded.error();
  MeshFaces united;
  united.directions = face_directions(**solid, {});
  for (const Solid::Face& face : (*solid)->faces) {
    united.original.push_back(face_of((*solid)->appearances[face.appearance]));
    if (united.original.back() >= mesh.face_normals.size())
      return Error{ErrorCode::kInternal, "a face of a self-union comes from nowhere", {}};
  }
  faces = std::move(united);
  moves.add(mesh.positions, mesh.triangles, farthest_from(lattice_of(mesh.positions), mesh));
  mesh.positions = std::move(rounded->positions);
  mesh.triangles = std::move(rounded->triangles);
  mesh.triangle_face = std::move(rounded->triangle_face);
  mesh.twins = std::move(rounded->twins);
  moves.add(mesh.positions, mesh.triangles, unit_of(precision, mesh.positions));
  mesh.dropped += rounded->dropped;
  mesh.cancelled += rounded->cancelled;
  for (auto& outline : mesh.outlines) outline.clear();
  return std::monostate{};
}

}  // namespace csgrun
