// How a surface that crosses itself divides one cell: an unlabelled BSP whose leaves are joined,
// across what no polygon covers, to the volumes that the surface leaves (Campen & Kobbelt 2010,
// section 6.2: flood filling of the cell adjacency graph).
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "engine/bsp/cell_walls.h"
#include "engine/bsp/local_bsp.h"
#include "engine/bsp/union_find.h"

namespace csgrun {

class CellArrangement {
 public:
  /// A piece of the surface: convex, with one volume on either side. Pieces do not overlap.
  struct Part {
    Fragment fragment;  ///< seen from the positive side of its plane; of the lowest polygon there
    uint32_t front, back;   ///< volumes on the positive and on the negative side
    bool has_up, has_down;  ///< polygons that face the positive side lie here, and the reverse
  };

  /// Arranges polygons that were clipped to the cell; `corner_winding` is the winding number at the
  /// cell's lowest corner, moved as in surface_octree.h. False when the winding numbers contradict
  /// each other: the surface is not closed.
  /// O(n^3) for n polygons in general position.
  bool build(CellGeometry& geometry, const Job& job, const CellBox& box, const CellWalls& walls,
             const std::vector<Fragment>& polygons, int32_t corner_winding);

  [[nodiscard]] const std::vector<Part>& parts() const { return parts_; }
  /// Per volume.
  [[nodiscard]] const std::vector<int32_t>& windings() const { return windings_; }
  /// The volume at a point of the cell (of the geometry), moved by (-e, -e^2, -e^3) for an
  /// infinitely small e.
  [[nodiscard]] uint32_t volume_below(CellGeometry& geometry, uint32_t point) const;

 private:
  struct Node {
    uint32_t plane;
    int32_t front, back;                ///< a node, or ~leaf
    uint32_t first_covering, covering;  ///< polygons in the plane, into covering_
    Fragment facet;                     ///< the plane inside the node's region
  };
  struct PathStep {
    uint32_t plane;
    bool front;
  };
  /// A piece of a facet between two leaves.
  struct Face {
    Fragment fragment;
    uint32_t front, back;
  };
  /// A piece of a face, by what covers it.
  struct Covered {
    Fragment fragment;
    int32_t winding_step = 0;  ///< of the back over the front
    bool has_up = false, has_down = false;
  };
  struct Contact {
    uint32_t front, back;  ///< leaves
    int32_t winding_step;
  };

  int32_t build_node(std::vector<Fragment> polygons);
  Fragment facet_of(uint32_t plane);
  void push(int32_t node, const Fragment& f, std::vector<std::pair<Fragment, uint32_t>>& out);
  void split_facet(const Node& node);
  void cover(const Node& node, const Face& face);
  bool label(uint32_t corner_leaf, int32_t corner_winding);
  uint32_t leaf_at_corner(const Job& job, const IVec3& corner) const;

  CellGeometry* geometry_ = nullptr;
  CellWalls walls_{};
  std::vector<Node> nodes_;
  std::vector<Fragment> covering_;
  std::vector<PathStep> path_;
  uint32_t leaf_count_ = 0;
  int32_t root_ = 0;
  UnionFind leaves_;  ///< joined across what no polygon covers
  std::vector<Contact> contacts_;
  std::vector<Part> parts_;
  std::vector<uint32_t> volume_of_leaf_;
  std::vector<int32_t> windings_;
  std::vector<std::pair<Fragment, uint32_t>> front_pieces_, back_pieces_;
  std::vector<Covered> pieces_, next_pieces_;
};

}  // namespace csgrun
