#include "engine/bsp/rounded_box.h"

#include "engine/bsp/piece_tree.h"

namespace csgrun {

PolygonBox rounded_outwards(const PieceBox& box) {
  // A whole coordinate may stand for one that is a little less, or more: it goes a step further.
  PolygonBox result{};
  for (size_t k = 0; k < 3; ++k) {
    const double lo = clamp_to_box(box.lo[k]), hi = clamp_to_box(box.hi[k]);
    const auto whole_lo = static_cast<int32_t>(lo), whole_hi = static_cast<int32_t>(hi);
    result.lo[k] = std::max(whole_lo - (lo > whole_lo ? 0 : 1), -PolygonBox::kLimit);
    result.hi[k] = std::min(whole_hi + (hi < whole_hi ? 0 : 1), PolygonBox::kLimit);
  }
  return result;
}

std::optional<PolygonBox> box_of_rounded(std::span<const std::array<double, 3>> points) {
  PieceBox all;
  for (const auto& point : points) all.add(point);
  constexpr double kMost = PolygonBox::kLimit - 1;
  for (size_t k = 0; k < 3; ++k) {
    if (all.lo[k] < -kMost || all.hi[k] > kMost) return std::nullopt;
  }
  return rounded_outwards(all);
}

}  // namespace csgrun
