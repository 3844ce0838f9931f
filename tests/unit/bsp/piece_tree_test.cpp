// Versions of a tree of boxes against a plain list, change after change.
#include "engine/bsp/piece_tree.h"

#include <set>

#include <gtest/gtest.h>

#include "tests/support/seeded.h"

namespace csgrun::piece_tree_test {
namespace {

using test::Random;

class PieceTrees : public testing::Test {
 protected:
  PieceBox random_box() {
    PieceBox box;
    for (int i = 0; i < 2; ++i) {
      std::array<double, 3> p{};
      for (double& c : p) c = static_cast<double>(random_.integer(0, 40));
      box.add(p);
    }
    return box;
  }
  uint32_t new_piece() {
    boxes_.push_back(random_box());
    return static_cast<uint32_t>(boxes_.size() - 1);
  }
  [[nodiscard]] std::set<uint32_t> in_box(const PieceTree& tree, const PieceBox& where) const {
    std::set<uint32_t> found;
    tree.each([&](const PieceBox& box) { return box.meets(where); },
              [&](uint32_t p) {
                if (boxes_[p].meets(where)) {
                  EXPECT_TRUE(found.insert(p).second) << "twice";
                }
              });
    return found;
  }
  [[nodiscard]] std::set<uint32_t> expected(const std::set<uint32_t>& all,
                                            const PieceBox& where) const {
    std::set<uint32_t> found;
    for (const uint32_t p : all) {
      if (boxes_[p].meets(where)) found.insert(p);
    }
    return found;
  }

  Random random_{8101};
  std::vector<PieceBox> boxes_;
};

TEST_F(PieceTrees, ChangesLeaveOtherVersionsAlone) {
  struct Version {
    PieceTree tree;
    std::set<uint32_t> pieces;
  };
  std::vector<Version> versions(1);
  const auto box_of = [&](uint32_t p) -> const PieceBox& { return boxes_[p]; };
  for (int step = 0; step < 150; ++step) {
    // From any version, so that histories branch.
    const Version from = versions[static_cast<size_t>(random_.integer(
        static_cast<int64_t>(versions.size()) / 2, static_cast<int64_t>(versions.size()) - 1))];
    Version next = from;
    std::vector<PieceBox> where;
    std::set<uint32_t> gone;
    for (int64_t n = random_.integer(0, 2); n > 0; --n) {
      where.push_back(random_box());
      for (const uint32_t p : expected(from.pieces, where.back())) {
        if (random_.integer(0, 1) == 1) gone.insert(p);
      }
    }
    std::vector<uint32_t> added;
    for (int64_t n = random_.integer(0, 60); n > 0; --n) added.push_back(new_piece());
    for (const uint32_t p : gone) next.pieces.erase(p);
    next.pieces.insert(added.begin(), added.end());
    std::vector<uint32_t> named(gone.begin(), gone.end());
    // What is not there does not go.
    for (uint32_t p = 0; p < boxes_.size(); p += 97) {
      if (!from.pieces.contains(p) && !std::count(added.begin(), added.end(), p)) {
        named.push_back(p);
      }
    }
    std::sort(named.begin(), named.end());
    next.tree = from.tree.changed(named, added, box_of, [&](const PieceBox& box) {
      return std::any_of(where.begin(), where.end(),
                         [&](const PieceBox& own) { return own.meets(box); });
    });
    versions.push_back(next);
    for (const Version& v : {from, next}) {
      ASSERT_EQ(v.tree.size(), v.pieces.size());
      const PieceBox asked = random_box();
      ASSERT_EQ(in_box(v.tree, asked), expected(v.pieces, asked));
      PieceBox hull;
      for (const uint32_t p : v.pieces) hull.add(boxes_[p]);
      ASSERT_EQ(v.tree.box().lo, hull.lo);
      ASSERT_EQ(v.tree.box().hi, hull.hi);
    }
  }
}

TEST_F(PieceTrees, StayShallowAlongALine) {
  // Each beside the one before: the worst for a tree that never turns.
  PieceTree tree;
  for (int i = 0; i < 3000; ++i) {
    PieceBox box;
    box.add(std::array{1.0 * i, 0.0, 0.0});
    box.add(std::array{1.0 * i + 1, 1.0, 1.0});
    boxes_.push_back(box);
    tree = tree.changed({}, {static_cast<uint32_t>(i)},
                        [&](uint32_t p) -> const PieceBox& { return boxes_[p]; });
  }
  ASSERT_EQ(tree.size(), 3000u);
  EXPECT_LE(tree.root()->height, 6u + 2 * 12u);
  EXPECT_EQ(in_box(tree, boxes_[1500]), (std::set<uint32_t>{1499, 1500, 1501}));
}

TEST_F(PieceTrees, UnchangedNodesAreShared) {
  std::vector<uint32_t> pieces;
  for (int i = 0; i < 500; ++i) pieces.push_back(new_piece());
  const auto box_of = [&](uint32_t p) -> const PieceBox& { return boxes_[p]; };
  const PieceTree tree = PieceTree().changed({}, pieces, box_of);
  EXPECT_EQ(tree.changed({}, {}, box_of).root(), tree.root());
  const std::vector<uint32_t> other{new_piece()};
  EXPECT_EQ(tree.changed(other, {}, box_of).root(), tree.root());
  const PieceTree less = tree.changed(std::vector<uint32_t>{3}, {}, box_of);
  EXPECT_EQ(less.size(), 499u);
  const PieceTree empty = tree.changed(pieces, {}, box_of);
  EXPECT_EQ(empty.size(), 0u);
  EXPECT_EQ(empty.root(), nullptr);
  EXPECT_EQ(tree.size(), 500u);
  // Of nothing nothing can go; what is added is all there is.
  const PieceTree one = empty.changed(pieces, {7}, box_of);
  EXPECT_EQ(one.size(), 1u);
  EXPECT_EQ(one.box().lo, boxes_[7].lo);
}

TEST(PieceBox, MeetsWhatItTouches) {
  const PieceBox box{{0, 0, 0}, {4, 4, 4}};
  for (int x = -2; x <= 5; ++x) {
    for (int y = -2; y <= 5; ++y) {
      for (int z = -2; z <= 5; ++z) {
        const double at[3] = {static_cast<double>(x), static_cast<double>(y),
                              static_cast<double>(z)};
        const PieceBox other{{at[0], at[1], at[2]}, {at[0] + 1, at[1] + 1, at[2] + 1}};
        const auto is_near = [](int c) { return c >= -1 && c <= 4; };
        EXPECT_EQ(box.meets(other), is_near(x) && is_near(y) && is_near(z));
        EXPECT_EQ(other.meets(box), box.meets(other));
      }
    }
  }
  EXPECT_FALSE(box.meets(PieceBox()));
  EXPECT_FALSE(PieceBox().meets(box));
}

}  // namespace
}  // namespace csgrun::piece_tree_test
