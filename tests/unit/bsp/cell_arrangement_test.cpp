// How a surface that crosses itself divides a cell: winding numbers on both sides of every piece,
// what lies in it and how much of it there is, against rationals.
#include "engine/bsp/cell_arrangement.h"

#include <map>

#include <gtest/gtest.h>

#include "tests/support/exact_solid.h"
#include "tests/support/gmp_bridge.h"
#include "tests/support/kernel_case.h"
#include "tests/support/random_solids.h"
#include "tests/support/rational_polygons.h"

namespace csgrun::cell_arrangement_test {
namespace {

using test::area_of, test::covers, test::sum, test::tiny, test::winding_around;
using test::Rational3;

/// Two or three solids over one another in one mesh, some inside out, and a cell that may cut them.
struct Case {
  explicit Case(test::Random& random) {
    std::vector<test::Loop> loops;
    for (int64_t i = random.integer(2, 3); i > 0; --i) {
      auto own = test::random_loops(random, 4);
      if (random.integer(0, 2) == 0) test::turn_over(own);
      loops.insert(loops.end(), own.begin(), own.end());
    }
    operands.push_back(test::operand_of(test::make_leaf(loops)));
    const bool all = random.integer(0, 1) != 0;
    const int64_t size = all ? 64 : random.integer(2, 8);
    for (int k = 0; k < 3; ++k) {
      box.lo[k] = all ? -20 : random.integer(-5, 3);
      box.hi[k] = box.lo[k] + size;
    }
  }
  std::vector<Operand> operands;
  CellBox box;
};

struct Arranged {
  explicit Arranged(const Case& c)
      : job(c.operands), surface(test::exact_solid(c.operands[0])), geometry(job.planes(), &job) {
    for (uint32_t p = 0; p < job.polygons().size(); ++p) job.ensure_planes(p);
    walls = walls_of(job, c.box);
    for (uint32_t p = 0; p < job.polygons().size(); ++p) {
      Fragment f = geometry.load(p);
      if (may_meet(job, p, c.box) && clip_to_cell(geometry, job, c.box, walls, f)) {
        polygons.push_back(f);
      }
    }
    Rational3 corner;
    for (int k = 0; k < 3; ++k) {
      corner[k] = mpz_class(c.box.lo[k]) + mpq_class(1, static_cast<unsigned long>(job.prime())) +
                  tiny(150 * (k + 1));
    }
    is_closed =
        arrangement.build(geometry, job, c.box, walls, polygons, winding_around(surface, corner));
  }

  Rational3 exact(uint32_t point) {
    const test::GmpPoint p = test::to_gmp(geometry.exact(point));
    return {mpq_class(p.x) / p.w, mpq_class(p.y) / p.w, mpq_class(p.z) / p.w};
  }
  std::vector<Rational3> corners(const Fragment& f) {
    std::vector<Rational3> result;
    for (uint32_t c = 0; c < f.count; ++c) result.push_back(exact(geometry.corners(f)[c]));
    return result;
  }

  Job job;
  test::ExactSolid surface;
  CellGeometry geometry;
  CellWalls walls{};
  std::vector<Fragment> polygons;
  CellArrangement arrangement;
  bool is_closed = false;
};

TEST(CellArrangement, PartsHaveTheirWindingsAndPolygons) {
  test::Random random(51);
  std::map<int, int> windings;
  int doubled = 0;
  for (int i = 0; i < 20; ++i) {
    const Case c(random);
    Arranged a(c);
    ASSERT_TRUE(a.is_closed) << "case " << i;
    std::map<uint32_t, Rational3> area;  // by plane: of the polygons less that of the parts
    std::vector<std::vector<Rational3>> outlines;
    for (const Fragment& f : a.polygons) {
      outlines.push_back(a.corners(f));
      Rational3& sum_of = area.try_emplace(f.support.index(), Rational3{0, 0, 0}).first->second;
      sum_of = sum(sum_of, area_of(outlines.back()), 1);
    }
    for (const CellArrangement::Part& part : a.arrangement.parts()) {
      const std::vector<Rational3> corners = a.corners(part.fragment);
      Rational3 middle{0, 0, 0};
      for (const Rational3& p : corners) middle = sum(middle, p, mpq_class(1, corners.size()));
      const Plane& plane = a.job.planes().plane(part.fragment.support.index());
      const Rational3 normal{test::to_gmp(plane.a), test::to_gmp(plane.b), test::to_gmp(plane.c)};
      const Rational3 generic{0, tiny(300), tiny(450)};
      const int front = a.arrangement.windings()[part.front],
                back = a.arrangement.windings()[part.back];
      ASSERT_EQ(front, winding_around(a.surface, sum(sum(middle, normal, tiny(150)), generic, 1)));
      ASSERT_EQ(back, winding_around(a.surface, sum(sum(middle, normal, -tiny(150)), generic, 1)));
      ++windings[front], ++windings[back];
      // Seen from the positive side, it turns left.
      const Rational3 own = area_of(corners);
      ASSERT_GT(test::dot(normal, own), 0);
      bool up = false, down = false;
      uint32_t lowest = kNone;
      for (size_t k = 0; k < a.polygons.size(); ++k) {
        const Fragment& f = a.polygons[k];
        if (f.support.index() != part.fragment.support.index()) continue;
        if (!covers(outlines[k], middle)) continue;
        (f.support.flipped() ? down : up) = true;
        lowest = std::min(lowest, f.polygon);
      }
      ASSERT_EQ(part.has_up, up);
      ASSERT_EQ(part.has_down, down);
      ASSERT_EQ(part.fragment.polygon, lowest);
      doubled += up && down;
      Rational3& sum_of = area.at(part.fragment.support.index());
      sum_of = sum(sum_of, own, front - back);
    }
    for (const auto& [plane, left] : area) ASSERT_EQ(left, (Rational3{0, 0, 0})) << "case " << i;
  }
  for (int w = -1; w <= 2; ++w) EXPECT_GT(windings[w], 30) << w;
  EXPECT_GT(doubled, 20);
}

TEST(CellArrangement, VolumeBelowAPointIsThatOfTheMovedPoint) {
  test::Random random(52);
  std::map<int, int> windings;
  int vertices = 0;
  for (int i = 0; i < 20; ++i) {
    const Case c(random);
    Arranged a(c);
    ASSERT_TRUE(a.is_closed);
    for (uint32_t p = 0; p < a.geometry.point_count(); p += 3) {
      bool inside = true;
      for (size_t w = 0; w < a.walls.size(); ++w) {
        inside = inside && a.geometry.side(a.walls[w], p) == (w % 2 == 0 ? 1 : -1);
      }
      if (!inside) continue;
      const Rational3 below =
          sum(a.exact(p), Rational3{tiny(150), tiny(300), tiny(450)}, mpq_class(-1));
      const int winding = a.arrangement.windings()[a.arrangement.volume_below(a.geometry, p)];
      ASSERT_EQ(winding, winding_around(a.surface, below)) << "case " << i;
      ++windings[winding];
      vertices += a.geometry.point(p).vertex != kNone;
    }
  }
  for (int w = -1; w <= 2; ++w) EXPECT_GT(windings[w], 10) << w;
  EXPECT_GT(vertices, 50);
}

TEST(CellArrangement, OpenSurfacesContradictThemselves) {
  for (uint32_t missing = 0; missing < 6; ++missing) {
    auto loops = test::box_loops({1, 1, 1}, {5, 5, 5});
    loops.erase(loops.begin() + missing);
    test::Random random(53);
    Case c(random);
    c.operands[0] = test::operand_of(test::make_leaf(loops));
    c.box = {{0, 0, 0}, {8, 8, 8}};
    EXPECT_FALSE(Arranged(c).is_closed) << missing;
  }
}

}  // namespace
}  // namespace csgrun::cell_arrangement_test
