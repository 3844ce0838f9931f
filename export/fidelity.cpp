#include "export/fidelity.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include <glm/geometric.hpp>

#include <csgrun/engine/exact_triangles.h>

#include "export/none.h"

namespace csgrun {
namespace {

/// Twice what is explained is allowed: turned edges and the roundings of these sums move a little
/// as well.
constexpr double kAllowance = 2;

double area_of(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
  return glm::length(glm::cross(b - a, c - a)) / 2;
}

std::string number(double x) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", x);
  return text;
}

}  // namespace

double unit_of(Precision precision, std::span<const glm::dvec3> positions) {
  double largest = 0;
  for (const glm::dvec3& p : positions)
    largest = std::max({largest, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
  int exponent = 0;  // largest < 2^exponent
  std::frexp(largest, &exponent);
  return std::ldexp(1.0, exponent - (precision == Precision::kFloat ? 24 : 53));
}

void Moves::add(std::span<const glm::dvec3> positions, std::span<const Triangle> triangles,
                double by) {
  if (by == 0) return;
  distance += by;
  for (const auto& [a, b, c] : triangles) {
    // Half the cross product of two sides, each of which changes by up to 2 * by.
    const glm::dvec3 &p = positions[a], &q = positions[b], &r = positions[c];
    const double sides[3] = {glm::length(q - p), glm::length(r - q), glm::length(p - r)};
    const double two = sides[0] + sides[1] + sides[2] - std::max({sides[0], sides[1], sides[2]});
    volume += by * (area_of(p, q, r) + by * (two + 2 * by));
  }
}

double SolidShell::thickness() const { return area > 0 ? 2 * std::abs(volume) / area : 0; }

Result<Fidelity> Fidelity::of(const Solid& solid, const Affine& placement, Precision precision) {
  Fidelity result;
  PlacedSolid placed = place_solid(solid, placement);
  result.positions_ = std::move(placed.positions);
  result.triangles_ = solid.triangles;
  if (placed.mirrored) {
    for (Triangle& t : result.triangles_) std::swap(t[1], t[2]);
  }
  result.triangle_face_ = solid.triangle_face;
  const auto twins = manifold_twins(result.triangles_, result.positions_.size());
  if (!twins) return twins.error();
  result.shell_ = shells_of(*twins);
  result.volume_ = exact_volume({result.positions_, result.triangles_});
  result.unit_ = unit_of(precision, result.positions_);
  result.rounding_.add(result.positions_, result.triangles_, result.unit_);
  return result;
}

std::vector<SolidShell> Fidelity::vanished(std::span<const uint32_t> triangle_face) const {
  uint32_t faces = 0, shells = 0;
  for (const uint32_t face : triangle_face_) faces = std::max(faces, face + 1);
  for (const uint32_t shell : shell_) shells = std::max(shells, shell + 1);
  std::vector<bool> face_left(faces, false), shell_left(shells, false);
  for (const uint32_t face : triangle_face) face_left[face] = true;
  for (size_t t = 0; t < shell_.size(); ++t) {
    if (face_left[triangle_face_[t]]) shell_left[shell_[t]] = true;
  }
  std::vector<std::vector<Triangle>> gone;
  std::vector<uint32_t> number_of(shells, kNone);
  std::vector<SolidShell> result;
  for (size_t t = 0; t < shell_.size(); ++t) {
    if (shell_left[shell_[t]]) continue;
    uint32_t& n = number_of[shell_[t]];
    if (n == kNone) {
      n = static_cast<uint32_t>(result.size());
      result.emplace_back();
      result.back().at = positions_[triangles_[t][0]];
      result.back().face = triangle_face_[t];
      gone.emplace_back();
    }
    gone[n].push_back(triangles_[t]);
    const auto& [a, b, c] = triangles_[t];
    result[n].area += area_of(positions_[a], positions_[b], positions_[c]);
  }
  for (size_t i = 0; i < result.size(); ++i) result[i].volume = exact_volume({positions_, gone[i]});
  return result;
}

std::string Fidelity::breach(const RoundedMesh& mesh, std::span<const uint32_t> triangle_face,
                             const Moves& moves) const {
  const double change = exact_volume({mesh.positions, mesh.triangles}) - volume_;
  if (!(std::abs(change) <= kAllowance * moves.volume)) {
    return "the volume would change by " + number(change) + " mm^3, and moves of at most " +
           number(moves.distance) + " mm do not explain that";
  }
  // A file of nothing says nothing of how little there was: only what its numbers cannot tell from
  // nothing goes altogether.
  const double thinnest = mesh.triangles.empty() ? unit_ : 2 * moves.distance;
  for (const SolidShell& shell : vanished(triangle_face)) {
    if (shell.thickness() <= thinnest) continue;
    return "a connected surface of " + number(shell.area) + " mm^2 around " +
           number(std::abs(shell.volume)) + " mm^3 would vanish";
  }
  return {};
}

}  // namespace csgrun
