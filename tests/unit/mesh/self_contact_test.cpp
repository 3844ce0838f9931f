// A face that touches itself: two pockets that meet in a point of one straight line.
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "engine/bsp/kernel.h"
#include "engine/mesh/present.h"

namespace csgrun::self_contact_test {
namespace {

std::shared_ptr<LeafGeometry> prism(const std::vector<std::array<int, 2>>& outline, int z0,
                                    int z1) {
  auto leaf = std::make_shared<LeafGeometry>();
  const auto n = static_cast<uint32_t>(outline.size());
  for (const int z : {z0, z1}) {
    for (const auto& p : outline) leaf->vertices.push_back({p[0], p[1], z});
  }
  const auto add = [&](const std::vector<uint32_t>& face) {
    leaf->corners.insert(leaf->corners.end(), face.begin(), face.end());
    leaf->face_starts.push_back(static_cast<uint32_t>(leaf->corners.size()));
  };
  std::vector<uint32_t> top, bottom;
  for (uint32_t i = 0; i < n; ++i) top.push_back(n + i), bottom.push_back(n - 1 - i);
  add(top);
  add(bottom);
  for (uint32_t i = 0; i < n; ++i) {
    const uint32_t j = (i + 1) % n;
    add({i, j, j + n, i + n});
  }
  return leaf;
}

/// The first leaf less all others, presented.
SolidPtr difference(const std::vector<std::shared_ptr<LeafGeometry>>& leaves) {
  std::vector<Operand> operands(leaves.size());
  Expression expression;
  Expression::Node root;
  root.is_operand = false;
  root.op = BooleanOp::kDifference;
  root.child_count = static_cast<uint32_t>(leaves.size());
  for (uint32_t i = 0; i < leaves.size(); ++i) {
    operands[i].leaf = leaves[i];
    operands[i].first_source = i;
    Expression::Node leaf;
    leaf.operand = i;
    expression.nodes.push_back(leaf);
    expression.children.push_back(i);
  }
  expression.nodes.push_back(root);
  EvaluateStats stats;
  const auto boundary =
      evaluate_boolean(operands, expression, {{-1, -1, -1}, {31, 31, 31}}, {}, stats);
  EXPECT_TRUE(boundary);
  PresentContext context;
  context.step = {1, 1, 0};
  context.appearances.resize(1);
  const auto result = present(**boundary, context);
  EXPECT_TRUE(result) << result.error().message;
  return *result;
}

TEST(SelfContact, NoVertexLiesInsideATrianglesEdge) {
  const SolidPtr result = difference({prism({{0, 0}, {20, 0}, {20, 20}, {0, 20}}, 0, 5),
                                      prism({{5, 5}, {10, 5}, {5, 12}}, -1, 6),
                                      prism({{10, 5}, {15, 5}, {15, 12}}, -1, 6)});
  const Solid& s = *result;
  EXPECT_EQ(s.measures.volume, 20 * 20 * 5 - 2 * 17.5 * 5);
  EXPECT_EQ(s.measures.genus, 1);
  int collinear_on_line = 0;
  for (const auto& t : s.triangles) {
    for (int k = 0; k < 3; ++k) {
      const glm::dvec3 a = s.positions[t[k]], b = s.positions[t[(k + 1) % 3]];
      for (const glm::dvec3& p : s.positions) {
        if (p == a || p == b || p.z != a.z || p.z != b.z) continue;
        const bool inside = glm::cross(b - a, p - a) == glm::dvec3(0) && glm::dot(p - a, p - b) < 0;
        collinear_on_line += inside;
      }
    }
  }
  EXPECT_EQ(collinear_on_line, 0);
}

// A diamond taken out of a plate leaves four corners, which touch in the middles of the walls.
TEST(SelfContact, WedgesThatTouchBehindAFaceAreApart) {
  const SolidPtr corners = difference({prism({{0, 0}, {20, 0}, {20, 20}, {0, 20}}, 0, 5),
                                       prism({{10, 0}, {20, 10}, {10, 20}, {0, 10}}, -1, 6)});
  EXPECT_EQ(corners->measures.components, 4);
  EXPECT_EQ(corners->measures.genus, 0);
  EXPECT_EQ(corners->measures.volume, 1000);
  EXPECT_EQ(corners->triangles.size(), 4u * 8);
}

// The same, less a part of the height: below, all is one piece, and nothing is cut.
TEST(SelfContact, ALineThatEndsInsideAFaceLeavesItWhole) {
  const SolidPtr plate = difference({prism({{0, 0}, {20, 0}, {20, 20}, {0, 20}}, 0, 5),
                                     prism({{10, 0}, {20, 10}, {10, 20}, {0, 10}}, 2, 6)});
  EXPECT_EQ(plate->measures.components, 1);
  EXPECT_EQ(plate->measures.genus, 0);
  EXPECT_EQ(plate->measures.volume, 20 * 20 * 2 + 200 * 3);
}

}  // namespace
}  // namespace csgrun::self_contact_test
