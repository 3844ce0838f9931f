// Points and lines in planar faces of few and of many edges, against whole numbers of the plane.
#include "engine/mesh/face_search.h"

#include <random>

#include <gtest/gtest.h>

#include "tests/unit/mesh/planar_faces.h"

namespace csgrun::face_search_test {
namespace {

using test::FlatLoop;
using GridPoint = test::FlatPoint;

/// A patch of a grid on the plane z = x + slope y, seen from above.
class Patch {
 public:
  Patch(int n, double density, int slope, uint32_t seed)
      : random_(seed),
        points_(test::grid_points(n)),
        triangles_(test::random_triangulation(n, points_, 20 * n, random_)),
        loops_(test::random_patch(triangles_, density, random_)),
        geometry_(planes_, nullptr) {
    const PlaneId support = planes_.intern(Plane{-1, -slope, 1, 0});
    for (const GridPoint& p : points_) {
      geometry_.add_point({planes_.intern(Plane{1, 0, 0, -p[0]}).index(),
                           planes_.intern(Plane{0, 1, 0, -p[1]}).index(), support.index()});
    }
    faces_.push_back({support, 0, 0, 0, false, face_loops()});
  }

  /// Checks every point of the grid and every edge of the triangles, both ways.
  void check() {
    PointView view(geometry_);
    FaceSearch search(faces_, geometry_, view, planes_);
    for (uint32_t p = 0; p < points_.size(); ++p) {
      ASSERT_EQ(search.locate(0, p), place({2 * points_[p][0], 2 * points_[p][1]})) << p;
    }
    // Loops that meet in a corner may cross there, as they are traced here: wedges overlap.
    std::vector<size_t> times(points_.size(), 0);
    for (const FlatLoop& loop : loops_) {
      for (const uint32_t p : loop) ++times[p];
    }
    std::set<std::pair<uint32_t, uint32_t>> lines;
    for (const auto& t : triangles_) {
      for (size_t i = 0; i < 3; ++i) {
        lines.insert({t[i], t[(i + 1) % 3]});
        lines.insert({t[(i + 1) % 3], t[i]});
      }
    }
    for (const auto& [a, b] : lines) {
      if (times[a] > 1) continue;
      const GridPoint middle{points_[a][0] + points_[b][0], points_[a][1] + points_[b][1]};
      ASSERT_EQ(search.runs_inside(0, edge(a, b)), place(middle) > 0) << a << ' ' << b;
    }
    check_boxes(search);
    // A face that is another one from now on.
    loops_.resize(1);
    faces_[0].loops = face_loops();
    search.forget();
    for (uint32_t p = 0; p < points_.size(); ++p) {
      ASSERT_EQ(search.locate(0, p), place({2 * points_[p][0], 2 * points_[p][1]})) << p;
    }
  }

  [[nodiscard]] size_t edge_count() const {
    size_t count = 0;
    for (const FlatLoop& loop : loops_) count += loop.size();
    return count;
  }

 private:
  FaceLoops face_loops() {
    std::vector<std::vector<DirectedEdge>> loops;
    for (const FlatLoop& loop : loops_) {
      auto& edges = loops.emplace_back();
      for (size_t i = 0; i < loop.size(); ++i) {
        edges.push_back(edge(loop[i], loop[(i + 1) % loop.size()]));
      }
    }
    return FaceLoops(loops);
  }
  DirectedEdge edge(uint32_t a, uint32_t b) {
    const GridPoint &p = points_[a], &q = points_[b];
    const int64_t x = q[1] - p[1], y = p[0] - q[0];
    return {a, b, planes_.intern(Plane{x, y, 0, -(x * p[0] + y * p[1])}).index()};
  }

  /// +1 inside of the loops, 0 on them, -1 outside; of a point in half steps.
  [[nodiscard]] int place(const GridPoint& at) const {
    bool inside = false;
    for (const FlatLoop& loop : loops_) {
      for (size_t i = 0; i < loop.size(); ++i) {
        GridPoint a = points_[loop[i]], b = points_[loop[(i + 1) % loop.size()]];
        for (size_t k = 0; k < 2; ++k) a[k] *= 2, b[k] *= 2;
        if (a[1] > b[1]) std::swap(a, b);
        const int64_t turn = test::cross(a, b, at);
        const bool is_beside = at[0] < std::min(a[0], b[0]) || at[0] > std::max(a[0], b[0]) ||
                               at[1] < a[1] || at[1] > b[1];
        if (turn == 0 && !is_beside) return 0;
        inside ^= a[1] <= at[1] && at[1] < b[1] && turn > 0;
      }
    }
    return inside ? 1 : -1;
  }

  void check_boxes(FaceSearch& search) {
    for (int i = 0; i < 20; ++i) {
      const auto &p = geometry_.point(random_() % points_.size()).rounded,
                 &q = geometry_.point(random_() % points_.size()).rounded;
      Box box{p, p};
      box.include({q, q});
      std::vector<DirectedEdge> found, expected;
      search.find(0, box, found);
      for (const auto& loop : faces_[0].loops) {
        for (const DirectedEdge& e : loop) {
          if (box_of(e, geometry_).overlaps(box)) expected.push_back(e);
        }
      }
      ASSERT_EQ(found.size(), expected.size());
      for (size_t e = 0; e < found.size(); ++e) {
        ASSERT_EQ(std::pair(found[e].from, found[e].to),
                  std::pair(expected[e].from, expected[e].to));
      }
    }
  }

  std::mt19937 random_;
  const std::vector<GridPoint> points_;
  const std::vector<std::array<uint32_t, 3>> triangles_;
  std::vector<FlatLoop> loops_;
  PlaneTable planes_;
  CellGeometry geometry_;
  std::vector<MergedFace> faces_;
};

TEST(FaceSearch, FindsPointsAndLinesInPatches) {
  size_t few = 0, many = 0;
  for (uint32_t seed = 0; seed < 120; ++seed) {
    Patch patch(seed % 3 == 0 ? 2 : 9, seed % 2 ? 0.6 : 0.85, seed / 2 % 2 ? 2 : -2, seed);
    ASSERT_NO_FATAL_FAILURE(patch.check()) << "seed " << seed;
    (patch.edge_count() <= 12 ? few : many) += 1;
  }
  EXPECT_GT(few, 20u);
  EXPECT_GT(many, 50u);
}

}  // namespace
}  // namespace csgrun::face_search_test
