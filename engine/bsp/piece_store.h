// Pieces of results over common planes and points. A store only grows: all versions of a result,
// from operation to operation, name their pieces in one store (result_pieces.h).
//
// A piece is a convex polygon, or stands for several, its parts, which are made when an operation
// comes near: a region is loops within a convex polygon (region_parts.h), a group is faces of a
// leaf that nothing met.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "engine/base/chunked_vector.h"
#include "engine/bsp/job.h"
#include "engine/bsp/operand.h"
#include "engine/bsp/piece_tree.h"
#include "engine/exact/plane.h"
#include "engine/exact/point.h"

namespace csgrun {

class PieceStore {
 public:
  /// A piece of a face of an operand, oriented to the outside of the result. Planes of it may not
  /// have been made yet if all its corners are grid points, or it is whole and of a leaf.
  struct Piece {
    uint32_t operand;       ///< number in the store
    uint32_t face;          ///< of the operand, a leaf or a boundary
    uint32_t first, count;  ///< corners
    PlaneId support;        ///< invalid until it was made
    bool is_whole;          ///< all of a leaf's face
    bool is_flipped;        ///< a whole one: runs the other way round than the face
    bool is_met = false;    ///< another operand's surface touched it
    uint32_t region = ~0u;  ///< number of the region, if it is one
    uint32_t group = ~0u;  ///< number of the group, if it is one: then it has no corners of its own
  };

  /// The pieces [first, first + count) that stand for a region or a group, when they were made.
  struct Parts {
    uint32_t first = ~0u, count = 0;
    [[nodiscard]] bool were_made() const { return first != ~0u; }
  };

  /// What else is known of a region.
  struct Region {
    uint32_t first_end, loop_count;   ///< where loops end, counted from the piece's first corner
    uint32_t first_cell, cell_count;  ///< corners of the convex polygon that it is within
    Parts parts;
  };

  PlaneTable planes;

  static constexpr uint32_t kNoNumber = ~0u;

  /// Operand `o` of a job over this store's planes: its vertices become points. Returns its number
  /// here; kNoNumber for a leaf in a frame some corner of which is a true corner of no face.
  uint32_t add_operand(Job& job, const std::vector<Operand>& operands, uint32_t o);
  /// The point in which three planes meet, with its coordinates, correctly rounded.
  uint32_t add_point(const std::array<uint32_t, 3>& meeting, const std::array<double, 3>& at);
  /// A piece whose corners and edge planes were appended to corners() and edges() last. Returns its
  /// number.
  uint32_t add_piece(const Piece& piece);
  /// A region, the loops of which end at `ends`, counted from its first corner. The corners and
  /// edges of the convex polygon around it, so many, were appended after its own.
  uint32_t add_region(Piece piece, std::span<const uint32_t> ends, uint32_t cell_count);
  /// A whole face of a leaf that nothing met, turned over if `piece` is.
  uint32_t add_face(Piece piece, uint32_t face);
  /// Several of them as one.
  uint32_t add_group(Piece piece, std::span<const uint32_t> faces);
  std::vector<uint32_t>& corners() { return corners_; }
  std::vector<uint32_t>& edges() { return edges_; }

  [[nodiscard]] const Piece& piece(uint32_t p) const { return pieces_[p]; }
  [[nodiscard]] uint32_t piece_count() const { return static_cast<uint32_t>(pieces_.size()); }
  [[nodiscard]] std::span<const uint32_t> corners(uint32_t piece) const {
    return {corners_.data() + pieces_[piece].first, pieces_[piece].count};
  }
  /// Planes of the edges: edge i runs from corner i to the next. kNone where they were not made.
  [[nodiscard]] std::span<const uint32_t> edges(uint32_t piece) const {
    return {edges_.data() + pieces_[piece].first, pieces_[piece].count};
  }
  [[nodiscard]] bool is_region(uint32_t piece) const { return pieces_[piece].region != kNoNumber; }
  [[nodiscard]] Region& region(uint32_t piece) { return regions_[pieces_[piece].region]; }
  [[nodiscard]] bool is_group(uint32_t piece) const { return pieces_[piece].group != kNoNumber; }
  [[nodiscard]] std::span<const uint32_t> group_faces(uint32_t piece) const {
    const Group& group = groups_[pieces_[piece].group];
    return {group_faces_.data() + group.first_face, group.face_count};
  }
  /// A piece for each face of a group, in their order. They are made when they are asked for first.
  Parts group_parts(uint32_t piece);
  /// The parts of a piece that were made; none of one that has none.
  [[nodiscard]] Parts parts(uint32_t piece) const {
    const Piece& p = pieces_[piece];
    if (p.region != kNoNumber) return regions_[p.region].parts;
    return p.group != kNoNumber ? groups_[p.group].parts : Parts{};
  }
  /// Calls f(corners) for each face of a group, or once for all corners of another piece.
  template <class F>
  void each_face(uint32_t piece, F&& f) const {
    if (!is_group(piece)) return f(corners(piece));
    std::vector<uint32_t> corners;
    for (const uint32_t face : group_faces(piece)) {
      corners.clear();
      append_corners(pieces_[piece], face, corners);
      f(std::span<const uint32_t>(corners));
    }
  }
  /// Calls f(begin, end) for the loops of a piece that is no group, counted from its first corner.
  template <class F>
  void each_loop(uint32_t piece, F&& f) const {
    const Piece& p = pieces_[piece];
    if (p.region == kNoNumber) return f(0u, p.count);
    const Region& region = regions_[p.region];
    for (uint32_t l = 0, begin = 0; l < region.loop_count; ++l) {
      const uint32_t end = loop_ends_[region.first_end + l];
      f(begin, end);
      begin = end;
    }
  }
  [[nodiscard]] const PieceBox& box(uint32_t piece) const { return boxes_[piece]; }
  void set_met(uint32_t piece) { pieces_[piece].is_met = true; }
  /// Makes the support, or the plane of an edge, of a piece over grid points in two steps: it is
  /// computed, which several threads may do, and is taken then. REQUIRES: it was not made.
  [[nodiscard]] ReducedPlane reduced_support(uint32_t piece) const;
  [[nodiscard]] ReducedPlane reduced_edge(uint32_t piece, uint32_t edge) const;
  PlaneId take_support(uint32_t piece, const ReducedPlane& plane) {
    return pieces_[piece].support = planes.intern_computed(plane);
  }
  uint32_t take_edge(uint32_t piece, uint32_t edge, const ReducedPlane& plane) {
    return edges_[pieces_[piece].first + edge] = planes.intern_computed(plane).index();
  }

  [[nodiscard]] size_t point_count() const { return rounded_.size(); }
  [[nodiscard]] const std::array<double, 3>& rounded(uint32_t point) const {
    return rounded_[point];
  }
  /// Three planes that meet in the point, or kNone thrice for a grid point, and for a vertex of a
  /// leaf in a frame that is a corner of groups only.
  [[nodiscard]] const std::array<uint32_t, 3>& point_planes(uint32_t point) const {
    return point_planes_[point];
  }
  /// Whether the exact point is known to be on the grid: then rounded() is the point.
  [[nodiscard]] bool is_on_grid(uint32_t point) const { return is_on_grid_[point] != 0; }
  [[nodiscard]] Point exact(uint32_t point) const;

  [[nodiscard]] const std::vector<Operand>& operands() const { return operands_; }
  /// To the world from the frame of an operand.
  [[nodiscard]] const FrameMap& map(uint32_t operand) const { return maps_[operand]; }
  /// The points of an operand's vertices stand together, from this one on.
  [[nodiscard]] uint32_t first_point(uint32_t operand) const { return first_point_[operand]; }
  /// The operand whose vertex a point is, or kNone.
  [[nodiscard]] uint32_t operand_of(uint32_t point) const { return point_operand_[point]; }
  /// Where sums over pieces take points from: a grid point near them.
  [[nodiscard]] const IVec3& origin() const { return origin_; }

  /// A point relative to the origin, cut to 64 fractional bits, for those who sum over pieces
  /// (mesh/pieces_measures), who put it there.
  struct CutPoint {
    std::array<Int<2>, 3> at;
    bool is_known = false, is_cut = false;
  };
  CutPoint& cut_point(uint32_t point) {
    return entry(point, rounded_.size(), cut_point_number_, cut_points_);
  }

  /// What a piece adds to sums, for the same.
  struct PieceSum {
    PieceSums sums;
    bool is_known = false;
  };
  PieceSum& piece_sum(uint32_t piece) {
    return entry(piece, pieces_.size(), piece_sum_number_, piece_sums_);
  }

  /// Room for a number per point, all kNone; whoever takes it leaves it so.
  std::vector<uint32_t>& scratch() {
    scratch_.resize(rounded_.size(), kNoNumber);
    return scratch_;
  }

 private:
  /// The entry of thing `i` of so many, of which few have one.
  template <class T>
  static T& entry(uint32_t i, size_t count, std::vector<uint32_t>& number,
                  ChunkedVector<T>& entries) {
    number.resize(count, kNoNumber);
    if (number[i] == kNoNumber) {
      number[i] = static_cast<uint32_t>(entries.size());
      entries.push_back({});
    }
    return entries[number[i]];
  }

  [[nodiscard]] bool meet_on_grid_at(const std::array<uint32_t, 3>& meeting,
                                     const std::array<double, 3>& at) const;
  [[nodiscard]] IVec3 on_grid(uint32_t point) const;
  /// Has a vertex of a leaf in a frame be where three planes meet.
  void ensure_name(uint32_t point) {
    if (!is_on_grid(point) && point_planes_[point][0] == kNoNumber) name(point);
  }
  void name(uint32_t point);
  [[nodiscard]] Plane plane_of_corners(uint32_t piece) const;
  /// Appends the corners of a face of a leaf as a piece of it has them.
  void append_corners(const Piece& piece, uint32_t face, std::vector<uint32_t>& out) const {
    const LeafGeometry& leaf = *operands_[piece.operand].leaf;
    const uint32_t begin = leaf.face_starts[face], count = leaf.face_starts[face + 1] - begin;
    for (uint32_t i = 0; i < count; ++i) {
      out.push_back(first_point_[piece.operand] +
                    leaf.corners[begin + corner_place(i, count, runs_back(piece))]);
    }
  }
  /// Whether the corners of a face of a leaf run the other way round in a piece of it.
  [[nodiscard]] bool runs_back(const Piece& piece) const {
    return piece.is_flipped != maps_[piece.operand].is_mirrored();
  }

  struct Group {
    uint32_t first_face, face_count;  ///< in group_faces_
    Parts parts;
  };

  std::vector<Operand> operands_;
  std::vector<FrameMap> maps_;
  std::vector<uint32_t> first_point_;
  /// Per operand, of a leaf in a frame: for each vertex a corner of the leaf that turns there.
  std::vector<std::vector<uint32_t>> corner_at_;
  ChunkedVector<std::array<double, 3>> rounded_;
  ChunkedVector<std::array<uint32_t, 3>> point_planes_;
  std::vector<uint32_t> point_operand_;
  std::vector<uint8_t> is_on_grid_;
  ChunkedVector<Piece> pieces_;
  std::vector<Region> regions_;
  std::vector<uint32_t> loop_ends_;
  std::vector<Group> groups_;
  std::vector<uint32_t> group_faces_;
  ChunkedVector<PieceBox> boxes_;
  std::vector<uint32_t> corners_, edges_;
  std::vector<uint32_t> scratch_;
  std::vector<uint32_t> cut_point_number_, piece_sum_number_;
  ChunkedVector<CutPoint> cut_points_;
  ChunkedVector<PieceSum> piece_sums_;
  IVec3 origin_{0, 0, 0};
};

/// A version of a result as an operand: a job takes those pieces that the boxes of its other
/// operands meet.
struct PieceOperand {
  std::shared_ptr<PieceStore> store;
  PieceTree pieces;
};

}  // namespace csgrun
