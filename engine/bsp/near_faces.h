// The faces of large leaves that a job needs: those near another operand. What is beyond is only
// asked for its fate, and named in the result (bsp/untouched).
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "engine/base/raw_vector.h"
#include "engine/bsp/operand.h"
#include "engine/bsp/polygon_box.h"
#include "engine/bsp/rounded_box.h"

namespace csgrun {

struct NearPairs;
struct PairCells;

struct NearFaces {
  std::vector<std::vector<uint32_t>> faces;  ///< per operand those that are near, ascending
  std::vector<PolygonBox> boxes;             ///< per operand, around all faces
  /// Per operand all vertices, if they had to be rounded: those of a leaf in a frame.
  std::vector<RoundedPoints> rounded;
  /// One of these, of the faces as they are numbered in this order: pairs whose boxes overlap, or
  /// what find_coarse_cells would find. Neither where the pieces of a result told what is near.
  std::shared_ptr<const NearPairs> pairs;
  std::shared_ptr<const PairCells> cells;
};

/// Of one operand the faces that are not near and are left, ascending: as they are, or turned over.
struct FarFaces {
  RawVector<uint32_t> kept, flipped;
};

/// The faces whose boxes overlap some of another operand, or, where too many do, that share a cell
/// of a coarse grid with it; and all that share a vertex with these: no other face is met, and what
/// is around a vertex of one was not met either. Nothing when it is not worth the while, or when
/// faces that are not met may have to be spelled out: only for two leaves, whose frames do not
/// mirror, of triangles that each are a facet of its own, with one fan around each vertex. O(n),
/// parallel.
std::optional<NearFaces> find_near_faces(const std::vector<Operand>& operands, uint32_t limit);

/// The box of a leaf on the grid, moved by whole steps; none if it is too far out. O(vertices).
std::optional<PolygonBox> box_of_leaf(const LeafGeometry& leaf, const IVec3& translation);

/// The box of a face of a leaf on the grid, moved by whole steps.
PolygonBox box_of_face(const LeafGeometry& leaf, size_t face, const IVec3& translation);

/// Calls visit(face) for the faces of a leaf that are not in a list, which ascends.
template <class Visit>
void for_each_far_face(const LeafGeometry& leaf, const std::vector<uint32_t>& near, Visit&& visit) {
  uint32_t next = 0;
  for (const uint32_t face : near) {
    for (; next < face; ++next) visit(next);
    next = face + 1;
  }
  for (; next < leaf.face_count(); ++next) visit(next);
}

}  // namespace csgrun
