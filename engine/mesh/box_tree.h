// A static tree over boxes of doubles, for finding those that overlap a given one.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "engine/bsp/packed_boxes.h"

namespace csgrun {

/// Axis-aligned box, closed. Coordinates are exact in double where the caller's are.
struct Box {
  std::array<double, 3> lo, hi;

  [[nodiscard]] bool overlaps(const Box& o) const {
    // Without branches: which of the six decides is as good as random.
    return (lo[0] <= o.hi[0]) & (o.lo[0] <= hi[0]) & (lo[1] <= o.hi[1]) & (o.lo[1] <= hi[1]) &
           (lo[2] <= o.hi[2]) & (o.lo[2] <= hi[2]);
  }
  void include(const Box& o);
};

/// Copes with boxes of very different sizes. REQUIRES: the boxes outlive it. Building costs O(n),
/// O(n log n) where many boxes are crowded.
class BoxTree {
 public:
  explicit BoxTree(const std::vector<Box>& boxes);

  /// Calls `visit(j)` for every j whose box overlaps `box`, in no particular (but deterministic)
  /// order.
  template <class Visit>
  void visit_all(const Box& box, Visit visit) const {
    packed_.visit_all(rounded(box), [&](uint32_t place) {
      const uint32_t j = packed_.order()[place];
      if (boxes_[j].overlaps(box)) visit(j);
    });
  }

  /// The number of the box at each place: they are looked at in this order, eight by eight.
  [[nodiscard]] const std::vector<uint32_t>& order() const { return packed_.order(); }

  /// The same for every j > i whose box overlaps the box of i.
  template <class Visit>
  void visit_later(uint32_t i, Visit visit) const {
    visit_all(boxes_[i], [&](uint32_t j) {
      if (j > i) visit(j);
    });
  }

  /// Tasks for visit_pairs, about so many.
  [[nodiscard]] std::vector<PackedBoxes::Task> pair_tasks(size_t wanted) const {
    return packed_.pair_tasks(wanted);
  }
  /// Calls `visit(i, j)` for pairs whose boxes overlap, over all tasks once for each pair, and of
  /// these for those that are of interest: `sift(place, group, hits)` says with which of those at
  /// the places 8 group + bit, a bit of `hits` for each, that at `place` is. Thread-safe.
  template <class Sift, class Visit>
  void visit_pairs(const PackedBoxes::Task& task, Sift sift, Visit visit) const {
    packed_.visit_rows(task, [&](uint32_t place, uint32_t group, uint32_t hits) {
      if (hits == 0) return;
      const uint32_t i = packed_.order()[place];
      PackedBoxes::for_each_bit(sift(place, group, hits), [&](uint32_t bit) {
        const uint32_t j = packed_.order()[8 * group + bit];
        if (boxes_[j].overlaps(boxes_[i])) visit(i, j);
      });
    });
  }

 private:
  [[nodiscard]] FloatBox rounded(const Box& box) const;
  [[nodiscard]] std::vector<FloatBox> rounded_boxes() const;

  const std::vector<Box>& boxes_;
  std::array<double, 3> middle_;  ///< the origin of what is rounded
  PackedBoxes packed_;
};

}  // namespace csgrun
