// The order of a boundary's points, loops and faces is a function of their exact coordinates, said
// here once more over rationals. That all ways of evaluation agree does not show it: all share one
// sort.
#include "engine/bsp/canonical_order.h"

#include <gtest/gtest.h>

#include "engine/bsp/kernel.h"
#include "tests/support/exact_solid.h"
#include "tests/support/gmp_bridge.h"
#include "tests/support/random_trees.h"

namespace csgrun::canonical_order_test {
namespace {

using test::Rational3;

/// Empty, or what is out of order.
std::string disorder_in(const BoundaryMesh& mesh) {
  const auto points = test::exact_solid(mesh).points;
  for (size_t p = 1; p < points.size(); ++p) {
    if (!(points[p - 1] < points[p])) return "point " + std::to_string(p);
  }
  using Edge = std::pair<uint32_t, uint32_t>;
  const auto edges_of = [&](uint32_t loop) {
    std::vector<Edge> edges;
    const uint32_t begin = mesh.loop_starts[loop], end = mesh.loop_starts[loop + 1];
    for (uint32_t c = begin; c < end; ++c) {
      edges.emplace_back(mesh.corners[c].point, mesh.corners[c + 1 < end ? c + 1 : begin].point);
    }
    return edges;
  };
  using Key = std::tuple<Edge, std::array<mpz_class, 4>, FaceLabel>;
  std::vector<Key> faces;
  for (const BoundaryMesh::Face& f : mesh.faces) {
    std::vector<Edge> firsts;
    for (uint32_t l = f.first_loop; l < f.first_loop + f.loop_count; ++l) {
      const auto edges = edges_of(l);
      if (edges[0] != *std::min_element(edges.begin(), edges.end())) return "corners of a loop";
      firsts.push_back(edges[0]);
    }
    if (!std::is_sorted(firsts.begin(), firsts.end())) return "loops of a face";
    const Plane& stored = mesh.planes[f.plane.index()];
    const Plane s = f.plane.flipped() ? stored.reversed() : stored;
    faces.emplace_back(firsts[0],
                       std::array<mpz_class, 4>{test::to_gmp(s.a), test::to_gmp(s.b),
                                                test::to_gmp(s.c), test::to_gmp(s.d)},
                       f.label);
  }
  for (size_t f = 1; f < faces.size(); ++f) {
    if (!(faces[f - 1] < faces[f])) return "face " + std::to_string(f);
  }
  return "";
}

TEST(CanonicalOrder, OfRandomResults) {
  test::Random random(61);
  test::TreeMaker maker(random);
  size_t faces = 0, several_loops = 0, equal_edges = 0;
  for (int i = 0; i < 150; ++i) {
    const auto tree =
        maker.make({.size = 5, .operands = static_cast<int>(random.integer(2, 5)), .depth = 2});
    EvaluateStats stats;
    const auto result = evaluate_boolean(tree.operands, tree.expression, tree.region, {}, stats);
    ASSERT_TRUE(result) << result.error().message;
    ASSERT_EQ(disorder_in(**result), "") << "tree " << i;
    faces += (*result)->faces.size();
    for (size_t f = 0; f < (*result)->faces.size(); ++f) {
      const auto& face = (*result)->faces[f];
      several_loops += face.loop_count > 1;
      if (f == 0) continue;
      const auto corner = [&](size_t at) {
        return (*result)->corners[(*result)->loop_starts[(*result)->faces[at].first_loop]].point;
      };
      equal_edges += corner(f) == corner(f - 1);
    }
  }
  EXPECT_GT(faces, 1000u);
  EXPECT_GT(several_loops, 20u);
  EXPECT_GT(equal_edges, 100u);
}

// A box so small that its eight corners have the same doubles: 1/3 and 1/3 + 2^-62 on each axis.
TEST(CanonicalOrder, OfPointsThatDoublesCannotTellApart) {
  constexpr Int128 kScale = Int128{1} << 61;
  PlaneTable planes;
  uint32_t wall[3][2];
  for (int axis = 0; axis < 3; ++axis) {
    for (int upper = 0; upper < 2; ++upper) {
      Plane p{0, 0, 0, -(kScale + upper)};  // 3 * 2^61 x = 2^61 + upper
      (axis == 0 ? p.a : axis == 1 ? p.b : p.c) = 3 * kScale;
      wall[axis][upper] = planes.intern(p).index();
    }
  }
  // In every order of making the points, the same.
  std::array<int, 8> making{0, 1, 2, 3, 4, 5, 6, 7};
  test::Random random(62);
  for (int attempt = 0; attempt < 50; ++attempt) {
    for (int i = 7; i > 0; --i) std::swap(making[i], making[random.integer(0, i)]);
    CellGeometry geometry(planes, nullptr);
    std::array<uint32_t, 8> point{};
    for (const int corner : making) {
      point[corner] =
          geometry.add_point({wall[0][corner >> 2], wall[1][corner >> 1 & 1], wall[2][corner & 1]});
    }
    ASSERT_EQ(geometry.point(point[0]).rounded, geometry.point(point[7]).rounded);
    DraftBoundary draft;
    for (int side = 0; side < 6; ++side) {
      const int axis = side / 2, upper = side % 2, i = (axis + 1) % 3, j = (axis + 2) % 3;
      const auto corner = [&](int u, int v) {
        return point[upper << (2 - axis) | u << (2 - i) | v << (2 - j)];
      };
      std::vector<DirectedEdge> loop{{corner(0, 0), corner(1, 0), wall[j][0]},
                                     {corner(1, 0), corner(1, 1), wall[i][1]},
                                     {corner(1, 1), corner(0, 1), wall[j][1]},
                                     {corner(0, 1), corner(0, 0), wall[i][0]}};
      if (upper == 0) {
        std::reverse(loop.begin(), loop.end());
        for (auto& e : loop) std::swap(e.from, e.to);
      }
      std::rotate(loop.begin(), loop.begin() + random.integer(0, 3), loop.end());
      draft.begin_face(PlaneId(wall[axis][upper], upper == 0), {}, false, false);
      draft.edges.insert(draft.edges.end(), loop.begin(), loop.end());
      draft.end_loop();
    }
    const BoundaryMesh mesh = canonical(geometry, planes, draft);
    ASSERT_EQ(mesh.point_planes.size(), 8u);
    ASSERT_EQ(disorder_in(mesh), "");
  }
}

}  // namespace
}  // namespace csgrun::canonical_order_test
