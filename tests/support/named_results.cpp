#include "tests/support/named_results.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include <gtest/gtest.h>

#include "engine/bsp/corner_walk.h"
#include "engine/bsp/untouched.h"
#include "engine/mesh/boundary_volume.h"
#include "engine/mesh/opposite_edges.h"

namespace csgrun::test {

std::shared_ptr<LeafGeometry> leaf_of_triangles(const std::vector<Loop>& loops) {
  auto leaf = std::make_shared<LeafGeometry>(*make_leaf(loops, true));
  leaf->opposite = pair_edges(*leaf).opposite;
  leaf->has_single_fans = find_vertices_of_fans(*leaf).empty();
  leaf->may_touch = false;
  return leaf;
}

void add_quad(std::vector<Loop>& loops, const IVec3& a, const IVec3& b, const IVec3& c,
              const IVec3& d, bool turned) {
  if (turned) {
    loops.insert(loops.end(), {{a, b, d}, {b, c, d}});
  } else {
    loops.insert(loops.end(), {{a, b, c}, {a, c, d}});
  }
}

std::vector<Loop> tiled_box(Random& random, const IVec3& lo, int64_t n, int64_t step) {
  std::vector<Loop> loops;
  for (int axis = 0; axis < 3; ++axis) {
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    for (const int64_t side : {int64_t{0}, n}) {
      for (int64_t i = 0; i < n; ++i) {
        for (int64_t j = 0; j < n; ++j) {
          const auto at = [&](int64_t x, int64_t y) {
            IVec3 p = lo;
            p[axis] += side * step, p[u] += x * step, p[v] += y * step;
            return p;
          };
          const bool turned = random.integer(0, 1) != 0;
          if (side == 0) {
            add_quad(loops, at(i, j), at(i, j + 1), at(i + 1, j + 1), at(i + 1, j), turned);
          } else {
            add_quad(loops, at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1), turned);
          }
        }
      }
    }
  }
  return loops;
}

std::vector<Loop> bumpy_torus(Random& random, const IVec3& center, double size) {
  constexpr int kAround = 22, kTube = 10;
  std::vector<IVec3> points;
  for (int i = 0; i < kAround; ++i) {
    for (int j = 0; j < kTube; ++j) {
      const double a = 2 * M_PI * i / kAround, b = 2 * M_PI * j / kTube;
      const double tube = size * (0.25 + 0.04 * random.unit()), ring = size + tube * std::cos(b);
      points.push_back({center[0] + std::llround(ring * std::cos(a)),
                        center[1] + std::llround(ring * std::sin(a)),
                        center[2] + std::llround(tube * std::sin(b))});
    }
  }
  std::vector<Loop> loops;
  for (int i = 0; i < kAround; ++i) {
    for (int j = 0; j < kTube; ++j) {
      const auto at = [&](int x, int y) { return points[x % kAround * kTube + y % kTube]; };
      add_quad(loops, at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1), false);
    }
  }
  return loops;
}

std::vector<Loop> operator+(std::vector<Loop> a, const std::vector<Loop>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

namespace {

template <class T>
bool same_bits(const std::vector<T>& a, const std::vector<T>& b) {
  return a.size() == b.size() &&
         (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
}

}  // namespace

std::string difference_of_arrays(const Solid& a, const Solid& b) {
  if (const std::string text = difference_between(a, b); !text.empty()) return text;
  if (!same_bits(a.positions, b.positions)) return "different bits of positions";
  if (!same_bits(a.positions_f32, b.positions_f32)) return "different bits of single positions";
  if (!same_bits(a.face_normals, b.face_normals)) return "different normals";
  if (a.exact_points != b.exact_points) return "different exact points";
  const Measures &m = a.measures, &n = b.measures;
  if (m.volume != n.volume || m.area != n.area || m.centroid != n.centroid) return "different mass";
  if (m.bbox != n.bbox) return "different boxes";
  if (m.components != n.components || m.genus != n.genus) return "different topology";
  return "";
}

size_t named(const BoundaryMesh& mesh) {
  size_t count = 0;
  for (const UntouchedPart& part : mesh.parts) count += part.faces.size();
  return count;
}

void expect_one_value(const Pair& pair, const std::string& what) {
  ASSERT_TRUE(pair.spelled->parts.empty()) << what;
  ASSERT_EQ(difference_between(*pair.spelled, *expanded(pair.naming)), "") << what;
  EXPECT_EQ(is_empty(*pair.spelled), is_empty(*pair.naming)) << what;
  const GridBox a = bounding_box(*pair.spelled), b = bounding_box(*pair.naming);
  EXPECT_TRUE(a.lo == b.lo && a.hi == b.hi) << what;
  EXPECT_EQ(only_appearance(*pair.spelled), only_appearance(*pair.naming)) << what;
  PresentContext context = test_context();
  for (const bool join : {false, true}) {
    context.join_contacts = join;
    const auto x = present(*pair.spelled, context), y = present(*pair.naming, context);
    ASSERT_TRUE(x) << what << text(x.error());
    ASSERT_TRUE(y) << what << text(y.error());
    ASSERT_EQ(difference_of_arrays(**x, **y), "") << what;
    // Where contacts are looked for must not matter.
    BoundaryMesh anywhere = *pair.spelled;
    anywhere.touches.clear();
    anywhere.may_touch = true;
    const auto z = present(anywhere, context);
    ASSERT_TRUE(z) << what << text(z.error());
    ASSERT_EQ(difference_of_arrays(**x, **z), "") << what;
  }
  if (is_empty(*pair.spelled)) return;
  const auto volume = boundary_volume(*pair.spelled, context.step),
             same = boundary_volume(*pair.naming, context.step);
  ASSERT_TRUE(volume && same) << what;
  EXPECT_EQ(*volume, *same) << what;
}

Pair evaluate_both(const Tree& tree, const std::vector<Operand>& operands) {
  Pair pair;
  KernelOptions options;
  for (Boundary* result : {&pair.spelled, &pair.naming}) {
    options.name_untouched = result == &pair.naming;
    const auto made = evaluate(tree, operands, options);
    if (!made) ADD_FAILURE() << text(made.error());
    *result = made ? *made : std::make_shared<BoundaryMesh>();
  }
  return pair;
}

Tree random_binary_tree(Random& random, int first, int count) {
  if (count == 1) return leaf(first);
  Tree tree;
  tree.op = static_cast<BooleanOp>(random.integer(0, 3));
  const int split = static_cast<int>(random.integer(1, count - 1));
  tree.children = {random_binary_tree(random, first, split),
                   random_binary_tree(random, first + split, count - split)};
  return tree;
}

Operand placed(Leaf leaf, const IVec3& at) {
  Operand operand = operand_of(std::move(leaf));
  operand.translation = at;
  return operand;
}

}  // namespace csgrun::test
