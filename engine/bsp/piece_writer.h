// What a job gives, put into a store of pieces.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "engine/bsp/assemble.h"
#include "engine/bsp/convexify.h"
#include "engine/bsp/fragment_set.h"
#include "engine/bsp/near_faces.h"
#include "engine/bsp/piece_store.h"
#include "engine/bsp/point_index.h"
#include "engine/bsp/regions.h"

namespace csgrun {

/// Puts what a job gives into a store.
class PieceWriter {
 public:
  PieceWriter(Job& job, const std::vector<Operand>& operands, PieceStore& store)
      : job_(job),
        operands_(operands),
        store_(store),
        geometry_(job.planes(), &job),
        index_(geometry_),
        regions_(geometry_, job.planes()),
        wall_of_([&job](int axis, int64_t m) { return job.wall(axis, m); }) {}

  /// Tells the store of operands that are not in pieces; false if one cannot be.
  bool add_operands();

  /// Has a vertex of the job be the same point of the store as another one.
  void set_same(uint32_t vertex, uint32_t other) {
    same_.resize(job_.vertex_count(), kNone);
    same_[vertex] = other;
  }

  /// Polygons that are kept. Ones in pieces must be turned over; others are there already. Of
  /// leaves those that nothing met become groups. `far`, per operand or empty: faces that
  /// the job does not have, which are kept, too.
  void add_whole(std::span<const WholePolygon> whole, std::span<const FarFaces> far = {});

  /// Pieces of polygons that were cut; false if they do not close up.
  bool add_cut(const std::vector<FragmentSet>& sets);

  std::vector<uint32_t> added;  ///< pieces

 private:
  void add_single(const WholePolygon& w);
  /// Whole faces of a leaf that nothing met, on one side: they end up in groups of what
  /// is together.
  void add_groups(uint32_t operand, std::span<const uint32_t> faces, bool flip);

  /// Where a polygon of the job comes from.
  PieceStore::Piece origin_of(uint32_t polygon) const;

  uint32_t store_vertex(uint32_t vertex);

  uint32_t store_point(uint32_t p);

  void add_edges(const FragmentSet& set, uint32_t piece, std::vector<uint32_t>& points);

  /// A polygon of the job, seen from one side of its plane.
  Fragment cell_of(uint32_t polygon, PlaneId plane);

  /// What is left of a polygon on one side of its plane, given by edges_.
  bool add_region(uint32_t polygon, PlaneId plane, bool is_simple);

  void add_corner(uint32_t point, uint32_t edge) {
    store_.corners().push_back(store_point(point));
    store_.edges().push_back(edge);
  }

  /// Puts loops within a cell into the store.
  void add_loops(PieceStore::Piece piece, const RegionLoops& loops, const Fragment& cell);

  Job& job_;
  const std::vector<Operand>& operands_;
  PieceStore& store_;
  CellGeometry geometry_;
  PointIndex index_;
  RegionBuilder regions_;
  const std::function<uint32_t(int, int64_t)> wall_of_;
  std::vector<uint32_t> number_;               ///< per operand: that in the store, or kNone
  std::vector<uint32_t> same_;                 ///< see set_same; empty, or kNone of most vertices
  std::vector<std::vector<uint32_t>> points_;  ///< per set: the geometry's
  std::vector<uint32_t> point_number_;         ///< per constructed point: the store's
  std::vector<DirectedEdge> edges_;
  std::vector<BoundaryEdge> boundary_;
  std::vector<Fragment> fragments_;
  RegionLoops loops_, rest_loops_;
  RegionRest rest_;
  std::vector<uint32_t> cell_points_, cell_edges_;
};

}  // namespace csgrun
