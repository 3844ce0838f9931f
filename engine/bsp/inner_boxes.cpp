#include "engine/bsp/inner_boxes.h"

#include <cmath>
#include <limits>
#include <utility>

#include "engine/bsp/convex_sides.h"

namespace csgrun {
namespace {

/// Each pair of polygons is held against all of them.
constexpr size_t kMost = 4;
/// What takes up less of the whole is not worth it.
constexpr double kLeastShare = 1.0 / 32;

double volume(const PolygonBox& box) {
  double product = 1;
  for (size_t k = 0; k < 3; ++k) {
    product *= std::max(0.0, static_cast<double>(box.hi[k]) - box.lo[k]);
  }
  return product;
}

/// A box inside of an operand, from a point that is behind all its faces: first one with the
/// proportions of the box around it, then as far as there is room to either side along each axis.
/// A point that is behind the planes of all faces of a closed surface is inside of it (see
/// OperandBalls::Ball::of).
class BoxInside {
 public:
  BoxInside(const Operand& operand, const PolygonBox& around) {
    std::array<double, 3> half{};
    for (size_t k = 0; k < 3; ++k) {
      middle_[k] = (static_cast<double>(around.lo[k]) + around.hi[k]) / 2;
      half[k] = (static_cast<double>(around.hi[k]) - around.lo[k]) / 2;
    }
    const FrameMap map(operand.frame);
    double scale = 1;
    for (size_t f = 0; f < operand.leaf->face_count(); ++f) {
      const UnitPlane plane = unit_plane(operand, map, f);
      // Less a step, which is more than all is wrong by.
      faces_.push_back({{plane[0], plane[1], plane[2]}, -above(plane, middle_) - 1});
      double reach = 0;
      for (size_t k = 0; k < 3; ++k) reach += std::fabs(plane[k]) * half[k];
      scale = std::min(scale, reach > 0 ? faces_.back().room / reach : 0);
    }
    if (!(scale > 0)) return;  // the middle is not behind all faces
    for (size_t k = 0; k < 3; ++k) down_[k] = up_[k] = scale * half[k];
    for (size_t k = 0; k < 3; ++k) {
      down_[k] = std::min(half[k], down_[k] + room_beyond(k, -1));
      up_[k] = std::min(half[k], up_[k] + room_beyond(k, 1));
    }
  }
  /// None where the middle is not behind all faces.
  [[nodiscard]] PolygonBox box() const {
    PolygonBox box = PolygonBox::none();
    for (size_t k = 0; k < 3; ++k) {
      if (!(down_[k] > 0)) return PolygonBox::none();
      box.lo[k] = static_cast<int32_t>(std::ceil(middle_[k] - down_[k]));
      box.hi[k] = static_cast<int32_t>(std::floor(middle_[k] + up_[k]));
    }
    return box;
  }

 private:
  struct Face {
    std::array<double, 3> normal;
    double room;  ///< between the middle and its plane
  };
  /// How much longer the box may be along an axis, downwards or upwards.
  [[nodiscard]] double room_beyond(size_t axis, double way) const {
    double least = std::numeric_limits<double>::max();
    for (const Face& face : faces_) {
      double room = face.room;
      for (size_t k = 0; k < 3; ++k) {
        room -= std::max(face.normal[k] * up_[k], -face.normal[k] * down_[k]);
      }
      room = std::max(room, 0.0);  // it may be less by rounding
      const double slope = face.normal[axis] * way;
      if (slope > 0) least = std::min(least, room / slope);
    }
    return least;
  }

  std::array<double, 3> middle_{}, down_{}, up_{};
  std::vector<Face> faces_;
};

}  // namespace

InnerBoxes::InnerBoxes(const std::vector<Operand>& operands, const std::vector<PolygonBox>& boxes,
                       const std::vector<uint8_t>& wanted, const PolygonBox& whole) {
  const double least = kLeastShare * volume(whole);
  std::vector<std::pair<double, uint32_t>> candidates;  // by what is around them
  for (uint32_t o = 0; o < operands.size(); ++o) {
    const double around = volume(boxes[o]);
    if (wanted[o] != 0 && around > least) candidates.emplace_back(-around, o);
  }
  const size_t count = std::min(kMost, candidates.size());
  std::partial_sort(candidates.begin(), candidates.begin() + static_cast<long>(count),
                    candidates.end());
  candidates.resize(count);
  for (const auto& [none, o] : candidates) {
    const PolygonBox inside = BoxInside(operands[o], boxes[o]).box();
    if (!inside.is_empty() && volume(inside) > least) all_.push_back({inside, o});
  }
}

bool InnerBoxes::hold(const std::array<double, 3>& point, double error) const {
  return std::any_of(all_.begin(), all_.end(), [&](const Inner& inner) {
    bool all = true;
    for (size_t k = 0; k < 3; ++k) {
      all &= point[k] - error >= inner.box.lo[k] && point[k] + error <= inner.box.hi[k];
    }
    return all;
  });
}

}  // namespace csgrun
