// What of a tree there is in a box: the same as that of the whole tree, cut with the box.
#include <map>
#include <utility>

#include <gtest/gtest.h>

#include <csgrun/engine/tree_in_boxes.h>

#include "test_meshes.h"
#include "tests/support/seeded.h"

namespace csgrun::tree_in_boxes_test {
namespace {

using namespace testing;
using test::Random;

NodePtr painted(float red, NodePtr child) {
  Appearance look;
  look.red = red;
  look.is_default = false;
  return Node::painted(look, std::move(child));
}

/// Trees all about the origin, with leaves in a space of so many millimetres.
class Trees {
 public:
  explicit Trees(uint64_t seed) : random_(Random::of_case(seed, 0)) {}

  NodePtr make(int depth, double room) {
    if (depth == 0) return leaf_in(room);
    std::vector<NodePtr> operands;
    const int64_t count = random_.integer(2, 4);
    for (int64_t i = 0; i < count; ++i) operands.push_back(make(depth - 1, room));
    switch (random_.integer(0, 11)) {
      case 0:
        return symmetric(std::move(operands));
      case 1:
        operands.resize(2);
        return intersect(std::move(operands));
      case 2:
      case 3:
      case 4:
        return subtract(std::move(operands));
      case 5:
        // What is around many leaves would be in most boxes.
        if (depth == 1) return Node::convex_hull({operands[0], moved(0.5, 0, 0, operands[0])});
        return unite(std::move(operands));
      case 6:
        return depth == 1 ? hull(operands[0]) : unite(std::move(operands));
      case 7:
        return turned(30, {0, 0, 1}, unite(std::move(operands)));
      case 8:
        return painted(0.5F, moved(0.1, 0.2, 0.3, unite(std::move(operands))));
      case 9:
        // The same in two places.
        return unite({operands[0], moved(room / 3, 0, 0, operands[0]), operands[1]});
      default:
        return unite(std::move(operands));
    }
  }
  double place(double room) { return static_cast<double>(random_.integer(-20, 20)) * room / 40; }

 private:
  glm::dvec3 corner(double room) { return {place(room), place(room), place(room)}; }
  PolygonMesh some_box(double room) {
    const glm::dvec3 lo = corner(room);
    const auto side = [&] { return 0.5 + static_cast<double>(random_.integer(1, 12)) * 0.25; };
    return box_mesh(lo, lo + glm::dvec3(side(), side(), side()));
  }
  NodePtr leaf_in(double room) {
    const int64_t kind = random_.integer(0, 5);
    if (kind == 0)
      return Node::transformed(translation(place(room), place(room), 0), prism(7, 2, 3));
    if (kind > 2) return leaf(some_box(room), FillRule::kNonZero);
    // Many bodies in one mesh, some of which cross one another, and some of which are hollow.
    PolygonMesh mesh = some_box(room);
    for (int i = 0; i < 12; ++i) {
      const PolygonMesh other = some_box(room);
      mesh = in_one(std::move(mesh), other);
      const glm::dvec3 lo = other.points[0], hi = other.points[7];
      if (i % 3 == 0) {
        mesh = in_one(std::move(mesh), inverted(box_mesh(lo + 0.125, hi - 0.125)));
      }
    }
    return leaf(std::move(mesh), kind == 1 ? FillRule::kNonZero : FillRule::kEvenOdd);
  }

  Random random_;
};

void expect_same(const Solid& a, const Solid& b) {
  EXPECT_EQ(a.canonical_hash, b.canonical_hash);
  EXPECT_EQ(a.positions, b.positions);
  EXPECT_EQ(a.triangles, b.triangles);
  EXPECT_EQ(a.triangle_face, b.triangle_face);
  EXPECT_EQ(a.loop_vertices, b.loop_vertices);
  EXPECT_EQ(a.measures.volume, b.measures.volume);
  EXPECT_EQ(a.appearances, b.appearances);
  ASSERT_EQ(a.faces.size(), b.faces.size());
  std::map<uint32_t, uint32_t> surfaces;
  for (size_t f = 0; f < a.faces.size(); ++f) {
    EXPECT_EQ(a.faces[f].appearance, b.faces[f].appearance);
    EXPECT_EQ(a.sources[a.faces[f].source].kind, b.sources[b.faces[f].source].kind);
    const uint32_t surface = a.faces[f].surface;
    EXPECT_EQ(surfaces.try_emplace(surface, b.faces[f].surface).first->second, b.faces[f].surface);
  }
}

TEST(TreeInBoxes, TheSameInTheBoxAsTheWhole) {
  EvaluateOptions options;
  options.grid = *GridStep::parse("2^-20mm");
  options.threads = 1;
  int small = 0, solid = 0;
  for (uint64_t seed = 1; seed <= 24; ++seed) {
    Trees trees(seed);
    constexpr double kRoom = 40;
    const NodePtr whole = trees.make(3, kRoom);
    TreeInBoxes boxes(whole);
    for (int i = 0; i < 40; ++i) {
      const glm::dvec3 middle(trees.place(kRoom), trees.place(kRoom), trees.place(kRoom));
      const glm::dvec3 half(2.0625 + i % 4);
      const NodePtr part = boxes.within(middle - half - 0.001, middle + half + 0.001);
      if (!part) continue;
      ++small;
      const NodePtr cut = box(middle - half, middle + half);
      const SolidPtr expected = solid_of(intersect({whole, cut}), options);
      expect_same(*solid_of(intersect({part, cut}), options), *expected);
      expect_same(*solid_of(Node::intersection_as({whole, cut}, intersect({part, cut})), options),
                  *expected);
      solid += expected->empty() ? 0 : 1;
      if (HasFailure()) FAIL() << "seed " << seed << ", box " << i;
    }
  }
  EXPECT_GT(small, 100);
  EXPECT_GT(solid, 40);
}

/// How many leaves a tree has.
size_t leaves_of(const NodePtr& tree) {
  if (tree->kind() == NodeKind::kLeaf) return 1;
  size_t count = 0;
  for (const NodePtr& child : tree->children()) count += leaves_of(child);
  return count;
}

TEST(TreeInBoxes, ChainsOfAnyLengthHaveWhatIsNear) {
  constexpr int kCount = 20000;
  NodePtr bar = box({0, 0, 0}, {kCount, 10, 2}), row = Node::empty();
  for (int i = 1; i < kCount; ++i) {
    const NodePtr slot = box({i - 0.125, -1, -1}, {i + 0.125, 11, 3});
    bar = subtract({bar, slot});
    row = unite({row, slot});
  }
  EvaluateOptions options;
  options.grid = *GridStep::parse("2^-10mm");
  TreeInBoxes of_bar(bar), of_row(row);
  for (const int i : {7, 8192, 19990}) {
    const glm::dvec3 low(i + 0.0625, -5, -5), high(i + 0.9375, 15, 5);
    const NodePtr piece = of_bar.within(low, high), slots = of_row.within(low, high);
    ASSERT_TRUE(piece && slots);
    EXPECT_EQ(leaves_of(piece), 3U);
    EXPECT_EQ(leaves_of(slots), 2U);
    EXPECT_EQ(solid_of(intersect({piece, box(low, high)}), options)->measures.volume,
              0.75 * 10 * 2);
  }
}

TEST(TreeInBoxes, LargePartsStayPartsOfTheWhole) {
  std::vector<NodePtr> row;
  for (int i = 0; i < 64; ++i) row.push_back(moved(i * 2, 0, 0, cube(1)));
  TreeInBoxes boxes(unite(row));
  EXPECT_FALSE(boxes.within({-1, -1, -1}, {12, 2, 2}));
  EXPECT_TRUE(boxes.within({-1, -1, -1}, {1.5, 2, 2}));
  // What a construction makes may be anywhere.
  row[63] = Node::minkowski_sum({cube(1), moved(-40, 0, 0, cube(1))});
  TreeInBoxes with_sum(unite(row));
  const NodePtr part = with_sum.within({21.5, -1, -1}, {22.5, 3, 3});
  ASSERT_TRUE(part);
  EXPECT_EQ(leaves_of(part), 3U);
}

/// Trees that are evaluated in the place of others, below colours, transforms and constructions.
TEST(TreeInBoxes, AnotherTreeIsEvaluatedInTheirPlace) {
  const NodePtr whole = unite({cube(1), moved(10, 0, 0, cube(2))});
  const NodePtr around = box({9, -1, -1}, {13, 3, 3});
  // Not the same on purpose: the volume tells which one was evaluated.
  const NodePtr marked = Node::intersection_as({whole, around}, moved(10, 0, 0, cube(3)));
  EXPECT_EQ(marked->children()[0], whole);
  EXPECT_EQ(solid_of(moved(1, 2, 3, painted(0.5F, marked)))->measures.volume, 27);
  EXPECT_EQ(solid_of(unite({marked, cube(1)}))->measures.volume, 28);
  EXPECT_EQ(solid_of(Node::convex_hull({marked}))->measures.volume, 27);
  const NodePtr sum = Node::minkowski_sum({cube(1), moved(10, 0, 0, cube(2))});
  const NodePtr other = Node::intersection_as({sum, around}, Node::convex_hull({cube(3)}));
  EXPECT_EQ(solid_of(other)->measures.volume, 27);
  EXPECT_EQ(solid_of(unite({moved(0, 0, 20, other), cube(1)}))->measures.volume, 28);
  // A part of a part.
  std::vector<NodePtr> row;
  for (int i = 0; i < 64; ++i) row.push_back(moved(i * 2, 0, 0, cube(1)));
  TreeInBoxes boxes(Node::intersection_as({unite(row), around}, unite(row)));
  const NodePtr part = boxes.within({3.5, -1, -1}, {5.5, 2, 2});
  ASSERT_TRUE(part);
  EXPECT_EQ(leaves_of(part), 1U);
}

}  // namespace
}  // namespace csgrun::tree_in_boxes_test
