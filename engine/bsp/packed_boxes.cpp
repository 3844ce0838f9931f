#include "engine/bsp/packed_boxes.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace csgrun {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr FloatBox kNothing{{kInfinity, kInfinity, kInfinity},
                            {-kInfinity, -kInfinity, -kInfinity}};
constexpr size_t kGroup = 8;
/// So few are not ordered: all pairs of their groups cost less.
constexpr size_t kFew = 4 * kGroup;

void include(FloatBox& box, const FloatBox& other) {
  for (size_t k = 0; k < 3; ++k) {
    box.lo[k] = std::min(box.lo[k], other.lo[k]);
    box.hi[k] = std::max(box.hi[k], other.hi[k]);
  }
}

/// The least and the greatest of eight, by halves, four at a time first.
float least(const std::array<float, kGroup>& x) {
  std::array<float, kGroup / 2> y;
  for (size_t i = 0; i < y.size(); ++i) y[i] = std::min(x[i], x[i + y.size()]);
  return std::min(std::min(y[0], y[2]), std::min(y[1], y[3]));
}
float most(const std::array<float, kGroup>& x) {
  std::array<float, kGroup / 2> y;
  for (size_t i = 0; i < y.size(); ++i) y[i] = std::max(x[i], x[i + y.size()]);
  return std::max(std::max(y[0], y[2]), std::max(y[1], y[3]));
}
/// Around all of them.
FloatBox box_of(const EightBoxes& group) {
  FloatBox box;
  for (size_t k = 0; k < 3; ++k) {
    box.lo[k] = least(group.lo[k]);
    box.hi[k] = most(group.hi[k]);
  }
  return box;
}

/// Puts two zero bits before each of the lowest 10 bits.
uint32_t spread(uint32_t x) {
  x = (x | x << 16) & 0x030000ff;
  x = (x | x << 8) & 0x0300f00f;
  x = (x | x << 4) & 0x030c30c3;
  return (x | x << 2) & 0x09249249;
}

/// Where a box stands in the space that all fill, in units of 2^-20 of its longest side.
class Curve {
 public:
  explicit Curve(const FloatBox& all) : lo_(all.lo) {
    float extent = 0;
    for (size_t k = 0; k < 3; ++k) extent = std::max(extent, all.hi[k] / 2 - all.lo[k] / 2);
    // Where the quotient is beyond the range of float any order does.
    constexpr float kLeast = kFinest / std::numeric_limits<float>::max();
    scale_ = extent > 2 * kLeast ? kFinest / extent : 0;
  }

  /// 30 bits for the upper ten bits of all three coordinates, or for the lower ten.
  [[nodiscard]] uint32_t code(const FloatBox& box, bool upper) const {
    uint32_t code = 0;
    for (size_t k = 0; k < 3; ++k) {
      const float from_lo = (box.lo[k] / 2 - lo_[k] / 2) + (box.hi[k] / 2 - lo_[k] / 2);
      const auto at = static_cast<uint32_t>(std::min(from_lo / 2 * scale_, kFinest));
      code |= spread(upper ? at >> 10 : at & 0x3ff) << k;
    }
    return code;
  }

 private:
  static constexpr float kFinest = 0xfffff;
  std::array<float, 3> lo_;
  float scale_;
};

struct Keyed {
  uint32_t key, number;
};

/// Sorts by keys of 30 bits, equal ones staying as they are.
void radix_sort(std::vector<Keyed>& items) {
  constexpr int kBits = 10, kPasses = 3;
  constexpr uint32_t kBuckets = 1u << kBits;
  std::vector<std::array<uint32_t, kBuckets>> counts(kPasses);
  for (const Keyed& item : items) {
    for (int pass = 0; pass < kPasses; ++pass) {
      ++counts[pass][item.key >> (pass * kBits) & (kBuckets - 1)];
    }
  }
  std::vector<Keyed> other(items.size());
  for (int pass = 0; pass < kPasses; ++pass) {
    uint32_t before = 0;
    for (uint32_t& count : counts[pass]) before += std::exchange(count, before);
    for (const Keyed& item : items) {
      other[counts[pass][item.key >> (pass * kBits) & (kBuckets - 1)]++] = item;
    }
    items.swap(other);
  }
}

std::vector<uint32_t> curve_order(std::span<const FloatBox> boxes) {
  std::vector<uint32_t> order(boxes.size());
  if (boxes.size() <= kFew) {
    for (uint32_t i = 0; i < order.size(); ++i) order[i] = i;
    return order;
  }
  FloatBox all = kNothing;
  for (const FloatBox& box : boxes) include(all, box);
  const Curve curve(all);
  std::vector<Keyed> items(boxes.size());
  for (uint32_t i = 0; i < boxes.size(); ++i) items[i] = {curve.code(boxes[i], true), i};
  radix_sort(items);
  // Boxes that are crowded within one step of the upper bits are ordered by the lower ones.
  for (size_t begin = 0, end = 0; begin < items.size(); begin = end) {
    while (end < items.size() && items[end].key == items[begin].key) ++end;
    if (end - begin <= kGroup) continue;
    for (size_t i = begin; i < end; ++i) items[i].key = curve.code(boxes[items[i].number], false);
    std::sort(items.begin() + static_cast<std::ptrdiff_t>(begin),
              items.begin() + static_cast<std::ptrdiff_t>(end), [](const Keyed& a, const Keyed& b) {
                return std::pair(a.key, a.number) < std::pair(b.key, b.number);
              });
  }
  for (size_t i = 0; i < items.size(); ++i) order[i] = items[i].number;
  return order;
}

}  // namespace

PackedBoxes::PackedBoxes(std::span<const FloatBox> boxes,
                         std::span<const std::vector<FloatBox>> more)
    : order_(curve_order(boxes)), levels_(levels_over(boxes)) {
  for (const std::vector<FloatBox>& others : more) more_.push_back(levels_over(others));
}

PackedBoxes::Levels PackedBoxes::levels_over(std::span<const FloatBox> boxes) const {
  Levels levels;
  if (boxes.empty()) return levels;
  Group none;
  for (size_t k = 0; k < 3; ++k) {
    none.lo[k].fill(kInfinity);
    none.hi[k].fill(-kInfinity);
  }
  const auto put = [](Group& group, size_t i, const FloatBox& box) {
    for (size_t k = 0; k < 3; ++k) {
      group.lo[k][i] = box.lo[k];
      group.hi[k][i] = box.hi[k];
    }
  };
  levels.emplace_back((boxes.size() + kGroup - 1) / kGroup, none);
  for (size_t place = 0; place < boxes.size(); ++place) {
    put(levels[0][place / kGroup], place % kGroup, boxes[order_[place]]);
  }
  while (levels.back().size() > 1) {
    const size_t count = levels.back().size();
    levels.emplace_back((count + kGroup - 1) / kGroup, none);
    const std::vector<Group>& below = levels[levels.size() - 2];
    for (size_t place = 0; place < count; ++place) {
      put(levels.back()[place / kGroup], place % kGroup, box_of(below[place]));
    }
  }
  return levels;
}

std::vector<PackedBoxes::Task> PackedBoxes::pair_tasks(size_t wanted) const {
  std::vector<Task> tasks;
  if (levels_.empty()) return tasks;
  tasks.push_back({static_cast<uint32_t>(levels_.size()) - 1, 0, 0});
  std::vector<Task> divided;
  // All tasks are of one level.
  while (tasks.size() < wanted && !tasks.empty() && tasks[0].level > 0) {
    divided.clear();
    for (const Task& task : tasks) {
      for_each_row(task, [&](uint32_t place, uint32_t group, uint32_t hits) {
        for_each_bit(hits, [&](uint32_t bit) {
          divided.push_back({task.level - 1, place, 8 * group + bit});
        });
      });
    }
    tasks.swap(divided);
  }
  return tasks;
}

}  // namespace csgrun
