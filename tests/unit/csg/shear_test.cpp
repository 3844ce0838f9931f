// Sheared parts beside others: what is flush with them is joined, and what they cut through is
// open, whatever turns all of it.
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include <csgrun/engine/evaluate.h>

#include "test_meshes.h"

namespace csgrun::shear_test {
namespace {

using namespace testing;

/// Numbers with few decimals, as they are typed.
class Decimals {
 public:
  explicit Decimals(uint32_t seed) : random_(seed) {}
  double between(int lo, int hi, int parts) {
    return static_cast<double>(std::uniform_int_distribution(lo, hi)(random_)) / parts;
  }
  /// Moves points of axis `of` along with those of another one.
  Affine shear(int of, int along) {
    Affine map;
    map.m[of][along] = between(-200, 200, 100);
    return map;
  }
  Affine turn() {
    return rotation(between(-1800, 1800, 10),
                    {between(-9, 9, 10), between(-9, 9, 10), between(1, 9, 10)});
  }

 private:
  std::mt19937 random_;
};

/// The axes of a shear, and how all of it is turned: every other round not at all.
struct Standing {
  int of, along;
  Affine map;
};
Standing standing(Decimals& random, int round) {
  Standing result{round % 3, (round + 1 + round / 3 % 2) % 3, {}};
  if (round % 2 == 1) result.map = random.turn();
  return result;
}

void expect_one(const NodePtr& root, double volume, int64_t genus, int round) {
  const SolidPtr solid = solid_of(root, false);
  EXPECT_EQ(solid->measures.components, 1) << round;
  EXPECT_EQ(solid->measures.genus, genus) << round;
  // A turned part is on a grid of its own.
  EXPECT_NEAR(solid->measures.volume, volume, (round % 2 == 1 ? 1e-6 : 1e-12) * volume) << round;
}

glm::dvec3 along_axis(int axis, double length, double across) {
  glm::dvec3 size(across);
  size[axis] = length;
  return size;
}

TEST(Shear, ABlockOnAShearedBlock) {
  Decimals random(21);
  for (int round = 0; round < 60; ++round) {
    const Standing at = standing(random, round);
    const double height = random.between(1, 330, 10);
    // The lower one is so wide that its top, moved, is under part of the upper one.
    const Affine shear = random.shear(at.of, at.along);
    const double move = shear.m[at.of][at.along] * height;
    const NodePtr lower = Node::transformed(shear, box({0, 0, 0}, along_axis(at.along, height, 5)));
    glm::dvec3 from(0), to(5);
    from[at.of] = move + 1, to[at.of] = move + 6;
    from[at.along] = height, to[at.along] = height + 5;
    const NodePtr upper = box(from, to);
    expect_one(Node::transformed(at.map, unite({lower, upper})), 25 * height + 125, 0, round);
  }
}

TEST(Shear, ASlantedHoleIsOpen) {
  Decimals random(22);
  for (int round = 0; round < 60; ++round) {
    const Standing at = standing(random, round);
    const double height = random.between(1, 100, 10);
    const Affine shear = random.shear(at.of, at.along);
    glm::dvec3 from(-400), to(400);
    from[at.along] = 0, to[at.along] = height;
    const NodePtr plate = box(from, to);
    const NodePtr hole = Node::transformed(shear, box({0, 0, 0}, along_axis(at.along, height, 2)));
    expect_one(Node::transformed(at.map, subtract({plate, hole})), (640'000 - 4) * height, 1,
               round);
  }
}

TEST(Shear, TwoThatLeanDifferentlyInOneTurn) {
  Decimals random(23);
  for (int round = 1; round < 60; round += 2) {
    const Standing at = standing(random, round);
    const double height = random.between(1, 50, 10);
    const NodePtr lower = Node::transformed(random.shear(at.of, at.along),
                                            box(glm::dvec3(0), along_axis(at.along, height, 400)));
    Affine lean = random.shear(at.of, at.along);
    lean.m[at.along][3] = height;
    lean.m[at.of][3] = 200;
    const int across = 3 - at.of - at.along;
    lean.m[across][3] = 100;
    const NodePtr upper = Node::transformed(lean, box(glm::dvec3(0), glm::dvec3(5)));
    expect_one(Node::transformed(at.map, unite({lower, upper})), 160'000 * height + 125, 0, round);
  }
}

}  // namespace
}  // namespace csgrun::shear_test
