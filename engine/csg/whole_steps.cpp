#include "engine/csg/whole_steps.h"

#include <array>

#include "engine/csg/frames.h"
#include "engine/csg/grid.h"
#include "engine/csg/grid_solid.h"

namespace csgrun {

Affine by_whole_steps(const Affine& map, const GridStep& step) {
  const LinearSplit split = split_linear(map);
  if (!split.framed) return map;
  RowTable table;  // it knows the unit rows by their noise
  std::array<Row, 3> rows;
  std::array<std::array<int64_t, 3>, 3> whole;
  for (int i = 0; i < 3; ++i) {
    rows[i] = table.representative(table.add(split.rows[i]));
    whole[i] = integer_row(rows[i]);
  }
  const CanonicalFrame canonical = canonical_frame(whole);
  if (!canonical.framed) return map;
  Row offset;
  for (int i = 0; i < 3; ++i) offset[i] = carry_translation(rows[i], map);
  const SignedPermutation& permutation = canonical.placement.permutation;
  const Row turned = permutation.apply(offset);
  const Quantiser quantiser(step);
  IVec3 steps;
  for (int i = 0; i < 3; ++i) {
    const auto rounded = quantiser(turned[i]);
    if (!rounded) return map;
    steps[i] = *rounded;
  }
  const glm::dvec3 mm = to_millimetres({permutation.inverse().apply(steps)}, step)[0];
  // The axes of the leaf are the columns of the map but for their lengths.
  Affine result = map;
  for (int i = 0; i < 3; ++i) {
    result.m[i][3] = 0;
    for (int j = 0; j < 3; ++j) result.m[i][3] += map.m[i][j] / split.scale[j] * mm[j];
  }
  return result;
}

}  // namespace csgrun
