// Which faces of a result are a whole facet of a leaf, by comparing areas in rationals: a face is a
// part of its facet, so it is all of it when its area is.
#include <map>
#include <numeric>

#include <gtest/gtest.h>

#include "tests/support/exact_measures.h"
#include "tests/support/exact_solid.h"
#include "tests/support/kernel_checks.h"
#include "tests/support/random_solids.h"

namespace csgrun::facets_test {
namespace {

using namespace test;  // NOLINT: a test

/// A leaf whose faces in one plane are one facet; they stand together, as in every leaf.
Leaf leaf_of_facets(Random& random) {
  auto loops = random_loops(random);
  std::map<std::pair<IVec3, int64_t>, std::vector<Loop>> by_plane;
  for (const Loop& l : loops) {
    IVec3 n{0, 0, 0};
    for (size_t i = 1; i + 1 < l.size(); ++i) {
      const IVec3 part = cross_of(sub(l[i], l[0]), sub(l[i + 1], l[0]));
      for (int k = 0; k < 3; ++k) n[k] += part[k];
    }
    const int64_t divisor = std::gcd(std::gcd(n[0], n[1]), n[2]);
    for (auto& x : n) x /= divisor;
    by_plane[{n, dot_of(n, l[0])}].push_back(l);
  }
  std::vector<Loop> ordered;
  std::vector<uint32_t> facet;
  uint32_t number = 0;
  for (const auto& [plane, group] : by_plane) {
    ++number;
    for (const Loop& l : group) ordered.push_back(l), facet.push_back(number);
  }
  auto leaf = std::make_shared<LeafGeometry>(*make_leaf(ordered, true));
  leaf->facet = facet;
  return leaf;
}

using Area = Rational3;  ///< twice the area vector, from outside
Area& operator+=(Area& a, const Area& b) {
  for (int k = 0; k < 3; ++k) a[k] += b[k];
  return a;
}

/// Empty, or the face whose flags are wrong.
std::string wrong_flag(const BoundaryMesh& mesh, const std::vector<Operand>& leaves, int& whole,
                       int& parts, int& both_sides) {
  std::map<std::pair<uint32_t, uint32_t>, Area> of_facet;  // by source and facet
  for (uint32_t o = 0; o < leaves.size(); ++o) {
    const ExactSolid s = exact_solid(leaves[o]);
    for (size_t f = 0; f < s.faces.size(); ++f) {
      of_facet[{o, leaves[o].leaf->facet[f]}] += area_vector(s, s.faces[f]);
    }
  }
  const ExactSolid s = exact_solid(mesh);
  // Both sides of a facet, looked at from the same one.
  std::map<FaceLabel, std::map<bool, Area>> by_label;
  for (size_t f = 0; f < s.faces.size(); ++f) {
    const BoundaryMesh::Face& face = mesh.faces[f];
    if (face.label.facet == 0) continue;
    const Area full = of_facet.at({face.label.source, face.label.facet});
    Area area = area_vector(s, s.faces[f]);
    const bool turned = dot(full, area) < 0;
    if (turned) {
      for (auto& x : area) x = -x;
    }
    by_label[face.label][turned] += area;
  }
  for (size_t f = 0; f < s.faces.size(); ++f) {
    const BoundaryMesh::Face& face = mesh.faces[f];
    if (face.label.facet == 0) {
      if (face.whole || face.complete) return "a face of no facet";
      continue;
    }
    const Area full = of_facet.at({face.label.source, face.label.facet});
    const auto& sides = by_label[face.label];
    Area sum{0, 0, 0};
    for (const auto& [turned, area] : sides) sum += area;
    const bool complete = sum == full;
    if (face.complete != complete) return "complete: face " + std::to_string(f);
    if (face.whole != (complete && sides.size() == 1)) return "whole: face " + std::to_string(f);
    ++(complete ? sides.size() == 1 ? whole : both_sides : parts);
  }
  return "";
}

TEST(Facets, AreWholeOrCompleteWhenTheirAreaIs) {
  Random random(91);
  int whole = 0, parts = 0, both_sides = 0;
  for (int i = 0; i < 120; ++i) {
    std::vector<Operand> leaves;
    for (int64_t n = random.integer(1, 3); n > 0; --n) {
      leaves.push_back(
          operand_of(random.integer(0, 2) ? leaf_of_facets(random) : random_leaf(random)));
      // Far enough to touch little, now and then.
      leaves.back().translation = {random.integer(0, 3) ? 0 : 3, 0, random.integer(0, 3) ? 0 : -4};
    }
    const Tree tree = random.integer(0, 1) && leaves.size() > 1
                          ? differ({leaf(0), leaf(1)})
                          : random_tree(random, 0, static_cast<int>(leaves.size()) - 1);
    if (tree.leaf_count() < leaves.size()) leaves.resize(tree.leaf_count());
    const auto flat = evaluate(tree, leaves, random_options(random));
    ASSERT_TRUE(flat) << text(flat.error());
    ASSERT_EQ(wrong_flag(**flat, leaves, whole, parts, both_sides), "")
        << tree.text() << " case " << i;
    const auto nested = evaluate(tree, leaves, random_options(random),
                                 [&](const Tree&) { return random.integer(0, 1) == 0; });
    ASSERT_TRUE(nested) << text(nested.error());
    ASSERT_EQ(wrong_flag(**nested, leaves, whole, parts, both_sides), "")
        << tree.text() << " case " << i;
  }
  EXPECT_GT(whole, 200);
  EXPECT_GT(parts, 200);
  EXPECT_GT(both_sides, 20);
}

/// A cube whose sides are facets of n x n squares each, of two steps.
Leaf cube_of_tiles(int64_t n) {
  std::vector<Loop> loops;
  std::vector<uint32_t> facet;
  for (size_t side = 0; side < 6; ++side) {
    const size_t axis = side / 2;
    for (int64_t i = 0; i < n; ++i) {
      for (int64_t j = 0; j < n; ++j) {
        Loop& loop = loops.emplace_back();
        for (const auto& [x, y] :
             {std::pair<int64_t, int64_t>{i, j}, {i + 1, j}, {i + 1, j + 1}, {i, j + 1}}) {
          IVec3 p{};
          p[axis] = side % 2 ? 2 * n : 0, p[(axis + 1) % 3] = 2 * x, p[(axis + 2) % 3] = 2 * y;
          loop.push_back(p);
        }
        if (side % 2 == 0) std::reverse(loop.begin(), loop.end());
        facet.push_back(static_cast<uint32_t>(side) + 1);
      }
    }
  }
  auto leaf = std::make_shared<LeafGeometry>(*make_leaf(loops, true));
  leaf->facet = facet;
  return leaf;
}

// However many polygons and corners they are made of, and cut by walls meanwhile.
TEST(Facets, OfManyPolygonsAreWholeToo) {
  const std::vector<Operand> leaves{operand_of(cube_of_tiles(5)),
                                    operand_of(box_leaf({7, 7, 7}, {13, 14, 15})),
                                    operand_of(box_leaf({1, 1, -1}, {2, 2, 1}))};
  for (const bool whole_faces : {true, false}) {
    for (const uint32_t limit : {1u, 17u}) {
      KernelOptions options;
      options.whole_faces = whole_faces;
      options.cell_limit = limit;
      int whole = 0, parts = 0, both_sides = 0;
      for (const Tree& tree : {join({leaf(0), leaf(1), leaf(2)}), less({leaf(0), leaf(1), leaf(2)}),
                               differ({leaf(0), leaf(1), leaf(2)})}) {
        const auto made = evaluate(tree, leaves, options);
        ASSERT_TRUE(made) << text(made.error());
        ASSERT_EQ(wrong_flag(**made, leaves, whole, parts, both_sides), "") << tree.text();
      }
      EXPECT_EQ(whole, 6);  // two sides are not cut into, thrice
      EXPECT_EQ(parts, 2 * 4);
      EXPECT_EQ(both_sides, 4 + 4);
    }
  }
}

}  // namespace
}  // namespace csgrun::facets_test
