// Which faces of an operand a ray may meet: boxes around runs of them, for operands through which
// several rays are sent, and bins of those that lie beside one another as a ray sees them, for
// those through which many are.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "engine/bsp/job.h"
#include "engine/bsp/near_faces.h"
#include "engine/bsp/piece_tree.h"
#include "engine/bsp/rounded_box.h"
#include "engine/bsp/square_bins.h"

namespace csgrun {

/// Rays run along (1, y, z): aslant, as coordinates along axes are often equal.
struct RayDirection {
  double y, z;
};

class RayBoxes {
 public:
  /// That of rays which are looked up in bins.
  static constexpr RayDirection kFirst = {0.0142578125, 0.0081787109375};
  /// By so much the bins are wide of the boxes on all sides.
  static constexpr double kMargin = 5;

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
    Known& known = of_operand(operand);
    if (!known.was_asked) {
      known.was_asked = true;
    } else if (known.boxes.empty()) {
      make(operand, known.boxes);
    }
    return known.boxes;
  }

  /// Those that a ray from a point along kFirst comes nearer to than kMargin, and others, if many
  /// have asked; nothing otherwise, or if faces are far out.
  [[nodiscard]] std::optional<std::span<const uint32_t>> along_first(
      uint32_t operand, const std::array<double, 3>& from) {
    Known& known = of_operand(operand);
    if (known.rays < kMany && ++known.rays == kMany) make_bins(operand, known);
    if (!known.bins) return std::nullopt;
    return known.bins->at(seen(from[0], from[1], from[2]));
  }

 private:
  /// Bins from the first ray on take as long for 12 shells, those from 4096 on 1.4 times as long.
  static constexpr uint32_t kMany = 256;

  struct Known {
    bool was_asked = false;
    uint32_t rays = 0;
    std::vector<PolygonBox> boxes;
    std::optional<SquareBins> bins;
  };

  Known& of_operand(uint32_t operand) {
    if (known_.empty()) known_.resize(job_.operand_count());
    return known_[operand];
  }

  /// A point as rays along kFirst see it, who are points then. There is no third axis.
  static std::array<double, 3> seen(double x, double y, double z) {
    return {y - kFirst.y * x, z - kFirst.z * x, 0};
  }

  void make_bins(uint32_t operand, Known& known) const {
    const uint32_t count = face_count(operand);
    if (count <= 2 * kEach) return;
    std::vector<SquareBins::Box> boxes(count);
    for (uint32_t f = 0; f < count; ++f) {
      const PolygonBox own = box(operand, f);
      for (size_t k = 0; k < 3; ++k) {
        if (own.lo[k] <= -PolygonBox::kLimit || own.hi[k] >= PolygonBox::kLimit) return;
      }
      boxes[f].lo = seen(own.hi[0], own.lo[1], own.lo[2]);
      boxes[f].hi = seen(own.lo[0], own.hi[1], own.hi[2]);
      for (size_t k = 0; k < 3; ++k) {
        boxes[f].lo[k] -= kMargin;
        boxes[f].hi[k] += kMargin;
      }
    }
    known.bins.emplace(boxes, count);
  }

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
