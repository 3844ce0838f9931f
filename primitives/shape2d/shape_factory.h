// Makes shapes from loops that are known to be clean, and clean loops from arrangements.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include <csgrun/primitives/shape2d.h>

#include "primitives/shape2d/frame2d.h"
#include "primitives/shape2d/grid2d.h"
#include "primitives/shape2d/regions.h"

namespace csgrun {

/// The order of the loops of a shape: by their points, from the first on.
bool is_before(const Shape2D::Loop& a, const Shape2D::Loop& b);
/// The largest coordinate, in absolute value.
double extent_of(const std::vector<Shape2D::Loop>& loops);
bool all_finite(const std::vector<Shape2D::Loop>& loops);
/// The grid for coordinates up to `extent` mm. Errors: kOutOfRange.
Result<Grid2D> grid_for(double extent);
GridLoop snap_loop(const Grid2D& grid, const Shape2D::Loop& loop);

/// A shape under a map that turns: its loops are those of `base`, mapped.
struct Shape2D::Turn {
  std::shared_ptr<const Data> base;  ///< has no turn
  Affine map;                        ///< its entries for z are the identity's
  Split2D split;                     ///< of the map
};

class Shape2DFactory {
 public:
  using Loop = Shape2D::Loop;
  using Turn = Shape2D::Turn;

  /// Null for the world's frame.
  static const Turn* turn_of(const Shape2D& shape);
  static Shape2D base_of(const Turn& turn);
  /// Whether edges along the axes of the world are as long in all as those along the turned axes,
  /// and there are any: then what is flush is so in the world. REQUIRES: turned shapes.
  static bool are_upright(const std::vector<Shape2D>& shapes);
  /// What a turned shape was before its last rigid motion; nothing for a shape without a turn, one
  /// that was sheared, and one that is upright.
  struct BeforeTurn {
    Shape2D shape;
    Affine motion;
  };
  static std::optional<BeforeTurn> before_turn(const Shape2D& shape);

  /// How far rounding may have put a corner of the shape beside a straight edge, mm: two steps of
  /// the grid on which its points, or those of what it was made of, were rounded, as large as the
  /// shape was scaled since then. 0 for what was never on a grid: there each corner is meant.
  static double noise_of(const Shape2D& shape) { return shape.data_ ? shape.data_->noise : 0; }
  /// The shape with so much noise, unless it has more.
  static Shape2D with_noise(Shape2D shape, double noise);

  /// GridRegions::group_of; nothing unless the shape is in the world's frame, and an arrangement on
  /// the grid gave its loops.
  static std::span<const uint32_t> group_of(const Shape2D& shape, const Grid2D& grid);
  /// For each loop the outer loop of its region, as in GridRegions.
  static std::vector<uint32_t> outer_of(const Shape2D& shape);
  /// `regions` without groups: it is not known that an arrangement on the grid gave them. `more`:
  /// loops on the grid after those of the regions, which say of all how they lie.
  static Shape2D from_grid(const Grid2D& grid, const GridRegions& regions,
                           std::vector<Loop> more = {});
  /// Loops with the right directions, in any order and from any start; outer_of as in GridRegions.
  static Shape2D canonical(std::vector<Loop> loops, const std::vector<uint32_t>& outer_of,
                           std::shared_ptr<const Turn> turn = nullptr);
  /// `base`, which has no turn, under a map that turns, and that map's split. Errors:
  /// kInvalidArgument when the result is not finite.
  static Result<Shape2D> turned(const Shape2D& base, const Affine& map, const Split2D& split);
  /// Where inside(first, rest) holds, as in extract_regions. Errors: kInternal.
  static Result<Shape2D> arranged(const Grid2D& grid, std::vector<Segment2D> segments,
                                  const std::function<bool(int32_t, int32_t)>& inside);

 private:
  static std::shared_ptr<Shape2D::Data> in_order(std::vector<Loop> loops,
                                                 const std::vector<uint32_t>& outer_of,
                                                 std::vector<uint32_t>& rank);
};

}  // namespace csgrun
