#include "primitives/shape2d/frame2d.h"

#include <cmath>

#include <glm/geometric.hpp>

namespace csgrun {
namespace {

/// The noise of a few hundred products of turns; far below the noise that a step of the 2D grid
/// forgives (2^-12 of it) for coordinates of a metre.
constexpr double kTolerance = 0x1p-45;
constexpr double kLeastDeterminant = 0x1p-16;

bool is_close(const glm::dvec2& a, const glm::dvec2& b) {
  return std::fabs(a.x - b.x) <= kTolerance && std::fabs(a.y - b.y) <= kTolerance;
}

}  // namespace

bool Frame2D::is_rigid() const { return std::fabs(glm::dot(axes[0], axes[1])) <= kTolerance; }

Affine Frame2D::map(const glm::dvec2& origin) const {
  Affine result;
  for (int i = 0; i < 2; ++i) {
    for (int j = 0; j < 2; ++j) result.m[i][j] = axes[j][i];
    result.m[i][3] = origin[i];
  }
  return result;
}

std::optional<Split2D> split_2d(const Affine& map) {
  Split2D split;
  auto& [axes, rows] = split.frame;
  for (int j = 0; j < 2; ++j) {
    axes[j] = {map.m[0][j], map.m[1][j]};
    // Plain sums and roots give the same bits on every machine.
    const double norm = std::sqrt(glm::dot(axes[j], axes[j]));
    if (!(norm >= 1e-100 && norm <= 1e100)) return std::nullopt;
    if (std::fabs(norm - 1) <= kTolerance) continue;
    split.scale[j] = norm;
    axes[j] /= norm;
  }
  const double determinant = axes[0].x * axes[1].y - axes[0].y * axes[1].x;
  if (!(std::fabs(determinant) >= kLeastDeterminant)) return std::nullopt;
  rows = {glm::dvec2(axes[1].y, -axes[1].x) / determinant,
          glm::dvec2(-axes[0].y, axes[0].x) / determinant};
  return split;
}

std::optional<QuarterTurn> quarter_turn(const Frame2D& common, const Frame2D& frame) {
  QuarterTurn turn;
  for (int i = 0; i < 2; ++i) {
    bool found = false;
    for (int j = 0; j < 2 && !found; ++j) {
      for (const int sign : {1, -1}) {
        if (!is_close(common.rows[i], static_cast<double>(sign) * frame.rows[j])) continue;
        turn.axis[i] = j;
        turn.sign[i] = sign;
        found = true;
      }
    }
    if (!found) return std::nullopt;
  }
  if (turn.axis[0] == turn.axis[1]) return std::nullopt;
  return turn;
}

std::optional<Split2D> find_turn(const Affine& map) {
  std::optional<Split2D> split = split_2d(map);
  if (split && quarter_turn(Frame2D(), split->frame)) split.reset();
  return split;
}

}  // namespace csgrun
