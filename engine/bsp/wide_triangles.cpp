#include "engine/bsp/wide_triangles.h"

#include <algorithm>
#include <cstddef>

#include "engine/base/parallel.h"
#include "engine/bsp/polygon_box.h"

namespace csgrun {
namespace {

/// A triangle is wide when its box is longer than so many places along two axes or more, and has so
/// many polygons in the places that it reaches.
constexpr int64_t kFewestPlaces = 2;
constexpr uint32_t kManyOthers = 64;
/// So few pairs are looked at in less time than it takes to count what is where.
constexpr uint64_t kFewPairs = 4096;
/// There is a tree of the others when all wide triangles have so many times as many in their boxes.
constexpr uint64_t kWorthIt = 4;

/// How many polygons of an operand are where, about: counts of the middles of their boxes.
class Density {
 public:
  static constexpr int32_t kPlaces = 16;

  explicit Density(const PolygonBox& bounds)
      : bounds_(bounds),
        side_(side_of(bounds)),
        sums_(size_t{kPlaces + 1} * (kPlaces + 1) * (kPlaces + 1), 0) {}
  /// The length of a place: that of the longest side has kPlaces.
  static int64_t side_of(const PolygonBox& bounds) {
    int64_t longest = 1;
    for (size_t k = 0; k < 3; ++k) {
      longest = std::max(longest, int64_t{bounds.hi[k]} - bounds.lo[k] + 1);
    }
    return (longest + kPlaces - 1) / kPlaces;
  }

  /// REQUIRES: it meets the bounds.
  void add(const PolygonBox& box) {
    std::array<int32_t, 3> at{};
    for (size_t k = 0; k < 3; ++k) {
      at[k] = place(k, static_cast<int32_t>((int64_t{box.lo[k]} + box.hi[k]) / 2)) + 1;
    }
    ++sums_[corner(at[0], at[1], at[2])];
  }
  /// After all were added.
  void add_up() {
    for (int32_t z = 1; z <= kPlaces; ++z) {
      for (int32_t y = 1; y <= kPlaces; ++y) {
        for (int32_t x = 1; x <= kPlaces; ++x) {
          const auto before = [&](int32_t dx, int32_t dy, int32_t dz) {
            return sums_[corner(x - dx, y - dy, z - dz)];
          };
          sums_[corner(x, y, z)] += before(1, 0, 0) + before(0, 1, 0) + before(0, 0, 1) -
                                    before(1, 1, 0) - before(1, 0, 1) - before(0, 1, 1) +
                                    before(1, 1, 1);
        }
      }
    }
  }
  /// How many have their middles in the places that a box reaches.
  [[nodiscard]] uint32_t count(const PolygonBox& box) const {
    std::array<int32_t, 3> lo{}, hi{};
    for (size_t k = 0; k < 3; ++k) lo[k] = place(k, box.lo[k]), hi[k] = place(k, box.hi[k]) + 1;
    uint32_t result = 0;
    for (unsigned ends = 0; ends < 8; ++ends) {
      const auto end = [&](size_t k) { return ends >> k & 1 ? lo[k] : hi[k]; };
      const uint32_t part = sums_[corner(end(0), end(1), end(2))];
      const bool is_odd = ((ends ^ ends >> 1 ^ ends >> 2) & 1) != 0;
      result += is_odd ? 0 - part : part;
    }
    return result;
  }

 private:
  [[nodiscard]] int32_t place(size_t k, int32_t at) const {
    const int64_t from = std::clamp(at, bounds_.lo[k], bounds_.hi[k]) - int64_t{bounds_.lo[k]};
    return static_cast<int32_t>(from / side_);
  }
  /// The corner of a place.
  static size_t corner(int32_t x, int32_t y, int32_t z) {
    constexpr size_t kRow = kPlaces + 1;
    return (static_cast<size_t>(z) * kRow + static_cast<size_t>(y)) * kRow + static_cast<size_t>(x);
  }

  const PolygonBox bounds_;
  const int64_t side_;
  std::vector<uint32_t> sums_;  ///< of what is below each corner of a place
};

/// Whether a box is longer than that along two axes or more.
bool is_wider(const PolygonBox& box, int64_t length) {
  const auto is_longer = [&](size_t k) { return int64_t{box.hi[k]} - box.lo[k] > length; };
  // Most are short along all axes: two tell.
  return is_longer(0) ? is_longer(1) || is_longer(2) : is_longer(1) && is_longer(2);
}

/// The box that both operands have in common, empty where boxes are not to be relied on.
PolygonBox common_box(const Job& job) {
  PolygonBox common = job.operand_box(0);
  for (size_t o = 0; o < 2; ++o) {
    const PolygonBox& box = job.operand_box(o);
    common.clip(box);
    for (size_t k = 0; k < 3; ++k) {
      if (box.lo[k] <= -PolygonBox::kLimit || box.hi[k] >= PolygonBox::kLimit) {
        return PolygonBox::none();
      }
    }
  }
  return common;
}

}  // namespace

FloatBox WideTriangles::box_of(const Job& job, uint32_t polygon) {
  const PolygonBox& box = job.boxes()[polygon];
  FloatBox result{};
  for (size_t k = 0; k < 3; ++k) {
    result.lo[k] = static_cast<float>(box.lo[k]);
    result.hi[k] = static_cast<float>(box.hi[k]);
  }
  return result;
}

std::vector<FloatBox> WideTriangles::boxes_of(const Job& job, std::span<const uint32_t> polygons) {
  std::vector<FloatBox> boxes;
  boxes.reserve(polygons.size());
  for (const uint32_t p : polygons) boxes.push_back(box_of(job, p));
  return boxes;
}

WideTriangles::Packed::Packed(const Job& job, std::span<const uint32_t> near)
    : tree(boxes_of(job, near)) {
  polygons.reserve(near.size());
  for (const uint32_t place : tree.order()) polygons.push_back(near[place]);
  triangles.reserve(polygons.size() / 8 + 1);
  for (size_t at = 0; at < polygons.size(); at += 8) {
    triangles.emplace_back(
        job, std::span(polygons).subspan(at, std::min<size_t>(8, polygons.size() - at)));
  }
}

WideTriangles::WideTriangles(const Job& job) {
  if (job.operand_count() != 2 || job.polygons().size() < kManyOthers) return;
  const PolygonBox common = common_box(job);
  if (common.is_empty()) return;
  std::array<std::vector<uint32_t>, 2> wide, near;
  const int64_t far = kFewestPlaces * Density::side_of(common);
  for (size_t o = 0; o < 2; ++o) {
    for (uint32_t p = job.polygon_start(o); p < job.polygon_start(o + 1); ++p) {
      const PolygonBox& box = job.boxes()[p];
      if (is_wider(box, far) && job.polygons()[p].count == 3 && common.meets(box)) {
        wide[o].push_back(p);
      }
    }
  }
  for (size_t o = 0; o < 2; ++o) {
    // Each has all of the others in its box at most.
    if (wide[1 - o].size() < kWorthIt) {
      wide[1 - o].clear();
      continue;
    }
    for (uint32_t p = job.polygon_start(o); p < job.polygon_start(o + 1); ++p) {
      if (common.meets(job.boxes()[p])) near[o].push_back(p);
    }
  }
  for (size_t o = 0; o < 2; ++o) {
    if (wide[o].empty()) continue;
    const std::vector<uint32_t>& others = near[1 - o];
    if (others.size() < kManyOthers || wide[o].size() * others.size() < kFewPairs) {
      wide[o].clear();
      continue;
    }
    Density density(common);
    for (const uint32_t p : others) density.add(job.boxes()[p]);
    density.add_up();
    uint64_t pairs = 0;
    std::erase_if(wide[o], [&](uint32_t p) {
      const uint32_t count = density.count(job.boxes()[p]);
      if (count >= kManyOthers) pairs += count;
      return count < kManyOthers;
    });
    if (pairs < kWorthIt * others.size()) wide[o].clear();
  }
  if (wide[0].empty() && wide[1].empty()) return;
  for (size_t o = 0; o < 2; ++o) {
    if (!wide[o].empty()) packed_[1 - o].emplace(job, near[1 - o]);
    list_.insert(list_.end(), wide[o].begin(), wide[o].end());
  }
  reach_ = reach_of(job);
  is_wide_.assign(job.polygons().size(), 0);
  for (const uint32_t p : list_) is_wide_[p] = 1;
}

}  // namespace csgrun
