// Random frames: rotations, mirrors and shears as the integer matrices that leaves carry.
#pragma once

#include <array>

#include "engine/bsp/operand.h"
#include "tests/support/seeded.h"

namespace csgrun::test {

using Matrix = std::array<std::array<double, 3>, 3>;

Matrix times(const Matrix& a, const Matrix& b);

Matrix turn_about(int axis, double degrees);

/// The frame whose map from the world is `inverse`.
Frame frame_of(const Matrix& inverse);

/// A turn about one axis by whole degrees (which keeps that axis' planes), about all three, the
/// same with a mirror, or a shear.
Frame random_frame(Random& random);

}  // namespace csgrun::test
