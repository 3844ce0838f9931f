// Solids from outlines along a path, and between outlines at different heights.
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <csgrun/engine/error.h>
#include <csgrun/primitives/shape2d.h>
#include <csgrun/primitives/solids.h>

namespace csgrun {

struct SweepOptions {
  std::vector<glm::dvec3> path;  ///< at least two points, three of a closed one; mm
  bool closed = false;           ///< the last point is joined to the first; no caps
  double twist = 0;  ///< degrees over the whole path, counter-clockwise seen against its direction
  glm::dvec2 scale{1, 1};  ///< of the outline at the end; 0 both ways: a point
  /// Where the outline's Y points to, as far as it is across the path there, at its start; Z, or Y
  /// where the path starts along Z.
  std::optional<glm::dvec3> up = std::nullopt;
  /// It points there along the whole path, as far as that is across it: on a helix the least
  /// rotation alone leans the outline ever more.
  bool upright = false;
  /// With a twist or two scales, the path and long edges of the outline are divided as finely as
  /// linear_extrude divides its height and its outline; the path not between bends that are nearer
  /// to one another than the outline is wide.
  Facets facets = {};
};

/// The outline, its plane across the path, moved along it. From piece to piece it turns no more
/// than the path does (a frame of minimal rotation); pieces are mitred where they meet, so each of
/// them is a prism of the outline. Where the path turns more sharply than the outline has room for,
/// the walls cross, and the solid is what they wind around. A closed sweep makes up for the turn
/// that such a frame has gathered when it comes home, evenly along the path; its twist is a
/// multiple of 360. Where the outline is upright, no piece of the path may go along `up`. Equal
/// points one after another count once. Errors: kInvalidArgument, kLimit.
MeshResult sweep_shape(const Shape2D& shape, const SweepOptions& options);
/// The same as a tree, made at `where`: a leaf less a box for each end that is not across an axis.
/// So these ends are planes, which depend on the place and the direction of the path there, and
/// those of different outlines, or of sweeps that go on from one another, are flush. (Not where
/// other parts of the sweep are so near that there is no room for it.) `make_leaf` makes the
/// leaves; null: Node::leaf.
Result<NodePtr> sweep_solid(const Shape2D& shape, const SweepOptions& options,
                            const SourceRef& where, const MakeLeaf& make_leaf = nullptr);

/// What lies at a height of a loft: a shape, or a point of which the walls rise or to which they
/// come together.
struct LoftOutline {
  LoftOutline(Shape2D outline) : shape(std::move(outline)) {}
  LoftOutline(const glm::dvec2& apex) : point(apex) {}
  Shape2D shape;
  std::optional<glm::dvec2> point = std::nullopt;
};

/// A solid between outlines, each flat at its height: straight walls from each to the next. All
/// must have the same numbers of pieces and of holes in them; these are paired by the places of
/// their middles. Points are paired by how far along their outline they lie, from that pair of
/// corners on which gives the shortest walls. Only the first or the last may be a point, which all
/// pieces and holes share. Heights increase. Errors: kInvalidArgument, kLimit.
MeshResult loft_shapes(const std::vector<LoftOutline>& outlines,
                       const std::vector<double>& heights);

}  // namespace csgrun
