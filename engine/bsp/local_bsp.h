// A labelled BSP of one operand inside one cell (Thibault & Naylor 1987; Campen & Kobbelt 2010,
// section 4.2): leaves say inside or outside, and a polygon pushed down it is cut into pieces that
// have one label in front and one behind.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/bsp/cell_geometry.h"

namespace csgrun {

/// Which of the polygons' supports to split a cell by: of a few tried, the one that splits fewest
/// others and halves the rest best.
size_t choose_splitter(CellGeometry& geometry, const std::vector<Fragment>& polygons);

/// Polygons of a cell on either side of a plane, cut by it where they cross it, and in it.
struct PartedPolygons {
  std::vector<Fragment> front, back, on;
};
PartedPolygons part_polygons(CellGeometry& geometry, const std::vector<Fragment>& polygons,
                             uint32_t plane);

class LocalBsp {
 public:
  static constexpr int32_t kOutside = -1, kInside = -2;
  struct Node {
    uint32_t plane;       ///< index; front is its positive side
    int32_t front, back;  ///< a node, or a label
  };

  /// Builds the tree from an operand's polygons, clipped to the cell. Without polygons the cell is
  /// inside or outside as `corner_inside` says. The labels follow from the polygons' orientation.
  void build(CellGeometry& geometry, const std::vector<Fragment>& polygons, bool corner_inside);

  /// A piece of a pushed polygon: whether the operand is inside just in front of it (where its
  /// support's normal points) and just behind.
  struct Piece {
    Fragment fragment;
    bool front_inside, back_inside;
  };
  /// Pushes `f` down the tree and appends its pieces. Pieces that a cut separated although their
  /// labels are the same are joined again.
  void classify(CellGeometry& geometry, const Fragment& f, std::vector<Piece>& pieces) const;

  [[nodiscard]] const std::vector<Node>& nodes() const { return nodes_; }
  [[nodiscard]] int32_t root() const { return root_; }

 private:
  int32_t build_node(CellGeometry& geometry, std::vector<Fragment> polygons);
  void push(CellGeometry& geometry, int32_t node, const Fragment& f,
            std::vector<Piece>& pieces) const;

  std::vector<Node> nodes_;
  int32_t root_ = kOutside;
};

}  // namespace csgrun
