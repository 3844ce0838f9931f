// Which leaf a face is from, when several leaves have surface in its plane.
#include <algorithm>
#include <map>
#include <string>

#include <gtest/gtest.h>

#include <csgrun/engine/evaluate.h>

#include "test_meshes.h"

namespace csgrun::face_sources_test {
namespace {

using namespace testing;

NodePtr named(const std::string& name, glm::dvec3 lo, glm::dvec3 hi) {
  PolygonMesh mesh = box_mesh(lo, hi);
  mesh.kind = name;
  return Node::leaf(std::make_shared<PolygonMesh>(std::move(mesh)));
}

/// Of the faces in the plane z = `height` that look up: the name of the leaf, by the lowest corner.
std::map<std::pair<double, double>, std::string> tops(const NodePtr& node, double height) {
  Evaluator evaluator({});
  const auto solid = evaluator.evaluate(node);
  EXPECT_TRUE(solid) << solid.error().message;
  std::map<std::pair<double, double>, std::string> names;
  if (!solid) return names;
  const Solid& s = **solid;
  for (size_t f = 0; f < s.faces.size(); ++f) {
    const Solid::Face& face = s.faces[f];
    const uint32_t begin = s.loop_starts[face.first_loop], end = s.loop_starts[face.first_loop + 1];
    std::pair<double, double> lowest{1e9, 1e9};
    bool is_top = s.face_normals[f].z > 0;
    for (uint32_t c = begin; c < end; ++c) {
      const glm::dvec3& p = s.positions[s.loop_vertices[c]];
      is_top = is_top && p.z == height;
      lowest = std::min(lowest, {p.x, p.y});
    }
    if (is_top) names[lowest] = s.sources[face.source].kind;
  }
  return names;
}

using Names = std::map<std::pair<double, double>, std::string>;

TEST(FaceSources, FacesThatAreApartKeepTheirs) {
  const NodePtr a = named("a", {0, 0, 0}, {10, 10, 10}), b = named("b", {30, 0, 0}, {40, 10, 10});
  EXPECT_EQ(tops(unite({a, b}), 10), (Names{{{0, 0}, "a"}, {{30, 0}, "b"}}));
  EXPECT_EQ(tops(unite({b, a}), 10), (Names{{{0, 0}, "a"}, {{30, 0}, "b"}}));
}

TEST(FaceSources, APieceInAHoleIsAFaceOfItsOwn) {
  const NodePtr plate = named("plate", {0, 0, 0}, {30, 30, 10}),
                hole = named("hole", {5, 5, -1}, {25, 25, 11}),
                post = named("post", {10, 10, 0}, {20, 20, 10});
  EXPECT_EQ(tops(unite({subtract({plate, hole}), post}), 10),
            (Names{{{0, 0}, "plate"}, {{10, 10}, "post"}}));
}

TEST(FaceSources, PiecesThatMeetInACornerAreApart) {
  const NodePtr a = named("a", {0, 0, 0}, {10, 10, 10}), b = named("b", {10, 10, 0}, {20, 20, 10});
  EXPECT_EQ(tops(unite({a, b}), 10), (Names{{{0, 0}, "a"}, {{10, 10}, "b"}}));
}

TEST(FaceSources, PiecesAlongALineAreOneFaceOfTheFirst) {
  // Neighbours whose corners on the common line are all different; c comes first.
  const NodePtr a = named("a", {0, 0, 0}, {10, 10, 10}), b = named("b", {10, 3, 0}, {20, 13, 10}),
                c = named("c", {20, 5, 0}, {30, 9, 10}), d = named("d", {40, 0, 0}, {50, 10, 10});
  EXPECT_EQ(tops(unite({c, d, a, b}), 10), (Names{{{0, 0}, "c"}, {{40, 0}, "d"}}));
  EXPECT_EQ(tops(unite({unite({a, d}), unite({b, c})}), 10),
            (Names{{{0, 0}, "a"}, {{40, 0}, "d"}}));
}

TEST(FaceSources, AFaceOfTwoPartsJoinsNothing) {
  // The bar is cut in two; the block, which comes first, stands at one of the halves.
  const NodePtr block = named("block", {-10, 0, 0}, {0, 10, 10}),
                bar = named("bar", {0, 0, 0}, {30, 10, 10}),
                gap = named("gap", {10, -1, -1}, {20, 11, 11});
  EXPECT_EQ(tops(unite({block, subtract({bar, gap})}), 10),
            (Names{{{-10, 0}, "block"}, {{20, 0}, "bar"}}));
}

// 2^30 leaves, counted as often as they are used, of which one has faces.
TEST(FaceSources, OfPartsThatAreUsedAgainAndAgain) {
  NodePtr part = named("all", {0, 0, 0}, {10, 10, 10});
  const NodePtr more = named("more", {0, 0, 0}, {1, 1, 1});
  for (int i = 0; i < 30; ++i) part = unite({intersect({part, moved(0.1, 0, 0, part)}), more});
  Evaluator evaluator({});
  const auto solid = evaluator.evaluate(part);
  ASSERT_TRUE(solid) << solid.error().message;
  // What is left of the first, and the small one beside it.
  EXPECT_NEAR((*solid)->measures.volume, 7 * 100 + 3, 1e-9);
  ASSERT_LE((*solid)->sources.size(), 8u);
  for (const Solid::Source& source : (*solid)->sources) {
    EXPECT_TRUE(source.kind == "all" || source.kind == "more") << source.kind;
  }
}

}  // namespace
}  // namespace csgrun::face_sources_test
