// Whole evaluations: results against known volumes, and what is reused.
#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include <csgrun/engine/evaluate.h>
#include <csgrun/engine/validate.h>

#include "test_meshes.h"

namespace csgrun::evaluate_test {
namespace {

using namespace testing;

TEST(Evaluate, BooleansOfCubes) {
  const NodePtr a = cube(2), b = moved(1, 1, 1, cube(2));
  EXPECT_EQ(solid_of(a)->measures.volume, 8);
  EXPECT_EQ(solid_of(unite({a, b}))->measures.volume, 15);
  EXPECT_EQ(solid_of(intersect({a, b}))->measures.volume, 1);
  EXPECT_EQ(solid_of(subtract({a, b}))->measures.volume, 7);
  EXPECT_EQ(solid_of(symmetric({a, b}))->measures.volume, 14);
  EXPECT_TRUE(solid_of(subtract({a, a}))->empty());
  EXPECT_TRUE(solid_of(intersect({a, moved(2, 0, 0, a)}))->empty());
}

/// Solids of their own that are equal only when they are on the grid.
std::vector<NodePtr> equal_cubes(int count) {
  std::vector<NodePtr> cubes;
  for (int i = 0; i < count; ++i)
    cubes.push_back(moved(i * 0.25, 0, 0, moved(-i * 0.25, 1, 1, cube(2))));
  return cubes;
}

TEST(Evaluate, EqualOperandsCountOnce) {
  EvaluateOptions options;
  options.threads = 1;
  const auto work_of = [&](const NodePtr& root, double volume) {
    Evaluator evaluator(options);
    const auto result = evaluator.evaluate(root);
    EXPECT_TRUE(result.has_value()) << result.error().message;
    if (result) {
      EXPECT_EQ((*result)->measures.volume, volume);
    }
    return evaluator.stats().cells;
  };
  std::vector<NodePtr> many = equal_cubes(50);
  for (const bool flatten : {true, false}) {
    options.flatten = flatten;
    const uint64_t limit = flatten ? 1 : many.size();
    EXPECT_LE(work_of(unite(many), 8), limit);
    EXPECT_LE(work_of(intersect(many), 8), limit);
    work_of(symmetric(equal_cubes(3)), 8);
    work_of(subtract(equal_cubes(2)), 0);
  }
  options.flatten = true;
  many.insert(many.begin(), cube(4));
  EXPECT_EQ(work_of(subtract(many), 56), work_of(subtract({cube(4), many[1]}), 56));
}

TEST(Evaluate, DecimalsMeet) {
  const auto joined = solid_of(unite({cube(0.3), moved(0.1 + 0.2, 0, 0, cube(0.3))}));
  EXPECT_EQ(joined->triangles.size(), 12u);
  std::vector<NodePtr> row;
  for (int i = 0; i < 10; ++i) row.push_back(moved(i * 0.1, 0, 0, cube(0.1)));
  EXPECT_EQ(solid_of(unite(row))->triangles.size(), 12u);
  const auto scaled = solid_of(
      unite({Node::transformed(scaling(1.1, 1.1, 1.1), cube(10)), moved(11, 0, 0, cube(11))}));
  EXPECT_EQ(scaled->triangles.size(), 12u);
}

TEST(Evaluate, FlushStaysFlushUnderOddRotations) {
  const NodePtr part = subtract({box({-5, -5, 0}, {5, 5, 4}), prism(32, 2, 4)});
  const NodePtr odd = turned(40, {0, 0, 1}, turned(30, {0, 1, 0}, turned(20, {1, 0, 0}, part)));
  const auto straight = solid_of(part), turned_part = solid_of(odd);
  EXPECT_EQ(turned_part->measures.genus, 1);
  EXPECT_EQ(turned_part->triangles.size(), straight->triangles.size());
  EXPECT_NEAR(turned_part->measures.volume / straight->measures.volume, 1, 1e-10);
}

NodePtr gear(int teeth) {
  std::vector<NodePtr> parts{prism(48, 10, 3)};
  for (int i = 0; i < teeth; ++i) {
    parts.push_back(turned(i * 360.0 / teeth, {0, 0, 1}, box({8, -0.6, 0}, {12, 0.6, 3})));
  }
  return unite(parts);
}

TEST(Evaluate, AGearKeepsOneTop) {
  const auto straight = solid_of(gear(17));
  EXPECT_EQ(straight->measures.genus, 0);
  EXPECT_EQ(straight->measures.components, 1);
  for (const auto& p : straight->positions) EXPECT_TRUE(p.z == 0 || p.z == 3) << p.z;
  const auto odd = solid_of(turned(37, {1, 2, 3}, gear(17)));
  EXPECT_EQ(odd->faces.size(), straight->faces.size());
  EXPECT_EQ(odd->measures.genus, 0);
  EXPECT_NEAR(odd->measures.volume / straight->measures.volume, 1, 1e-10);
}

TEST(Evaluate, APolarArrayIsEvaluatedOnce) {
  const NodePtr part = subtract({box({20, -1, 0}, {25, 1, 3}), box({21, -0.5, -1}, {24, 0.5, 4})});
  std::vector<NodePtr> array;
  for (int i = 0; i < 36; ++i) array.push_back(turned(10 * i, {0, 0, 1}, part));
  EvaluateOptions options;
  options.threads = 1;
  Evaluator evaluator(options);
  const auto result = evaluator.evaluate(unite(array));
  ASSERT_TRUE(result.has_value()) << result.error().message;
  EXPECT_NEAR((*result)->measures.volume, 36 * (30 - 9), 1e-6);
  EXPECT_EQ(evaluator.stats().nodes_evaluated, 2u);
  EXPECT_EQ(evaluator.stats().nodes_from_memory, 35u);
}

TEST(Evaluate, MovedPaintedAndMirroredCopiesAreReused) {
  const NodePtr part = subtract({cube(4), box({1, 1, -1}, {2, 3, 5})});
  Appearance red;
  red.red = 1;
  red.is_default = false;
  EvaluateOptions options;
  options.threads = 1;
  Evaluator evaluator(options);
  const auto result = evaluator.evaluate(std::vector<NodePtr>{
      part, moved(10, 0.001, 0, part), Node::painted(red, part),
      Node::transformed(scaling(-1, 1, 1), part), turned(33, {1, 1, 1}, part)});
  ASSERT_TRUE(result.has_value()) << result.error().message;
  EXPECT_EQ(evaluator.stats().nodes_evaluated, 1u);
  EXPECT_EQ(evaluator.stats().nodes_from_memory, 4u);
  for (const auto& solid : *result) EXPECT_NEAR(solid->measures.volume, 64 - 8, 1e-9);
  EXPECT_EQ((*result)[2]->appearances.size(), 1u);
  EXPECT_EQ((*result)[2]->appearances[0], red);
  EXPECT_EQ((*result)[3]->measures.bbox[0].x, -4);
}

// Parts of one solid where it stands: in one job its surface would be there once for each.
TEST(Evaluate, PartsOfOneSolidAreEvaluatedOneByOne) {
  for (const bool is_leaf : {false, true}) {
    for (const BooleanOp op : {BooleanOp::kIntersection, BooleanOp::kDifference}) {
      std::vector<NodePtr> rods;
      for (int i = 0; i < 6; ++i) rods.push_back(moved(4 * i, 0, 0, prism(24, 1.5, 3)));
      const NodePtr solid = is_leaf ? box({-2, -2, 0}, {22, 2, 3}) : unite(rods);
      std::vector<NodePtr> parts;
      for (int i = 0; i < 6; ++i) {
        const NodePtr near = box({4.0 * i - 1, -3, -1}, {4.0 * i + 1, 3, 4});
        parts.push_back(moved(0, 0, 1, Node::boolean(op, {solid, near})));
      }
      EvaluateOptions options;
      options.threads = 1;
      Evaluator evaluator(options);
      const auto whole = evaluator.evaluate(unite(parts));
      ASSERT_TRUE(whole) << whole.error().message;
      const EvaluateStats& stats = evaluator.stats();
      uint64_t signs = stats.sign_filter + stats.sign_symbolic;
      for (const uint64_t n : stats.sign_exact) signs += n;
      if (is_leaf) {
        EXPECT_EQ(signs, 0u) << "boxes are decided by the order of coordinates";
      } else if (op == BooleanOp::kIntersection) {
        EXPECT_LT(signs, 10000u) << "126,000 in one job";
      }
      options.flatten = false;
      Evaluator other(options);
      const auto one_by_one = other.evaluate(unite(parts));
      ASSERT_TRUE(one_by_one) << one_by_one.error().message;
      EXPECT_EQ((*whole)->canonical_hash, (*one_by_one)->canonical_hash);
      EXPECT_EQ((*whole)->positions, (*one_by_one)->positions);
      EXPECT_EQ((*whole)->triangles, (*one_by_one)->triangles);
      EXPECT_GT((*whole)->measures.volume, 30);
    }
  }
}

// What check_mesh finds bad is an error here, too, and nothing is read beyond a list.
TEST(Evaluate, ListsThatDoNotGoTogetherAreRefused) {
  const PolygonMesh good = *cube(2)->mesh();
  std::vector<PolygonMesh> bad(8, good);
  bad[0].loop_starts.back() = 1000;
  bad[1].face_starts.back() = 1000;
  bad[2].face_starts[3] = bad[2].face_starts[2];
  bad[3].loop_starts[2] = bad[3].loop_starts[1];
  bad[4].loop_starts.clear();
  bad[5].face_starts.clear();
  std::swap(bad[6].loop_starts[1], bad[6].loop_starts[2]);
  bad[7].corners.pop_back();
  for (size_t i = 0; i < bad.size(); ++i) {
    EXPECT_FALSE(check_mesh(bad[i]).text().empty()) << i;
    const auto result =
        Evaluator({}).evaluate(Node::leaf(std::make_shared<PolygonMesh>(bad[i]), SourceRef{}));
    ASSERT_FALSE(result) << i;
    EXPECT_EQ(result.error().code, ErrorCode::kInvalidMesh) << i;
  }
  EXPECT_FALSE(Evaluator({}).evaluate(Node::leaf(nullptr, SourceRef{})));
}

// Slices of what somebody looked at before each cut: that is known, and a surface of its own, which
// coincides with those of all others, as they were cut from one solid.
TEST(Evaluate, SlicesOfKnownRestsAreEvaluatedOneByOne) {
  for (const bool by_difference : {false, true}) {
    NodePtr rest = subtract({prism(48, 10, 12), prism(24, 4, 12)});
    EvaluateOptions options;
    options.threads = 1;
    Evaluator evaluator(options);
    std::vector<NodePtr> slices;
    for (int i = 1; i < 12; ++i) {
      ASSERT_TRUE(evaluator.extent(rest));
      const NodePtr below = box({-11, -11, -1}, {11, 11, 1.0 * i});
      slices.push_back(Node::boolean(BooleanOp::kIntersection, {rest, below}));
      rest = by_difference ? subtract({rest, below})
                           : Node::boolean(BooleanOp::kIntersection,
                                           {rest, box({-11, -11, 1.0 * i}, {11, 11, 13})});
    }
    slices.push_back(rest);
    const auto signs = [&] {
      const EvaluateStats& stats = evaluator.stats();
      uint64_t all = stats.sign_filter + stats.sign_symbolic;
      for (const uint64_t n : stats.sign_exact) all += n;
      return all;
    };
    const uint64_t before = signs();
    const auto whole = evaluator.evaluate(unite(slices));
    ASSERT_TRUE(whole) << whole.error().message;
    EXPECT_LT(signs() - before, 500000u) << "2,700,000 in one job";
    const auto solid = solid_of(subtract({prism(48, 10, 12), prism(24, 4, 12)}));
    EXPECT_EQ((*whole)->measures.volume, solid->measures.volume);
    EXPECT_EQ((*whole)->measures.area, solid->measures.area);
    EXPECT_EQ((*whole)->triangles.size(), solid->triangles.size());
    Evaluator fresh(options);
    const auto unknown = fresh.evaluate(unite(slices));
    ASSERT_TRUE(unknown) << unknown.error().message;
    EXPECT_EQ((*whole)->canonical_hash, (*unknown)->canonical_hash);
    EXPECT_EQ((*whole)->triangles, (*unknown)->triangles);
  }
}

TEST(Evaluate, AGrowingChainReusesItsPrefix) {
  EvaluateOptions options;
  options.threads = 1;
  Evaluator evaluator(options), fresh(options);
  NodePtr part = cube(10);
  for (int i = 0; i < 20; ++i) {
    part = subtract({part, moved(i * 0.5 - 1, i * 0.3, 8, cube(2.7))});
    const auto result = evaluator.evaluate(part);
    ASSERT_TRUE(result.has_value()) << result.error().message;
  }
  EXPECT_EQ(evaluator.stats().nodes_evaluated, 20u);
  EXPECT_EQ(evaluator.stats().nodes_from_memory, 19u);
  const auto again = evaluator.evaluate(part), once = fresh.evaluate(part);
  EXPECT_EQ(evaluator.stats().nodes_evaluated, 20u);
  EXPECT_EQ(fresh.stats().nodes_evaluated, 1u);
  EXPECT_EQ((*again)->canonical_hash, (*once)->canonical_hash);
  EXPECT_EQ((*again)->positions, (*once)->positions);
  EXPECT_EQ((*again)->triangles, (*once)->triangles);
}

TEST(Evaluate, FlatAndNestedAgree) {
  const NodePtr hole = prism(12, 1, 6);
  std::vector<NodePtr> holes;
  for (int i = 0; i < 5; ++i) holes.push_back(moved(2 * i, 0.3 * i, -1, hole));
  const NodePtr model =
      unite({subtract({box({-2, -2, 0}, {10, 4, 3}), unite(holes)}), turned(25, {0, 0, 1}, cube(3)),
             symmetric({moved(0, 5, 0, cube(2)), moved(1, 5, 1, cube(2)), moved(0, 6, 0, cube(2))}),
             intersect({gear(7), box({-20, -20, 1}, {20, 20, 2})})});
  const auto flat = solid_of(model);
  EvaluateOptions nested;
  nested.flatten = false;
  const auto other = solid_of(model, nested);
  EXPECT_EQ(flat->canonical_hash, other->canonical_hash);
  EXPECT_EQ(flat->positions, other->positions);
  EXPECT_EQ(flat->triangles, other->triangles);
}

TEST(Evaluate, HugeCuttersDoNotCoarsenTheGrid) {
  EvaluateOptions options;
  options.threads = 1;
  Evaluator evaluator(options);
  const auto result =
      evaluator.evaluate(subtract({cube(1), box({0.5, -9000, -9000}, {9000, 9000, 9000})}));
  ASSERT_TRUE(result.has_value()) << result.error().message;
  EXPECT_EQ((*result)->measures.volume, 0.5);
  EXPECT_EQ(evaluator.stats().grid_mm, 1.5625e-08);
}

TEST(Evaluate, PartsShareOneGridAndEqualPartsOneSolid) {
  EvaluateOptions options;
  options.threads = 1;
  Evaluator evaluator(options);
  const auto result = evaluator.evaluate(
      std::vector<NodePtr>{cube(1), cube(1), moved(1, 0, 0, cube(1)), cube(1000)});
  ASSERT_TRUE(result.has_value()) << result.error().message;
  EXPECT_EQ((*result)[0], (*result)[1]);
  EXPECT_NE((*result)[0], (*result)[2]);
  EXPECT_EQ(evaluator.stats().grid_mm, 8e-6);
}

TEST(Evaluate, ErrorsAndWarningsNameTheirLine) {
  const auto file = std::make_shared<const std::string>("m.lua");
  EvaluateOptions options;
  options.threads = 1;
  {
    Evaluator evaluator(options);
    Affine flat = scaling(1, 1, 0);
    const auto result = evaluator.evaluate(
        unite({cube(1), Node::transformed(flat, box({5, 0, 0}, {6, 1, 1}, {file, 7}))}));
    ASSERT_TRUE(result.has_value());
    EXPECT_EQ((*result)->measures.volume, 1);
    ASSERT_EQ(evaluator.warnings().size(), 1u);
    EXPECT_EQ(evaluator.warnings()[0].substr(0, 8), "m.lua:7:");
  }
  {
    Evaluator evaluator(options);
    Affine skew;
    skew.m[0][2] = 66'000;
    const auto result = evaluator.evaluate(Node::transformed(skew, cube(1), {file, 9}));
    ASSERT_TRUE(result.has_value()) << result.error().message;
    EXPECT_NEAR((*result)->measures.volume, 1, 0.01);
    ASSERT_EQ(evaluator.warnings().size(), 1u);
    EXPECT_EQ(evaluator.warnings()[0].substr(0, 8), "m.lua:9:");
  }
  {
    options.grid = *GridStep::parse("2^-30");
    Evaluator evaluator(options);
    const auto result = evaluator.evaluate(cube(100));
    ASSERT_FALSE(result.has_value());
    EXPECT_EQ(result.error().code, ErrorCode::kOutOfRange);
  }
}

TEST(Evaluate, ContainsAgreesWithTheLeaves) {
  // The truth is the Boolean expression over boxes, in decimals of 0.5; on a boundary the eight
  // points around decide.
  const NodePtr model = subtract({unite({cube(4), box({4, 1, 1}, {6, 3, 3})}),
                                  box({1, 1, 0}, {3, 3, 5}), box({4, 0, 3}, {7, 4, 4})});
  const auto in_box = [](glm::dvec3 p, glm::dvec3 lo, glm::dvec3 hi) {
    return p.x > lo.x && p.y > lo.y && p.z > lo.z && p.x < hi.x && p.y < hi.y && p.z < hi.z;
  };
  const auto inside = [&](glm::dvec3 p) {
    return (in_box(p, {0, 0, 0}, {4, 4, 4}) || in_box(p, {4, 1, 1}, {6, 3, 3}) ||
            // between the two boxes there is no wall
            (p.x == 4 && in_box({4.1, p.y, p.z}, {4, 1, 1}, {6, 3, 3}))) &&
           !in_box(p, {1, 1, 0}, {3, 3, 5});
  };
  EvaluateOptions options;
  options.threads = 1;
  Evaluator evaluator(options), often(options);  // what is asked of one solid alone is quicker
  const Affine map = Affine::compose(translation(3, 1, 2), rotation(90, {0, 0, 1}));
  for (double x = -0.5; x <= 6.5; x += 0.5) {
    for (double y = -0.5; y <= 4.5; y += 0.5) {
      for (double z = -0.5; z <= 5.5; z += 0.5) {
        int around = 0;
        for (int i = 0; i < 8; ++i) {
          around += inside(
              {x + (i & 1 ? 0.1 : -0.1), y + (i & 2 ? 0.1 : -0.1), z + (i & 4 ? 0.1 : -0.1)});
        }
        const int truth = around == 8 ? 1 : around == 0 ? -1 : 0;
        const auto found = evaluator.contains(model, {x, y, z});
        ASSERT_TRUE(found.has_value());
        EXPECT_EQ(*found, truth) << x << " " << y << " " << z;
        EXPECT_EQ(*often.contains(model, {x, y, z}), truth) << x << " " << y << " " << z;
        const auto moved_point =
            evaluator.contains(Node::transformed(map, model), map.apply({x, y, z}));
        EXPECT_EQ(*moved_point, truth) << x << " " << y << " " << z;
      }
    }
  }
  EXPECT_EQ(evaluator.stats().nodes_evaluated, 2u) << "a union within a difference, once";
  EXPECT_EQ(*evaluator.contains(model, {1e30, 0, 0}), -1);
  EXPECT_FALSE(evaluator.contains(model, {NAN, 0, 0}).has_value());
  EXPECT_EQ(*evaluator.contains(cube(0.3), {0.1 + 0.2, 0.1, 0.1}), 0);
}

TEST(Evaluate, ContainsInATurnedPart) {
  const NodePtr ring = subtract({prism(24, 10, 4), prism(24, 5, 4)});
  const Affine map = Affine::compose(translation(1, 2, 3), rotation(37, {1, 2, 3}));
  EvaluateOptions options;
  options.threads = 1;
  Evaluator evaluator(options);
  for (int i = 0; i < 24; ++i) {
    const double t = 0.2618 * i + 0.1;
    for (auto [r, z, truth] : {std::tuple{7.0, 2.0, 1},
                               {4.5, 2.0, -1},
                               {11.0, 2.0, -1},
                               {7.0, 4.5, -1},
                               {7.0, -0.5, -1},
                               {7.0, 3.99, 1}}) {
      const auto p = map.apply({r * std::cos(t), r * std::sin(t), z});
      EXPECT_EQ(*evaluator.contains(Node::transformed(map, ring), p), truth) << i << " " << r;
    }
  }
}

TEST(Evaluate, RandomTreesKeepTheirCombinatoricsWhenTurned) {
  std::mt19937_64 random(20);
  const auto pick = [&](int n) { return static_cast<int>(random() % static_cast<uint64_t>(n)); };
  for (int tree = 0; tree < 300; ++tree) {
    // Decimals on a coarse lattice, so that much is flush, touching or equal.
    // Turned leaves have frames of their own, where the outer turn is not a move by whole steps:
    // their axis-aligned contacts must survive, contacts of slanted faces need not.
    const bool mixes_frames = tree % 2 == 1;
    std::vector<NodePtr> pool;
    for (int i = 0; i < 5; ++i) {
      NodePtr leaf = mixes_frames || pick(3)
                         ? box({0, 0, 0}, {0.5 + pick(4), 0.5 + pick(4), 0.5 + pick(4)})
                         : prism(3 + pick(5), 1 + 0.5 * pick(4), 0.5 + pick(4));
      if (pick(3) == 0) leaf = turned(90 * pick(4), {0, 0, 1}, leaf);
      const bool is_turned = mixes_frames && pick(3) == 0;
      if (is_turned) leaf = turned(17.3, {0, 0, 1}, leaf);
      // Off the lattice: edges of one frame that rest on faces of another by chance may not stay
      // so.
      const double off = is_turned ? 0.137 : 0;
      pool.push_back(moved(0.5 * pick(8) + off, 0.5 * pick(8) + off / 3, 0.5 * pick(8), leaf));
    }
    while (pool.size() > 1) {
      const NodePtr a = pool.back();
      pool.pop_back();
      const size_t other = static_cast<size_t>(pick(static_cast<int>(pool.size())));
      pool[other] = Node::boolean(pick(4) ? BooleanOp::kUnion : static_cast<BooleanOp>(pick(4)),
                                  {pool[other], a});
    }
    EvaluateOptions options;
    options.grid = *GridStep::parse("0.00001");
    const auto straight = solid_of(pool[0], options);
    if (straight->empty()) continue;
    for (int turn = 0; turn < 20; ++turn) {
      Affine map = rotation(pick(3600) * 0.1, {1.0 + pick(9), pick(9) - 4.0, pick(9) - 4.0});
      if (turn % 3 == 2) map = Affine::compose(map, scaling(-1, 1, 1));
      // A move by whole steps of the lattice is none in the axes of turned leaves.
      if (!mixes_frames) map = Affine::compose(map, translation(0.5 * pick(9), 0.25, 0.125));
      const auto other = solid_of(Node::transformed(map, pool[0]), options);
      EXPECT_EQ(other->faces.size(), straight->faces.size()) << tree << " " << turn;
      EXPECT_EQ(other->positions.size(), straight->positions.size()) << tree << " " << turn;
      EXPECT_EQ(other->triangles.size(), straight->triangles.size()) << tree << " " << turn;
      EXPECT_EQ(other->measures.genus, straight->measures.genus) << tree << " " << turn;
      EXPECT_EQ(other->measures.components, straight->measures.components) << tree << " " << turn;
      EXPECT_NEAR(other->measures.volume / straight->measures.volume, 1, 1e-10)
          << tree << " " << turn;
    }
  }
}

/// Bodies that are apart, unions of two or three of them, some turned: what unions have in common
/// is nothing, wherever the step comes from.
TEST(Evaluate, LeavesInFramesThatNothingSees) {
  std::mt19937 random(20261129);
  const auto place = [&] { return static_cast<double>(random() % 81) / 2 - 20; };
  const auto body = [&] {
    NodePtr made = random() % 2 == 0 ? cube(2) : prism(5, 1, 2);
    if (random() % 2 == 0) made = turned(45, {0, 0, 1}, made);
    if (random() % 4 == 0) made = turned(20, {1, 2, 3}, made);
    return made;
  };
  // No body is farther than 3.5 from where it is put.
  constexpr double kApart = 7;
  const NodePtr small = moved(0, 0, 60, cube(0.01));
  int boxes_meet = 0;
  for (int scene = 0; scene < 400; ++scene) {
    std::vector<std::array<double, 3>> places;
    std::array<std::vector<NodePtr>, 2> sides;
    while (places.size() < 5) {
      const std::array<double, 3> at{place(), place(), place()};
      const bool is_apart = std::all_of(places.begin(), places.end(), [&](const auto& p) {
        return std::hypot(p[0] - at[0], p[1] - at[1], p[2] - at[2]) > kApart;
      });
      if (!is_apart) continue;
      sides[places.size() % 2].push_back(moved(at[0], at[1], at[2], body()));
      places.push_back(at);
    }
    const NodePtr common = intersect({unite(sides[0]), unite(sides[1])});
    EXPECT_TRUE(solid_of(common)->empty()) << scene;
    const SolidPtr beside = solid_of(unite({small, common}));
    EXPECT_NEAR(beside->measures.volume, 1e-6, 1e-9) << scene;
    EXPECT_EQ(beside->measures.components, 1) << scene;
    EXPECT_NEAR(solid_of(symmetric({small, common}))->measures.volume, 1e-6, 1e-9) << scene;
    // The boxes of both sides have something in common in most scenes.
    const auto a = solid_of(unite(sides[0]))->measures.bbox,
               b = solid_of(unite(sides[1]))->measures.bbox;
    bool meet = true;
    for (int k = 0; k < 3; ++k) meet &= a[0][k] < b[1][k] && b[0][k] < a[1][k];
    boxes_meet += meet ? 1 : 0;
  }
  EXPECT_GT(boxes_meet, 200);
}

TEST(Evaluate, FlushFacesOfBoxesThatHoldAllAreTheFirstOperands) {
  Appearance red, blue;
  red.is_default = blue.is_default = false;
  red.green = red.blue = blue.red = blue.green = 0;
  const NodePtr part = Node::painted(red, subtract({cube(4), moved(1, 1, 1, cube(9))})),
                bounds = Node::painted(blue, cube(4));
  // With a tool beyond the box that leaves no trace, it is an operand.
  const NodePtr near = unite({part, moved(4, 4, 4, Node::painted(red, cube(1)))});
  for (const NodePtr& before : {part, near}) {
    const SolidPtr solid = solid_of(intersect({before, bounds}));
    for (const auto& face : solid->faces) EXPECT_EQ(solid->appearances[face.appearance], red);
    EXPECT_EQ(solid->canonical_hash, solid_of(part)->canonical_hash);
    const SolidPtr other = solid_of(intersect({bounds, before}));
    size_t flush = 0;
    for (const auto& face : other->faces) flush += other->appearances[face.appearance] == blue;
    EXPECT_EQ(flush, 6u);
  }
}

TEST(Evaluate, EmptyTrees) {
  EXPECT_TRUE(solid_of(Node::empty())->empty());
  EXPECT_TRUE(solid_of(subtract({Node::empty(), cube(1)}))->empty());
  EXPECT_TRUE(solid_of(intersect({cube(1), Node::empty()}))->empty());
  EXPECT_EQ(solid_of(unite({Node::empty(), cube(1)}))->measures.volume, 1);
}

}  // namespace
}  // namespace csgrun::evaluate_test
