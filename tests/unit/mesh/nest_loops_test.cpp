// Holes and the outer loops that are around them, nested and beside one another, against how they
// were made.
#include "engine/mesh/nest_loops.h"

#include <algorithm>
#include <array>
#include <map>
#include <random>

#include <gtest/gtest.h>

namespace csgrun::nest_loops_test {
namespace {

using Corner = std::array<int64_t, 2>;

/// Loops in the plane z = 0, turned by quarters.
class Drawing {
 public:
  explicit Drawing(int quarters) : quarters_(quarters), geometry_(planes_, nullptr) {}

  /// An arch; a bar that stands in it and sticks out below, with a hole up in the arch; in the hole
  /// the same again.
  void add(int64_t x, int64_t y, int64_t size, int depth) {
    const auto at = [&](int64_t u, int64_t v) { return Corner{x + u * size, y + v * size}; };
    add_loop({at(0, 2), at(2, 2), at(2, 10), at(8, 10), at(8, 2), at(10, 2), at(10, 12), at(0, 12)},
             false);
    const uint32_t bar = add_loop({at(3, 0), at(7, 0), at(7, 9), at(3, 9)}, false);
    parent_[add_loop({at(4, 5), at(6, 5), at(6, 8), at(4, 8)}, true)] = bar;
    if (depth > 0) add(x + 4 * size + size / 8, y + 5 * size + size / 8, size / 6, depth - 1);
  }

  void check(std::mt19937& random) {
    std::shuffle(loops_.begin(), loops_.end(), random);
    RegionLoops region;
    for (const auto& loop : loops_) {
      region.edges.insert(region.edges.end(), loop.begin(), loop.end());
      region.starts.push_back(static_cast<uint32_t>(region.edges.size()));
    }
    PointView view(geometry_);
    const auto faces = nest_loops(planes_.intern(Plane{0, 0, 1, 0}), region, view, planes_);
    EXPECT_EQ(faces.size(), loops_.size() - parent_.size());
    size_t holes = 0;
    for (const auto& face : faces) {
      ASSERT_FALSE(parent_.contains(face[0][0].from)) << "a hole is an outer loop";
      for (size_t i = 1; i < face.size(); ++i, ++holes) {
        ASSERT_TRUE(parent_.contains(face[i][0].from));
        ASSERT_EQ(parent_[face[i][0].from], face[0][0].from);
      }
    }
    EXPECT_EQ(holes, parent_.size());
  }

 private:
  /// Returns the number of its first corner.
  uint32_t add_loop(std::vector<Corner> corners, bool is_hole) {
    if (is_hole) std::reverse(corners.begin(), corners.end());
    for (Corner& c : corners) {
      for (int i = 0; i < quarters_; ++i) c = {-c[1], c[0]};
    }
    const auto first = static_cast<uint32_t>(geometry_.point_count());
    auto& loop = loops_.emplace_back();
    const uint32_t support = planes_.intern(Plane{0, 0, 1, 0}).index();
    for (size_t i = 0; i < corners.size(); ++i) {
      const Corner &p = corners[i], &q = corners[(i + 1) % corners.size()];
      geometry_.add_point({planes_.intern(Plane{1, 0, 0, -p[0]}).index(),
                           planes_.intern(Plane{0, 1, 0, -p[1]}).index(), support});
      const int64_t a = q[1] - p[1], b = p[0] - q[0];
      loop.push_back({first + static_cast<uint32_t>(i),
                      first + static_cast<uint32_t>((i + 1) % corners.size()),
                      planes_.intern(Plane{a, b, 0, -(a * p[0] + b * p[1])}).index()});
    }
    return first;
  }

  const int quarters_;
  PlaneTable planes_;
  CellGeometry geometry_;
  std::vector<std::vector<DirectedEdge>> loops_;
  std::map<uint32_t, uint32_t> parent_;  ///< of holes; all by their first corners
};

TEST(NestLoops, HolesAreInTheInnermostLoopAroundThem) {
  std::mt19937 random(4417);
  for (int quarters = 0; quarters < 4; ++quarters) {
    for (int i = 0; i < 10; ++i) {
      Drawing drawing(quarters);
      for (int64_t k = 0; k < 3; ++k) drawing.add(40'000 * k, 5'000 * (k % 2), 1296, 3);
      ASSERT_NO_FATAL_FAILURE(drawing.check(random)) << quarters;
    }
  }
}

}  // namespace
}  // namespace csgrun::nest_loops_test
