// Copies of evaluated parts that stand apart, or touch: the union of parts side by side is what a
// job of all of them makes, whatever else is in the job.
#include <random>

#include <gtest/gtest.h>

#include "draw.h"
#include "test_meshes.h"

namespace csgrun::apart_parts_test {
namespace {

using namespace testing;

/// Triangles that are facets of their own, as of a file.
NodePtr imported(double size) {
  PolygonMesh mesh = box_mesh({0, 0, 0}, {size, size, size});
  PolygonMesh triangles;
  triangles.points = mesh.points;
  for (size_t f = 0; f < mesh.face_count(); ++f) {
    const uint32_t* c = mesh.corners.data() + mesh.loop_starts[f];
    triangles.add_face(std::array{c[0], c[1], c[2]});
    triangles.add_face(std::array{c[0], c[2], c[3]});
  }
  triangles.keep_facets = true;
  return leaf(triangles, FillRule::kNonZero);
}

NodePtr painted(float red, NodePtr child) {
  Appearance appearance;
  appearance.red = red;
  appearance.is_default = false;
  return Node::painted(appearance, std::move(child));
}

/// Of a size below 4, from solids of which some reach no other one.
NodePtr part_of(Draw& draw) {
  std::vector<NodePtr> solids;
  for (int i = 2 + draw.below(2); i-- > 0;) {
    const double size = 1 + draw.upto(1);
    NodePtr solid = draw.below(3) == 0   ? imported(size)
                    : draw.below(2) == 0 ? prism(3 + draw.below(5), size, 2)
                                         : cube(size);
    if (draw.below(6) == 0) solid = turned(draw.upto(90), {1, 2, 0}, solid);
    if (draw.below(4) == 0) solid = painted(0.5, solid);
    solids.push_back(moved(draw.upto(1.5), draw.upto(1.5), draw.upto(0.5), solid));
  }
  // Some cut with tools that reach far.
  if (draw.below(5) == 0) solids.push_back(box({0.5, 0.5, 0.5}, {100, 0.75, 0.75}));
  switch (draw.below(4)) {
    case 0:
      return unite(solids);
    case 1:
      return symmetric(solids);
    default:
      return subtract(solids);
  }
}

/// Copies at distances that leave room, none, or less.
NodePtr copies_of(Draw& draw, const NodePtr& part, int count) {
  std::vector<NodePtr> copies;
  const double distance = std::array{5.0, 4.0, 2.0, 8.003}[draw.below(4)];
  for (int i = 0; i < count; ++i) {
    NodePtr copy = moved(distance * i, draw.below(3) == 0 ? draw.upto(1) : 0, 0, part);
    if (draw.below(8) == 0) copy = painted(0.25, copy);
    if (draw.below(8) == 0) copy = turned(90, {0, 0, 1}, copy);
    copies.push_back(copy);
  }
  return unite(copies);
}

NodePtr model_of(unsigned seed) {
  Draw draw{std::mt19937(seed)};
  const NodePtr part = part_of(draw), row = copies_of(draw, part, 2 + draw.below(4));
  const NodePtr other = moved(draw.upto(10), -1, -0.25, box({0, 0, 0}, {2, 6, 0.5}));
  switch (draw.below(6)) {
    case 0:
      return row;
    case 1:
      return unite({row, other});
    case 2:
      return subtract({row, other, moved(0, 0, 30, part)});
    case 3:
      return symmetric({row, other, moved(0, 40, 0, part)});
    case 4:
      return unite({copies_of(draw, row, 2), intersect({part, moved(20, 0, 0, part)})});
    default:
      return unite({moved(0, 50, 0, row), row, intersect({row, other})});
  }
}

TEST(ApartParts, AreWhatOneJobMakesOfThem) {
  int parts = 0;
  for (unsigned seed = 0; seed < 150; ++seed) {
    const NodePtr model = model_of(seed);
    EvaluateOptions by_cells;
    by_cells.whole_faces = false;
    const SolidPtr truth = solid_of(model, by_cells), fast = solid_of(model);
    EXPECT_EQ(fast->canonical_hash, truth->canonical_hash) << seed;
    EXPECT_EQ(fast->positions, truth->positions) << seed;
    EXPECT_EQ(fast->triangles, truth->triangles) << seed;
    parts += fast->measures.components > 1;
  }
  EXPECT_GT(parts, 75);
}

// Several roots, and results that were evaluated before.
TEST(ApartParts, AreTheSameWhereOneOfThemIsKnown) {
  EvaluateOptions options;
  options.grid = *GridStep::parse("2^-20mm");
  for (unsigned seed = 0; seed < 60; ++seed) {
    Draw draw{std::mt19937(seed)};
    const NodePtr part = part_of(draw), row = copies_of(draw, part, 3);
    Evaluator evaluator(options);
    ASSERT_TRUE(evaluator.extent(part));
    const auto solids = evaluator.evaluate({moved(7, 0, 0, part), row, moved(0, 9, 1, row)});
    ASSERT_TRUE(solids) << seed;
    EXPECT_EQ((*solids)[0]->canonical_hash, solid_of(moved(7, 0, 0, part), options)->canonical_hash)
        << seed;
    EXPECT_EQ((*solids)[1]->canonical_hash, solid_of(row, options)->canonical_hash) << seed;
    EXPECT_EQ((*solids)[2]->canonical_hash, solid_of(moved(0, 9, 1, row), options)->canonical_hash)
        << seed;
  }
}

// A tool that reaches beyond the grid in one place alone: what is known from another is used.
TEST(ApartParts, StandWhereTheirToolsDoNotFit) {
  EvaluateOptions options;
  options.grid = *GridStep::parse("2^-20mm");  // up to 128 mm
  const NodePtr part = subtract({cube(3), box({1, 1, 1}, {60, 2, 2})});
  const NodePtr near = moved(5, 0, 0, part), far = moved(100, 0, 0, part);
  const SolidPtr of_near = solid_of(near, options), of_far = solid_of(far, options);
  EXPECT_EQ(of_far->measures.volume, 27 - 2);
  for (const auto& roots : {std::vector{near, far}, std::vector{far, near}}) {
    Evaluator evaluator(options);
    const auto solids = evaluator.evaluate(roots);
    ASSERT_TRUE(solids);
    for (size_t i = 0; i < 2; ++i) {
      const SolidPtr& truth = roots[i] == far ? of_far : of_near;
      EXPECT_EQ((*solids)[i]->canonical_hash, truth->canonical_hash);
    }
  }
  for (const auto& both : {unite({near, far}), unite({far, near}), symmetric({far, near})}) {
    EvaluateOptions by_cells = options;
    by_cells.whole_faces = false;
    EXPECT_EQ(solid_of(both, options)->canonical_hash, solid_of(both, by_cells)->canonical_hash);
    EXPECT_EQ(solid_of(both, options)->measures.volume, 2 * (27 - 2));
  }
}

// What is asked about one part is not asked again about its copies.
TEST(ApartParts, CostWhatOneDoes) {
  const NodePtr part = unite({subtract({cube(3), moved(1, 1, 1, prism(64, 0.5, 9))}),
                              subtract({cube(2), moved(1, 1, -1, prism(48, 0.25, 9))})});
  const auto signs = [&](int count) {
    std::vector<NodePtr> copies;
    for (int i = 0; i < count; ++i) copies.push_back(moved(5.0 * i, 0, 0, part));
    Evaluator evaluator{EvaluateOptions{}};
    EXPECT_TRUE(evaluator.evaluate(unite(copies)));
    return evaluator.stats().sign_filter;
  };
  EXPECT_GT(signs(1), 100u);
  EXPECT_LT(signs(20), 2 * signs(2));
}

}  // namespace
}  // namespace csgrun::apart_parts_test
