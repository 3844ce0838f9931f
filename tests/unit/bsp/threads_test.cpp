// Operands large enough for several threads: the result is that of cells, to the last bit of every
// array, on any number of threads.
#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <vector>

#include <gtest/gtest.h>

#include "engine/base/parallel.h"
#include "engine/bsp/coarse_cells.h"
#include "engine/bsp/kernel.h"
#include "engine/bsp/untouched.h"
#include "engine/mesh/opposite_edges.h"
#include "engine/mesh/present.h"
#include "tests/support/boundary_compare.h"
#include "tests/support/kernel_case.h"
#include "tests/support/random_solids.h"

namespace csgrun::threads_test {
namespace {

/// A sphere with bumps: an octahedron of which each face is divided into n^2 triangles.
std::shared_ptr<const LeafGeometry> bumpy_sphere(int n, double radius, double phase) {
  auto leaf = std::make_shared<LeafGeometry>();
  std::map<std::array<int, 3>, uint32_t> known;
  const auto vertex = [&](const std::array<int, 3>& p) {
    const auto [at, is_new] = known.try_emplace(p, static_cast<uint32_t>(leaf->vertices.size()));
    if (is_new) {
      const double length = std::hypot(p[0], p[1], p[2]);
      const double x = p[0] / length, y = p[1] / length, z = p[2] / length;
      const double r = radius * (1 + 0.08 * std::sin(5 * x + phase) * std::sin(4 * y + phase) +
                                 0.05 * std::sin(7 * z + phase));
      leaf->vertices.push_back({std::llround(r * x), std::llround(r * y), std::llround(r * z)});
    }
    return at->second;
  };
  const auto add = [&](const std::array<int, 3>& a, const std::array<int, 3>& b,
                       const std::array<int, 3>& c, bool turned) {
    leaf->corners.insert(leaf->corners.end(),
                         {vertex(a), vertex(turned ? c : b), vertex(turned ? b : c)});
    leaf->face_starts.push_back(static_cast<uint32_t>(leaf->corners.size()));
  };
  for (const int sx : {-1, 1}) {
    for (const int sy : {-1, 1}) {
      for (const int sz : {-1, 1}) {
        const auto at = [&](int i, int j) {
          return std::array<int, 3>{sx * i, sy * j, sz * (n - i - j)};
        };
        const bool turned = sx * sy * sz < 0;
        for (int i = 0; i < n; ++i) {
          for (int j = 0; i + j < n; ++j) {
            add(at(i + 1, j), at(i, j + 1), at(i, j), turned);
            if (i + j + 1 < n) add(at(i + 1, j), at(i + 1, j + 1), at(i, j + 1), turned);
          }
        }
      }
    }
  }
  leaf->facet = FaceNumbers::ascending(1);
  leaf->opposite = pair_edges(*leaf).opposite;
  leaf->may_touch = false;
  return leaf;
}

constexpr int kDivisions = 48;  // 18432 triangles each, more than one part

std::vector<Operand> three_spheres() {
  std::vector<Operand> operands(3);
  for (uint32_t o = 0; o < 3; ++o) {
    operands[o].leaf = bumpy_sphere(kDivisions, 4e6, o);
    operands[o].translation = {2'000'000 * int64_t{o}, 1'500'000 * (o % 2), 700'000 * int64_t{o}};
    operands[o].first_source = o;
  }
  return operands;
}

std::shared_ptr<const BoundaryMesh> evaluate(const std::vector<Operand>& operands, BooleanOp op,
                                             const KernelOptions& options, EvaluateStats& stats) {
  Expression expression;
  Expression::Node root{false, op, 0, 0, static_cast<uint32_t>(operands.size())};
  for (uint32_t o = 0; o < operands.size(); ++o) {
    expression.nodes.push_back({true, BooleanOp::kUnion, o, 0, 0});
    expression.children.push_back(o);
  }
  expression.nodes.push_back(root);
  const GridBox region{{-20'000'000, -20'000'000, -20'000'000},
                       {20'000'000, 20'000'000, 20'000'000}};
  const auto result = evaluate_boolean(operands, expression, region, options, stats);
  EXPECT_TRUE(result) << result.error().message;
  return result ? *result : nullptr;
}

TEST(Threads, GiveWhatCellsGive) {
  std::vector<Operand> operands = three_spheres();
  operands.resize(2);
  ASSERT_GT(operands[0].leaf->face_count(), kFewForThreads);
  ASSERT_FALSE(operands[0].leaf->opposite.empty());
  KernelOptions options;
  options.whole_faces = false;
  EvaluateStats ignored;
  const auto slow = evaluate(operands, BooleanOp::kDifference, options, ignored);
  options.whole_faces = true;
  for (const unsigned threads : {0u, 1u, 2u, 5u}) {
    options.threads = threads;
    const auto fast = evaluate(operands, BooleanOp::kDifference, options, ignored);
    EXPECT_EQ(test::first_difference(*fast, *slow), "") << threads;
  }
}

TEST(Threads, AreNotSeenInNamedFacesAndCounts) {
  const std::vector<Operand> operands = three_spheres();
  KernelOptions options;
  EvaluateStats ignored;
  const auto spelled = evaluate(operands, BooleanOp::kUnion, options, ignored);
  options.name_untouched = true;
  PresentContext context;
  context.step.numerator = 1;
  context.appearances.resize(1);
  const auto arrays = *present(*spelled, context);
  EvaluateStats one;
  for (const unsigned threads : {1u, 2u, 4u}) {
    options.threads = threads;
    EvaluateStats stats;
    const auto named = evaluate(operands, BooleanOp::kUnion, options, stats);
    EXPECT_EQ(named->parts.size(), 3u);
    EXPECT_EQ(test::first_difference(*expanded(named), *spelled), "");
    const auto same = with_threads(threads, [&] { return *present(*named, context); });
    EXPECT_EQ(same->positions, arrays->positions);
    EXPECT_EQ(same->positions_f32, arrays->positions_f32);
    EXPECT_EQ(same->point_of, arrays->point_of);
    EXPECT_EQ(same->triangles, arrays->triangles);
    EXPECT_EQ(same->triangle_face, arrays->triangle_face);
    EXPECT_EQ(same->loop_starts, arrays->loop_starts);
    EXPECT_EQ(same->loop_vertices, arrays->loop_vertices);
    EXPECT_EQ(same->face_normals, arrays->face_normals);
    ASSERT_EQ(same->faces.size(), arrays->faces.size());
    for (size_t f = 0; f < same->faces.size(); ++f) {
      ASSERT_EQ(same->faces[f].first_loop, arrays->faces[f].first_loop);
      ASSERT_EQ(same->faces[f].loop_count, arrays->faces[f].loop_count);
      ASSERT_EQ(same->faces[f].source, arrays->faces[f].source);
    }
    EXPECT_EQ(same->canonical_hash, arrays->canonical_hash);
    if (threads == 1) one = stats;
    EXPECT_EQ(stats.surface_cells, one.surface_cells);
    EXPECT_EQ(stats.solved_cells, one.solved_cells);
    EXPECT_EQ(stats.sign_filter, one.sign_filter);
  }
}

/// Bodies on a coarse lattice, so that most of what meets touches: more polygons than one thread
/// cuts at a time.
std::vector<Operand> touching_bodies(uint64_t seed) {
  test::Random random(seed);
  std::vector<Operand> operands;
  for (size_t polygons = 0; polygons < 1200;) {
    Operand operand;
    if (random.integer(0, 1)) {
      operand = test::operand_of(test::random_leaf(random));
    } else {
      IVec3 hi{};
      for (int64_t& h : hi) h = random.integer(1, 4);
      auto leaf = std::make_shared<LeafGeometry>(*test::make_leaf(test::box_loops({0, 0, 0}, hi)));
      leaf->opposite = pair_edges(*leaf).opposite;
      leaf->may_touch = false;
      leaf->convex = random.integer(0, 1) == 0;
      operand = test::operand_of(std::move(leaf));
    }
    operand.translation = {random.integer(-12, 12), random.integer(-12, 12),
                           random.integer(-12, 12)};
    polygons += operand.leaf->face_count();
    operands.push_back(std::move(operand));
  }
  return operands;
}

TEST(Threads, CutWhatTouchesAsCellsDo) {
  for (const uint64_t seed : {871u, 872u, 873u}) {
    std::vector<Operand> operands = touching_bodies(seed);
    for (const BooleanOp op : {BooleanOp::kUnion, BooleanOp::kDifference}) {
      if (op == BooleanOp::kDifference) {
        operands.insert(operands.begin(),
                        test::operand_of(test::box_leaf({-13, -13, -13}, {15, 15, 15})));
      }
      KernelOptions options;
      options.whole_faces = false;
      EvaluateStats ignored;
      const auto slow = evaluate(operands, op, options, ignored);
      ASSERT_GT(slow->faces.size(), 300u);
      options.whole_faces = true;
      std::vector<EvaluateStats> stats;
      for (const unsigned threads : {1u, 2u, 5u}) {
        options.threads = threads;
        const auto fast = evaluate(operands, op, options, stats.emplace_back());
        ASSERT_EQ(test::first_difference(*fast, *slow), "") << threads << " threads, " << seed;
        ASSERT_EQ(stats.back().sign_filter, stats[0].sign_filter);
        ASSERT_EQ(stats.back().sign_symbolic, stats[0].sign_symbolic);
        ASSERT_EQ(stats.back().sign_exact, stats[0].sign_exact);
      }
    }
  }
}

/// Cells hold exactly the polygons that meet them, with others of another operand there.
TEST(Threads, CoarseCellsHoldWhatMeetsThem) {
  const std::vector<Operand> operands = three_spheres();
  const Job job(operands);
  for (const unsigned threads : {1u, 4u}) {
    std::vector<uint8_t> covered(job.polygons().size(), 0);
    for (size_t p = 0; p < covered.size(); ++p) covered[p] = p % 5 == 0;
    for (const bool any_covered : {false, true}) {
      const auto cells = with_threads(threads, [&] {
        return find_coarse_cells(
            job, any_covered ? std::span<const uint8_t>(covered) : std::span<const uint8_t>(), 17);
      });
      ASSERT_GT(cells.cells.size(), 100u);
      for (size_t c = 0; c < cells.cells.size(); c += 97) {
        const auto& cell = cells.cells[c];
        const PolygonBox box{cell.lo, cell.hi};
        std::vector<uint32_t> expected;
        bool several = false, open = false;
        for (uint32_t p = 0; p < job.polygons().size(); ++p) {
          if (!job.boxes()[p].meets(box)) continue;
          expected.push_back(p);
          several |= job.polygons()[p].operand != job.polygons()[expected[0]].operand;
          open |= !any_covered || !covered[p];
        }
        const std::vector<uint32_t> held(cells.polygons.begin() + cell.first,
                                         cells.polygons.begin() + cell.first + cell.count);
        ASSERT_EQ(held, expected);
        ASSERT_TRUE(several && open);
      }
    }
  }
}

}  // namespace
}  // namespace csgrun::threads_test
