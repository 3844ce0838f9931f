// Boxes around runs of faces of an operand, for operands through which several rays are sent.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/bsp/job.h"
#include "engine/bsp/near_faces.h"
#include "engine/bsp/piece_tree.h"
#include "engine/bsp/rounded_box.h"

namespace csgrun {

class RayBoxes {
 public:
  static constexpr uint32_t kEach = 16;  ///< faces; fewer in the last run

  explicit RayBoxes(const Job& job) : job_(job) {}

  /// How many faces a ray may meet: the job's polygons of an operand, or all faces of a leaf of
  /// which it has some. REQUIRES: not an operand in pieces.
  [[nodiscard]] uint32_t face_count(uint32_t operand) const {
    return job_.some_faces(operand) ? static_cast<uint32_t>(job_.leaf(operand)->face_count())
                                    : job_.polygon_start(operand + 1) - job_.polygon_start(operand);
  }
  /// The box of one of them.
  [[nodiscard]] PolygonBox box(uint32_t operand, uint32_t face) const {
    if (!job_.some_faces(operand)) return job_.boxes()[job_.polygon_start(operand) + face];
    const LeafGeometry& leaf = *job_.leaf(operand);
    if (job_.has_grid_vertices(operand)) {
      return box_of_face(leaf, face, job_.operand(operand).translation);
    }
    PieceBox box;
    for (uint32_t c = leaf.face_starts[face]; c < leaf.face_starts[face + 1]; ++c) {
      box.add(job_.rounded(job_.vertex_start(operand) + leaf.corners[c]));
    }
    return rounded_outwards(box);
  }

  /// Those around runs of them, in their order. None when an operand is asked about for the first
  /// time, as they cost what they save a ray, or if it has few faces.
  [[nodiscard]] std::span<const PolygonBox> of(uint32_t operand) {
    if (known_.empty()) known_.resize(job_.operand_count());
    Known& known = known_[operand];
    if (!known.was_asked) {
      known.was_asked = true;
    } else if (known.boxes.empty()) {
      make(operand, known.boxes);
    }
    return known.boxes;
  }

 private:
  struct Known {
    bool was_asked = false;
    std::vector<PolygonBox> boxes;
  };

  void make(uint32_t operand, std::vector<PolygonBox>& boxes) const {
    const uint32_t count = face_count(operand);
    if (count <= 2 * kEach) return;
    boxes.reserve(count / kEach + 1);
    for (uint32_t f = 0; f < count; ++f) {
      if (f % kEach == 0) boxes.push_back(PolygonBox::none());
      boxes.back().include(box(operand, f));
    }
  }

  const Job& job_;
  std::vector<Known> known_;
};

}  // namespace csgrun
