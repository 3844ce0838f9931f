#include "engine/mesh/triangle_pairs.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace csgrun {
namespace {

/// Differences of coordinates are below 2^30: normals fit 62 bits, and three of their
/// components 63.
constexpr int64_t kLargestExtent = int64_t{1} << 30;

/// The directions from which vertices are looked at: the axes and the diagonals, and the reverse of
/// each. Bit 2 i stands for direction i, bit 2 i + 1 for its reverse.
constexpr std::array<IVec3, 7> kDirections{
    {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}, {1, 1, -1}, {1, -1, 1}, {-1, 1, 1}}};
/// A direction across each of them, which is up as one looks from there.
constexpr std::array<IVec3, 7> kUps{
    {{0, 1, 0}, {0, 0, 1}, {1, 0, 0}, {1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {1, 1, 0}}};

constexpr IVec3 cross(const IVec3& a, const IVec3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
constexpr int64_t dot(const IVec3& a, const IVec3& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
constexpr bool are_across() {
  for (size_t i = 0; i < kUps.size(); ++i) {
    if (dot(kUps[i], kDirections[i]) != 0) return false;
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

bool TrianglePairs::covers(const LeafGeometry& leaf, const GridBox& box) {
  if (leaf.corners.size() != 3 * leaf.face_count()) return false;
  for (int k = 0; k < 3; ++k) {
    if (box.hi[k] - box.lo[k] >= kLargestExtent) return false;
  }
  for (size_t f = 0; f < leaf.face_count(); ++f) {
    if (leaf.face_starts[f] != 3 * f) return false;
  }
  return true;
}

TrianglePairs::TrianglePairs(const LeafGeometry& leaf, const GridBox& box,
                             std::span<const uint32_t> order, bool is_balanced)
    : points_(leaf.vertices.size()), shapes_(order.size()) {
  double reach = 0;  // of all coordinates
  IVec3 middle;
  for (int k = 0; k < 3; ++k) {
    middle[k] = box.lo[k] + (box.hi[k] - box.lo[k]) / 2;
    reach = std::max(reach, static_cast<double>(box.hi[k] - middle[k]));
  }
  for (size_t v = 0; v < points_.size(); ++v) {
    for (size_t k = 0; k < 3; ++k) {
      points_[v][k] = static_cast<double>(leaf.vertices[v][k] - middle[k]);
    }
  }
  for (size_t i = 0; i < order.size(); ++i) {
    const uint32_t* const c = &leaf.corners[3 * size_t{order[i]}];
    const IVec3& origin = leaf.vertices[c[0]];
    const IVec3 normal =
        cross(difference(leaf.vertices[c[1]], origin), difference(leaf.vertices[c[2]], origin));
    Shape& shape = shapes_[i];
    shape.corners = {c[0], c[1], c[2], c[2]};
    shape.offset = 0;
    double size = 0;
    for (size_t k = 0; k < 3; ++k) {
      shape.normal[k] = static_cast<double>(normal[k]);
      size += std::fabs(shape.normal[k]);
    }
    // With u = 2^-53: the normal and the products of three sums are off by 2 u, the sums by 2 u,
    // of the offset and of what it is taken from; the difference by u of both: below 10 u.
    shape.offset = distance(shape, c[0]);
    shape.slack = 0x1p-49 * size * reach;
    shape.spread = 0;
    shape.facing = is_balanced ? facing(normal) : 0;
  }
  if (is_balanced) find_spread_vertices(leaf);
}

void TrianglePairs::find_spread_vertices(const LeafGeometry& leaf) {
  constexpr uint8_t kNone = 255;
  std::vector<uint16_t> common(leaf.vertices.size(), 0x3fff);
  for (const Shape& shape : shapes_) {
    for (int i = 0; i < 3; ++i) common[shape.corners[i]] &= static_cast<uint16_t>(shape.facing);
  }
  std::vector<uint8_t> direction(leaf.vertices.size());
  for (size_t v = 0; v < direction.size(); ++v) {
    direction[v] =
        common[v] == 0 ? kNone : static_cast<uint8_t>(std::countr_zero(uint32_t{common[v]}));
  }
  // Each triangle is a sector of less than half a turn, all in the same sense. So none leads past
  // the upper half plane, and together they surround the vertex as often as one of them enters it.
  std::vector<uint8_t> turns(leaf.vertices.size(), 0);  // 2 stands for more
  for (const Shape& shape : shapes_) {
    for (size_t i = 0; i < 3; ++i) {
      const uint32_t v = shape.corners[i];
      if (direction[v] == kNone) continue;
      const IVec3& up = kUps[direction[v] / 2];
      const auto height = [&](size_t k) { return dot(up, leaf.vertices[shape.corners[k % 3]]); };
      const int64_t own = height(i);
      const bool enters = height(i + 1) <= own && height(i + 2) > own;
      turns[v] = static_cast<uint8_t>(turns[v] + (enters && turns[v] < 2 ? 1 : 0));
    }
  }
  for (Shape& shape : shapes_) {
    for (uint32_t i = 0; i < 3; ++i) {
      const uint32_t v = shape.corners[i];
      shape.spread |= static_cast<uint32_t>(direction[v] != kNone && turns[v] == 1) << i;
    }
  }
}

/// Whether g lies strictly on one side of f's plane.
bool TrianglePairs::beside_plane(const Shape& f, const Shape& g) const {
  const double a = distance(f, g.corners[0]), b = distance(f, g.corners[1]),
               c = distance(f, g.corners[2]);
  return std::min({a, b, c}) > f.slack || std::max({a, b, c}) < -f.slack;
}

bool TrianglePairs::separated(const Shape& f, const Shape& g) const {
  return beside_plane(f, g) || beside_plane(g, f);
}

/// For triangles with common corners: what they have in common lies in both planes, so it is enough
/// that the others of one triangle lie strictly on one side of the plane of the other one.
bool TrianglePairs::neighbours_apart(const Shape& f, const Shape& g) const {
  const auto others_beside = [this](const Shape& s, const Shape& t) {
    const uint32_t common = common_corners(t, s);
    if (common == 7) return false;
    bool front = true, back = true;
    for (uint32_t i = 0; i < 3; ++i) {
      if ((common >> i & 1) != 0) continue;
      const double d = distance(s, t.corners[i]);
      front = front && d > s.slack;
      back = back && d < -s.slack;
    }
    return front || back;
  };
  return others_beside(f, g) || others_beside(g, f);
}

}  // namespace csgrun
