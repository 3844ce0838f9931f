#include "engine/mesh/spread_vertices.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>

namespace csgrun {
namespace {

/// The directions from which vertices are looked at: the axes and the diagonals, and the reverse of
/// each. Bit 2 i stands for direction i, bit 2 i + 1 for its reverse.
constexpr std::array<IVec3, 7> kDirections{
    {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}, {1, 1, -1}, {1, -1, 1}, {-1, 1, 1}}};
/// A direction across each of them, which is up as one looks from there: an axis, and so many times
/// the next one.
struct Up {
  size_t axis;
  int64_t times;
};
constexpr std::array<Up, 7> kUps{{{1, 0}, {2, 0}, {0, 0}, {0, -1}, {0, -1}, {0, 1}, {0, 1}}};

constexpr int64_t height(const Up& up, const IVec3& p) {
  return p[up.axis] + up.times * p[(up.axis + 1) % 3];
}
constexpr IVec3 cross(const IVec3& a, const IVec3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
constexpr int64_t dot(const IVec3& a, const IVec3& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
constexpr bool are_across() {
  for (size_t i = 0; i < kUps.size(); ++i) {
    if (height(kUps[i], kDirections[i]) != 0) return false;
  }
  return true;
}
static_assert(are_across());

IVec3 difference(const IVec3& a, const IVec3& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }

/// A bit for each direction that a normal has a part along.
uint32_t facing(const IVec3& normal) {
  uint32_t bits = 0;
  for (size_t i = 0; i < kDirections.size(); ++i) {
    const int64_t along = dot(kDirections[i], normal);
    bits |= static_cast<uint32_t>(along > 0) << 2 * i | static_cast<uint32_t>(along < 0)
                                                            << (2 * i + 1);
  }
  return bits;
}

}  // namespace

std::vector<uint8_t> find_spread_vertices(const LeafGeometry& leaf) {
  constexpr uint16_t kAll = (1 << 2 * kDirections.size()) - 1;
  constexpr uint8_t kNoDirection = 255, kMany = 2;
  const size_t count = leaf.vertices.size(), faces = leaf.face_count();
  std::vector<uint16_t> common(count, kAll);
  for (size_t f = 0; f < faces; ++f) {
    const uint32_t* const t = &leaf.corners[3 * f];
    const IVec3& origin = leaf.vertices[t[0]];
    const IVec3 normal =
        cross(difference(leaf.vertices[t[1]], origin), difference(leaf.vertices[t[2]], origin));
    const auto bits = static_cast<uint16_t>(facing(normal));
    for (size_t i = 0; i < 3; ++i) common[t[i]] &= bits;
  }
  std::vector<uint8_t> direction(count);
  for (size_t v = 0; v < count; ++v) {
    const auto lowest = static_cast<uint8_t>(std::countr_zero(uint32_t{common[v]}) / 2);
    direction[v] = common[v] != 0 ? lowest : kNoDirection;
  }
  // Each triangle is a sector of less than half a turn, all in the same sense. So none leads past
  // the upper half plane, and together they surround the vertex as often as one of them enters it.
  std::vector<uint8_t> turns(count, 0);
  for (size_t f = 0; f < faces; ++f) {
    const uint32_t* const t = &leaf.corners[3 * f];
    const std::array<const IVec3*, 3> p{&leaf.vertices[t[0]], &leaf.vertices[t[1]],
                                        &leaf.vertices[t[2]]};
    for (size_t i = 0; i < 3; ++i) {
      if (direction[t[i]] == kNoDirection) continue;
      const Up& up = kUps[direction[t[i]]];
      const int64_t own = height(up, *p[i]);
      const bool enters = height(up, *p[(i + 1) % 3]) <= own && height(up, *p[(i + 2) % 3]) > own;
      uint8_t& known = turns[t[i]];
      known = static_cast<uint8_t>(std::min<int>(known + (enters ? 1 : 0), kMany));
    }
  }
  for (size_t v = 0; v < count; ++v) turns[v] = turns[v] == 1;
  return turns;
}

}  // namespace csgrun
