// The cells of a surface that crosses itself: what is said of edges in walls and of the volumes
// below points is so, by rationals; and a surface that is open is refused.
#include "engine/bsp/surface_cells.h"

#include <map>
#include <numeric>
#include <set>
#include <tuple>

#include <gtest/gtest.h>

#include "tests/support/exact_solid.h"
#include "tests/support/gmp_bridge.h"
#include "tests/support/kernel_case.h"
#include "tests/support/random_solids.h"
#include "tests/support/rational_polygons.h"

namespace csgrun::surface_cells_test {
namespace {

using test::Rational3;

/// A surface all of which is solved, in cells of few polygons.
class Solved {
 public:
  Solved(const std::vector<test::Loop>& loops, const KernelOptions& options)
      : operands_{test::operand_of(test::make_leaf(loops))},
        job_(operands_),
        surface_(test::exact_solid(operands_[0])) {
    const size_t count = job_.polygons().size();
    std::vector<uint32_t> all(count);
    std::iota(all.begin(), all.end(), 0u);
    SurfacePatches patches;
    patches.patch_of.assign(count, kNone);
    tree_ = build_surface_octree(job_, all, std::vector<uint8_t>(count, 1), {}, options);
    SurfaceCellsRequest request;
    request.wall_edges = request.below_points = true;
    runs_ = solve_surface_cells(job_, tree_, patches, request, options, stats_);
  }

  const Result<std::vector<SurfaceCells>>& runs() const { return runs_; }
  const std::vector<SurfaceCell>& cells() const { return tree_.cells; }
  const test::ExactSolid& surface() const { return surface_; }

  Rational3 exact(const FragmentSet::NamedPoint& p) const {
    if (p.vertex != kNone) {
      const test::GmpPoint at = test::to_gmp(job_.exact(p.vertex));
      return {mpq_class(at.x) / at.w, mpq_class(at.y) / at.w, mpq_class(at.z) / at.w};
    }
    const auto plane = [&](int i) -> const Plane& { return job_.planes().plane(p.planes[i]); };
    return test::meeting_point(plane(0), plane(1), plane(2));
  }

  /// Where walls stand: a p-th of a step above whole numbers.
  mpq_class wall(int64_t at) const {
    return mpz_class(at) + mpq_class(1, static_cast<unsigned long>(job_.prime()));
  }
  /// +1 inside of a cell, 0 in one of its walls, -1 beyond.
  int place_in(const CellBox& box, const Rational3& p) const {
    int place = 1;
    for (size_t k = 0; k < 3; ++k) {
      const double near = p[k].get_d();  // beyond most cells
      if (near < static_cast<double>(box.lo[k]) || near > static_cast<double>(box.hi[k] + 1)) {
        return -1;
      }
    }
    for (size_t k = 0; k < 3; ++k) {
      const int above = sgn(mpq_class(p[k] - wall(box.lo[k]))),
                below = sgn(mpq_class(wall(box.hi[k]) - p[k]));
      place = std::min({place, above, below});
    }
    return place;
  }
  /// The box of the cell that has a point inside.
  const CellBox& cell_at(const Rational3& p) const {
    const auto cell = std::find_if(tree_.cells.begin(), tree_.cells.end(),
                                   [&](const SurfaceCell& c) { return place_in(c.box, p) > 0; });
    EXPECT_NE(cell, tree_.cells.end());
    return cell->box;
  }

 private:
  std::vector<Operand> operands_;
  Job job_;
  test::ExactSolid surface_;
  EvaluateStats stats_;
  SurfaceOctree tree_;
  Result<std::vector<SurfaceCells>> runs_ = Error{ErrorCode::kInternal, "not solved", {}};
};

/// Two or three solids over one another in one mesh, some inside out.
std::vector<test::Loop> tangle(test::Random& random) {
  std::vector<test::Loop> loops;
  for (int64_t i = random.integer(2, 3); i > 0; --i) {
    auto own = test::random_loops(random, 4);
    if (random.integer(0, 2) == 0) test::turn_over(own);
    loops.insert(loops.end(), own.begin(), own.end());
  }
  return loops;
}

KernelOptions small_cells(test::Random& random) {
  KernelOptions options;
  options.cell_limit = static_cast<uint32_t>(random.integer(2, 8));
  for (auto& s : options.octree_shift) s = static_cast<uint32_t>(random.integer(0, 5));
  return options;
}

// No point inside of one cell is in a wall of another one.
TEST(SurfaceCells, VolumesBelowPointsAreThoseOfMovedPoints) {
  test::Random random(991);
  size_t in_walls = 0;
  std::map<int, int> windings;
  for (int i = 0; i < 8; ++i) {
    const auto loops = tangle(random);
    const Solved solved(loops, small_cells(random));
    ASSERT_TRUE(solved.runs());
    for (const SurfaceCells& run : *solved.runs()) {
      ASSERT_EQ(run.below_point.size(), run.set.points.size());
      for (size_t n = 0; n < run.set.points.size(); ++n) {
        const Rational3 p = solved.exact(run.set.points[n]);
        const bool is_inside =
            std::any_of(solved.cells().begin(), solved.cells().end(),
                        [&](const SurfaceCell& c) { return solved.place_in(c.box, p) > 0; });
        ASSERT_EQ(run.below_point[n] != kNone, is_inside) << "case " << i << " point " << n;
        in_walls += !is_inside;
        if (!is_inside || n % 3 != 0) continue;
        const Rational3 moved = test::sum(
            p, Rational3{test::tiny(150), test::tiny(300), test::tiny(450)}, mpq_class(-1));
        const int winding = run.windings[run.below_point[n]];
        ASSERT_EQ(winding, test::winding_around(solved.surface(), moved)) << "case " << i;
        ++windings[winding];
      }
    }
  }
  EXPECT_GT(in_walls, 200u);
  for (int w = -1; w <= 2; ++w) EXPECT_GT(windings[w], 10) << w;
}

// A piece is inside of its cell, but for its edges in walls, each of which is told of once.
TEST(SurfaceCells, EdgesInWallsAreThoseWithBothEndsInOne) {
  test::Random random(992);
  size_t found = 0;
  for (int i = 0; i < 8; ++i) {
    const auto loops = tangle(random);
    const Solved solved(loops, small_cells(random));
    ASSERT_TRUE(solved.runs());
    for (const SurfaceCells& run : *solved.runs()) {
      // By ends, volumes at the front and the back, and whether the piece is below the wall.
      using Edge = std::tuple<uint32_t, uint32_t, uint32_t, uint32_t, bool>;
      std::multiset<Edge> told;
      for (const SurfaceCells::WallEdge& e : run.wall_edges) {
        told.insert({e.from, e.to, e.front, e.back, e.is_below});
      }
      found += told.size();
      ASSERT_EQ(run.sides.size(), run.set.pieces.size());
      for (size_t n = 0; n < run.set.pieces.size(); ++n) {
        const FragmentSet::Piece& piece = run.set.pieces[n];
        std::vector<uint32_t> numbers;
        std::vector<Rational3> corners;
        Rational3 middle{0, 0, 0};
        for (uint32_t c = piece.first; c < piece.first + piece.count; ++c) {
          numbers.push_back(run.set.corner_point[c]);
          corners.push_back(solved.exact(run.set.points[numbers.back()]));
          middle = test::sum(middle, corners.back(), mpq_class(1, piece.count));
        }
        const CellBox& box = solved.cell_at(middle);
        for (size_t c = 0; c < corners.size(); ++c) {
          const size_t next = (c + 1) % corners.size();
          std::vector<bool> is_upper;  // of the walls that hold it: two, where they meet
          for (size_t k = 0; k < 3; ++k) {
            for (const bool upper : {false, true}) {
              const mpq_class wall = solved.wall(upper ? box.hi[k] : box.lo[k]);
              if (corners[c][k] == wall && corners[next][k] == wall) is_upper.push_back(upper);
            }
          }
          const bool is_told = std::any_of(is_upper.begin(), is_upper.end(), [&](bool is_below) {
            const auto edge = told.find(
                {numbers[c], numbers[next], run.sides[n].front, run.sides[n].back, is_below});
            if (edge == told.end()) return false;
            told.erase(edge);
            return true;
          });
          ASSERT_EQ(is_told, !is_upper.empty()) << "case " << i << " piece " << n;
        }
      }
      ASSERT_TRUE(told.empty()) << "case " << i;
    }
  }
  EXPECT_GT(found, 300u);
}

TEST(SurfaceCells, OpenSurfacesAreRefused) {
  for (uint32_t missing = 0; missing < 6; ++missing) {
    auto loops = test::box_loops({1, 1, 1}, {5, 5, 5});
    loops.erase(loops.begin() + missing);
    const Solved solved(loops, {});
    ASSERT_FALSE(solved.runs()) << missing;
    EXPECT_EQ(solved.runs().error().code, ErrorCode::kInternal);
  }
}

}  // namespace
}  // namespace csgrun::surface_cells_test
