// Frames: rows are shared where normals are, whatever the noise and the order.
#include "engine/csg/frames.h"

#include <array>
#include <cmath>
#include <random>
#include <set>
#include <vector>

#include <gtest/gtest.h>

#include "tests/unit/csg/test_meshes.h"

namespace csgrun::frames_test {
namespace {

using testing::rotation;
using testing::scaling;

constexpr int64_t kOne = int64_t{1} << Frame::kShift;

Affine signed_axes(const SignedPermutation& p) {
  Affine r;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) r.m[i][j] = p.axis[i] == j ? p.sign[i] : 0;
  }
  return r;
}

std::vector<SignedPermutation> all_signed_permutations() {
  std::vector<SignedPermutation> all;
  std::array<int8_t, 3> order{0, 1, 2};
  do {
    for (int s = 0; s < 8; ++s) {
      SignedPermutation p;
      p.axis = order;
      for (int i = 0; i < 3; ++i) p.sign[i] = (s >> i) & 1 ? -1 : 1;
      all.push_back(p);
    }
  } while (std::next_permutation(order.begin(), order.end()));
  return all;
}

/// The frames of a scene of transforms, as the evaluator makes them.
std::vector<CanonicalFrame> frames_of(const std::vector<Affine>& maps) {
  RowTable table;
  std::vector<LinearSplit> splits;
  std::vector<std::array<RowTable::Handle, 3>> handles;
  for (const Affine& map : maps) {
    const LinearSplit& split = splits.emplace_back(split_linear(map));
    EXPECT_TRUE(split.framed);
    handles.push_back({table.add(split, 0), table.add(split, 1), table.add(split, 2)});
  }
  std::vector<CanonicalFrame> frames;
  for (size_t leaf = 0; leaf < maps.size(); ++leaf) {
    std::array<std::array<int64_t, 3>, 3> rows;
    double least = 1;
    for (int i = 0; i < 3; ++i) {
      const auto represented = table.representative(handles[leaf][i]);
      rows[i] = integer_row(represented.row);
      if (represented.is_direction) least /= splits[leaf].lengths[i];
    }
    frames.push_back(canonical_frame(rows, least));
  }
  return frames;
}

std::array<int64_t, 3> up_to_sign(std::array<int64_t, 3> row) {
  const std::array<int64_t, 3> negative{-row[0], -row[1], -row[2]};
  return std::max(row, negative);
}

/// The row of the world normal of the leaf's local axis.
std::array<int64_t, 3> normal_of_axis(const CanonicalFrame& frame, int axis) {
  for (int i = 0; i < 3; ++i) {
    if (frame.placement.permutation.axis[i] == axis) {
      return up_to_sign(frame.placement.frame.matrix[i]);
    }
  }
  ADD_FAILURE();
  return {};
}

TEST(Frames, TeethTurnedAboutAnAxisKeepTheirTopPlaneUnderAnyRotation) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> angle(-180, 180), unit(-1, 1);
  for (int trial = 0; trial < 300; ++trial) {
    const Affine outer = rotation(angle(random), {unit(random), unit(random), unit(random)});
    std::vector<Affine> scene{outer};
    for (int tooth = 0; tooth < 24; ++tooth) {
      scene.push_back(Affine::compose(outer, rotation(tooth * 15 + 0.37 * trial, {0, 0, 1})));
    }
    std::set<std::array<int64_t, 3>> tops;
    for (const auto& frame : frames_of(scene)) {
      ASSERT_TRUE(frame.framed);
      tops.insert(normal_of_axis(frame, 2));
    }
    EXPECT_EQ(tops.size(), 1u) << "trial " << trial;
  }
}

TEST(Frames, SharedNormalsStaySharedUnderMildShearsAndScales) {
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> angle(-180, 180), unit(-1, 1), size(0.5, 2);
  for (int trial = 0; trial < 100; ++trial) {
    Affine outer = rotation(angle(random), {unit(random), unit(random), unit(random)});
    Affine shear = scaling(size(random), size(random), size(random));
    shear.m[0][1] = unit(random) * 0.5;
    outer = Affine::compose(outer, shear);
    std::vector<Affine> scene;
    for (int tooth = 0; tooth < 12; ++tooth) {
      scene.push_back(Affine::compose(outer, rotation(tooth * 17.3, {0, 0, 1})));
    }
    std::set<std::array<int64_t, 3>> tops;
    for (const auto& frame : frames_of(scene)) tops.insert(normal_of_axis(frame, 2));
    EXPECT_EQ(tops.size(), 1u) << "trial " << trial;
  }
}

TEST(Frames, AboutZTheThirdRowIsExactlyTheUnitRow) {
  std::vector<Affine> scene;
  for (int i = 0; i < 100; ++i) scene.push_back(rotation(3.7 * i + 0.1, {0, 0, 1}));
  for (const auto& frame : frames_of(scene)) {
    EXPECT_EQ(normal_of_axis(frame, 2), (std::array<int64_t, 3>{0, 0, kOne}));
  }
}

TEST(Frames, SignedPermutationsOfThePartShareItsFrame) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> angle(-180, 180), unit(-1, 1);
  for (int trial = 0; trial < 50; ++trial) {
    // Also at 45 degrees, where the order of the axes is a tie that noise must not decide.
    const Affine outer = trial < 8
                             ? rotation(45 + 90 * trial, {0, 0, 1})
                             : rotation(angle(random), {unit(random), unit(random), unit(random)});
    std::vector<Affine> scene;
    const auto all = all_signed_permutations();
    ASSERT_EQ(all.size(), 48u);
    for (const auto& p : all) scene.push_back(Affine::compose(outer, signed_axes(p)));
    const auto frames = frames_of(scene);
    for (size_t i = 0; i < frames.size(); ++i) {
      EXPECT_EQ(frames[i].placement.frame, frames[0].placement.frame) << trial << " " << i;
      // The permutations must differ by the turn itself.
      const auto relative = SignedPermutation::compose(frames[0].placement.permutation.inverse(),
                                                       frames[i].placement.permutation);
      const auto expected = SignedPermutation::compose(all[0].inverse(), all[i]);
      EXPECT_EQ(relative, expected);
    }
  }
}

TEST(Frames, TurnedBySignedPermutationsOnlyIsTheWorld) {
  for (const auto& p : all_signed_permutations()) {
    const auto frames = frames_of({Affine::compose(signed_axes(p), scaling(1.1, 2, 0.3))});
    EXPECT_TRUE(frames[0].placement.frame.is_identity);
    EXPECT_EQ(frames[0].placement.permutation, p);
  }
}

TEST(Frames, NoiseLevelRoutesGiveOneFrame) {
  const Affine twice = Affine::compose(rotation(10, {0, 0, 1}), rotation(10, {0, 0, 1}));
  Affine many;
  for (int i = 0; i < 40; ++i) many = Affine::compose(rotation(0.5, {0, 0, 1}), many);
  const Affine full = Affine::compose(rotation(380, {0, 0, 1}), scaling(1, 1, 1));
  const auto frames = frames_of({rotation(20, {0, 0, 1}), twice, many, full});
  for (const auto& frame : frames) {
    EXPECT_EQ(frame.placement.frame, frames[0].placement.frame);
    EXPECT_EQ(frame.placement.permutation, frames[0].placement.permutation);
  }
}

TEST(Frames, ClustersAreTransitiveAndLedByTheFirst) {
  RowTable table;
  const double h = 0x1p-46;
  const Row a{0.5, 0.25, 0.7}, b{0.5 + 0.9 * h, 0.25, 0.7}, c{0.5 + 1.8 * h, 0.25, 0.7},
      far{0.5 + 4 * h, 0.25, 0.7}, minus_b{-b[0], -b[1], -b[2]};
  const auto ha = table.add(a), hc = table.add(c), hf = table.add(far);
  EXPECT_NE(table.representative(hc), a);
  const auto hm = table.add(minus_b);
  EXPECT_EQ(table.representative(ha), a);
  EXPECT_EQ(table.representative(hc), a) << "joined by the row between them";
  EXPECT_EQ(table.representative(hm), (Row{-a[0], -a[1], -a[2]}));
  EXPECT_EQ(table.representative(hf), far);
}

TEST(Frames, ScaleIsTakenOutOfTheColumns) {
  const Affine map = Affine::compose(rotation(33, {1, 2, 3}), scaling(1.1, 2.5, 0.01));
  const LinearSplit split = split_linear(map);
  EXPECT_NEAR(split.scale[0], 1.1, 1e-15);
  EXPECT_NEAR(split.scale[1], 2.5, 1e-15);
  EXPECT_NEAR(split.scale[2], 0.01, 1e-17);
  EXPECT_EQ(split_linear(rotation(33, {1, 2, 3})).scale, (std::array<double, 3>{1, 1, 1}));
  EXPECT_EQ(split_linear(scaling(1.1, 0.3, 7)).scale, (std::array<double, 3>{1.1, 0.3, 7}));
}

TEST(Frames, MirrorsHaveFramesAndNearlySingularMapsHaveNone) {
  const auto frames = frames_of(
      {rotation(20, {1, 1, 0}), Affine::compose(rotation(20, {1, 1, 0}), scaling(-1, 1, 1))});
  EXPECT_EQ(frames[0].placement.frame, frames[1].placement.frame);
  EXPECT_EQ(frames[0].placement.permutation.determinant(),
            -frames[1].placement.permutation.determinant());

  Affine shear;
  shear.m[0][1] = 1e6;
  EXPECT_FALSE(split_linear(shear).framed);
  shear.m[0][1] = 100;
  EXPECT_TRUE(split_linear(shear).framed);
  EXPECT_FALSE(split_linear(scaling(1, 1, 0)).framed);
}

Affine sheared(int of, int along, double by) {
  Affine shear;
  shear.m[of][along] = by;
  return shear;
}

// x = x + s z leaves planes across Y and Z where they are.
TEST(Frames, WhatAShearLeavesParallelIsMeasuredInTheWorld) {
  for (int of = 0; of < 3; ++of) {
    for (int along = 0; along < 3; ++along) {
      if (of == along) continue;
      for (const double by : {1e-6, 0.3, -1.0, 7.3}) {
        const LinearSplit split =
            split_linear(Affine::compose(sheared(of, along, by), scaling(1.1, 0.3, 7)));
        ASSERT_TRUE(split.framed);
        EXPECT_EQ(split.scale, (std::array<double, 3>{1.1, 0.3, 7})) << by;
        for (int i = 0; i < 3; ++i) {
          if (i == of) continue;
          Row unit{};
          unit[i] = 1;
          EXPECT_EQ(split.rows[i], unit);
        }
        EXPECT_NEAR(split.rows[of][along], -by, 1e-15);
      }
    }
  }
  // Half a step along a column of Rn moves a point by as many steps.
  EXPECT_GE(split_linear(sheared(0, 2, 7.3)).longest_column, std::hypot(1, 7.3) - 1e-9);
  const LinearSplit steep = split_linear(sheared(0, 2, 100));
  EXPECT_EQ(steep.scale[2], std::hypot(1, 100));
  EXPECT_EQ(steep.longest_column, 1);
}

TEST(Frames, AShearedPartSharesTheRowsOfPartsThatAreTurnedAlike) {
  std::mt19937_64 random(13);
  std::uniform_real_distribution<double> angle(-180, 180), unit(-1, 1);
  for (int trial = 0; trial < 200; ++trial) {
    const Affine turn = rotation(angle(random), {unit(random), unit(random), unit(random)});
    const int of = trial % 3, along = (of + 1 + trial / 3 % 2) % 3;
    const Affine slanted = Affine::compose(turn, sheared(of, along, 2 * unit(random)));
    const Affine more = Affine::compose(turn, sheared(of, along, 2 * unit(random)));
    for (const auto& scene : std::vector<std::vector<Affine>>{
             {turn, slanted}, {slanted, turn}, {slanted, more}, {slanted, more, turn}}) {
      for (int axis = 0; axis < 3; ++axis) {
        std::set<std::array<int64_t, 3>> normals;
        for (const auto& frame : frames_of(scene)) {
          ASSERT_TRUE(frame.framed);
          normals.insert(normal_of_axis(frame, axis));
        }
        if (axis != of) {
          EXPECT_EQ(normals.size(), 1u) << trial;
        } else {
          EXPECT_GE(normals.size(), 2u) << trial;
        }
      }
    }
  }
}

TEST(Frames, ALongRowIsItsDirectionOnceAnotherOneIs) {
  const Affine turn = rotation(25, {1, 2, 3});
  const LinearSplit plain = split_linear(turn),
                    slanted = split_linear(Affine::compose(turn, sheared(0, 2, 0.5)));
  EXPECT_NEAR(slanted.lengths[2], std::hypot(1, 0.5), 1e-15);
  EXPECT_EQ(slanted.direction_scale[2], 1);
  RowTable table;
  const auto handle = table.add(slanted, 2);
  EXPECT_EQ(table.representative(handle).row, slanted.rows[2]);
  EXPECT_FALSE(table.representative(handle).is_direction);
  table.add(slanted, 0);
  table.add(slanted, 2);
  EXPECT_FALSE(table.has_bridged());
  const auto other = table.add(plain, 2);
  EXPECT_TRUE(table.has_bridged());
  EXPECT_TRUE(table.representative(handle).is_direction);
  EXPECT_FALSE(table.representative(other).is_direction);
  EXPECT_EQ(table.representative(handle).row, plain.rows[2]);
  EXPECT_EQ(table.representative(other).row, plain.rows[2]);
}

TEST(Frames, RowsAreTheInverse) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> unit(-1, 1);
  for (int trial = 0; trial < 200; ++trial) {
    Affine map;
    for (auto& row : map.m) {
      for (double& entry : row) entry = unit(random);
    }
    const LinearSplit split = split_linear(map);
    if (std::fabs(split.determinant) < 0.05) continue;
    ASSERT_TRUE(split.framed);
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) {
        double sum = 0;
        for (int k = 0; k < 3; ++k) sum += split.rows[i][k] * map.m[k][j] / split.scale[j];
        EXPECT_NEAR(sum, i == j ? 1 : 0, 1e-13);
      }
    }
  }
}

}  // namespace
}  // namespace csgrun::frames_test
