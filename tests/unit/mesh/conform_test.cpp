// Contacts of faces of a result: what becomes of those that meet in corners and edges they have in
// common, and of edges that run into a face from one of its corners.
#include "engine/mesh/conform.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include <gtest/gtest.h>

namespace csgrun::conform_test {
namespace {

/// Faces whose corners are on the grid.
class Faces {
 public:
  Faces() : geometry_(planes_, nullptr) {}

  uint32_t point(const IVec3& at) {
    const auto [found, is_new] = points_.try_emplace(at, 0);
    if (is_new) {
      constexpr uint32_t kNoPlane = ~0u;
      found->second = geometry_.add_point(
          {kNoPlane, kNoPlane, kNoPlane},
          {static_cast<double>(at[0]), static_cast<double>(at[1]), static_cast<double>(at[2])},
          true);
    }
    return found->second;
  }

  /// A face of one loop, counter-clockwise seen from outside. Its edges are in planes that stand
  /// upright on it.
  void add(const std::vector<IVec3>& corners) {
    const IVec3 normal = cross(minus(corners[1], corners[0]), minus(corners[2], corners[1]));
    std::vector<DirectedEdge> loop;
    for (size_t i = 0; i < corners.size(); ++i) {
      const IVec3 &from = corners[i], &to = corners[(i + 1) % corners.size()];
      loop.push_back({point(from), point(to), plane(cross(minus(to, from), normal), from).index()});
    }
    faces_.push_back({plane(normal, corners[0]), 0, 0, 0, false, FaceLoops(loop)});
  }

  void conform() {
    std::vector<uint32_t> all(faces_.size());
    std::iota(all.begin(), all.end(), 0);
    conform_contacts(faces_, all, geometry_, planes_);
  }

  [[nodiscard]] const MergedFace& operator[](size_t face) const { return faces_[face]; }
  [[nodiscard]] size_t count() const { return faces_.size(); }
  [[nodiscard]] const std::array<double, 3>& at(uint32_t p) const {
    return geometry_.point(p).rounded;
  }
  [[nodiscard]] uint64_t signs() const {
    const SignCounters& c = geometry_.counters;
    return c.filter + c.symbolic + std::accumulate(c.exact.begin(), c.exact.end(), uint64_t{0});
  }

 private:
  static IVec3 minus(const IVec3& a, const IVec3& b) {
    return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
  }
  static IVec3 cross(const IVec3& a, const IVec3& b) {
    IVec3 n{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
    const int64_t common = std::gcd(std::gcd(n[0], n[1]), n[2]);
    for (int64_t& x : n) x /= common;
    return n;
  }
  PlaneId plane(const IVec3& n, const IVec3& p) {
    return planes_.intern(Plane{n[0], n[1], n[2], -(n[0] * p[0] + n[1] * p[1] + n[2] * p[2])});
  }

  PlaneTable planes_;
  CellGeometry geometry_;
  std::vector<MergedFace> faces_;
  std::map<IVec3, uint32_t> points_;
};

/// Wedges around one edge, with gaps between them. `notch`: whether the outer sides are bent
/// inwards.
Faces wedges(int count, bool notch) {
  Faces faces;
  const IVec3 low{0, 0, 0};
  const auto on_circle = [](double angle, double radius) {
    return IVec3{std::llround(radius * std::cos(angle)), std::llround(radius * std::sin(angle)), 0};
  };
  const auto up = [](IVec3 p) {
    p[2] = 1000;
    return p;
  };
  for (int i = 0; i < count; ++i) {
    const double step = 6.283185307 / count;
    std::vector<IVec3> rim{low, on_circle(i * step, 1e6), on_circle((i + 0.5) * step, 1e6)};
    if (notch) rim.insert(rim.begin() + 2, on_circle((i + 0.25) * step, 6e5));
    std::vector<IVec3> top, bottom(rim.rbegin(), rim.rend());
    for (const IVec3& p : rim) top.push_back(up(p));
    // The corner at the axis is convex: it tells the normal.
    std::rotate(top.begin(), top.end() - 1, top.end());
    std::rotate(bottom.begin(), bottom.end() - 2, bottom.end());
    faces.add(top);
    faces.add(bottom);
    for (size_t c = 0; c < rim.size(); ++c) {
      const IVec3 &from = rim[c], &to = rim[(c + 1) % rim.size()];
      faces.add({from, to, up(to), up(from)});
    }
  }
  return faces;
}

TEST(Conform, WedgesAroundAnEdgeStayAsTheyAre) {
  for (const bool notch : {false, true}) {
    uint64_t signs = 0;
    for (const int count : {20, 40, 80}) {
      Faces faces = wedges(count, notch);
      const uint64_t before = faces.signs();
      faces.conform();
      for (size_t f = 0; f < faces.count(); ++f) {
        ASSERT_EQ(faces[f].loops.size(), 1u);
        EXPECT_EQ(faces[f].loops[0].size(), !notch && f % 5 < 2 ? 3u : 4u);
        EXPECT_TRUE(faces[f].slits().empty());
        EXPECT_TRUE(faces[f].points().empty());
      }
      // Each is held against each other one, but no two of what they have in common against a
      // third one: that would be eight times as much for twice as many.
      const uint64_t now = faces.signs() - before;
      EXPECT_GT(now, 0u);
      if (signs != 0) {
        EXPECT_LT(now, 5 * signs) << count;
      }
      signs = now;
    }
  }
}

/// A U of two arms whose inner sides are x = 2 and x = 4, from y = 2 upwards.
const std::vector<IVec3> kLetter{{0, 0, 0}, {6, 0, 0}, {6, 4, 0}, {4, 4, 0},
                                 {4, 2, 0}, {2, 2, 0}, {2, 4, 0}, {0, 4, 0}};

struct Case {
  IVec3 from, to;
  std::vector<std::array<double, 4>> slits;  ///< (x, y) of either end
  size_t corners;                            ///< of the letter, with those that break its edges
};

TEST(Conform, AnEdgeThatLeavesACornerMayComeBack) {
  const double third = 1. / 3;
  const std::vector<Case> cases{
      // Across the gap and into the other arm.
      {{2, 4, 0}, {5, 3, 0}, {{4, 3 + third, 5, 3}}, 9},
      // The same with the corner last, and through the whole arm.
      {{5, 3, 0}, {2, 4, 0}, {{4, 3 + third, 5, 3}}, 9},
      {{2, 4, 0}, {8, 2, 0}, {{4, 3 + third, 6, 2 + 2 * third}}, 10},
      // Across the gap to the other arm's side or corner, into the gap, and away.
      {{2, 4, 0}, {4, 3, 0}, {}, 9},
      {{2, 4, 0}, {4, 4, 0}, {}, 8},
      {{2, 4, 0}, {3, 3, 0}, {}, 8},
      {{2, 4, 0}, {3, 7, 0}, {}, 8},
      {{0, 0, 0}, {-3, -1, 0}, {}, 8},
      // Along the rim, beyond an edge of it, and a part of one.
      {{2, 4, 0}, {2, 1, 0}, {{2, 1, 2, 2}}, 8},
      {{6, 0, 0}, {6, 9, 0}, {}, 8},
      {{6, 0, 0}, {6, 3, 0}, {}, 9},
      // From a corner into the letter, also through a corner of it.
      {{0, 0, 0}, {1, 1, 0}, {{0, 0, 1, 1}}, 8},
      {{0, 0, 0}, {3, 3, 0}, {{0, 0, 2, 2}}, 8},
      {{0, 0, 0}, {6, 3, 0}, {{0, 0, 4, 2}, {4, 2, 6, 3}}, 9},
  };
  for (const Case& c : cases) {
    Faces faces;
    faces.add(kLetter);
    IVec3 above = c.from;
    above[2] = 5;
    faces.add({c.from, c.to, above});
    faces.conform();
    const std::string name = testing::PrintToString(c.from) + testing::PrintToString(c.to);
    std::vector<std::array<double, 4>> slits;
    for (const auto& [p, q] : faces[0].slits()) {
      const auto &a = faces.at(p), &b = faces.at(q);
      std::array<double, 4> ends{a[0], a[1], b[0], b[1]};
      if (std::pair(a[0], a[1]) > std::pair(b[0], b[1])) ends = {b[0], b[1], a[0], a[1]};
      slits.push_back(ends);
    }
    std::sort(slits.begin(), slits.end());
    ASSERT_EQ(slits.size(), c.slits.size()) << name;
    for (size_t s = 0; s < slits.size(); ++s) {
      for (size_t k = 0; k < 4; ++k) EXPECT_DOUBLE_EQ(slits[s][k], c.slits[s][k]) << name;
    }
    EXPECT_EQ(faces[0].loops[0].size(), c.corners) << name;
  }
}

}  // namespace
}  // namespace csgrun::conform_test
