// Triangles whose boxes hold much of the other operand, as the long triangles of machine parts do
// that stand aslant: cells that are divided by boxes do not tell them from what is only near.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "engine/bsp/job.h"
#include "engine/bsp/job_triangles.h"
#include "engine/bsp/packed_boxes.h"
#include "engine/bsp/slabs.h"

namespace csgrun {

/// Of the polygons of a job. Those of the other operand are in a tree of boxes, and a wide triangle
/// is held against these along its own directions.
class WideTriangles {
 public:
  /// Finds them, and packs the others: O(n) for n polygons. There are none in a job that has not
  /// two operands, or where they are too few to be worth it.
  explicit WideTriangles(const Job& job);

  /// In ascending order.
  [[nodiscard]] const std::vector<uint32_t>& list() const { return list_; }
  /// A byte for each polygon of the job, 1 if it is wide; nothing if none is.
  [[nodiscard]] std::span<const uint8_t> is_wide() const { return is_wide_; }

  /// Calls visit(p, q), p < q, for pairs of the polygon, which is wide, and others that may meet
  /// it, but for those of two that are covered; the pair of two wide ones is visited once, for the
  /// first of them. (Coplanar ones that are apart may be left out, or not.) Thread-safe.
  template <class Visit>
  void visit_pairs(const Job& job, std::span<const uint8_t> covered, uint32_t polygon,
                   Visit&& visit) const {
    const uint32_t own = job.polygons()[polygon].operand;
    const std::optional<Packed>& others = packed_[1 - own];
    if (!others) return;
    const Slabs slabs = slabs_of(job, polygon, reach_);
    const auto sift = [&](const EightBoxes& boxes, uint32_t hits) {
      return hits & ~slabs.apart(boxes, hits);
    };
    others->tree.visit_groups(box_of(job, polygon), sift, [&](uint32_t group, uint32_t hits) {
      const JobTriangles& triangles = others->triangles[group];
      hits &= ~slabs.apart_in_space(triangles.corners, hits & triangles.which);
      PackedBoxes::for_each_bit(hits, [&](uint32_t bit) {
        const uint32_t other = others->polygons[8 * group + bit];
        if (!covered.empty() && covered[polygon] && covered[other]) return;
        if (own == 0) return visit(polygon, other);
        if (!is_wide_[other]) visit(other, polygon);
      });
    });
  }

 private:
  /// Polygons of an operand, by their places in a tree of their boxes.
  struct Packed {
    std::vector<uint32_t> polygons;
    PackedBoxes tree;
    std::vector<JobTriangles> triangles;  ///< eight by eight

    Packed(const Job& job, std::span<const uint32_t> near);
  };
  static FloatBox box_of(const Job& job, uint32_t polygon);
  static std::vector<FloatBox> boxes_of(const Job& job, std::span<const uint32_t> polygons);

  std::vector<uint32_t> list_;
  std::vector<uint8_t> is_wide_;
  double reach_ = 0;                             ///< of all corners
  std::array<std::optional<Packed>, 2> packed_;  ///< per operand, if the other one has wide ones
};

}  // namespace csgrun
