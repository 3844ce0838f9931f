// Hulls, Minkowski sums and resizing in trees, against closed forms and identities.
#include <cmath>
#include <random>
#include <set>

#include <gtest/gtest.h>

#include <csgrun/engine/evaluate.h>

#include "test_meshes.h"

namespace csgrun::constructions_test {
namespace {

using namespace testing;

struct Evaluated {
  SolidPtr solid = std::make_shared<Solid>();
  std::vector<std::string> warnings;
  [[nodiscard]] double volume() const { return solid->measures.volume; }
};

Evaluated evaluated(const NodePtr& root, const char* grid = nullptr) {
  EvaluateOptions options;
  options.threads = 2;
  if (grid != nullptr) options.grid = *GridStep::parse(grid);
  Evaluator evaluator(options);
  auto result = evaluator.evaluate(root);
  EXPECT_TRUE(result.has_value()) << (result ? "" : result.error().message);
  if (!result) return {};
  return {*result, evaluator.warnings()};
}

NodePtr moved(const NodePtr& node, double x, double y, double z) {
  return testing::moved(x, y, z, node);
}
NodePtr turned(const NodePtr& node) {
  // About an axis off all others, by columns that are orthogonal only up to rounding.
  Affine map;
  const double a = std::cos(0.3), b = std::sin(0.3), c = std::cos(0.7), d = std::sin(0.7);
  map.m[0] = {a, -b, 0, 0};
  map.m[1] = {b * c, a * c, -d, 0};
  map.m[2] = {b * d, a * d, c, 0};
  return Node::transformed(map, node);
}

void expect_same(const NodePtr& given, const NodePtr& truth, const std::string& what) {
  const Evaluated a = evaluated(given), b = evaluated(truth);
  EXPECT_EQ(a.volume(), b.volume()) << what;
  EXPECT_EQ(a.solid->canonical_hash, b.solid->canonical_hash) << what;
}

using Cell = std::array<int, 3>;

const NodePtr kBox = box({0, 0, 0}, {1, 2, 3});

TEST(ConvexHullNode, OfBoxesInARow) {
  const NodePtr row = Node::convex_hull({kBox, moved(kBox, 5, 0, 0)});
  expect_same(row, box({0, 0, 0}, {6, 2, 3}), "plain");
  expect_same(turned(row), turned(box({0, 0, 0}, {6, 2, 3})), "turned as a whole");
  expect_same(Node::convex_hull({turned(kBox), turned(moved(kBox, 5, 0, 0))}),
              turned(box({0, 0, 0}, {6, 2, 3})), "each turned");
  expect_same(Node::convex_hull({row, moved(row, 0, 0, 7)}), box({0, 0, 0}, {6, 2, 10}), "nested");
  expect_same(Node::convex_hull({unite({kBox, moved(kBox, 5, 0, 0)})}), box({0, 0, 0}, {6, 2, 3}),
              "of a union");
}

TEST(ConvexHullNode, OfBooleans) {
  const NodePtr cross = subtract({box({0, 0, 0}, {9, 9, 9}), box({3, 3, -1}, {6, 6, 10})});
  const Evaluated plain = evaluated(Node::convex_hull({cross}));
  EXPECT_EQ(plain.volume(), 729);
  EXPECT_TRUE(plain.warnings.empty());
  expect_same(Node::convex_hull({turned(cross)}), turned(box({0, 0, 0}, {9, 9, 9})), "turned");
  const NodePtr nothing = intersect({kBox, moved(kBox, 9, 0, 0)});
  EXPECT_TRUE(evaluated(Node::convex_hull({nothing})).solid->empty());
  EXPECT_EQ(evaluated(Node::convex_hull({nothing, kBox})).volume(), 6);
  // A corner where three planes meet off the grid.
  const NodePtr cut = intersect({kBox, turned(moved(kBox, -0.5, -0.5, -0.5))});
  const Evaluated rounded = evaluated(Node::convex_hull({cut}));
  ASSERT_EQ(rounded.warnings.size(), 1u);
  EXPECT_NE(rounded.warnings[0].find("off the grid"), std::string::npos);
  EXPECT_NEAR(rounded.volume(), evaluated(cut).volume(), 1e-6);
}

TEST(ConvexHullNode, WhatIsFlatIsEmptyWithANote) {
  auto flat = std::make_shared<PolygonMesh>();
  flat->points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {2, 3, 0}};
  flat->hull_of_points = true;
  flat->kind = "hull";
  const Evaluated result = evaluated(Node::leaf(flat));
  EXPECT_TRUE(result.solid->empty());
  ASSERT_EQ(result.warnings.size(), 1u);
  EXPECT_EQ(result.warnings[0], "'hull' encloses no volume on the grid and is left out");
  EXPECT_TRUE(evaluated(Node::convex_hull({})).solid->empty());
  EXPECT_TRUE(evaluated(Node::convex_hull({Node::empty(), Node::empty()})).solid->empty());
}

TEST(MinkowskiNode, OfBoxes) {
  expect_same(Node::minkowski_sum({kBox, box({-1, -1, -1}, {1, 1, 1})}),
              box({-1, -1, -1}, {2, 3, 4}), "two");
  expect_same(Node::minkowski_sum({kBox, kBox, kBox}), box({0, 0, 0}, {3, 6, 9}), "three");
  expect_same(Node::minkowski_sum({turned(kBox), turned(kBox)}), turned(box({0, 0, 0}, {2, 4, 6})),
              "turned");
  expect_same(Node::minkowski_sum({Node::empty(), kBox, Node::empty()}), kBox, "and nothing");
  EXPECT_TRUE(evaluated(Node::minkowski_sum({Node::empty()})).solid->empty());
  const NodePtr nothing = intersect({kBox, moved(kBox, 9, 0, 0)});
  expect_same(Node::minkowski_sum({nothing, kBox}), kBox, "and an empty result");
}

/// A plate with a slot, an L and a frame: their sums are boxes less boxes.
TEST(MinkowskiNode, OfWhatIsNotConvex) {
  const NodePtr cube = box({0, 0, 0}, {1, 1, 1});
  const NodePtr frame = subtract({box({0, 0, 0}, {10, 10, 2}), box({3, 3, -1}, {7, 7, 3})});
  expect_same(Node::minkowski_sum({frame, cube}),
              subtract({box({0, 0, 0}, {11, 11, 3}), box({4, 4, -1}, {7, 7, 4})}), "frame, cube");
  expect_same(Node::minkowski_sum({cube, frame}),
              subtract({box({0, 0, 0}, {11, 11, 3}), box({4, 4, -1}, {7, 7, 4})}), "cube, frame");
  expect_same(Node::minkowski_sum({frame, frame}), box({0, 0, 0}, {20, 20, 4}), "two frames");
  const NodePtr corner = subtract({box({0, 0, 0}, {10, 10, 2}), box({-1, -1, -1}, {5, 5, 3})});
  EXPECT_EQ(evaluated(Node::minkowski_sum({corner, corner})).volume(), (400 - 75) * 4);
  EXPECT_EQ(evaluated(Node::minkowski_sum({corner, corner, corner})).volume(), (900 - 150) * 6);
  // A void that the cube does not fill, and one that it does.
  const NodePtr hollow = subtract({box({0, 0, 0}, {9, 9, 9}), box({2, 2, 2}, {7, 7, 7})});
  expect_same(Node::minkowski_sum({hollow, cube}),
              subtract({box({0, 0, 0}, {10, 10, 10}), box({3, 3, 3}, {7, 7, 7})}), "hollow");
  expect_same(Node::minkowski_sum({hollow, box({0, 0, 0}, {5, 5, 5})}),
              box({0, 0, 0}, {14, 14, 14}), "filled");
  // In pieces, one of which is a union, and three operands in another order.
  const NodePtr apart = unite({kBox, moved(kBox, 20, 0, 0)});
  expect_same(Node::minkowski_sum({apart, cube, frame}), Node::minkowski_sum({frame, apart, cube}),
              "commutes");
}

/// Unions of unit cubes against cells: a cell is in the sum if it is in the sum of two of them.
NodePtr hull_of(std::vector<glm::dvec3> points) {
  auto mesh = std::make_shared<PolygonMesh>();
  mesh->points = std::move(points);
  mesh->hull_of_points = true;
  mesh->kind = "hull";
  return Node::leaf(mesh);
}

TEST(MinkowskiNode, WithWhatIsFlat) {
  const NodePtr square = hull_of({{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {2, 2, 0}});
  const NodePtr edge = hull_of({{0, 0, 0}, {0, 0, 4}}), point = hull_of({{5, 6, 7}, {5, 6, 7}});
  expect_same(Node::minkowski_sum({kBox, square}), box({0, 0, 0}, {3, 4, 3}), "a square");
  expect_same(Node::minkowski_sum({edge, kBox}), box({0, 0, 0}, {1, 2, 7}), "a segment");
  expect_same(Node::minkowski_sum({kBox, point}), moved(kBox, 5, 6, 7), "a point");
  expect_same(Node::minkowski_sum({square, edge}), box({0, 0, 0}, {2, 2, 4}), "two of them");
  expect_same(Node::minkowski_sum({square, square, point, edge}),
              moved(box({0, 0, 0}, {4, 4, 4}), 5, 6, 7), "four");
  expect_same(Node::minkowski_sum({Node::minkowski_sum({square, square}), edge}),
              box({0, 0, 0}, {4, 4, 4}), "nested");
  expect_same(Node::minkowski_sum({turned(kBox), turned(square)}),
              turned(box({0, 0, 0}, {3, 4, 3})), "turned");
  // Beside a solid in one operand, and with one that is not convex.
  expect_same(Node::minkowski_sum({kBox, unite({square, box({0, 0, 0}, {1, 1, 5})})}),
              unite({box({0, 0, 0}, {3, 4, 3}), box({0, 0, 0}, {2, 3, 8})}), "and a solid");
  const NodePtr frame = subtract({box({0, 0, 0}, {9, 9, 2}), box({3, 3, -1}, {6, 6, 3})});
  expect_same(Node::minkowski_sum({frame, square}),
              subtract({box({0, 0, 0}, {11, 11, 2}), box({5, 5, -1}, {6, 6, 3})}), "a frame");
  expect_same(Node::minkowski_sum({frame, edge}),
              subtract({box({0, 0, 0}, {9, 9, 6}), box({3, 3, -1}, {6, 6, 7})}), "a deep frame");
  for (const NodePtr& flat : {square, edge, point}) {
    const Evaluated sum = evaluated(Node::minkowski_sum({kBox, flat}));
    EXPECT_TRUE(sum.warnings.empty());
  }
  // Flat by itself, or left out elsewhere: that is said.
  EXPECT_EQ(evaluated(Node::minkowski_sum({square, square})).warnings.size(), 1u);
  EXPECT_EQ(evaluated(unite({Node::minkowski_sum({kBox, square}), square})).warnings.size(), 1u);
}

TEST(MinkowskiNode, WithSheetsOfManyFaces) {
  // A mesh that is thinner than the grid is its faces, on both sides the same: an L, and a bar that
  // became a segment.
  PolygonMesh mesh;
  mesh.kind = "sheet";
  mesh.points = {{0, 0, 0},    {4, 0, 0},    {4, 1, 0},    {1, 1, 0},
                 {1, 4, 0},    {0, 4, 0},    {0, 0, 1e-9}, {4, 0, 1e-9},
                 {4, 1, 1e-9}, {1, 1, 1e-9}, {1, 4, 1e-9}, {0, 4, 1e-9}};
  mesh.add_face(std::vector<uint32_t>{5, 4, 3, 2, 1, 0});
  mesh.add_face(std::vector<uint32_t>{6, 7, 8, 9, 10, 11});
  for (uint32_t i = 0; i < 6; ++i) {
    const uint32_t j = (i + 1) % 6;
    mesh.add_face(std::vector<uint32_t>{i, j, j + 6, i + 6});
  }
  const NodePtr sheet = Node::leaf(std::make_shared<PolygonMesh>(mesh));
  const NodePtr sum = unite({box({0, 0, 0}, {5, 3, 3}), box({0, 0, 0}, {2, 6, 3})});
  expect_same(Node::minkowski_sum({kBox, sheet}), sum, "an L");
  EXPECT_TRUE(evaluated(Node::minkowski_sum({kBox, sheet})).warnings.empty());
  for (glm::dvec3& p : mesh.points) p.y *= 1e-9;
  expect_same(Node::minkowski_sum({Node::leaf(std::make_shared<PolygonMesh>(mesh)), kBox}),
              box({0, 0, 0}, {5, 2, 3}), "a segment");
}

TEST(MinkowskiNode, OfRandomCells) {
  std::mt19937 random(3);
  for (int round = 0; round < 12; ++round) {
    std::array<std::vector<Cell>, 2> cells;
    std::array<NodePtr, 2> solids;
    for (int k = 0; k < 2; ++k) {
      std::vector<NodePtr> cubes;
      for (int i = 0; i < 27; ++i) {
        if (random() % 3 != 0) continue;
        const Cell c{i % 3, i / 3 % 3, i / 9};
        cells[k].push_back(c);
        cubes.push_back(box({c[0], c[1], c[2]}, {c[0] + 1, c[1] + 1, c[2] + 1}));
      }
      // Under a difference they are one operand that is not convex.
      solids[k] =
          cubes.empty() ? Node::empty() : subtract({unite(cubes), box({50, 50, 50}, {51, 51, 51})});
    }
    if (cells[0].empty() || cells[1].empty()) continue;
    std::set<Cell> filled;
    for (const Cell& a : cells[0]) {
      for (const Cell& b : cells[1]) {
        for (int i = 0; i < 8; ++i) {
          filled.insert(
              {a[0] + b[0] + (i & 1), a[1] + b[1] + (i >> 1 & 1), a[2] + b[2] + (i >> 2)});
        }
      }
    }
    const Evaluated sum = evaluated(Node::minkowski_sum({solids[0], solids[1]}));
    EXPECT_EQ(sum.volume(), static_cast<double>(filled.size())) << "round " << round;
  }
}

/// The hull of the points in `shape`, moved.
NodePtr hull_at(const std::vector<glm::dvec3>& shape, const glm::dvec3& at) {
  auto mesh = std::make_shared<PolygonMesh>();
  for (const glm::dvec3& p : shape) mesh->points.push_back(at + p);
  mesh->hull_of_points = true;
  mesh->kind = "hull";
  return Node::leaf(mesh);
}

/// A sum with a union is the union of the sums, which are sums of convex solids. Planes of boxes
/// and octahedra meet in multiples of a quarter, so nothing is rounded.
TEST(MinkowskiNode, OfRandomUnionsWithAConvexSolid) {
  const std::vector<glm::dvec3> octahedron{{4, 0, 0},  {-4, 0, 0}, {0, 4, 0},
                                           {0, -4, 0}, {0, 0, 4},  {0, 0, -4}};
  std::vector<glm::dvec3> cube;
  for (int i = 0; i < 8; ++i) cube.emplace_back(i & 1 ? 3 : -1, i & 2 ? 2 : -2, i & 4 ? 3 : -2);
  std::mt19937 random(11);
  const auto coordinate = [&](int most) { return static_cast<double>(random() % most); };
  for (int round = 0; round < 24; ++round) {
    std::vector<glm::dvec3> convex;
    switch (round % 4) {
      case 0:
        convex = octahedron;
        break;
      case 1:
        for (const glm::dvec3& p : cube) convex.push_back(p * 0.5);
        break;
      case 2:  // in no symmetry
        for (int i = 0; i < 12; ++i) {
          convex.emplace_back(coordinate(5), coordinate(5), coordinate(5));
        }
        break;
      default:  // without a grid point inside
        convex = {{0, 0, 0}, {1e-6, 0, 0}, {0, 1e-6, 0}, {0, 0, 1e-6}};
        break;
    }
    std::vector<NodePtr> members, sums;
    const int count = 2 + round % 5;
    const NodePtr other = hull_at(convex, {0, 0, 0});
    for (int i = 0; i < count; ++i) {
      const glm::dvec3 at(coordinate(9), coordinate(9), coordinate(9));
      members.push_back(hull_at(random() % 2 == 0 ? cube : octahedron, at));
      sums.push_back(Node::minkowski_sum({members.back(), other}));
    }
    // Under a difference they are one operand that is not convex.
    const NodePtr whole = subtract({unite(members), box({50, 50, 50}, {51, 51, 51})});
    const Evaluated sum = evaluated(Node::minkowski_sum({whole, other}), "0.000001");
    const Evaluated truth = evaluated(unite(sums), "0.000001");
    EXPECT_TRUE(sum.warnings.empty()) << "round " << round;
    EXPECT_EQ(sum.volume(), truth.volume()) << "round " << round;
    EXPECT_EQ(sum.solid->measures.bbox, truth.solid->measures.bbox) << "round " << round;
  }
}

/// The sum of two unions is the union of the sums of their members.
TEST(MinkowskiNode, OfRandomUnionsWithEachOther) {
  const std::vector<glm::dvec3> octahedron{{4, 0, 0},  {-4, 0, 0}, {0, 4, 0},
                                           {0, -4, 0}, {0, 0, 4},  {0, 0, -4}};
  std::vector<glm::dvec3> cube;
  for (int i = 0; i < 8; ++i) cube.emplace_back(i & 1 ? 3 : -1, i & 2 ? 2 : -2, i & 4 ? 3 : -2);
  std::mt19937 random(13);
  const auto coordinate = [&] { return static_cast<double>(random() % 11); };
  const NodePtr far = box({90, 90, 90}, {91, 91, 91});
  for (int round = 0; round < 30; ++round) {
    std::array<std::vector<NodePtr>, 2> members;
    for (auto& list : members) {
      for (size_t i = 0; i < 2 + random() % 4; ++i) {
        list.push_back(hull_at(random() % 2 == 0 ? cube : octahedron,
                               {coordinate(), coordinate(), coordinate()}));
      }
    }
    std::vector<NodePtr> sums;
    for (const NodePtr& a : members[0]) {
      for (const NodePtr& b : members[1]) sums.push_back(Node::minkowski_sum({a, b}));
    }
    // Under a difference each is one operand that is not convex.
    const NodePtr sum = Node::minkowski_sum(
        {subtract({unite(members[0]), far}), subtract({unite(members[1]), far})});
    const Evaluated made = evaluated(sum, "0.000001"), truth = evaluated(unite(sums), "0.000001");
    EXPECT_TRUE(made.warnings.empty()) << "round " << round;
    EXPECT_EQ(made.solid->canonical_hash, truth.solid->canonical_hash) << "round " << round;
  }
}

/// Two balls of 20,000 corners: 10^10 pairs.
TEST(MinkowskiNode, OfTooManyFacesIsAnError) {
  std::mt19937 random(17);
  std::normal_distribution<double> normal;
  std::vector<glm::dvec3> ball;
  for (int i = 0; i < 20000; ++i) {
    const glm::dvec3 p(normal(random), normal(random), normal(random));
    ball.push_back(p * (1000 / std::sqrt(p.x * p.x + p.y * p.y + p.z * p.z)));
  }
  const NodePtr node = hull_at(ball, {0, 0, 0});
  const SourceRef where{std::make_shared<const std::string>("ball.lua"), 7};
  Evaluator evaluator{EvaluateOptions()};
  const auto result = evaluator.evaluate(Node::minkowski_sum({node, node}, where));
  ASSERT_FALSE(result.has_value());
  EXPECT_EQ(result.error().code, ErrorCode::kLimit);
  EXPECT_NE(result.error().message.find("too many faces: more than 2^30 pairs"), std::string::npos)
      << result.error().message;
  EXPECT_EQ(result.error().where.line, 7);
  // With one that has a few facets it is no trouble.
  EXPECT_GT(evaluated(Node::minkowski_sum({node, box({0, 0, 0}, {1, 1, 1})})).volume(), 0);
}

/// Corners that were rounded: no gap opens, and the volume is right to the width of a step.
TEST(MinkowskiNode, OfWhatIsOffTheGrid) {
  std::vector<glm::dvec3> ball;
  for (int i = 0; i < 8; ++i) ball.emplace_back(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1);
  for (int i = 0; i < 3; ++i) {
    ball.emplace_back(0, 0, 0)[i] = 1.5;
    ball.emplace_back(0, 0, 0)[i] = -1.5;
  }
  const NodePtr other = hull_at(ball, {0, 0, 0});
  const std::vector<NodePtr> members{box({0, 0, 0}, {9, 3, 2}),
                                     turned(box({1, -1, -1}, {3, 9, 2}))};
  const NodePtr whole = subtract({unite(members), box({50, 50, 50}, {51, 51, 51})});
  const Evaluated sum = evaluated(Node::minkowski_sum({whole, other}));
  ASSERT_EQ(sum.warnings.size(), 1u);
  EXPECT_NE(sum.warnings[0].find("off the grid"), std::string::npos);
  const Evaluated truth = evaluated(
      unite({Node::minkowski_sum({members[0], other}), Node::minkowski_sum({members[1], other})}));
  EXPECT_NEAR(sum.volume(), truth.volume(), 1e-4);
  EXPECT_EQ(sum.solid->measures.components, 1);
  EXPECT_EQ(sum.solid->measures.genus, truth.solid->measures.genus);
}

/// A corner so near to a grid point that its double is that of the point: exact fractions tell.
TEST(MinkowskiNode, CornersThatAreNearlyOnTheGridAreOffIt) {
  const auto prism = [](const std::vector<std::array<double, 2>>& base, double low, double high) {
    std::vector<glm::dvec3> points;
    for (const auto& [x, y] : base) {
      points.emplace_back(x, y, low);
      points.emplace_back(x, y, high);
    }
    return hull_at(points, {0, 0, 0});
  };
  // The side of the first from (134000000, 5000000) to (5066422, 133902997) passes the diagonal
  // side of the second 3.9e-9 from (71428363, 67556796).
  const NodePtr cut = subtract(
      {prism({{134000000, 5000000}, {5066422, 133902997}, {5066422, 5000000}}, 0, 100000),
       prism({{65428363, 61556796}, {74428363, 70556796}, {77428363, 67556796}}, -1000, 200000)});
  EvaluateOptions options;
  options.grid = *GridStep::parse("1");
  options.exact_points = true;
  Evaluator evaluator(options);
  const SolidPtr solid = *evaluator.evaluate(cut);
  size_t off = 0, hidden = 0;
  for (size_t v = 0; v < solid->positions.size(); ++v) {
    bool is_whole = true, looks_whole = true;
    for (int i = 0; i < 3; ++i) {
      is_whole &= solid->exact_points[solid->point_of[v]][i].find('/') == std::string::npos;
      looks_whole &= solid->positions[v][i] == std::round(solid->positions[v][i]);
    }
    EXPECT_EQ(solid->on_grid[v] != 0, is_whole) << "vertex " << v;
    off += is_whole ? 0 : 1;
    hidden += looks_whole && !is_whole ? 1 : 0;
  }
  EXPECT_EQ(off, 4u);
  EXPECT_EQ(hidden, 2u);
  const Evaluated sum =
      evaluated(Node::minkowski_sum({cut, box({-1000, -1000, -1000}, {1000, 1000, 1000})}), "1");
  ASSERT_EQ(sum.warnings.size(), 1u);
  EXPECT_NE(sum.warnings[0].find("4 corners"), std::string::npos) << sum.warnings[0];
}

/// Two corners of B that are all but equally far along the normal of A's face, which is slanted a
/// little, with a hole. The truth is the union of the sums of A's convex parts.
TEST(MinkowskiNode, WhatIsNearlyExtremeIsNotTakenForExtreme) {
  constexpr int kSides = 24;
  using Point = std::array<int, 2>;
  const std::array<Point, 4> outer{{{400, 400}, {-400, 400}, {-400, -400}, {400, -400}}};
  std::vector<Point> hole;
  for (int k = 0; k < kSides; ++k) {
    const double angle = 2 * M_PI * (k + 0.5) / kSides;
    hole.push_back({static_cast<int>(std::lround(200 * std::cos(angle))),
                    static_cast<int>(std::lround(200 * std::sin(angle)))});
  }
  // In the plane of (1000, 0, 1) and (0, 1001, 1).
  const auto prism = [](const std::vector<Point>& base, double below, double above) {
    std::vector<glm::dvec3> points;
    for (const auto& [i, j] : base) {
      points.emplace_back(1000. * i, 1001. * j, i + j + above);
      points.emplace_back(1000. * i, 1001. * j, i + j - below);
    }
    return hull_at(points, {0, 0, 0});
  };
  const auto nearest = [&](const Point& p) {
    size_t best = 0;
    for (size_t o = 1; o < 4; ++o) {
      const auto along = [&](size_t at) { return outer[at][0] * p[0] + outer[at][1] * p[1]; };
      if (along(o) > along(best)) best = o;
    }
    return best;
  };
  const NodePtr plate =
      subtract({prism({outer.begin(), outer.end()}, 3000, 0), prism(hole, 50000, 50000)});
  for (const double sign : {1., -1.}) {
    const double h = 4000000, r = 2000000;
    const NodePtr convex = hull_at({{0, 0, h},
                                    {sign * 999999, sign, h + sign * 1000},
                                    {-r, -r, -h},
                                    {r, -r, -h},
                                    {r, r, -h},
                                    {-r, r, -h}},
                                   {0, 0, 0});
    std::vector<NodePtr> sums;
    for (int k = 0; k < kSides; ++k) {
      const Point &a = hole[k], &b = hole[(k + 1) % kSides];
      const size_t s = nearest(a), t = nearest(b);
      sums.push_back(Node::minkowski_sum({prism({a, b, outer[s]}, 3000, 0), convex}));
      if (s == t) continue;
      sums.push_back(Node::minkowski_sum({prism({b, outer[s], outer[t]}, 3000, 0), convex}));
    }
    const NodePtr sum = Node::minkowski_sum({plate, convex}), truth = unite(sums);
    EXPECT_EQ(evaluated(sum, "1").solid->canonical_hash,
              evaluated(truth, "1").solid->canonical_hash);
    EXPECT_TRUE(evaluated(subtract({truth, sum}), "1").solid->empty()) << sign;
    EXPECT_TRUE(evaluated(subtract({sum, truth}), "1").solid->empty()) << sign;
  }
}

TEST(ResizeNode, ScalesTheBox) {
  const auto volume = [](std::array<double, 3> size, std::array<bool, 3> automatic) {
    return evaluated(Node::resized({size, automatic}, moved(kBox, 1, 0, 0))).volume();
  };
  EXPECT_EQ(volume({0, 0, 0}, {true, true, true}), 6);
  EXPECT_EQ(volume({4, 0, 0}, {false, false, false}), 24);
  EXPECT_EQ(volume({2, 0, 0}, {false, true, true}), 48);
  EXPECT_EQ(volume({2, 8, 0}, {false, false, true}), 2 * 8 * 12);
  EXPECT_EQ(volume({-2, 8, 0}, {false, false, false}), 24);
  const Evaluated result = evaluated(Node::resized({{2, 2, 2}, {}}, moved(kBox, 1, 0, 0)));
  EXPECT_EQ(result.solid->measures.bbox[0], glm::dvec3(2, 0, 0));  // about the origin
  EXPECT_TRUE(evaluated(Node::resized({{1, 1, 1}, {}}, Node::empty())).solid->empty());
  // So long that its width is nothing on a grid that holds its length.
  EXPECT_EQ(evaluated(Node::resized({{0, 0, 0.5}, {}}, box({0, 0, 0}, {6, 6, 1e10}))).volume(), 18);
  const NodePtr notched = subtract({kBox, box({0, 0, 2}, {9, 9, 9})});
  EXPECT_EQ(evaluated(Node::resized({{0, 0, 5}, {}}, notched)).volume(), 10);
}

TEST(ConstructionNode, KeepsColours) {
  Appearance red;
  red.red = 1, red.green = red.blue = 0, red.is_default = false;
  const NodePtr painted = Node::painted(red, kBox);
  for (const NodePtr& node :
       {Node::convex_hull({painted, moved(kBox, 9, 0, 0)}), Node::minkowski_sum({painted, kBox}),
        Node::minkowski_sum({subtract({painted, box({0, 0, 0}, {0.5, 0.5, 0.5})}), kBox})}) {
    const Evaluated result = evaluated(node);
    ASSERT_EQ(result.solid->appearances.size(), 1u);
    EXPECT_EQ(result.solid->appearances[0], red);
  }
}

TEST(ConstructionNode, DeepChainsUseConstantStack) {
  NodePtr chain = kBox;
  for (int i = 0; i < 20000; ++i) chain = Node::convex_hull({chain});
  EXPECT_EQ(evaluated(chain).volume(), 6);
  // Shared operands are walked once.
  NodePtr doubled = kBox;
  for (int i = 0; i < 60; ++i) doubled = unite({doubled, doubled});
  EXPECT_EQ(evaluated(Node::convex_hull({doubled})).volume(), 6);
}

}  // namespace
}  // namespace csgrun::constructions_test
