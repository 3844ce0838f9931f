// The corners of polygons of many, eight by eight: most are on one side of a plane with those
// beside them.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/bsp/job.h"
#include "engine/bsp/vertex_signs.h"

namespace csgrun {

/// Boxes around the corners of the polygons that were asked for last.
class CornerBlocks {
 public:
  static constexpr uint32_t kEach = 8;  ///< corners
  /// Of fewer corners each is asked about.
  static constexpr uint32_t kWorthIt = 2 * kEach;

  explicit CornerBlocks(const Job& job) : job_(job) {}

  /// Those of a polygon, in its order; valid until the next one is asked for. O(corners) if it was
  /// not known.
  [[nodiscard]] std::span<const VertexSigns::Box> of(uint32_t polygon) {
    Known& known = known_[polygon % known_.size()];
    if (known.polygon != polygon) {
      known.polygon = polygon;
      make(job_.corners(job_.polygons()[polygon]), known.boxes);
    }
    return known.boxes;
  }

 private:
  struct Known {
    uint32_t polygon = kNone;
    std::vector<VertexSigns::Box> boxes;
  };

  void make(std::span<const uint32_t> corners, std::vector<VertexSigns::Box>& boxes) const {
    boxes.clear();
    for (size_t begin = 0; begin < corners.size(); begin += kEach) {
      const auto block = corners.subspan(begin, std::min<size_t>(kEach, corners.size() - begin));
      VertexSigns::Position lo = job_.rounded(block[0]), hi = lo;
      for (const uint32_t v : block.subspan(1)) {
        const VertexSigns::Position& at = job_.rounded(v);
        for (size_t k = 0; k < 3; ++k) {
          lo[k] = std::min(lo[k], at[k]);
          hi[k] = std::max(hi[k], at[k]);
        }
      }
      VertexSigns::Box& box = boxes.emplace_back();
      for (size_t k = 0; k < 3; ++k) {
        box.middle[k] = lo[k] / 2 + hi[k] / 2;
        box.reach[k] = std::max(hi[k] - box.middle[k], box.middle[k] - lo[k]);
      }
    }
  }

  const Job& job_;
  std::array<Known, 16> known_;
};

}  // namespace csgrun
