// Jobs that have only the faces that are near the other operand, against jobs of all faces.
#include "engine/bsp/near_faces.h"

#include <algorithm>
#include <array>

#include <gtest/gtest.h>

#include "tests/support/exact_solid.h"
#include "tests/support/named_results.h"
#include "tests/support/random_frames.h"

namespace csgrun::near_faces_test {
namespace {

using namespace test;  // NOLINT: a test

Frame unmirrored_frame(Random& random) {
  Frame frame = random_frame(random);
  while (mirrors(frame)) frame = random_frame(random);
  return frame;
}

/// One for each of two operands: that of the world, one that both have, or others.
std::array<Frame, 2> random_frames(Random& random, int kind) {
  const Frame first = kind == 0 ? Frame() : unmirrored_frame(random);
  if (kind <= 1) return {first, first};
  return {kind == 2 ? Frame() : unmirrored_frame(random), first};
}

TEST(NearFaces, GiveWhatAllGive) {
  Random random(1208);
  size_t far = 0, dropped = 0, by_pairs = 0, by_cells = 0, touching = 0, touching_in_frames = 0;
  for (int round = 0; round < 240; ++round) {
    const int kind = round / 4 % 4;  // of frames
    const std::array<Frame, 2> frames = random_frames(random, kind);
    const int64_t size = round % 4 < 2 ? 1 << 20 : 24;
    const auto torus = [&](double part) {
      return bumpy_torus(random, {0, 0, 0}, part * static_cast<double>(1 << 20));
    };
    std::vector<std::shared_ptr<LeafGeometry>> leaves;
    if (size > 24) {
      // One in the hole of the other, too; or two surfaces, far apart or one in the other.
      const IVec3 beside{0, 0, round % 3 == 0 ? size : size / 64};
      leaves = {leaf_of_triangles(torus(1)),
                leaf_of_triangles(torus(0.5) + bumpy_torus(random, beside, 0.1 * size))};
    } else {
      // Sides in one plane, edges and corners in common.
      for (int i = 0; i < 2; ++i) {
        const int64_t step = random.integer(1, 2);
        leaves.push_back(
            leaf_of_triangles(tiled_box(random, {0, 0, 0}, random.integer(4, 12) / step, step)));
      }
    }
    const int64_t reach = round % 2 == 0 ? size / 2 : 2 * size;
    std::vector<Operand> operands;
    for (const auto& leaf : leaves) {
      const auto move = [&] { return random.integer(-reach, reach) / (size > 24 ? 1 : 2); };
      operands.push_back(placed(leaf, {move(), move(), move()}));
      operands.back().frame = frames[operands.size() - 1];
      operands.back().first_source = static_cast<uint32_t>(operands.size());
    }
    const Tree tree = random_binary_tree(random, 0, 2);
    KernelOptions options;
    options.name_untouched = true;
    options.faces_for_near = UINT32_MAX;
    const auto all = evaluate(tree, operands, options);
    options.faces_for_near = 0;
    options.threads = 1 + round % 2;
    const auto some = evaluate(tree, operands, options);
    ASSERT_TRUE(all && some) << tree.text();
    ASSERT_EQ((*all)->parts.size(), (*some)->parts.size()) << round << tree.text();
    for (size_t k = 0; k < (*all)->parts.size(); ++k) {
      const UntouchedPart &a = (*all)->parts[k], &b = (*some)->parts[k];
      ASSERT_EQ(a.faces, b.faces) << round << tree.text();
      ASSERT_EQ(a.flipped, b.flipped) << round << tree.text();
      ASSERT_EQ(a.source, b.source) << round << tree.text();
    }
    touching += (*all)->may_touch;
    touching_in_frames += kind > 0 && (*all)->may_touch;
    ASSERT_NO_FATAL_FAILURE(
        expect_one_value({evaluate_both(tree, operands).spelled, *some}, tree.text()));
    const auto near = find_near_faces(operands, options.cell_limit);
    ASSERT_TRUE(near);
    ASSERT_NE(near->pairs == nullptr, near->cells == nullptr);
    ++(near->pairs ? by_pairs : by_cells);
    for (size_t o = 0; o < 2; ++o) {
      for_each_far_face(*leaves[o], near->faces[o], [&](uint32_t f) {
        ++far;
        dropped += std::none_of((*some)->parts.begin(), (*some)->parts.end(), [&](const auto& p) {
          return p.leaf == leaves[o] && std::binary_search(p.faces.begin(), p.faces.end(), f);
        });
      });
    }
  }
  EXPECT_GT(far, 20000u);
  EXPECT_GT(dropped, 2000u);
  EXPECT_LT(dropped, far);
  EXPECT_GT(touching, 10u);
  EXPECT_GT(touching_in_frames, 5u);
  EXPECT_GT(by_pairs, 20u);
  EXPECT_GT(by_cells, 20u);
}

/// A slab with a top of so many ridges along an axis, each of four long triangles; `up`: or its
/// bottom has them.
std::vector<Loop> ridges(int count, int axis, bool up) {
  const auto at = [&](int64_t along, int64_t across, int64_t z) {
    IVec3 p{along, across, up ? z : -z};
    if (axis == 1) std::swap(p[0], p[1]);
    return p;
  };
  const int64_t length = 40 * count;
  std::vector<Loop> loops;
  const auto top = [&](int i) { return i % 2 == 0 ? 100 : 160; };
  const bool turned = up != (axis == 0);
  const auto add = [&](const IVec3& a, const IVec3& b, const IVec3& c, const IVec3& d) {
    turned ? add_quad(loops, d, c, b, a, false) : add_quad(loops, a, b, c, d, false);
  };
  for (int i = 0; i < 2 * count; ++i) {
    const int64_t y = 20 * i, next = y + 20;
    add(at(0, y, top(i)), at(length, y, top(i)), at(length, next, top(i + 1)),
        at(0, next, top(i + 1)));
    add(at(0, next, 0), at(length, next, 0), at(length, y, 0), at(0, y, 0));
    add(at(0, y, 0), at(0, y, top(i)), at(0, next, top(i + 1)), at(0, next, 0));
    add(at(length, next, 0), at(length, next, top(i + 1)), at(length, y, top(i)), at(length, y, 0));
  }
  const int64_t end = 20 * 2 * int64_t{count};
  add(at(0, 0, 0), at(length, 0, 0), at(length, 0, 100), at(0, 0, 100));
  add(at(0, end, 100), at(length, end, 100), at(length, end, 0), at(0, end, 0));
  return loops;
}

/// With so many contacts that cells are less work: these need all faces.
TEST(NearFaces, DoNotDoForACrowd) {
  Random random(1210);
  const auto slab =
                 leaf_of_triangles(ridges(80, 0, true) + tiled_box(random, {9000, 0, 0}, 12, 10)),
             other = leaf_of_triangles(ridges(80, 1, false));
  ASSERT_FALSE(slab->opposite.empty());
  ASSERT_FALSE(other->opposite.empty());
  const std::vector<Operand> operands{placed(slab, {0, 0, 0}), placed(other, {3, 7, 257})};
  const auto near = find_near_faces(operands, 17);
  ASSERT_TRUE(near);
  EXPECT_LT(near->faces[0].size(), slab->face_count() - 500);
  EXPECT_TRUE(near->cells);
  for (const BooleanOp op : {BooleanOp::kUnion, BooleanOp::kDifference}) {
    const Tree tree = op == BooleanOp::kUnion ? join({leaf(0), leaf(1)}) : less({leaf(0), leaf(1)});
    KernelOptions options;
    options.name_untouched = true;
    options.faces_for_near = 0;
    const auto naming = evaluate(tree, operands, options);
    ASSERT_TRUE(naming) << text(naming.error());
    EXPECT_GT(named(**naming), 500u);
    expect_one_value({evaluate_both(tree, operands).spelled, *naming}, tree.text());
  }
}

TEST(NearFaces, AreFoundOfLeavesThatCanBeNamed) {
  Random random(1209);
  const auto torus = leaf_of_triangles(bumpy_torus(random, {0, 0, 0}, 1 << 20));
  const std::vector<Operand> good{placed(torus, {0, 0, 0}), placed(torus, {9, 9, 1 << 19})};
  ASSERT_TRUE(find_near_faces(good, 17));
  // Of either operand.
  const auto refused = [&](auto change) {
    size_t count = 0;
    for (size_t o = 0; o < 2; ++o) {
      auto leaf = std::make_shared<LeafGeometry>(*torus);
      std::vector<Operand> operands = good;
      change(*leaf, operands[o]);
      operands[o].leaf = leaf;
      count += find_near_faces(operands, 17) ? 0 : 1;
    }
    EXPECT_NE(count, 1u);
    return count == 2;
  };
  EXPECT_FALSE(refused([](LeafGeometry&, Operand&) {}));
  EXPECT_TRUE(refused([](LeafGeometry& l, Operand&) { l.has_single_fans = false; }));
  EXPECT_TRUE(refused([](LeafGeometry& l, Operand&) { l.may_touch = true; }));
  EXPECT_TRUE(refused([](LeafGeometry& l, Operand&) { l.opposite.clear(); }));
  EXPECT_TRUE(refused([](LeafGeometry& l, Operand&) { l.facet = FaceNumbers(); }));
  EXPECT_TRUE(refused(
      [](LeafGeometry& l, Operand&) { l.facet = std::vector<uint32_t>(l.face_count(), 1); }));
  EXPECT_TRUE(refused([](LeafGeometry&, Operand& o) { o.translation[2] = -(int64_t{1} << 30); }));
  EXPECT_TRUE(refused([](LeafGeometry&, Operand& o) { o.translation[1] = int64_t{1} << 30; }));
  EXPECT_FALSE(refused([](LeafGeometry&, Operand& o) { o.frame = frame_of(turn_about(1, 30)); }));
  EXPECT_TRUE(refused([](LeafGeometry&, Operand& o) {
    o.frame = frame_of(turn_about(1, 30));
    o.translation[2] = int64_t{3} << 29;
  }));
  EXPECT_TRUE(refused([](LeafGeometry&, Operand& o) {
    o.frame = frame_of({{{1, 0, 0}, {0, -1, 0}, {0, 0, 1}}});
  }));
  std::vector<Operand> three = good;
  three.push_back(good[0]);
  EXPECT_FALSE(find_near_faces(three, 17));
}

}  // namespace
}  // namespace csgrun::near_faces_test
