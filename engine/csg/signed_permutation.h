// The 48 signed permutations of the axes: the part of a transform that the integer grid itself
// bears.
#pragma once

#include <array>
#include <cstdint>

#include "engine/bsp/operand.h"

namespace csgrun {

/// The map out[i] = sign[i] * in[axis[i]].
struct SignedPermutation {
  std::array<int8_t, 3> axis{0, 1, 2};
  std::array<int8_t, 3> sign{1, 1, 1};

  bool operator==(const SignedPermutation&) const = default;
  [[nodiscard]] bool is_identity() const { return *this == SignedPermutation{}; }

  template <class Vector>
  [[nodiscard]] Vector apply(const Vector& in) const {
    Vector out = in;
    for (int i = 0; i < 3; ++i) out[i] = sign[i] < 0 ? -in[axis[i]] : in[axis[i]];
    return out;
  }

  [[nodiscard]] SignedPermutation inverse() const {
    SignedPermutation r;
    for (int i = 0; i < 3; ++i) {
      r.axis[axis[i]] = static_cast<int8_t>(i);
      r.sign[axis[i]] = sign[i];
    }
    return r;
  }

  /// The map that applies `inner` first, then `outer`.
  static SignedPermutation compose(const SignedPermutation& outer, const SignedPermutation& inner) {
    SignedPermutation r;
    for (int i = 0; i < 3; ++i) {
      r.axis[i] = inner.axis[outer.axis[i]];
      r.sign[i] = static_cast<int8_t>(outer.sign[i] * inner.sign[outer.axis[i]]);
    }
    return r;
  }

  [[nodiscard]] int determinant() const {
    const bool even = (axis[0] == 0 && axis[1] == 1) || (axis[0] == 1 && axis[1] == 2) ||
                      (axis[0] == 2 && axis[1] == 0);
    return (even ? 1 : -1) * sign[0] * sign[1] * sign[2];
  }

  /// This map after the frame's map from the world: a frame with turned axes.
  [[nodiscard]] Frame apply_to_frame(const Frame& frame) const {
    constexpr int64_t one = int64_t{1} << Frame::kShift;
    Frame r;
    auto in = frame.matrix;
    if (frame.is_identity) in = {{{one, 0, 0}, {0, one, 0}, {0, 0, one}}};
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) r.matrix[i][j] = sign[i] * in[axis[i]][j];
    }
    r.is_identity = frame.is_identity && is_identity();
    return r;
  }
};

/// The frame of the world: the identity, with its matrix filled in.
inline Frame world_frame() { return SignedPermutation{}.apply_to_frame(Frame{}); }

}  // namespace csgrun
