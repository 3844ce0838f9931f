#include "engine/mesh/spread_vertices.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>

#include "engine/mesh/face_normal.h"

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

bool is_straight(const LeafGeometry& leaf, uint32_t a, uint32_t b, uint32_t c) {
  const IVec3& origin = leaf.vertices[b];
  return cross(difference(leaf.vertices[a], origin), difference(leaf.vertices[c], origin)) ==
         IVec3{0, 0, 0};
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
/// Looks at `faces` many faces, which face_at(i) names.
template <class FaceAt>
std::vector<uint8_t> common_directions(const LeafGeometry& leaf, size_t faces, FaceAt face_at,
                                       uint8_t none) {
  const size_t count = leaf.vertices.size();
  std::vector<uint16_t> common(count, kAll);
  for (size_t i = 0; i < faces; ++i) {
    const uint32_t f = face_at(i), begin = leaf.face_starts[f], end = leaf.face_starts[f + 1];
    const uint16_t bits = facing<0, kAxes>(face_normal(leaf, begin, end));
    for (uint32_t c = begin; c < end; ++c) common[leaf.corners[c]] &= bits;
  }
  const auto is_open = [&](uint32_t v) { return (common[v] & kAlongAxes) == 0; };
  std::vector<uint8_t> direction(count);
  bool any_open = false;
  for (uint32_t v = 0; v < count; ++v) any_open |= is_open(v);
  for (size_t i = 0; any_open && i < faces; ++i) {
    const uint32_t f = face_at(i), begin = leaf.face_starts[f], end = leaf.face_starts[f + 1];
    if (std::none_of(&leaf.corners[begin], &leaf.corners[end - 1] + 1, is_open)) continue;
    const uint16_t bits = facing<kAxes, kDirections.size()>(face_normal(leaf, begin, end));
    for (uint32_t c = begin; c < end; ++c) common[leaf.corners[c]] &= bits;
  }
  for (size_t v = 0; v < count; ++v) {
    const auto lowest = static_cast<uint8_t>(std::countr_zero(uint32_t{common[v]}) / 2);
    direction[v] = common[v] != 0 ? lowest : none;
  }
  return direction;
}

template <class FaceAt>
std::vector<uint8_t> spread_among(const LeafGeometry& leaf, size_t faces, FaceAt face_at) {
  constexpr uint8_t kUnknown = 255, kMany = 2;
  const std::vector<uint8_t> direction = common_directions(leaf, faces, face_at, kUnknown);
  // Each corner is a sector of less than half a turn, all in the same sense. So none leads past the
  // upper half plane, and together they surround the vertex as often as one of them enters it.
  std::vector<uint8_t> turns(leaf.vertices.size(), 0);
  const auto count_turn = [&](uint32_t vertex, uint32_t after, uint32_t before) {
    const IVec3 &own = leaf.vertices[vertex], &from = leaf.vertices[after],
                &to = leaf.vertices[before];
    const uint8_t d = direction[vertex];
    bool enters = false;
    if (d < kAxes) {
      const size_t up = kUps[d].axis;
      enters = (from[up] <= own[up]) & (to[up] > own[up]);
    } else if (d != kUnknown) {
      const int64_t level = height(kUps[d], own);
      enters = height(kUps[d], from) <= level && height(kUps[d], to) > level;
    }
    turns[vertex] = static_cast<uint8_t>(std::min<int>(turns[vertex] + (enters ? 1 : 0), kMany));
  };
  for (size_t k = 0; k < faces; ++k) {
    const uint32_t f = face_at(k);
    const uint32_t begin = leaf.face_starts[f], count = leaf.face_starts[f + 1] - begin;
    const uint32_t* const loop = &leaf.corners[begin];
    if (count == 3) {
      count_turn(loop[0], loop[1], loop[2]);
      count_turn(loop[1], loop[2], loop[0]);
      count_turn(loop[2], loop[0], loop[1]);
      continue;
    }
    for (uint32_t i = 0; i < count; ++i) {
      const uint32_t after = loop[(i + 1) % count], before = loop[(i + count - 1) % count];
      if (is_straight(leaf, before, loop[i], after)) turns[loop[i]] = kMany;
      count_turn(loop[i], after, before);
    }
  }
  for (uint8_t& known : turns) known = known == 1;
  return turns;
}

}  // namespace

std::vector<uint8_t> find_spread_vertices(const LeafGeometry& leaf) {
  return spread_among(leaf, leaf.face_count(), [](size_t i) { return static_cast<uint32_t>(i); });
}

std::vector<uint8_t> find_spread_vertices(const LeafGeometry& leaf,
                                          std::span<const uint32_t> faces) {
  return spread_among(leaf, faces.size(), [&](size_t i) { return faces[i]; });
}

}  // namespace csgrun
