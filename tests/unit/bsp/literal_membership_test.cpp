// The solids that the kernel gives hold the points that the expression says they hold. The truth is
// a ray through the leaves themselves: no cells, no trees, no planes of the kernel.
#include <cmath>
#include <optional>

#include <gtest/gtest.h>

#include "engine/bsp/boundary_mesh.h"
#include "engine/bsp/kernel.h"
#include "tests/support/random_trees.h"

namespace csgrun::literal_membership_test {
namespace {

using Vec = std::array<double, 3>;

Vec minus(const Vec& a, const Vec& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
double dot(const Vec& a, const Vec& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Vec cross(const Vec& a, const Vec& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// Parity of crossings of the ray from `p` along `d` with a face given by its loops. Loops fan out
/// into triangles from an arbitrary point of the plane: parities add up. Empty when a crossing is
/// too near an edge to be sure in doubles.
std::optional<bool> crosses(const std::vector<std::vector<Vec>>& loops, const Vec& p,
                            const Vec& d) {
  bool parity = false;
  const Vec apex = loops[0][0];
  for (const auto& loop : loops) {
    for (size_t i = 0; i < loop.size(); ++i) {
      const Vec a = minus(apex, p), b = minus(loop[i], p),
                c = minus(loop[(i + 1) % loop.size()], p);
      const double u = dot(d, cross(a, b)), v = dot(d, cross(b, c)), w = dot(d, cross(c, a));
      const double det = u + v + w, along = dot(a, cross(b, c));
      const Vec ab = minus(b, a), ac = minus(c, a);
      const double doubled_area = std::sqrt(dot(cross(ab, ac), cross(ab, ac)));
      if (doubled_area < 1e-9) continue;  // a fan triangle without area: on the apex's own edges
      if (std::fabs(det) < 1e-7 * doubled_area) return std::nullopt;
      const bool in = det > 0 ? u > 0 && v > 0 && w > 0 : u < 0 && v < 0 && w < 0;
      const double near = 1e-9 * (1 + std::fabs(det));
      const bool away = (u < -near || v < -near || w < -near) && (u > near || v > near || w > near);
      if (!away && (std::fabs(u) < near || std::fabs(v) < near || std::fabs(w) < near)) {
        return std::nullopt;
      }
      if (!in) continue;
      if (std::fabs(along / det) < 1e-7) return std::nullopt;
      parity ^= along / det > 0;
    }
  }
  return parity;
}

std::optional<bool> inside(const std::vector<std::vector<std::vector<Vec>>>& faces, const Vec& p,
                           const Vec& d) {
  bool parity = false;
  for (const auto& face : faces) {
    const auto c = crosses(face, p, d);
    if (!c) return std::nullopt;
    parity ^= *c;
  }
  return parity;
}

std::vector<std::vector<std::vector<Vec>>> faces_of(const Operand& o) {
  std::vector<std::vector<std::vector<Vec>>> faces;
  const LeafGeometry& leaf = *o.leaf;
  for (size_t f = 0; f < leaf.face_count(); ++f) {
    std::vector<Vec> loop;
    for (uint32_t c = leaf.face_starts[f]; c < leaf.face_starts[f + 1]; ++c) {
      loop.push_back(test::TreeMaker::world(o, leaf.vertices[leaf.corners[c]]));
    }
    faces.push_back({loop});
  }
  return faces;
}

std::vector<std::vector<std::vector<Vec>>> faces_of(const BoundaryMesh& m) {
  std::vector<std::vector<std::vector<Vec>>> faces;
  for (const auto& f : m.faces) {
    faces.emplace_back();
    for (uint32_t l = f.first_loop; l < f.first_loop + f.loop_count; ++l) {
      faces.back().emplace_back();
      for (uint32_t c = m.loop_starts[l]; c < m.loop_starts[l + 1]; ++c) {
        faces.back().back().push_back(m.point_rounded[m.corners[c].point]);
      }
    }
  }
  return faces;
}

bool evaluate(const Expression& e, const std::vector<bool>& operand) {
  std::vector<bool> value(e.nodes.size());
  for (size_t i = 0; i < e.nodes.size(); ++i) {
    const Expression::Node& n = e.nodes[i];
    if (n.is_operand) {
      value[i] = operand[n.operand];
      continue;
    }
    value[i] = value[e.children[n.first_child]];
    for (uint32_t c = 1; c < n.child_count; ++c) {
      const bool v = value[e.children[n.first_child + c]];
      switch (n.op) {
        case BooleanOp::kUnion:
          value[i] = value[i] || v;
          break;
        case BooleanOp::kIntersection:
          value[i] = value[i] && v;
          break;
        case BooleanOp::kDifference:
          value[i] = value[i] && !v;
          break;
        case BooleanOp::kSymmetricDifference:
          value[i] = value[i] != v;
          break;
      }
    }
  }
  return value.back();
}

void check_membership(uint64_t seed, int trees, bool frames) {
  test::Random random(seed);
  test::TreeMaker maker(random);
  int sure = 0, in = 0;
  for (int i = 0; i < trees; ++i) {
    SCOPED_TRACE("tree " + std::to_string(i));
    const test::RandomTree tree = maker.make({.size = 5,
                                              .operands = static_cast<int>(random.integer(2, 5)),
                                              .depth = static_cast<int>(random.integer(1, 3)),
                                              .frames = frames});
    std::vector<std::vector<std::vector<std::vector<Vec>>>> operands, results;
    for (const Operand& o : tree.operands) operands.push_back(faces_of(o));
    for (const bool literal : {false, true}) {
      KernelOptions options;
      options.literal_cells = literal;
      EvaluateStats stats;
      const auto result =
          evaluate_boolean(tree.operands, tree.expression, tree.region, options, stats);
      ASSERT_TRUE(result) << result.error().message;
      results.push_back(faces_of(**result));
    }
    for (int s = 0; s < 40; ++s) {
      Vec p{}, d{};
      for (int k = 0; k < 3; ++k) {
        const auto lo = static_cast<double>(tree.region.lo[k]);
        const auto hi = static_cast<double>(tree.region.hi[k]);
        p[k] = lo + (hi - lo) * random.unit();
        d[k] = random.unit() - 0.5;
      }
      std::vector<bool> values;
      for (const auto& faces : operands) {
        const auto v = inside(faces, p, d);
        if (!v) break;
        values.push_back(*v);
      }
      if (values.size() != operands.size()) continue;
      const bool expected = evaluate(tree.expression, values);
      for (size_t r = 0; r < results.size(); ++r) {
        const auto got = inside(results[r], p, d);
        if (!got) continue;
        ++sure;
        in += *got;
        ASSERT_EQ(*got, expected) << (r ? "literal" : "default") << " at " << p[0] << ' ' << p[1]
                                  << ' ' << p[2];
      }
    }
  }
  EXPECT_GT(sure, trees * 60);  // hardly any sample is given up
  EXPECT_GT(in, trees / 2);     // and enough of them hit
}

TEST(Membership, OfDenseLeaves) { check_membership(31, 150, false); }
TEST(Membership, InFrames) { check_membership(32, 60, true); }

}  // namespace
}  // namespace csgrun::literal_membership_test
