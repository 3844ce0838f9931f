// Boxes of floats in groups of eight, and the boxes of the groups in groups of eight, up to one
// group: eight of them are held against a box at once.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

namespace csgrun {

/// Axis-aligned box, closed; bounds are finite. Rounding to float is monotone, so boxes that
/// overlap still do when all their bounds are rounded.
struct FloatBox {
  std::array<float, 3> lo, hi;
};

/// Eight boxes: [axis][lane]. Lanes that hold none are inside out: they overlap nothing.
struct alignas(16) EightBoxes {
  std::array<std::array<float, 8>, 3> lo, hi;
};

class PackedBoxes {
 public:
  /// O(n). Boxes are ordered by their middles along a space-filling curve. `more`: the same things
  /// along other axes, which pairs must overlap along too; other visits do not look at them.
  explicit PackedBoxes(std::span<const FloatBox> boxes,
                       std::span<const std::vector<FloatBox>> more = {});

  /// The number of the box at each place in the order.
  [[nodiscard]] const std::vector<uint32_t>& order() const { return order_; }

  /// Calls `visit(place)` for every box that overlaps `box`, in their order.
  template <class Visit>
  void visit_all(const FloatBox& box, Visit visit) const {
    visit_groups(
        box, [](const EightBoxes&, uint32_t hits) { return hits; },
        [&](uint32_t group, uint32_t hits) {
          for_each_bit(hits, [&](uint32_t bit) { visit(8 * group + bit); });
        });
  }

  /// Calls `visit(group, hits)` for groups with boxes that overlap `box`, in their order, with a
  /// bit of `hits` for each: at the places 8 group + bit. `sift(boxes, hits)` says which of the
  /// boxes, and of those around groups, are still of interest.
  template <class Sift, class Visit>
  void visit_groups(const FloatBox& box, Sift sift, Visit visit) const {
    if (levels_.empty()) return;
    std::array<Step, kMostLevels * 8> stack;
    size_t depth = 0;
    stack[depth++] = {static_cast<uint32_t>(levels_.size()) - 1, 0};
    while (depth > 0) {
      const uint32_t level = stack[--depth].level, group = stack[depth].group;
      uint32_t hits = overlapping(levels_[level][group], box);
      if (hits != 0) hits = sift(levels_[level][group], hits);
      if (level == 0) {
        if (hits != 0) visit(group, hits);
        continue;
      }
      for (; hits != 0; hits ^= std::bit_floor(hits)) {
        stack[depth++] = {level - 1, 8 * group + static_cast<uint32_t>(std::bit_width(hits)) - 1};
      }
    }
  }

  /// Two groups of a level, or one twice.
  struct Task {
    uint32_t level, first, second;
  };
  /// All pairs of boxes that overlap, as tasks, about `wanted` of them or more if there are many
  /// boxes: a function of the boxes and of `wanted` only.
  [[nodiscard]] std::vector<Task> pair_tasks(size_t wanted) const;
  /// Calls `visit(place, group, hits)` for boxes that may overlap others in a group, with a bit of
  /// `hits` for each that does: the places of these are 8 group + bit, and above `place`. (Places
  /// fill the last group; those beyond the last box have no hits.) Over all tasks each pair occurs
  /// once. Thread-safe.
  template <class Visit>
  void visit_rows(const Task& task, Visit visit) const {
    std::vector<Task> stack{task};
    while (!stack.empty()) {
      const Task top = stack.back();
      stack.pop_back();
      if (top.level == 0) {
        for_each_row(top, visit);
        continue;
      }
      for_each_row(top, [&](uint32_t place, uint32_t group, uint32_t hits) {
        for_each_bit(hits, [&](uint32_t bit) {
          stack.push_back({top.level - 1, place, 8 * group + bit});
        });
      });
    }
  }

  template <class Visit>
  static void for_each_bit(uint32_t bits, Visit visit) {
    for (; bits != 0; bits &= bits - 1) visit(static_cast<uint32_t>(std::countr_zero(bits)));
  }

 private:
  static constexpr size_t kMostLevels = 11;  // 8^11 > 2^32

  struct Step {
    uint32_t level, group;
  };
  using Group = EightBoxes;
  using Levels = std::vector<std::vector<Group>>;

  [[nodiscard]] Levels levels_over(std::span<const FloatBox> boxes) const;

  /// A bit for each of the eight that overlaps the box.
  static uint32_t overlapping(const Group& group, const FloatBox& box) {
#if defined(__SSE2__)
    uint32_t bits = 0;
    for (size_t half = 0; half < 8; half += 4) {
      __m128 all = _mm_cmple_ps(_mm_load_ps(&group.lo[0][half]), _mm_set1_ps(box.hi[0]));
      all = _mm_and_ps(all, _mm_cmpge_ps(_mm_load_ps(&group.hi[0][half]), _mm_set1_ps(box.lo[0])));
      for (size_t k = 1; k < 3; ++k) {
        all =
            _mm_and_ps(all, _mm_cmple_ps(_mm_load_ps(&group.lo[k][half]), _mm_set1_ps(box.hi[k])));
        all =
            _mm_and_ps(all, _mm_cmpge_ps(_mm_load_ps(&group.hi[k][half]), _mm_set1_ps(box.lo[k])));
      }
      bits |= static_cast<uint32_t>(_mm_movemask_ps(all)) << half;
    }
    return bits;
#else
    uint32_t bits = 0;
    for (size_t i = 0; i < 8; ++i) {
      bool all = true;
      for (size_t k = 0; k < 3; ++k) {
        all = all & (group.lo[k][i] <= box.hi[k]) & (group.hi[k][i] >= box.lo[k]);
      }
      bits |= static_cast<uint32_t>(all) << i;
    }
    return bits;
#endif
  }

  static FloatBox box_at(const std::vector<Group>& level, size_t place) {
    const Group& group = level[place / 8];
    const size_t i = place % 8;
    return {{group.lo[0][i], group.lo[1][i], group.lo[2][i]},
            {group.hi[0][i], group.hi[1][i], group.hi[2][i]}};
  }

  /// Those of `which`, of a group of a level, that overlap a box of a level along all axes.
  [[nodiscard]] uint32_t overlapping_boxes(size_t group_level, size_t group, size_t box_level,
                                           size_t place, uint32_t which) const {
    which &= overlapping(levels_[group_level][group], box_at(levels_[box_level], place));
    for (const Levels& levels : more_) {
      if (which == 0) break;
      which &= overlapping(levels[group_level][group], box_at(levels[box_level], place));
    }
    return which;
  }

  /// What each box of a group of a level overlaps in another one; above the lowest level of a group
  /// also itself.
  template <class Visit>
  void for_each_row(const Task& task, Visit visit) const {
    uint32_t rows = 0xff;
    // Few of either group reach the other one.
    if (task.first != task.second) {
      rows = overlapping_boxes(task.level, task.first, task.level + 1, task.second, rows);
    }
    for_each_bit(rows, [&](uint32_t row) {
      const uint32_t place = 8 * task.first + row;
      uint32_t hits = 0xff;
      if (task.first == task.second) hits <<= task.level == 0 ? row + 1 : row;
      hits = overlapping_boxes(task.level, task.second, task.level, place, hits & 0xff);
      visit(place, task.second, hits);
    });
  }

  std::vector<uint32_t> order_;
  Levels levels_;             ///< the boxes first; the last has one group
  std::vector<Levels> more_;  ///< along other axes
};

}  // namespace csgrun
