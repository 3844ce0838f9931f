// The canonical order of a boundary that names untouched triangles: of all points, and of all faces
// as they are presented. Explicit points and faces keep their own numbers elsewhere; here they are
// lined up with the others.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "engine/base/raw_vector.h"
#include "engine/bsp/boundary_mesh.h"
#include "engine/bsp/cell_geometry.h"

namespace csgrun {

/// An untouched triangle, counter-clockwise from outside, from its lowest point.
struct UntouchedTriangle {
  std::array<uint32_t, 3> points;  ///< numbers in the whole
  uint32_t part, face;             ///< of BoundaryMesh::parts, and of the part's leaf
};

/// Where untouched triangles border on explicit ones: an edge of the former, by explicit points.
struct RimEdge {
  uint32_t from, to;
  uint32_t part, face, corner;  ///< the edge that leaves this corner of the part's triangle
};

/// The lowest edge of a face, by its points.
struct LowestEdge {
  uint32_t from, to;
};

class WholeOrder {
 public:
  /// A point of the whole: an explicit one, or a vertex of a part's leaf.
  struct Place {
    uint32_t explicit_point;  ///< or kNone
    uint32_t part, vertex;
  };

  /// `geometry` holds the explicit points of the boundary under their own numbers. O(n), but for
  /// points that have many x in common. REQUIRES: points of different places are different.
  WholeOrder(const BoundaryMesh& boundary, const CellGeometry& geometry);

  /// In canonical order.
  [[nodiscard]] const RawVector<Place>& points() const { return points_; }
  /// The number of an explicit point; points that the geometry got since come after all others.
  [[nodiscard]] uint32_t number(uint32_t explicit_point) const {
    return explicit_point < explicit_count_
               ? number_[explicit_point]
               : static_cast<uint32_t>(points_.size()) + explicit_point - explicit_count_;
  }
  /// That of a place which is no explicit point.
  [[nodiscard]] const UntouchedPart& part(const Place& place) const {
    return boundary_.parts[place.part];
  }

  /// Lines up the untouched triangles with explicit faces, given in canonical order by their lowest
  /// edges, as explicit points.
  void order_faces(std::span<const LowestEdge> explicit_faces);
  /// Number f < explicit_face_count(): the explicit face f, else triangle f - that number.
  [[nodiscard]] const std::vector<uint32_t>& faces() const { return faces_; }
  [[nodiscard]] uint32_t explicit_face_count() const { return explicit_face_count_; }
  [[nodiscard]] const RawVector<UntouchedTriangle>& triangles() const { return triangles_; }
  [[nodiscard]] const UntouchedTriangle& triangle(uint32_t face) const {
    return triangles_[face - explicit_face_count_];
  }
  /// That of its outward normal: see outward_direction.
  [[nodiscard]] const glm::dvec3& direction(uint32_t face) const {
    return directions_[face - explicit_face_count_];
  }

  /// By the lower of their points.
  [[nodiscard]] const std::vector<RimEdge>& rim() const { return rim_; }
  /// The planes of a rim edge's triangle and of the edge.
  [[nodiscard]] std::array<PlaneId, 2> planes_of(const RimEdge& edge, PlaneTable& planes) const;
  /// Whether untouched triangles have this explicit point, too; it is then simple.
  [[nodiscard]] bool is_shared(uint32_t explicit_point) const {
    return explicit_point < shared_.size() && shared_[explicit_point];
  }

 private:
  /// What parts that are done together met.
  struct Met {
    RawVector<Place> places;
    std::vector<RimEdge> candidates;
    std::vector<uint32_t> number;  ///< of the vertices of the part at hand
  };

  void collect_triangles();
  static size_t most_places(const UntouchedPart& part);
  void collect_triangles(uint32_t k, size_t first, Met& met);
  void sort_points(const CellGeometry& geometry);
  void number_triangles();
  void find_rim(const std::vector<RimEdge>& candidates);

  const BoundaryMesh& boundary_;
  uint32_t explicit_count_;
  RawVector<Place> points_;
  std::vector<uint32_t> number_;  ///< per explicit point, then per other point as it was met
  std::vector<uint8_t> shared_;
  RawVector<UntouchedTriangle> triangles_;
  RawVector<glm::dvec3> directions_;   ///< of the triangles, found while their leaves are at hand
  std::vector<uint32_t> first_point_;  ///< per part: how many points the parts before it have
  std::vector<RimEdge> rim_;
  uint32_t explicit_face_count_ = 0;
  std::vector<uint32_t> faces_;
};

}  // namespace csgrun
