// The polygons of a job: corners, planes and boxes against the operands in rationals; walls of
// cells that keep off all vertices.
#include "engine/bsp/job.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "engine/base/parallel.h"
#include "engine/bsp/piece_store.h"
#include "engine/bsp/rounded_box.h"
#include "tests/support/exact_measures.h"
#include "tests/support/exact_solid.h"
#include "tests/support/gmp_bridge.h"
#include "tests/support/kernel_case.h"
#include "tests/support/random_frames.h"
#include "tests/support/random_solids.h"

namespace csgrun::job_test {
namespace {

using namespace test;  // NOLINT: a test

Rational3 value_of(const Point& p) {
  const GmpPoint g = to_gmp(p);
  return {mpq_class(g.x) / g.w, mpq_class(g.y) / g.w, mpq_class(g.z) / g.w};
}

mpq_class value_at(const Plane& s, const Rational3& p) {
  return to_gmp(s.a) * p[0] + to_gmp(s.b) * p[1] + to_gmp(s.c) * p[2] + to_gmp(s.d);
}

/// Random leaves and results in frames, moved, some with an appearance of their own.
std::vector<Operand> random_operands(Random& random) {
  std::vector<Operand> operands;
  for (uint32_t o = 0; o < 3; ++o) {
    Operand operand;
    operand.leaf = random_leaf(random);
    if (random.integer(0, 2) == 0) {
      const auto r =
          evaluate(random.integer(0, 1) ? less({leaf(0), leaf(1)}) : join({leaf(0), leaf(1)}),
                   {operand, operand_of(random_leaf(random))});
      EXPECT_TRUE(r) << text(r.error());
      operand.leaf = nullptr;
      operand.boundary = *r;
    }
    if (random.integer(0, 1)) operand.frame = random_frame(random);
    if (random.integer(0, 1)) {
      for (int64_t& t : operand.translation) t = random.integer(-70, 70);
    }
    if (random.integer(0, 2) == 0) operand.appearance = 3;
    operand.first_source = 10 * o;
    operands.push_back(operand);
  }
  return operands;
}

TEST(Job, PolygonsAreThoseOfTheOperands) {
  Random random(101);
  int results = 0, mirrored = 0;
  for (int i = 0; i < 60; ++i) {
    const auto operands = random_operands(random);
    Job job(operands);
    ASSERT_EQ(job.operand_count(), operands.size());
    for (uint32_t o = 0; o < operands.size(); ++o) {
      const Operand& operand = operands[o];
      const ExactSolid exact = exact_solid(operand);
      std::vector<Rational3> area(exact.faces.size());  // twice, of the polygons of each face
      mirrored += mirrors(operand.frame);
      for (uint32_t p = job.polygon_start(o); p < job.polygon_start(o + 1); ++p) {
        job.ensure_planes(p);
        const JobPolygon& polygon = job.polygons()[p];
        ASSERT_EQ(polygon.operand, o);
        const auto corners = job.corners(polygon);
        const auto edges = job.edge_planes(polygon);
        ASSERT_EQ(corners.size(), polygon.count);
        std::vector<Rational3> points;
        for (const uint32_t v : corners) {
          points.push_back(value_of(job.exact(v)));
          for (int k = 0; k < 3; ++k) {
            ASSERT_TRUE(is_correctly_rounded(points.back()[k], job.rounded(v)[k]));
            // Boxes are closed, and a step wider than need be at most.
            const PolygonBox& box = job.boxes()[p];
            ASSERT_LE(box.lo[k], points.back()[k]);
            ASSERT_GE(box.hi[k], points.back()[k]);
          }
          const auto planes = job.vertex_name(v).planes;
          ASSERT_EQ(planes[0] == ~0u, operand.leaf != nullptr);
          for (const uint32_t s : planes) {
            if (s != ~0u) {
              ASSERT_EQ(value_at(job.planes().plane(s), points.back()), 0);
            }
          }
        }
        for (int k = 0; k < 3; ++k) {
          mpq_class lo = points[0][k], hi = lo;
          for (const auto& x : points) lo = std::min(lo, x[k]), hi = std::max(hi, x[k]);
          const bool grid = operand.leaf && operand.frame.is_identity;
          ASSERT_LE(abs(lo - job.boxes()[p].lo[k]), grid ? 0 : 2);
          ASSERT_LE(abs(hi - job.boxes()[p].hi[k]), grid ? 0 : 2);
        }
        // The support holds all corners and looks outwards; convex, and edges lie in their planes.
        const Plane support = job.planes().oriented(polygon.support);
        Rational3 own{0, 0, 0};
        for (size_t c = 0; c < points.size(); ++c) {
          const Rational3 &from = points[c], &to = points[(c + 1) % points.size()];
          ASSERT_EQ(value_at(support, from), 0);
          ASSERT_NE(edges[c], polygon.support.index());
          const Plane& edge = job.planes().plane(edges[c]);
          ASSERT_EQ(value_at(edge, from), 0);
          ASSERT_EQ(value_at(edge, to), 0);
          int sides = 0;
          for (const auto& x : points) {
            const int s = sgn(value_at(edge, x));
            ASSERT_TRUE(s == 0 || sides == 0 || s == sides);
            if (s) sides = s;
          }
          const Rational3 part = cross(minus(from, points[0]), minus(to, points[0]));
          for (int k = 0; k < 3; ++k) own[k] += part[k], area[polygon.face][k] += part[k];
        }
        const Rational3 normal{to_gmp(support.a), to_gmp(support.b), to_gmp(support.c)};
        ASSERT_GT(dot(normal, own), 0);
        // Labels.
        FaceLabel label;
        if (operand.leaf) {
          label = {0, operand.leaf->facet[polygon.face], operand.leaf->surface[polygon.face],
                   operand.leaf->appearance[polygon.face]};
          ASSERT_EQ(job.is_of_whole_facet(polygon), label.facet != 0);
          ASSERT_EQ(job.is_of_complete_facet(polygon), label.facet != 0);
        } else {
          const auto& face = operand.boundary->faces[polygon.face];
          label = face.label;
          ASSERT_EQ(job.is_of_whole_facet(polygon), face.whole);
          ASSERT_EQ(job.is_of_complete_facet(polygon), face.complete);
        }
        label.source += operand.first_source;
        if (operand.appearance) label.appearance = *operand.appearance;
        ASSERT_EQ(job.label(polygon), label);
      }
      // Polygons fill their face.
      for (size_t f = 0; f < exact.faces.size(); ++f) {
        ASSERT_EQ(area[f], area_vector(exact, exact.faces[f])) << f;
      }
      results += operand.boundary != nullptr;
    }
  }
  EXPECT_GT(results, 20);
  EXPECT_GT(mirrored, 10);
}

// Planes that are asked for together have the numbers that they get one after another.
TEST(Job, ManyPlanesAreMadeAsOneByOne) {
  Random random(103);
  for (int i = 0; i < 40; ++i) {
    const auto operands = random_operands(random);
    Job single(operands), many(operands);
    std::vector<uint32_t> polygons;
    std::vector<PolygonEdge> edges;
    for (uint32_t p = 0; p < single.polygons().size(); ++p) {
      if (random.integer(0, 2) == 0) continue;
      polygons.push_back(p);
    }
    for (int k = 0; k < 50 && !polygons.empty(); ++k) {  // some of them twice
      const uint32_t p = polygons[random.bits() % polygons.size()];
      edges.push_back({p, static_cast<uint32_t>(random.bits() % single.polygons()[p].count)});
    }
    for (const uint32_t p : polygons) single.ensure_support(p);
    for (const PolygonEdge& e : edges) single.edge_plane(e.polygon, e.edge);
    with_threads(3, [&] {
      many.ensure_supports(polygons);
      many.ensure_edges(edges);
    });
    ASSERT_EQ(many.planes().size(), single.planes().size());
    for (uint32_t p = 0; p < single.planes().size(); ++p) {
      ASSERT_EQ(many.planes().plane(p), single.planes().plane(p));
    }
    for (uint32_t p = 0; p < single.polygons().size(); ++p) {
      const JobPolygon &a = single.polygons()[p], &b = many.polygons()[p];
      ASSERT_EQ(a.support, b.support);
      ASSERT_TRUE(std::ranges::equal(single.edge_planes(a), many.edge_planes(b)));
    }
  }
}

TEST(Job, WallsHoldNoVertex) {
  Random random(102);
  for (int i = 0; i < 60; ++i) {
    const auto operands = random_operands(random);
    Job job(operands);
    const mpq_class step(1, static_cast<unsigned long>(job.prime()));
    for (uint32_t v = 0; v < job.vertex_count(); ++v) {
      if (job.vertex_name(v).planes[0] != ~0u)
        continue;  // of a result: three planes may meet on a wall
      for (const mpq_class& c : value_of(job.exact(v))) {
        ASSERT_NE(mpq_class(c - step).get_den(), 1) << "a wall at " << c;
      }
    }
    const int64_t m = random.integer(-9, 9);
    for (int axis = 0; axis < 3; ++axis) {
      const uint32_t wall = job.wall(axis, m);
      ASSERT_EQ(job.wall(axis, m), wall);
      Rational3 at{mpq_class(7), mpq_class(-5, 3), mpq_class(1, 2)};
      at[axis] = mpz_class(m) + step;
      ASSERT_EQ(value_at(job.planes().plane(wall), at), 0);
      at[axis] += 1;
      ASSERT_GT(value_at(job.planes().plane(wall), at), 0);
    }
  }
}

// A wall must keep off the planes of a result that was itself cut at thirds, fifths and so on.
TEST(Job, WallsAreNoPlanesOfTheOperands) {
  auto mesh = std::make_shared<BoundaryMesh>();
  for (const int p : {3, 5, 7, 11, 13}) {
    for (int axis = 0; axis < 3; ++axis) {
      Plane s{0, 0, 0, -(4 * p + 1)};
      (axis == 0 ? s.a : axis == 1 ? s.b : s.c) = p;
      if (p % 4 == axis) mesh->planes.push_back(s);  // each prime on some axes only
      if (p == 13) mesh->planes.push_back(s);
    }
  }
  Operand operand;
  operand.boundary = mesh;
  const std::vector<Operand> operands{operand};
  Job job(operands);
  for (const Plane& s : mesh->planes) EXPECT_NE(s.a + s.b + s.c, job.prime());
}

/// A result that is nothing but a plane.
Operand plane_operand(const std::vector<Plane>& planes) {
  auto mesh = std::make_shared<BoundaryMesh>();
  mesh->planes.assign(planes.begin(), planes.end());
  Operand operand;
  operand.boundary = mesh;
  return operand;
}

TEST(Job, PrimesAreTheSmallestThatWillDo) {
  const auto prime_of = [](const std::vector<Plane>& planes) {
    const std::vector<Operand> operands{plane_operand(planes)};
    return Job(operands).prime();
  };
  EXPECT_EQ(prime_of({}), 3);
  for (int axis = 0; axis < 3; ++axis) {
    const auto along = [&](int c) {
      Plane s{0, 0, 0, 1};
      (axis == 0 ? s.a : axis == 1 ? s.b : s.c) = c;
      return s;
    };
    EXPECT_EQ(prime_of({along(1)}), 3);
    EXPECT_EQ(prime_of({along(3)}), 5);
    EXPECT_EQ(prime_of({along(5)}), 3);
    EXPECT_EQ(prime_of({along(5), along(3)}), 7);
    EXPECT_EQ(prime_of({along(3), along(5), along(7)}), 11);  // not 9
    EXPECT_EQ(prime_of({along(3), along(5), along(7), along(11), along(13), along(17), along(19),
                        along(23)}),
              29);  // not 25
  }
  // Planes along no axis are no walls, whatever their coefficients' sum.
  EXPECT_EQ(prime_of({{1, 2, 0, 1},
                      {2, 0, 1, 1},
                      {0, 1, 2, 1},
                      {1, 1, 1, 1},
                      {1, -1, 3, 1},
                      {4, -1, 0, 2},
                      {0, 4, -1, 2},
                      {4, 0, -1, 2},
                      {5, -1, -1, 1},
                      {1, 3, -1, 1}}),
            3);

  // Frames: no divisor of the determinant.
  const auto prime_in = [](int64_t x, int64_t y, int64_t z) {
    Operand operand = operand_of(box_leaf({0, 0, 0}, {1, 1, 1}));
    operand.frame.is_identity = false;
    operand.frame.matrix = {{{x << 36, 0, 0}, {0, y << 36, 0}, {0, 0, z << 36}}};
    const std::vector<Operand> operands{operand_of(box_leaf({0, 0, 0}, {1, 1, 1})), operand};
    return Job(operands).prime();
  };
  EXPECT_EQ(prime_in(16, 16, 16), 3);
  EXPECT_EQ(prime_in(16, 11, 16), 3);
  EXPECT_EQ(prime_in(16, 12, 16), 5);
  EXPECT_EQ(prime_in(15, 16, 16), 7);
  EXPECT_EQ(prime_in(15, 16, -14), 11);
}

TEST(Job, WallsMove) {
  const std::vector<Operand> operands{plane_operand({{5, 0, 0, 1}, {0, 0, 11, 2}})};
  Job job(operands);
  for (const int64_t prime : {3, 7, 13, 17, 19, 23, 29}) {
    EXPECT_EQ(job.prime(), prime);
    job.move_walls();
  }
}

// A vertex of a result has a denominator, in which the prime of walls must not be.
TEST(Job, WallsKeepOffVertices) {
  Random random(103);
  int moved = 0;
  for (int i = 0; i < 60; ++i) {
    const auto operands = random_operands(random);
    Job job(operands);
    std::vector<uint32_t> vertices;
    for (uint32_t v = 0; v < job.vertex_count(); ++v) vertices.push_back(v);
    const auto is_free = [&](int64_t p) {
      return std::all_of(vertices.begin(), vertices.end(), [&](uint32_t v) {
        const mpz_class w = to_gmp(job.exact(v)).w;
        return w % p != 0;
      });
    };
    const int64_t before = job.prime();
    const bool was_free = is_free(before);
    job.keep_walls_off(vertices);
    EXPECT_TRUE(is_free(job.prime()));
    EXPECT_EQ(job.prime() == before, was_free);
    moved += !was_free;
  }
  EXPECT_GT(moved, 0);
}

TEST(Job, VerticesHaveALexicographicOrder) {
  Random random(104);
  for (int i = 0; i < 40; ++i) {
    std::vector<Operand> operands;  // some points are equal
    for (int o = 0; o < 3; ++o) {
      operands.push_back(operand_of(make_leaf(random_loops(random, 3))));
      if (i % 2) operands.back().frame = random_frame(random);
      if (i % 4 == 1 && o > 0) operands.back().frame = operands[0].frame;
    }
    const Job job(operands);
    std::vector<Rational3> points;
    for (uint32_t v = 0; v < job.vertex_count(); ++v) points.push_back(value_of(job.exact(v)));
    for (uint32_t v = 0; v < points.size(); ++v) {
      for (uint32_t w = 0; w < points.size(); ++w) {
        ASSERT_EQ(job.is_below(v, w), points[v] < points[w]) << v << ' ' << w;
      }
    }
  }
}

TEST(Job, OperandsHaveTheBoxOfTheirPolygons) {
  Random random(105);
  for (int i = 0; i < 20; ++i) {
    auto operands = random_operands(random);
    operands.push_back(operand_of(std::make_shared<LeafGeometry>()));
    const Job job(operands);
    for (uint32_t o = 0; o < operands.size(); ++o) {
      PolygonBox box = PolygonBox::none();
      for (uint32_t p = job.polygon_start(o); p < job.polygon_start(o + 1); ++p) {
        box.include(job.boxes()[p]);
      }
      ASSERT_EQ(job.operand_box(o).is_empty(), box.is_empty());
      if (box.is_empty()) continue;
      ASSERT_EQ(job.operand_box(o).lo, box.lo);
      ASSERT_EQ(job.operand_box(o).hi, box.hi);
    }
  }
}

TEST(Job, BoxesHoldTheirBorders) {
  const PolygonBox box{{-3, 4, 5}, {7, 8, 9}};
  EXPECT_TRUE(box.holds(box));
  EXPECT_TRUE(box.meets(box));
  for (size_t k = 0; k < 3; ++k) {
    PolygonBox other = box;
    --other.lo[k];
    EXPECT_FALSE(box.holds(other));
    EXPECT_TRUE(other.holds(box));
    other = box;
    ++other.hi[k];
    EXPECT_FALSE(box.holds(other));
    EXPECT_TRUE(other.holds(box));
    PolygonBox flat = box;
    flat.lo[k] = flat.hi[k];
    EXPECT_FALSE(flat.is_empty());
    EXPECT_TRUE(box.holds(flat));
    EXPECT_TRUE(box.meets(flat));
    ++flat.lo[k];
    EXPECT_TRUE(flat.is_empty());
    PolygonBox beyond = box;
    beyond.lo[k] = box.hi[k] + 1, beyond.hi[k] = box.hi[k] + 5;
    EXPECT_FALSE(box.meets(beyond));
    EXPECT_FALSE(beyond.meets(box));
    PolygonBox common = box;
    common.clip(beyond);
    EXPECT_TRUE(common.is_empty());
  }
  EXPECT_TRUE(PolygonBox::none().is_empty());
}

// A rounded coordinate stands for all that round to it.
TEST(Job, BoxesOfRoundedPointsHoldTheTrueOnes) {
  PieceBox box;
  box.lo = {3, 2.5, -4};
  box.hi = {3, 2.5, 0x1p40};
  const PolygonBox outwards = rounded_outwards(box);
  EXPECT_EQ(outwards.lo, (std::array<int32_t, 3>{2, 2, -5}));
  EXPECT_EQ(outwards.hi, (std::array<int32_t, 3>{4, 3, 1 << 30}));
}

}  // namespace
}  // namespace csgrun::job_test
