// Booleans of turned shapes: against closed formulas of the shapes before the turn, against the
// same Boolean done before it, and against points.
#include <cmath>
#include <random>
#include <string>

#include <gtest/gtest.h>

#include <csgrun/primitives/shape_operations.h>

#include "primitives/shape2d/shape_factory.h"
#include "tests/unit/primitives/outlines.h"

namespace csgrun::turned_shapes_test {
namespace {

using Loop = Shape2D::Loop;
using testing::box;
using testing::good;
using testing::outlines;

constexpr double kPi = 3.14159265358979323846;
constexpr BooleanOp kUnion = BooleanOp::kUnion, kIntersection = BooleanOp::kIntersection;
constexpr BooleanOp kDifference = BooleanOp::kDifference;
constexpr BooleanOp kXor = BooleanOp::kSymmetricDifference;

Affine linear(double a, double b, double c, double d) {
  Affine map;
  map.m[0] = {a, b, 0, 0};
  map.m[1] = {c, d, 0, 0};
  return map;
}
Affine turn(double degrees) {
  const double c = std::cos(degrees * kPi / 180), s = std::sin(degrees * kPi / 180);
  return linear(c, -s, s, c);
}
Affine scale(double x, double y) { return linear(x, 0, 0, y); }
Affine move(double x, double y) {
  Affine map;
  map.m[0][3] = x;
  map.m[1][3] = y;
  return map;
}

/// The maps one after another, as a script writes them.
template <class... Maps>
Shape2D mapped(Shape2D shape, const Maps&... maps) {
  ((shape = good(shape.transformed(maps))), ...);
  return shape;
}

Shape2D boolean(BooleanOp op, const std::vector<Shape2D>& operands) {
  return good(Shape2D::boolean(op, operands));
}

/// Every whole degree but quarter turns, and some that are none.
std::vector<double> angles() {
  std::vector<double> all{1e-3,       10 * std::sqrt(2), 10 * std::exp(1),
                          1000 / kPi, -1e-9 * kPi,       123.4};
  for (int i = 1; i < 90; ++i) all.push_back(i);
  for (int i = 95; i < 360; i += 10) all.push_back(i);
  return all;
}

/// That a shape is the box from (x0, y0) to (x1, y1), turned about the origin and moved.
void expect_turned_box(const Shape2D& shape, std::array<double, 4> box, double degrees,
                       const glm::dvec2& by, const std::string& what) {
  const auto [x0, y0, x1, y1] = box;
  ASSERT_EQ(shape.loops().size(), 1u) << what << " at " << degrees;
  EXPECT_EQ(shape.loops()[0].size(), 4u) << what << " at " << degrees;
  EXPECT_NEAR(shape.area(), (x1 - x0) * (y1 - y0), 1e-9) << what << " at " << degrees;
  const double c = std::cos(degrees * kPi / 180), s = std::sin(degrees * kPi / 180);
  const glm::dvec2 half{(std::fabs(c) * (x1 - x0) + std::fabs(s) * (y1 - y0)) / 2,
                        (std::fabs(s) * (x1 - x0) + std::fabs(c) * (y1 - y0)) / 2};
  const glm::dvec2 middle{(c * (x0 + x1) - s * (y0 + y1)) / 2 + by.x,
                          (s * (x0 + x1) + c * (y0 + y1)) / 2 + by.y};
  const auto [low, high] = shape.bounds();
  for (int i = 0; i < 2; ++i) {
    EXPECT_NEAR(low[i], middle[i] - half[i], 1e-10) << what << " at " << degrees;
    EXPECT_NEAR(high[i], middle[i] + half[i], 1e-10) << what << " at " << degrees;
  }
}

TEST(TurnedShapes, FlushBoxesByFormula) {
  const Shape2D plate = box(-20, -10, 20, 10), end = good(make_square({10, 20}, {true, true}));
  for (const double angle : angles()) {
    for (const glm::dvec2 by : {glm::dvec2(0), glm::dvec2(7.3, -1.0 / 3)}) {
      const auto at = [&](const Shape2D& shape, double x) {
        return mapped(shape, move(x, 0), turn(angle), move(by.x, by.y));
      };
      // The second is turned and moved in its own way to the same place.
      const Shape2D a = at(plate, 0), b = at(end, 15), beside = at(end, 25), half = at(end, 22.5);
      const auto expect = [&](const Shape2D& shape, double x0, double x1, const char* what) {
        expect_turned_box(shape, {x0, -10, x1, 10}, angle, by, what);
      };
      expect(boolean(kDifference, {a, b}), -20, 10, "difference");
      expect(boolean(kUnion, {a, b}), -20, 20, "union with a part");
      expect(boolean(kUnion, {a, beside}), -20, 30, "union with a neighbour");
      expect(boolean(kIntersection, {b, a}), 10, 20, "intersection with a part");
      expect(boolean(kXor, {a, b}), -20, 10, "symmetric difference");
      expect(boolean(kDifference, {half, a}), 20, 27.5, "difference of two that overlap");
      EXPECT_TRUE(boolean(kIntersection, {a, beside}).empty()) << angle;
      EXPECT_TRUE(boolean(kDifference, {b, a}).empty()) << angle;
    }
  }
}

TEST(TurnedShapes, ManyWaysLeadToOneFrame) {
  const Shape2D tile = good(make_square({4, 3})), upright = good(make_square({3, 4}));
  const Shape2D flat = good(make_square({8, 1.5}));
  for (const double angle : angles()) {
    const Shape2D whole = mapped(good(make_square({16, 3})), turn(angle));
    // 4 x 3 at 0, 4, 8 and 12, each made in a way of its own.
    std::vector<Shape2D> turns{tile};
    for (int i = 0; i < 9; ++i) turns[0] = mapped(turns[0], turn(angle / 9));
    const double c = std::cos(angle * kPi / 180), s = std::sin(angle * kPi / 180);
    turns.push_back(mapped(upright, turn(90 + angle), move(8 * c, 8 * s)));
    turns.push_back(mapped(flat, scale(-0.5, 2), move(12, 0), turn(angle + 720)));
    turns.push_back(mapped(tile, move(12, -3), turn(-angle), scale(1, -1)));
    std::vector<Shape2D> all{whole};
    all.insert(all.end(), turns.begin(), turns.end());
    EXPECT_TRUE(boolean(kDifference, all).empty()) << angle;
    EXPECT_TRUE(boolean(kXor, all).empty()) << angle;
    expect_turned_box(boolean(kUnion, turns), {0, 0, 16, 3}, angle, {0, 0}, "union");
    EXPECT_TRUE(boolean(kDifference, {whole, boolean(kUnion, turns)}).empty()) << angle;
    Shape2D rest = whole;
    for (const Shape2D& one : {turns[1], turns[3], turns[2], turns[0]}) {
      rest = boolean(kDifference, {rest, one});
      // Later moves stay in the frame, when all take part in them.
      if (rest.empty()) break;
      rest =
          mapped(rest, turn(-angle), scale(-1, 1), turn(17), turn(-17), scale(-1, 1), turn(angle));
    }
    EXPECT_TRUE(rest.empty()) << angle;
  }
}

TEST(TurnedShapes, ChainsOfManyCutsStayFlush) {
  Shape2D rest = mapped(good(make_square({400, 3})), turn(33), move(1.23, 4.56));
  for (int i = 0; i < 399; ++i) {
    const Shape2D cut = mapped(good(make_square({1, 3})), move(i, 0), turn(33), move(1.23, 4.56));
    rest = boolean(kDifference, {rest, cut});
  }
  expect_turned_box(rest, {399, 0, 400, 3}, 33, {1.23, 4.56}, "the last");
}

/// An outline of decimals that crosses itself.
Shape2D tangle(std::mt19937& random) {
  Loop loop;
  for (int i = 0; i < 9; ++i) {
    loop.push_back({static_cast<int>(random() % 2001 - 1000) / 100.0,
                    static_cast<int>(random() % 2001 - 1000) / 100.0});
  }
  return outlines({loop});
}

void expect_same(const Shape2D& a, const Shape2D& b, double tolerance, const std::string& what) {
  ASSERT_EQ(a.loops().size(), b.loops().size()) << what;
  ASSERT_EQ(a.regions().size(), b.regions().size()) << what;
  for (size_t i = 0; i < a.regions().size(); ++i) {
    EXPECT_EQ(a.regions()[i].outer, b.regions()[i].outer) << what;
    EXPECT_EQ(a.regions()[i].holes, b.regions()[i].holes) << what;
  }
  for (size_t i = 0; i < a.loops().size(); ++i) {
    ASSERT_EQ(a.loops()[i].size(), b.loops()[i].size()) << what;
    for (size_t k = 0; k < a.loops()[i].size(); ++k) {
      const glm::dvec2 apart = a.loops()[i][k] - b.loops()[i][k];
      EXPECT_LE(std::hypot(apart.x, apart.y), tolerance) << what;
    }
  }
}

TEST(TurnedShapes, MapsAndBooleansChangePlaces) {
  std::mt19937 random(83);
  std::uniform_real_distribution<double> angle(-360, 360), place(-50, 50), factor(0.3, 3);
  for (int round = 0; round < 60; ++round) {
    const std::vector<Shape2D> shapes{tangle(random), tangle(random), tangle(random)};
    const double a = angle(random), f = factor(random), g = factor(random);
    const Affine at = move(place(random), place(random)), mirror = scale(1, -1);
    for (const BooleanOp op : {kUnion, kIntersection, kDifference, kXor}) {
      const auto check = [&](double tolerance, const char* what, const auto&... maps) {
        std::vector<Shape2D> after;
        for (const Shape2D& shape : shapes) after.push_back(mapped(shape, maps...));
        expect_same(boolean(op, after), mapped(boolean(op, shapes), maps...), tolerance,
                    what + std::string(" in round ") + std::to_string(round));
      };
      check(1e-13, "rigid", turn(a), at);
      check(1e-13, "moved twice", turn(a), at, turn(a / 3), at);
      check(1e-13, "mirrored", turn(a), mirror, at);
      check(1e-13, "mirrored first", mirror, turn(a), at);
      // Stretched, crossings go to other points of the grid.
      check(1e-6, "stretched first", scale(f, g), turn(a), at);
      check(1e-6, "stretched", turn(a), scale(f, g), at);
      check(1e-6, "grown and mirrored", turn(a), scale(-f, f), at, turn(-a / 2));
    }
  }
}

TEST(TurnedShapes, WithoutATurnTheWorldsGridDecides) {
  std::mt19937 random(7);
  for (int round = 0; round < 40; ++round) {
    const Shape2D a = tangle(random), b = tangle(random);
    const double c = std::cos(kPi / 2);  // 6e-17, as from a map that was computed
    for (const Affine& map : {scale(-1.1, 0.7), linear(0, -1, 1, 0), linear(c, 1, 1, -c),
                              linear(-1, c, -c, -1), move(1.0 / 3, 0.1)}) {
      const Shape2D x = mapped(a, map, move(0.1, 1.0 / 3)), y = mapped(b, map);
      EXPECT_EQ(Shape2DFactory::turn_of(x), nullptr);
      // The same loops from a drawing, which remembers nothing.
      const std::vector<Shape2D> drawn{outlines(x.loops()), outlines(y.loops())};
      for (const BooleanOp op : {kUnion, kIntersection, kDifference, kXor}) {
        EXPECT_EQ(boolean(op, {x, y}).loops(), boolean(op, drawn).loops());
      }
    }
  }
}

TEST(TurnedShapes, ATurnBackIsNone) {
  const Shape2D disc = good(make_circle(10, Facets{31, 12, 2}));
  for (const double angle : angles()) {
    const Shape2D back = mapped(disc, turn(angle), turn(-angle));
    EXPECT_EQ(back.loops(), disc.loops()) << angle;
    EXPECT_TRUE(boolean(kXor, {back, disc}).empty());
    const Shape2D quarter = mapped(disc, turn(angle), turn(90 - angle));
    EXPECT_EQ(Shape2DFactory::turn_of(quarter), nullptr);
    EXPECT_TRUE(boolean(kXor, {quarter, mapped(disc, linear(0, -1, 1, 0))}).empty());
  }
}

/// Less than 1e-6 from an outline: rounding may decide.
bool is_near_outline(const Shape2D& shape, const glm::dvec2& p) {
  for (const Loop& loop : shape.loops()) {
    for (size_t i = 0; i < loop.size(); ++i) {
      const glm::dvec2 a = loop[i], d = loop[(i + 1) % loop.size()] - a;
      if (std::fabs(d.x * (p.y - a.y) - d.y * (p.x - a.x)) < 1e-6 * std::hypot(d.x, d.y)) {
        return true;
      }
    }
  }
  return false;
}

TEST(TurnedShapes, SeveralFramesByPoints) {
  std::mt19937 random(22);
  std::uniform_real_distribution<double> place(-3, 3), probe(-15, 15);
  int inside_count = 0;
  for (int round = 0; round < 40; ++round) {
    std::vector<Shape2D> shapes;
    for (int i = 0; i < 6; ++i) {
      shapes.push_back(mapped(tangle(random),
                              turn(std::array<int, 4>{0, 10, 55, 100}[random() % 4]),
                              move(place(random), place(random))));
    }
    for (const BooleanOp op : {kUnion, kIntersection, kDifference, kXor}) {
      std::vector<Shape2D> operands = shapes;
      if (op == kIntersection) operands.resize(3);
      const Shape2D result = boolean(op, operands);
      for (int k = 0; k < 200; ++k) {
        const glm::dvec2 p(probe(random), probe(random));
        size_t count = 0;
        bool skip = false;
        for (const Shape2D& shape : operands) {
          skip = skip || is_near_outline(shape, p);
          count += shape.contains(p) ? 1 : 0;
        }
        if (skip) continue;
        const bool first = operands[0].contains(p);
        const bool expected = op == kUnion          ? count > 0
                              : op == kIntersection ? count == operands.size()
                              : op == kDifference   ? first && count == 1
                                                    : count % 2 == 1;
        EXPECT_EQ(result.contains(p), expected) << static_cast<int>(op) << " in round " << round;
        inside_count += expected ? 1 : 0;
      }
    }
  }
  EXPECT_GT(inside_count, 2000);
}

TEST(TurnedShapes, EachFrameOfSeveralIsFlush) {
  const auto tiles = [](double angle, double x) {
    std::vector<Shape2D> all;
    for (int i = 0; i < 3; ++i) {
      all.push_back(mapped(good(make_square({4, 3})), move(4 * i, 0), turn(angle), move(x, 1)));
    }
    return all;
  };
  for (const double angle : {1.0, 10.0, 36.87, 45.0, 61.0}) {
    std::vector<Shape2D> mixed{box(-20, 0, -10, 1)};
    const auto left = tiles(angle, 0.1), right = tiles(angle + 7, 100);
    for (int i = 0; i < 3; ++i) {
      mixed.push_back(left[i]);
      mixed.push_back(right[i]);
    }
    for (const BooleanOp op : {kUnion, kXor}) {
      const Shape2D all = boolean(op, mixed);
      ASSERT_EQ(all.loops().size(), 3u) << angle;
      for (const Loop& loop : all.loops()) EXPECT_EQ(loop.size(), 4u) << angle;
      EXPECT_NEAR(all.area(), 10 + 36 + 36, 1e-5) << angle;
    }
    // The first less its neighbours, and less tiles of another frame that make a hole of one loop.
    const Shape2D plate = mapped(good(make_square({120, 40}, {true, true})), turn(angle));
    const auto strip = [&](double y) {
      return mapped(good(make_square({120, 5})), move(-60, y), turn(angle));
    };
    const auto hole = tiles(angle + 7, 10);
    const Shape2D rest =
        boolean(kDifference, {plate, hole[1], strip(15), hole[0], strip(-20), hole[2]});
    ASSERT_EQ(rest.loops().size(), 2u) << angle;
    EXPECT_EQ(rest.loops()[0].size() + rest.loops()[1].size(), 8u) << angle;
    EXPECT_NEAR(rest.area(), 120 * 30 - 36, 1e-5) << angle;
    EXPECT_TRUE(boolean(kDifference, {strip(15), box(0, 0, 1, 1), plate}).empty()) << angle;
  }
}

TEST(TurnedShapes, EdgesThatTheTurnMakesUprightMeetTheWorld) {
  for (const int n : {3, 6, 8, 12}) {
    for (int tenth = 31; tenth < 60; ++tenth) {
      // Flat at the right, where x is `side`.
      const double side = tenth / 10.0, r = side / std::cos(kPi / n);
      const Shape2D even = mapped(good(make_circle(r, Facets{1.0 * n, 12, 2})), turn(180.0 / n));
      const double area = n * r * r * std::sin(2 * kPi / n) / 2;
      const Shape2D pair =
          boolean(kUnion, {mapped(even, move(0, 1.0 / 3)), mapped(even, move(0, 30))});
      const Shape2D wall = box(side, -20, side + 1, 50);
      const Shape2D all = boolean(kUnion, {pair, wall});
      ASSERT_EQ(all.loops().size(), 1u) << n << ", " << side;
      EXPECT_EQ(all.loops()[0].size(), 4u + 2 * n) << n << ", " << side;
      EXPECT_NEAR(all.area(), 2 * area + 70, 1e-6) << n << ", " << side;
      EXPECT_TRUE(boolean(kIntersection, {pair, wall}).empty()) << n << ", " << side;
    }
  }
}

TEST(TurnedShapes, SidesThatTheTurnMakesUprightAreFlush) {
  for (int tenth = 31; tenth < 60; ++tenth) {
    const double side = tenth / 10.0, r = side / std::cos(kPi / 6), length = 3;
    const Shape2D nut = mapped(good(make_circle(r, Facets{6, 12, 2})), turn(30));
    const auto slot = [&](const std::vector<Shape2D>& nuts, double wider) {
      const Shape2D all = boolean(kUnion, nuts);
      ASSERT_EQ(all.loops().size(), 1u) << side;
      EXPECT_EQ(all.loops()[0].size(), 6u) << side;
      const double flat = side + wider;
      EXPECT_NEAR(all.area(), 6 * flat * flat * std::tan(kPi / 6) + 2 * flat * length, 1e-6);
      EXPECT_NEAR(all.bounds()[1].x, flat, 1e-12);
      EXPECT_TRUE(boolean(kIntersection, {all, box(flat, -9, 9, 9)}).empty()) << side;
    };
    const Shape2D up = mapped(nut, move(0, length));
    slot({nut, up}, 0);
    slot({nut, mapped(nut, move(0, 1.7)), up}, 0);
    for (const double distance : {1.5, -0.4}) {
      const OffsetOptions options{distance, OffsetJoin::kMitre, Facets{32, 12, 2}};
      slot({good(offset_shape(nut, options)), good(offset_shape(up, options))}, distance);
    }
    // Among boxes of that turn, the boxes are more.
    const auto bar = [&](double x) { return mapped(box(x, -1, x + 10.5, 1), turn(30)); };
    const Shape2D bars = boolean(kDifference, {boolean(kUnion, {bar(0), bar(10.5), nut}), nut});
    ASSERT_EQ(bars.regions().size(), 1u) << side;
    EXPECT_EQ(boolean(kUnion, {bars, nut}).loops()[0].size(), 9u) << side;
    EXPECT_TRUE(boolean(kDifference, {bars, bar(10.5), bar(0)}).empty()) << side;
  }
}

TEST(TurnedShapes, NestingDoesNotMatterBetweenManyPlaces) {
  std::mt19937 random(15);
  std::uniform_real_distribution<double> place(-3, 3), angle(0, 360);
  for (int round = 0; round < 100; ++round) {
    const Affine turned = turn(angle(random));
    const auto at = [&](const Shape2D& shape, double x) {
      return mapped(shape, turned, move(x + place(random), place(random)));
    };
    const Shape2D disc = good(make_circle(3.5, Facets{17, 12, 2}));
    const Shape2D plate = at(good(make_square({100, 60}, {true, true})), 0);
    const Shape2D a = at(disc, -14), b = at(disc, 0), c = at(disc, 14);
    const Shape2D discs = boolean(kUnion, {boolean(kUnion, {b, c}), a});
    Shape2D rest = plate;
    for (const Shape2D& s : {a, b, c}) rest = boolean(kDifference, {rest, s});
    ASSERT_EQ(rest.loops().size(), 4u);
    for (const Shape2D& filled : {boolean(kUnion, {discs, rest}), boolean(kUnion, {rest, discs}),
                                  boolean(kXor, {b, rest, boolean(kUnion, {c, a})})}) {
      ASSERT_EQ(filled.loops().size(), 1u);
      EXPECT_EQ(filled.loops()[0].size(), 4u);
    }
    EXPECT_TRUE(boolean(kDifference, {plate, discs, rest}).empty());
    EXPECT_TRUE(boolean(kXor, {boolean(kDifference, {plate, discs}), rest}).empty());
  }
}

TEST(TurnedShapes, EmptyAndFlatOnes) {
  const Shape2D a = mapped(box(0, 0, 1, 1), turn(10)), far = mapped(box(5, 5, 6, 6), turn(10));
  EXPECT_EQ(boolean(kUnion, {Shape2D(), a}).loops(), a.loops());
  EXPECT_TRUE(boolean(kDifference, {Shape2D(), a, far}).empty());
  EXPECT_TRUE(boolean(kIntersection, {a, Shape2D(), a}).empty());
  EXPECT_TRUE(boolean(kIntersection, {a, box(0, 0, 1, 1), far}).empty());
  EXPECT_TRUE(mapped(a, scale(1, 0)).empty());
  // Nearly singular: the shape stays, without a frame.
  const Shape2D thin = mapped(a, linear(1, 1, 1, 1 + 1e-7));
  EXPECT_NEAR(thin.area(), 1e-7, 1e-12);
  EXPECT_EQ(Shape2DFactory::turn_of(thin), nullptr);
  const double huge = std::numeric_limits<double>::max();
  EXPECT_FALSE(a.transformed(move(huge, 0))->transformed(scale(2, 2)));
  EXPECT_FALSE(Shape2D::boolean(kUnion, {mapped(a, move(2e12, 0)), mapped(far, move(2e12, 0))}));
}

TEST(TurnedShapes, OperationsGoOnInTheFrame) {
  const Shape2D ring = boolean(kDifference, {box(0, 0, 30, 20), box(5, 5, 25, 15)});
  const Shape2D two = boolean(kUnion, {ring, box(-9, 8, -4, 9), box(40, 0, 50, 1)});
  for (const double angle : angles()) {
    const auto at = [&](const Shape2D& s) { return mapped(s, turn(angle), move(3, 0.7)); };
    expect_same(good(fill_shape(at(two))), at(good(fill_shape(two))), 1e-13, "fill");
    for (const double distance : {1.5, -1.5}) {
      const OffsetOptions options{distance, OffsetJoin::kRound, Facets{32, 12, 2}};
      expect_same(good(offset_shape(at(two), options)), at(good(offset_shape(two, options))), 1e-13,
                  "offset");
    }
    // A moved edge meets the edge of a box where it should: nothing is left between them.
    const Shape2D wide = good(offset_shape(at(ring), {2, OffsetJoin::kMitre, {}}));
    expect_turned_box(boolean(kDifference, {wide, at(box(-2, -2, 30, 22)), at(box(4, 4, 26, 16))}),
                      {30, -2, 32, 22}, angle, {3, 0.7}, "beside the offset");
    const std::vector<Shape2D> pieces = pieces_of_shape(at(two));
    ASSERT_EQ(pieces.size(), 3u);
    for (size_t i = 0; i < 3; ++i) {
      EXPECT_EQ(pieces[i].loops()[pieces[i].regions()[0].outer],
                at(two).loops()[at(two).regions()[i].outer]);
    }
    EXPECT_TRUE(boolean(kDifference, {at(two), pieces[0], pieces[1], pieces[2]}).empty()) << angle;
  }
}

TEST(TurnedShapes, BeforeTurnGivesTheShapeBack) {
  const Shape2D ring = boolean(kDifference, {box(0, 0, 4, 2), box(1, 0.5, 2, 1.5)});
  for (const double angle : angles()) {
    const Shape2D turned = mapped(ring, scale(2, 1), turn(angle), move(1, 2), scale(-3, 3));
    const auto before = Shape2DFactory::before_turn(turned);
    ASSERT_TRUE(before) << angle;
    EXPECT_NEAR(before->shape.area(), 9 * 14, 1e-9);
    EXPECT_NEAR(before->shape.bounds()[1].x, 24, 1e-12);
    const auto& m = before->motion.m;
    EXPECT_NEAR(m[0][0] * m[1][1] - m[0][1] * m[1][0], -1, 1e-14);
    expect_same(mapped(before->shape, before->motion), turned, 1e-12, "there and back");
    EXPECT_FALSE(Shape2DFactory::before_turn(mapped(ring, turn(angle), scale(1, 2))) &&
                 std::fabs(std::sin(angle * kPi / 90)) > 1e-6)
        << "sheared";
  }
}

}  // namespace
}  // namespace csgrun::turned_shapes_test
