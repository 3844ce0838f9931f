// Roofs over 2D shapes: solids of slope 1.
#pragma once

#include <csgrun/engine/error.h>
#include <csgrun/primitives/shape2d.h>
#include <csgrun/primitives/solids.h>

namespace csgrun {

enum class RoofMethod : uint8_t {
  /// Every point lies as high as the outline is far away: around a corner that points inwards the
  /// roof is a cone, in facets.
  kVoronoi,
  /// Planes only, one over each edge: around a corner that points inwards its two planes run on
  /// until they meet (the straight skeleton).
  kStraight,
};

struct RoofOptions {
  RoofMethod method = RoofMethod::kVoronoi;
  /// Of kVoronoi: how finely the parabolas that bound cones are divided. As in OpenSCAD, no chord
  /// turns from the curve by more than half of 360 / fn degrees; without fn, of fa, and then none
  /// is longer than fs.
  Facets facets;
  /// Of kVoronoi: borders between two corners that point inwards, hyperbolas seen from the side,
  /// are divided like parabolas. Without it they are straight, as OpenSCAD has them: too high,
  /// between corners that face each other by far.
  bool divide_between_corners = true;
};

/// The solid between the shape, at z = 0, and its roof: planes that rise from the edges inwards at
/// 45 degrees. Holes have eaves too, and outlines that touch keep their own roofs. The shape is
/// taken on a grid of 2^-31 of its extent, but corners keep their coordinates. O(n log n) for
/// kVoronoi, O(n^2) for kStraight. Errors: kInvalidArgument for an empty shape or facets that are
/// not finite; kLimit for kStraight with more than 10,000 edges; kInternal where rounding
/// leaves no closed roof.
MeshResult make_roof(const Shape2D& shape, const RoofOptions& options);

}  // namespace csgrun
