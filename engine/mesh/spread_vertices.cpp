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
constexpr size_t kAxes = 3;
constexpr uint16_t kAll = (1 << 2 * kDirections.size()) - 1, kAlongAxes = (1 << 2 * kAxes) - 1;

/// A direction across each of them, which is up as one looks from there: one axis, and so many
/// times another one. For an axis it is the next axis alone.
struct Up {
  size_t axis, other;
  int64_t times;
};
constexpr std::array<Up, 7> kUps{
    {{1, 2, 0}, {2, 0, 0}, {0, 1, 0}, {0, 1, -1}, {0, 1, -1}, {0, 1, 1}, {0, 1, 1}}};

constexpr int64_t height(const Up& up, const IVec3& p) {
  return p[up.axis] + up.times * p[up.other];
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
    if (i < kAxes && kUps[i].times != 0) return false;
  }
  return true;
}
static_assert(are_across());

IVec3 difference(const IVec3& a, const IVec3& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }

IVec3 normal_of(const LeafGeometry& leaf, const uint32_t* t) {
  const IVec3& origin = leaf.vertices[t[0]];
  return cross(difference(leaf.vertices[t[1]], origin), difference(leaf.vertices[t[2]], origin));
}

/// A bit for each direction that a normal has a part along; the others are set too.
template <size_t kFirst, size_t kLast>
uint16_t facing(const IVec3& normal) {
  uint32_t bits = 0;
  for (size_t i = kFirst; i < kLast; ++i) {
    const int64_t along = dot(kDirections[i], normal);
    bits |= static_cast<uint32_t>(along > 0) << 2 * i;
    bits |= static_cast<uint32_t>(along < 0) << (2 * i + 1);
  }
  constexpr uint32_t kAsked = (1u << 2 * kLast) - (1u << 2 * kFirst);
  return static_cast<uint16_t>(bits | (kAll & ~kAsked));
}

/// For each vertex a direction that all its triangles face, one of an axis if there is one; as half
/// the number of its bit.
std::vector<uint8_t> common_directions(const LeafGeometry& leaf, uint8_t none) {
  const size_t count = leaf.vertices.size(), corners = leaf.corners.size();
  std::vector<uint16_t> common(count, kAll);
  for (size_t c = 0; c < corners; c += 3) {
    const uint32_t* const t = &leaf.corners[c];
    const uint16_t bits = facing<0, kAxes>(normal_of(leaf, t));
    for (size_t i = 0; i < 3; ++i) common[t[i]] &= bits;
  }
  const auto is_open = [&](uint32_t v) { return (common[v] & kAlongAxes) == 0; };
  std::vector<uint8_t> direction(count);
  bool any_open = false;
  for (uint32_t v = 0; v < count; ++v) any_open |= is_open(v);
  if (any_open) {
    for (size_t c = 0; c < corners; c += 3) {
      const uint32_t* const t = &leaf.corners[c];
      if (!is_open(t[0]) && !is_open(t[1]) && !is_open(t[2])) continue;
      const uint16_t bits = facing<kAxes, kDirections.size()>(normal_of(leaf, t));
      for (size_t i = 0; i < 3; ++i) common[t[i]] &= bits;
    }
  }
  for (size_t v = 0; v < count; ++v) {
    const auto lowest = static_cast<uint8_t>(std::countr_zero(uint32_t{common[v]}) / 2);
    direction[v] = common[v] != 0 ? lowest : none;
  }
  return direction;
}

}  // namespace

std::vector<uint8_t> find_spread_vertices(const LeafGeometry& leaf) {
  constexpr uint8_t kNone = 255, kMany = 2;
  const std::vector<uint8_t> direction = common_directions(leaf, kNone);
  // Each triangle is a sector of less than half a turn, all in the same sense. So none leads past
  // the upper half plane, and together they surround the vertex as often as one of them enters it.
  std::vector<uint8_t> turns(leaf.vertices.size(), 0);
  for (size_t c = 0; c < leaf.corners.size(); c += 3) {
    const uint32_t* const t = &leaf.corners[c];
    const std::array<const IVec3*, 3> p{&leaf.vertices[t[0]], &leaf.vertices[t[1]],
                                        &leaf.vertices[t[2]]};
    for (size_t i = 0; i < 3; ++i) {
      const IVec3 &own = *p[i], &from = *p[(i + 1) % 3], &to = *p[(i + 2) % 3];
      const uint8_t d = direction[t[i]];
      bool enters = false;
      if (d < kAxes) {
        const size_t up = kUps[d].axis;
        enters = (from[up] <= own[up]) & (to[up] > own[up]);
      } else if (d != kNone) {
        const int64_t level = height(kUps[d], own);
        enters = height(kUps[d], from) <= level && height(kUps[d], to) > level;
      }
      uint8_t& known = turns[t[i]];
      known = static_cast<uint8_t>(std::min<int>(known + (enters ? 1 : 0), kMany));
    }
  }
  for (uint8_t& known : turns) known = known == 1;
  return turns;
}

}  // namespace csgrun
