#include "engine/bsp/boundary_mesh.h"

#include <algorithm>
#include <cmath>

#include "engine/bsp/untouched.h"
#include "engine/exact/grid_meeting.h"

namespace csgrun {

FaceLabel label_of(const Operand& operand, uint32_t face) {
  FaceLabel label;
  if (operand.leaf) {
    const LeafGeometry& leaf = *operand.leaf;
    label = {operand.first_source, leaf.facet[face], leaf.surface[face], leaf.appearance[face]};
  } else {
    const BoundaryMesh& mesh = *operand.boundary;
    if (face < mesh.faces.size()) {
      label = mesh.faces[face].label;
    } else {
      const BoundaryMesh::NamedFace named = mesh.named_face(face);
      label = named.part->label(named.face);
    }
    label.source += operand.first_source;
  }
  if (operand.appearance) label.appearance = *operand.appearance;
  return label;
}

Plane translate_plane(const Plane& p, const IVec3& t) {
  return {p.a, p.b, p.c, p.d - (p.a * t[0] + p.b * t[1] + p.c * t[2])};
}

std::array<double, 3> rounded_when_moved(const BoundaryMesh& mesh, uint32_t point, const IVec3& t) {
  std::array<double, 3> at = mesh.point_rounded[point];
  if (t == IVec3{0, 0, 0}) return at;
  const auto& named = mesh.point_planes[point];
  const Plane &p = mesh.planes[named[0]], &q = mesh.planes[named[1]], &r = mesh.planes[named[2]];
  if (meet_on_grid(p, q, r, at)) {
    for (size_t k = 0; k < 3; ++k) at[k] += static_cast<double>(t[k]);
    return at;
  }
  return rounded(intersect(translate_plane(p, t), translate_plane(q, t), translate_plane(r, t)));
}

BoundaryMesh translated(const BoundaryMesh& mesh, const IVec3& t) {
  const bool is_on_grid = std::all_of(mesh.parts.begin(), mesh.parts.end(),
                                      [](const UntouchedPart& p) { return p.map.is_identity(); });
  // Whole steps are none in a frame.
  BoundaryMesh moved = is_on_grid ? mesh : *expanded(std::make_shared<BoundaryMesh>(mesh));
  const BoundaryMesh& from = is_on_grid ? mesh : moved;
  for (uint32_t p = 0; p < moved.point_planes.size(); ++p) {
    moved.point_rounded[p] = rounded_when_moved(from, p, t);
  }
  for (Plane& plane : moved.planes) plane = translate_plane(plane, t);
  for (GridBox& box : moved.touches) box = box.moved(t);
  for (UntouchedPart& part : moved.parts) {
    for (int k = 0; k < 3; ++k) part.translation[k] += t[k];
  }
  return moved;
}

bool is_empty(const BoundaryMesh& b) { return b.faces.empty() && b.parts.empty(); }

size_t face_count(const BoundaryMesh& b) {
  size_t count = b.faces.size();
  for (const UntouchedPart& part : b.parts) count += part.faces.size();
  return count;
}

size_t memory_bytes(const BoundaryMesh& b) {
  size_t bytes =
      sizeof b + b.planes.size() * sizeof(Plane) +
      b.point_planes.size() * (sizeof(std::array<uint32_t, 3>) + sizeof(std::array<double, 3>)) +
      b.faces.size() * sizeof(BoundaryMesh::Face) + b.loop_starts.size() * sizeof(uint32_t) +
      b.corners.size() * sizeof(BoundaryMesh::Corner) + b.touches.size() * sizeof(GridBox);
  for (const UntouchedPart& part : b.parts) {
    bytes += sizeof part + part.faces.size() * sizeof(uint32_t) +
             part.shared.size() * sizeof(UntouchedPart::Shared) +
             part.world.size() * sizeof part.world[0];
  }
  return bytes;
}

GridBox bounding_box(const BoundaryMesh& b) {
  GridBox box;
  if (is_empty(b)) return box;
  box.lo = {INT64_MAX, INT64_MAX, INT64_MAX};
  box.hi = {INT64_MIN, INT64_MIN, INT64_MIN};
  const auto include = [&box](int k, int64_t lo, int64_t hi) {
    box.lo[k] = std::min(box.lo[k], lo);
    box.hi[k] = std::max(box.hi[k], hi);
  };
  const auto include_point = [&include](const std::array<double, 3>& p) {
    for (int k = 0; k < 3; ++k) {
      // The true coordinate is within half a unit in the last place of the rounded one.
      const bool whole = p[k] == std::floor(p[k]);
      const double lo = whole ? p[k] - 1 : std::floor(p[k]),
                   hi = whole ? p[k] + 1 : std::ceil(p[k]);
      include(k, static_cast<int64_t>(lo), static_cast<int64_t>(hi));
    }
  };
  for (const auto& p : b.point_rounded) include_point(p);
  for (const UntouchedPart& part : b.parts) {
    for (const uint32_t f : part.faces) {
      for (const uint32_t v : part.triangle(f)) include_point(part.rounded_point(v));
    }
  }
  return box;
}

std::optional<uint32_t> only_appearance(const BoundaryMesh& b) {
  std::optional<uint32_t> only;
  bool several = false;
  const auto see = [&](uint32_t appearance) {
    if (!only) only = appearance;
    several = several || *only != appearance;
  };
  for (const BoundaryMesh::Face& f : b.faces) see(f.label.appearance);
  for (const UntouchedPart& part : b.parts) {
    if (part.appearance) {
      see(*part.appearance);
    } else {
      for (const uint32_t f : part.faces) see(part.leaf->appearance[f]);
    }
  }
  return several ? std::nullopt : only;
}

}  // namespace csgrun
