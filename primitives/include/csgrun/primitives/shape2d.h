// 2D shapes as values: outlines on an integer grid, their Booleans, and extrusion to solids.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <csgrun/engine/csg_tree.h>
#include <csgrun/primitives/solids.h>

namespace csgrun {

/// A 2D region: loops in millimetres, outer ones counter-clockwise, holes clockwise, free of
/// crossings (loops may touch, one another only in vertices that both have). Each loop starts at
/// its smallest point (by x, then y) and visits a vertex once; loops are sorted. Immutable; copies
/// share the data.
///
/// Results of Booleans and polygons lie on a decimal grid: the step is 2^-6 nm (1.5625e-8 mm) up to
/// coordinates of 17 m, then 2^-3 nm, 2^0 nm and so on by eights. On that grid everything is exact
/// but the points where edges cross, which are rounded to it. A lone square or circle, and
/// transforms of any shape, keep their doubles.
///
/// A shape remembers what it was before it was turned, and its turn: the frame. Booleans combine
/// shapes of one frame there, on a grid of its axes from the first shape's origin on, so what was
/// flush stays flush and `T(a) - T(b)` is `T(a - b)`. Frames that differ by quarter turns and
/// mirrors along the axes are one. Where as much of the outlines runs along the world's axes as
/// along the turned ones (a hexagon that was turned by 30 degrees), the world decides as it does
/// without a turn. Shapes of several frames meet in the world, those of each frame combined first
/// where the operation lets them.
class Shape2D {
 public:
  using Loop = std::vector<glm::dvec2>;
  /// A connected piece: one outer loop and the holes in it, as indices into loops().
  struct Region {
    uint32_t outer = 0;
    std::vector<uint32_t> holes;
  };

  Shape2D() = default;  ///< the empty region
  /// Any outlines, by default under the even-odd rule; snapped to the 2D grid, cleaned. Outlines
  /// that enclose nothing give the empty shape. Errors: kInvalidArgument for coordinates that are
  /// not finite, kOutOfRange beyond 1e12 mm.
  static Result<Shape2D> from_outlines(const std::vector<Loop>& outlines,
                                       FillRule fill = FillRule::kEvenOdd);

  [[nodiscard]] const std::vector<Loop>& loops() const;
  /// In the order of their outer loops; each loop is in exactly one region.
  [[nodiscard]] const std::vector<Region>& regions() const;
  [[nodiscard]] bool empty() const { return loops().empty(); }
  /// In mm^2.
  [[nodiscard]] double area() const;
  /// The smallest and largest coordinates; both 0 when empty.
  [[nodiscard]] std::array<glm::dvec2, 2> bounds() const;
  /// Whether p, rounded to the 2D grid, is inside or on the boundary.
  [[nodiscard]] bool contains(const glm::dvec2& p) const;

  /// A difference is the first operand less all others. One operand comes back as it is. Errors:
  /// kOutOfRange beyond 1e12 mm.
  static Result<Shape2D> boolean(BooleanOp op, const std::vector<Shape2D>& operands);
  /// Uses the entries (0,0) (0,1) (0,3) (1,0) (1,1) (1,3) of the map. A map of determinant 0 gives
  /// the empty shape. Errors: kInvalidArgument when the result is not finite.
  [[nodiscard]] Result<Shape2D> transformed(const Affine& map) const;

  /// The memory of the loops, and of those that it remembers.
  [[nodiscard]] size_t bytes() const;

 private:
  struct Turn;
  struct Data {
    std::vector<Loop> loops;
    std::vector<Region> regions;
    std::shared_ptr<const Turn> turn;  ///< null: the frame is the world's
    double noise = 0;                  ///< Shape2DFactory::noise_of
    /// Of the grid on which an arrangement gave the loops, the steps per mm; else 0. Then, for each
    /// loop, one of those that it is connected with by points in common.
    double arranged_steps = 0;
    std::vector<uint32_t> group_of;
  };
  friend class Shape2DFactory;
  std::shared_ptr<const Data> data_;
};

/// Errors: kInvalidArgument for sizes that are not positive and finite.
Result<Shape2D> make_square(const glm::dvec2& size, std::array<bool, 2> center = {false, false});
/// Quarters of a circle of radius r at the corners, each in ceil(fragments(r) / 4) steps. Errors:
/// kInvalidArgument as above, and when two radii are longer than a side.
Result<Shape2D> make_rounded_square(const glm::dvec2& size, double r, const Facets& facets,
                                    std::array<bool, 2> center = {false, false});
Result<Shape2D> make_circle(double r, const Facets& facets);
/// No paths: one outline of all points. With paths: all outlines together, even-odd; winding and
/// order do not matter. Errors: kInvalidArgument for fewer than 3 points in an outline, indices out
/// of range, or outlines that enclose no area.
Result<Shape2D> make_polygon(const std::vector<glm::dvec2>& points,
                             const std::vector<std::vector<uint32_t>>& paths);

struct LinearExtrudeOptions {
  double height = 100;                  ///< mm; not used when only `direction` is given
  std::optional<glm::dvec3> direction;  ///< OpenSCAD's `v`; normalised when `height_given`
  bool height_given = false;
  bool center = false;        ///< moves the solid by half its height vector
  glm::dvec2 scale{1, 1};     ///< of the top; 0 makes a point or an edge there
  double twist = 0;           ///< degrees over the whole height, clockwise seen from above
  std::optional<int> slices;  ///< at least 1
  /// Radii of the bottom's and of the top's edges, mm; 0 leaves them sharp. Not with a twist, a
  /// scale or a direction aslant.
  std::array<double, 2> round{0, 0};
  std::optional<int> segments;  ///< target number of vertices a loop; 0: edges are never split
  Facets facets;
};
/// The bottom is at z = 0 (or -height/2). Faces: caps (flat), sides as quads where they are planar,
/// else two triangles, cut along the shorter diagonal (below a top that is an edge: cut alike). A
/// loop of 12 vertices or more that turns by less than 40 degrees everywhere is one curved surface;
/// with a twist every chain of such turns is. Rounded edges run in quarters of a circle of
/// ceil(fragments(r) / 4) steps; corners of the outline stay sharp. A radius at which an edge of
/// the outline would vanish, or walls meet, is refused, but a piece may come down to a point or a
/// ridge at it. Errors: kInvalidArgument, kLimit.
MeshResult linear_extrude(const Shape2D& shape, const LinearExtrudeOptions& options);

struct RotateExtrudeOptions {
  double angle = 360;  ///< degrees; -360 or less, or more than 360, is a full turn
  double start = 0;    ///< the caller decides OpenSCAD's 180 for a full turn without `angle`
  Facets facets;
};
/// The shape's Y becomes Z, positive angles turn counter-clockwise seen from above. Points on the
/// axis collapse. Chains of profile edges that turn by less than 40 degrees are one curved surface;
/// horizontal ones are flat. Errors: kInvalidArgument when the shape crosses the axis or the angle
/// is 0, kLimit.
MeshResult rotate_extrude(const Shape2D& shape, const RotateExtrudeOptions& options);
/// The same as a tree, made at `where`. The ends of a part of a turn lie exactly in planes through
/// the axis, so that those of different profiles at one angle are flush, and so is what is turned
/// by that angle. (Not where the ends are less than a tenth of a degree apart.) `make_leaf` makes
/// the leaves, of which there are one to three; null: Node::leaf.
using MakeLeaf = std::function<NodePtr(PolygonMesh)>;
Result<NodePtr> rotate_extrude_solid(const Shape2D& shape, const RotateExtrudeOptions& options,
                                     const SourceRef& where, const MakeLeaf& make_leaf = nullptr);

}  // namespace csgrun
