// Where points and lines lie in faces, of which some have very many edges: what a question needs of
// these is found by boxes, and by where edges start.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "engine/mesh/box_tree.h"
#include "engine/mesh/face_location.h"

namespace csgrun {

/// Box of the rounded ends of an edge. Rounding is monotone: what is on the edge is in the box when
/// it is rounded.
Box box_of(const DirectedEdge& e, const CellGeometry& geometry);

/// Exact. Of a face with many edges the first question costs O(n log n), each one after it what is
/// beside the point along an axis.
class FaceSearch {
 public:
  /// REQUIRES: all of these outlive it.
  FaceSearch(const std::vector<MergedFace>& faces, const CellGeometry& geometry, PointView& points,
             const PlaneTable& planes)
      : faces_(faces),
        geometry_(geometry),
        points_(points),
        planes_(planes),
        large_(faces.size()) {}

  /// FaceLocator::locate, of a point in the plane of a face.
  int locate(uint32_t face, uint32_t p);
  /// Whether an edge in the plane of a face, broken at the face's corners, runs through the face.
  bool runs_inside(uint32_t face, const DirectedEdge& e);
  /// Whether an edge in the plane of a face, which leaves one of its corners, goes on inside it.
  bool starts_inside(uint32_t face, const DirectedEdge& e);
  /// Appends the edges of a face whose boxes overlap a box, in the order of the loops.
  void find(uint32_t face, const Box& box, std::vector<DirectedEdge>& found);
  /// Whether a face has so many edges that it pays to find those that are asked for.
  bool has_many_edges(uint32_t face) { return large(face) != nullptr; }
  /// The faces have other edges from now on.
  void forget();

 private:
  /// A face of many edges.
  struct Large {
    Large(const MergedFace& face, const CellGeometry& geometry);
    /// The edges that start at a point, by their numbers.
    [[nodiscard]] std::span<const uint32_t> starting_at(uint32_t point) const;

    std::vector<DirectedEdge> edges;  ///< loop after loop
    std::vector<uint32_t> before;     ///< per edge, the one that arrives where it starts
    std::vector<uint32_t> by_start;   ///< edges by the points at which they start
    std::vector<Box> boxes;
    Box around;
    BoxTree tree;
  };

  /// Null for a face of few edges.
  const Large* large(uint32_t face);
  bool is_rim(uint32_t face, const DirectedEdge& e);

  const std::vector<MergedFace>& faces_;
  const CellGeometry& geometry_;
  PointView& points_;
  const PlaneTable& planes_;
  std::vector<std::unique_ptr<Large>> large_;  ///< per face, if it is one and something was asked
  std::vector<uint32_t> met_;
  std::vector<std::vector<DirectedEdge>> band_{1};  ///< of locate
};

}  // namespace csgrun
