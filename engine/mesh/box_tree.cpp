#include "engine/mesh/box_tree.h"

#include <algorithm>
#include <limits>

namespace csgrun {
namespace {

std::array<double, 3> middle_of(const std::vector<Box>& boxes) {
  if (boxes.empty()) return {0, 0, 0};
  Box all = boxes[0];
  for (const Box& box : boxes) all.include(box);
  std::array<double, 3> middle;
  for (size_t k = 0; k < 3; ++k) middle[k] = all.lo[k] / 2 + all.hi[k] / 2;
  return middle;
}

/// Monotone, and finite for all but NaN.
float round_to_float(double x) {
  constexpr double kMost = std::numeric_limits<float>::max();
  return static_cast<float>(std::clamp(x, -kMost, kMost));
}

}  // namespace

void Box::include(const Box& o) {
  for (int k = 0; k < 3; ++k) {
    lo[k] = std::min(lo[k], o.lo[k]);
    hi[k] = std::max(hi[k], o.hi[k]);
  }
}

BoxTree::BoxTree(const std::vector<Box>& boxes)
    : boxes_(boxes), middle_(middle_of(boxes)), packed_(rounded_boxes()) {}

FloatBox BoxTree::rounded(const Box& box) const {
  FloatBox result;
  for (size_t k = 0; k < 3; ++k) {
    result.lo[k] = round_to_float(box.lo[k] - middle_[k]);
    result.hi[k] = round_to_float(box.hi[k] - middle_[k]);
  }
  return result;
}

std::vector<FloatBox> BoxTree::rounded_boxes() const {
  std::vector<FloatBox> result;
  result.reserve(boxes_.size());
  for (const Box& box : boxes_) result.push_back(rounded(box));
  return result;
}

}  // namespace csgrun
