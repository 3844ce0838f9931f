// Frames of 2D shapes: the turned axes in which shapes under one turn are combined, so that what is
// flush before it is flush after it (the engine has the same in 3D, engine/csg/frames.h).
#pragma once

#include <array>
#include <optional>

#include <glm/vec2.hpp>

#include <csgrun/engine/csg_tree.h>

namespace csgrun {

/// Turned axes: the linear part of a map with columns of length 1.
struct Frame2D {
  std::array<glm::dvec2, 2> axes{glm::dvec2(1, 0), glm::dvec2(0, 1)};
  std::array<glm::dvec2, 2> rows{glm::dvec2(1, 0), glm::dvec2(0, 1)};  ///< of the inverse

  /// Whether lengths and angles stay as they are, to within 2^-45.
  [[nodiscard]] bool is_rigid() const;
  /// x -> origin + axes x.
  [[nodiscard]] Affine map(const glm::dvec2& origin) const;
};

/// The linear part of a map: first along the axes by `scale`, then the frame. A length within 2^-45
/// of 1 is 1.
struct Split2D {
  Frame2D frame;
  std::array<double, 2> scale{1, 1};
};

/// Uses the entries of Shape2D::transformed. Nothing when the map is nearly singular (|determinant|
/// of the frame < 2^-16) or its entries are beyond the range of squares.
std::optional<Split2D> split_2d(const Affine& map);

/// The map out[i] = sign[i] * in[axis[i]]: quarter turns and mirrors along the axes.
struct QuarterTurn {
  std::array<int, 2> axis{0, 1};
  std::array<int, 2> sign{1, 1};

  [[nodiscard]] glm::dvec2 apply(const glm::dvec2& in) const {
    return {sign[0] * in[axis[0]], sign[1] * in[axis[1]]};
  }
  [[nodiscard]] bool mirrors() const { return (axis[0] == 0) != (sign[0] * sign[1] > 0); }
};

/// The quarter turn that leads from the axes of `frame` to those of `common`, or nothing when no
/// such turn does, to within 2^-45 in every entry.
std::optional<QuarterTurn> quarter_turn(const Frame2D& common, const Frame2D& frame);

/// Where a map turns by other than quarters: its split; else nothing, as for maps without one.
std::optional<Split2D> find_turn(const Affine& map);

}  // namespace csgrun
