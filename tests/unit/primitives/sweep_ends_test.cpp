// Ends of sweeps are planes: what is flush there is flush.
#include <cmath>
#include <random>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <csgrun/engine/evaluate.h>
#include <csgrun/primitives/sweep.h>
#include <csgrun/primitives/trig.h>

#include "tests/unit/primitives/outlines.h"

namespace csgrun::sweep_ends_test {
namespace {

using testing::box;

using Path = std::vector<glm::dvec3>;

NodePtr swept_by(const Shape2D& shape, const SweepOptions& options) {
  auto solid = sweep_solid(shape, options, {});
  EXPECT_TRUE(solid) << (solid ? "" : solid.error().message);
  return solid ? *solid : Node::empty();
}

NodePtr swept(const Shape2D& shape, const Path& path) { return swept_by(shape, {.path = path}); }

SolidPtr solid_of(const NodePtr& node, std::vector<std::string>* notes = nullptr) {
  EvaluateOptions options;
  options.threads = 1;
  Evaluator evaluator(options);
  auto solid = evaluator.evaluate(node);
  EXPECT_TRUE(solid) << (solid ? "" : solid.error().message);
  if (notes != nullptr) *notes = evaluator.warnings();
  return solid ? *solid : std::make_shared<Solid>();
}

NodePtr less(const NodePtr& a, const NodePtr& b) {
  return Node::boolean(BooleanOp::kDifference, {a, b});
}
NodePtr together(const NodePtr& a, const NodePtr& b) {
  return Node::boolean(BooleanOp::kUnion, {a, b});
}

double length_of(const Path& path) {
  double length = 0;
  for (size_t i = 1; i < path.size(); ++i) length += glm::length(path[i] - path[i - 1]);
  return length;
}

/// Paths of one to five pieces, of which none turns by more than a right angle.
std::vector<Path> random_paths(int count) {
  std::mt19937 random(20261201);
  const auto draw = [&](double most) {
    return most * (2 * (static_cast<double>(random()) / 4294967296.0) - 1);
  };
  std::vector<Path> paths;
  while (static_cast<int>(paths.size()) < count) {
    Path path{{draw(5), draw(5), draw(5)}};
    glm::dvec3 way(draw(10), draw(10), 10);
    const unsigned pieces = 1 + random() % 5;
    for (unsigned i = 0; i < pieces; ++i) {
      path.push_back(path.back() + way);
      way += glm::dvec3(draw(6), draw(6), draw(3));
    }
    paths.push_back(path);
  }
  return paths;
}

const Shape2D kOuter = box(-1, -1, 1, 1), kInner = box(-0.5, -0.5, 0.5, 0.5);

TEST(SweepEnds, TubesAreOpenAtBothEnds) {
  for (const Path& path : random_paths(60)) {
    const SolidPtr tube = solid_of(less(swept(kOuter, path), swept(kInner, path)));
    const double length = length_of(path);
    EXPECT_EQ(tube->measures.components, 1);
    EXPECT_EQ(tube->measures.genus, 1);
    EXPECT_NEAR(tube->measures.volume, 3 * length, 1e-5 * length);
    // Walls of an outline about the path are as long as the path on the average. A wall over an
    // opening, as thin as it may be, would add its area twice.
    EXPECT_NEAR(tube->measures.area, (8 + 4) * length + 2 * 3, 1e-5 * length);
  }
}

TEST(SweepEnds, FlushWhateverTheOutlineDoesElsewhere) {
  std::vector<SweepOptions> ways(4);
  ways[0].up = glm::dvec3(1, 2, 3);
  ways[1].twist = 70;
  ways[2].scale = {1.5, 1.5};
  ways[3].scale = {0.9, 1.25};
  const Shape2D hole = *make_circle(0.4, Facets{16, 12, 2});
  for (const Path& path : random_paths(20)) {
    for (SweepOptions way : ways) {
      way.path = path;
      const SolidPtr tube = solid_of(less(swept_by(kOuter, way), swept(hole, path)));
      EXPECT_EQ(tube->measures.components, 1);
      EXPECT_EQ(tube->measures.genus, 1);
    }
    Path back(path.rbegin(), path.rend());
    EXPECT_EQ(solid_of(less(swept(kOuter, path), swept(hole, back)))->measures.genus, 1);
  }
}

TEST(SweepEnds, WhatGoesOnIsOneSolid) {
  for (const Path& path : random_paths(60)) {
    const glm::dvec3 end = path.back(), way = end - path[path.size() - 2];
    const Path onwards{end, end + way * 0.5, end + way * 0.5 + glm::dvec3(0, 0, 5)};
    const SolidPtr both = solid_of(together(swept(kOuter, path), swept(kInner, onwards)));
    EXPECT_EQ(both->measures.components, 1);
    EXPECT_EQ(both->measures.genus, 0);
    const double volume = 4 * length_of(path) + length_of(onwards);
    EXPECT_NEAR(both->measures.volume, volume, 1e-5 * volume);
    const double area = 8 * length_of(path) + 4 * length_of(onwards) + 4 + 4;
    EXPECT_NEAR(both->measures.area, area, 1e-5 * area);
  }
}

/// Beside one another, along one path: their common walls are cut alike.
TEST(SweepEnds, WallsInCommonStayInCommon) {
  const Shape2D narrow = box(0, 0, 1, 1), wide = box(1, 0, 2.5, 1);
  for (const Path& path : random_paths(40)) {
    const SolidPtr both = solid_of(together(swept(narrow, path), swept(wide, path))),
                   whole = solid_of(swept(box(0, 0, 2.5, 1), path));
    EXPECT_EQ(both->measures.components, 1);
    EXPECT_EQ(both->measures.genus, 0);
    EXPECT_NEAR(both->measures.area, whole->measures.area, 1e-5 * whole->measures.area);
  }
}

TEST(SweepEnds, AcrossAnAxisTheyArePlanesAsTheyAre) {
  EXPECT_EQ(swept(kOuter, Path{{0, 0, 0}, {0, 0, 9}, {5, 0, 20}, {9, 0, 20}})->kind(),
            NodeKind::kLeaf);
  EXPECT_EQ(swept_by(kOuter, {.path = {{0, 0, 0}, {9, 1, 0}, {5, 9, 1}}, .closed = true})->kind(),
            NodeKind::kLeaf);
  const NodePtr one = swept(kOuter, Path{{0, 0, 0}, {0, 0, 9}, {5, 1, 20}});
  ASSERT_EQ(one->kind(), NodeKind::kBoolean);
  EXPECT_EQ(one->children().size(), 2u);
  EXPECT_EQ(swept_by(kOuter, {.path = {{0, 0, 0}, {3, 4, 5}}, .scale = {0, 0}})->children().size(),
            2u);
}

/// A ring that nearly comes home, and a hook whose end lies beside its shaft: nothing but what is
/// beyond an end is taken off.
TEST(SweepEnds, TakeNothingOffElsewhere) {
  for (const double turn : {200.0, 340.0, 355.0, 358.0, 359.5}) {
    Path path;
    for (int i = 0; i <= 60; ++i) {
      const double angle = turn * i / 60;
      path.push_back({10 * cos_deg(angle), 10 * sin_deg(angle), 0});
    }
    const double length = length_of(path);
    EXPECT_NEAR(solid_of(swept(kInner, path))->measures.volume, length, 1e-5 * length) << turn;
  }
  for (const double gap : {2.1, 2.01, 2.001}) {
    const Path hook{{0, 0, 0}, {20, 3, 1}, {20, 3 + gap, 1}, {5, 0.75 + gap, 0.25}};
    SweepOptions plain{.path = hook};
    const SolidPtr mesh =
        solid_of(Node::leaf(std::make_shared<const PolygonMesh>(*sweep_shape(kOuter, plain))));
    EXPECT_NEAR(solid_of(swept(kOuter, hook))->measures.volume, mesh->measures.volume, 1e-4);
  }
}

TEST(SweepEnds, HullsAndSumsAreMadeOfTheSweepAsItIs) {
  const Path path{{0, 0, 0}, {20, 3, 1}, {25, 9, 7}};
  const NodePtr cut = swept(kOuter, path);
  ASSERT_EQ(cut->kind(), NodeKind::kBoolean);
  const NodePtr mesh =
      Node::leaf(std::make_shared<const PolygonMesh>(*sweep_shape(kOuter, {.path = path})));
  const NodePtr other =
      Node::leaf(std::make_shared<const PolygonMesh>(*make_sphere(1, Facets{8, 12, 2})));
  Appearance red;
  red.is_default = false;
  red.green = red.blue = 0;
  const auto made_of = [&](const NodePtr& sweep) {
    std::vector<SolidPtr> made;
    for (const NodePtr& node : {Node::convex_hull({sweep}), Node::minkowski_sum({sweep, other}),
                                Node::convex_hull({Node::painted(red, sweep), other}),
                                Node::resized({.size = {1, 2, 3}}, sweep)}) {
      std::vector<std::string> notes;
      made.push_back(solid_of(node, &notes));
      EXPECT_TRUE(notes.empty()) << notes[0];
    }
    return made;
  };
  const std::vector<SolidPtr> of_cut = made_of(cut), of_mesh = made_of(mesh);
  for (const size_t i : {0u, 1u, 2u}) {
    EXPECT_EQ(of_cut[i]->canonical_hash, of_mesh[i]->canonical_hash) << i;
  }
  for (int k = 0; k < 3; ++k) {
    EXPECT_NEAR(of_cut[3]->measures.bbox[1][k] - of_cut[3]->measures.bbox[0][k], k + 1, 1e-6);
  }
  // So are those of parts of a turn, which end in planes, too.
  const auto turn =
      rotate_extrude_solid(box(5, 0, 7, 3), {.angle = 40, .facets = Facets{48, 12, 2}}, {});
  ASSERT_TRUE(turn);
  ASSERT_EQ((*turn)->kind(), NodeKind::kBoolean);
  std::vector<std::string> notes;
  const auto plain = *rotate_extrude(box(5, 0, 7, 3), {.angle = 40, .facets = Facets{48, 12, 2}});
  const NodePtr plain_leaf = Node::leaf(std::make_shared<const PolygonMesh>(plain));
  EXPECT_EQ(solid_of(Node::convex_hull({*turn}), &notes)->canonical_hash,
            solid_of(Node::convex_hull({plain_leaf}))->canonical_hash);
  EXPECT_TRUE(notes.empty());
}

}  // namespace
}  // namespace csgrun::sweep_ends_test
