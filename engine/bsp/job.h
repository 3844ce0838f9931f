// The operands of one evaluation as one set of convex polygons over common vertices and planes.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "engine/base/raw_vector.h"
#include "engine/bsp/boundary_mesh.h"
#include "engine/bsp/frame_map.h"
#include "engine/bsp/live_faces.h"
#include "engine/bsp/near_faces.h"
#include "engine/bsp/operand.h"
#include "engine/bsp/polygon_box.h"
#include "engine/exact/plane.h"
#include "engine/exact/point.h"

namespace csgrun {

/// An edge of a polygon of a job, by its first corner.
struct PolygonEdge {
  uint32_t polygon, edge;
};

class OperandReach;
struct PieceBox;
class PieceStore;

/// One convex polygon of an operand. Its planes are made when somebody asks: most polygons are near
/// no intersection and never need them.
struct JobPolygon {
  uint32_t operand;
  uint32_t face;          ///< of the leaf or of the boundary (also BoundaryMesh::named_face)
  uint32_t first, count;  ///< corners in Job::corners; also edge planes in Job::edge_planes
  PlaneId support;        ///< oriented outwards; invalid until planes were made
};

/// Where the i-th corner of a loop is, and the edge after it, if it is run backwards when `flip`:
/// the edge that follows corner n - 1 - i is then the one that came before it.
constexpr uint32_t corner_place(uint32_t i, uint32_t count, bool flip) {
  return flip ? count - 1 - i : i;
}
constexpr uint32_t edge_place(uint32_t i, uint32_t count, bool flip) {
  return flip ? (2 * count - 2 - i) % count : i;
}

class Job {
 public:
  /// Planes go into `planes`, if a table is given: that of the operand in pieces, if there is one.
  /// Of a single leaf beside one in pieces the job has only the faces that may be near it.
  /// REQUIRES: can_stand_named() of each operand (untouched.h).
  explicit Job(const std::vector<Operand>& operands, PlaneTable* planes = nullptr);
  /// Only these faces of the operands, which are leaves, are polygons of the job; it has all their
  /// vertices, and operand_box() is of all faces. `near` must outlive it.
  Job(const std::vector<Operand>& operands, const NearFaces& near);
  /// The same of operands that are partial; all of the others.
  Job(const std::vector<Operand>& operands, const LiveFaces& live);
  /// The same over a table of planes, for those who only put a result together: there are no
  /// boxes() and no operand_box().
  Job(const std::vector<Operand>& operands, PlaneTable& planes, const SomeFaces& some);
  ~Job();
  Job(const Job&) = delete;
  Job& operator=(const Job&) = delete;

  [[nodiscard]] const std::vector<Operand>& operands() const { return *operands_; }
  [[nodiscard]] const Operand& operand(size_t o) const { return (*operands_)[o]; }
  [[nodiscard]] bool is_leaf(size_t o) const { return leaf(o) != nullptr; }
  /// The leaf that an operand is, or null.
  [[nodiscard]] const LeafGeometry* leaf(size_t o) const { return (*operands_)[o].leaf.get(); }
  /// The version of a result that an operand is, or null.
  [[nodiscard]] const PieceOperand* pieces(size_t o) const { return (*operands_)[o].pieces.get(); }
  /// The piece that a polygon of such an operand is, and the point that a vertex of it is.
  [[nodiscard]] uint32_t piece(uint32_t polygon) const;
  /// The piece of the version that it comes from: that one, or the region that it is a part of.
  [[nodiscard]] uint32_t version_piece(uint32_t polygon) const;
  [[nodiscard]] uint32_t piece_point(uint32_t vertex) const;
  /// Whether the operands beside such a one may have points in a box: all pieces that the job has
  /// of it, and the nodes above them, are in such boxes.
  [[nodiscard]] bool others_may_meet(const PieceBox& box) const;
  /// The faces that the job has of its operands, if it does not have all: the others are far, or
  /// in dead space.
  [[nodiscard]] const NearFaces* near_faces() const { return near_; }
  [[nodiscard]] const LiveFaces* live_faces() const { return live_; }
  [[nodiscard]] bool has_all_faces() const { return !near_ && !some_; }
  /// The number of faces of an operand that are far, and that of all.
  [[nodiscard]] size_t far_face_count(size_t o) const {
    return near_ && leaf(o) ? leaf(o)->face_count() - near_->faces[o].size() : 0;
  }
  [[nodiscard]] size_t far_face_count() const {
    size_t count = 0;
    for (size_t o = 0; o < operand_count(); ++o) count += far_face_count(o);
    return count;
  }
  /// Calls visit(face) for those of one operand, in ascending order.
  template <class Visit>
  void for_each_far_face(size_t o, Visit&& visit) const {
    if (near_ && leaf(o)) csgrun::for_each_far_face(*leaf(o), near_->faces[o], visit);
  }
  /// Those of one operand, ascending; null: all.
  [[nodiscard]] const std::vector<uint32_t>* some_faces(size_t o) const {
    if (near_) return leaf(o) ? &near_->faces[o] : nullptr;
    return some_ && some_->is_partial[o] ? &some_->faces[o] : nullptr;
  }
  [[nodiscard]] size_t operand_count() const { return operands_->size(); }
  [[nodiscard]] uint32_t operand_of_vertex(uint32_t vertex) const;
  /// Whether the vertices that the job has of an operand are grid points, so that their doubles are
  /// exact.
  [[nodiscard]] bool has_grid_vertices(size_t o) const {
    return is_leaf(o) ? (*operands_)[o].frame.is_identity : pieces(o) && are_pieces_on_grid_;
  }
  [[nodiscard]] const RawVector<JobPolygon>& polygons() const { return polygons_; }
  [[nodiscard]] const RawVector<PolygonBox>& boxes() const { return boxes_; }
  /// That of all faces of an operand; empty (lo > hi) if it has none.
  [[nodiscard]] const PolygonBox& operand_box(size_t o) const { return operand_boxes_[o]; }
  /// Polygons of operand o are [polygon_start(o), polygon_start(o + 1)).
  [[nodiscard]] uint32_t polygon_start(size_t o) const { return polygon_starts_[o]; }
  [[nodiscard]] std::span<const uint32_t> corners(const JobPolygon& p) const {
    return {corners_.data() + p.first, p.count};
  }
  /// Plane indices of the edges: edge i runs from corner i to the next. Valid after ensure_planes.
  [[nodiscard]] std::span<const uint32_t> edge_planes(const JobPolygon& p) const {
    return {edge_planes_.data() + p.first, p.count};
  }
  [[nodiscard]] const std::array<double, 3>& rounded(uint32_t vertex) const {
    return rounded_[vertex];
  }
  /// Those of an operand.
  [[nodiscard]] std::span<const std::array<double, 3>> rounded_of(size_t o) const {
    return std::span(rounded_).subspan(vertex_start(o), vertex_start(o + 1) - vertex_start(o));
  }
  [[nodiscard]] size_t vertex_count() const { return rounded_.size(); }
  /// Whether the faces of an operand meet in corners and edges that both have, or nowhere, and each
  /// edge has two faces.
  [[nodiscard]] bool has_simple_edges(size_t o) const {
    return is_leaf(o) && !(*operands_)[o].leaf->may_touch &&
           !(*operands_)[o].leaf->opposite.empty();
  }
  [[nodiscard]] bool is_convex(size_t o) const {
    return is_leaf(o) && (*operands_)[o].leaf->convex;
  }
  /// Vertices of operand o are [vertex_start(o), vertex_start(o + 1)).
  [[nodiscard]] uint32_t vertex_start(size_t o) const { return vertex_operand_starts_[o]; }
  /// A part of a boundary operand.
  struct NamedPart {
    uint32_t first_polygon;         ///< that of its first face; the others follow
    RawVector<uint32_t> vertex_of;  ///< of the leaf's vertices, but for those of no face of it
  };
  /// Those of an operand, one for each part.
  [[nodiscard]] const std::vector<NamedPart>& named_parts(size_t o) const {
    return named_parts_[o];
  }
  [[nodiscard]] Point exact(uint32_t vertex) const;
  /// Whether both operands are leaves in one frame, and not the world's.
  [[nodiscard]] bool are_in_one_frame(size_t o, size_t other) const {
    return is_leaf(o) && is_leaf(other) && !(*operands_)[o].frame.is_identity &&
           (*operands_)[o].frame == (*operands_)[other].frame;
  }
  /// Whether an operand's frame mirrors, and a vertex of it in that frame. REQUIRES: a leaf.
  [[nodiscard]] bool is_mirrored(size_t o) const { return sources_[o].map.is_mirrored(); }
  [[nodiscard]] IVec3 frame_point(size_t o, uint32_t vertex) const;
  /// Whether one vertex comes before another in the exact lexicographic order of their points.
  [[nodiscard]] bool is_below(uint32_t vertex, uint32_t other) const;
  struct VertexName {
    std::array<uint32_t, 3> planes;  ///< of this job, that meet in it; ~0 thrice if it is a leaf's
    bool is_on_grid;                 ///< known to be: then its doubles are exact
  };
  [[nodiscard]] VertexName vertex_name(uint32_t vertex) const;
  /// The label of a polygon of a leaf or a boundary; so are the two below.
  [[nodiscard]] FaceLabel label(const JobPolygon& p) const;
  /// Whether the polygon is a part of a facet of a leaf whose facets are kept, and all of that
  /// facet is there, on either side of its plane; and whether all of it is there on the polygon's
  /// side, in which case the polygons of the facet stand together.
  [[nodiscard]] bool is_of_complete_facet(const JobPolygon& p) const;
  [[nodiscard]] bool is_of_whole_facet(const JobPolygon& p) const;

  /// Makes the support and edge planes of a polygon. Not thread-safe; all that does not make
  /// planes is.
  void ensure_planes(uint32_t polygon);
  /// Makes the support only.
  void ensure_support(uint32_t polygon);
  /// The plane of one edge, which is made now if it was not.
  uint32_t edge_plane(uint32_t polygon, uint32_t edge);
  /// The same for many, computed on several threads.
  void ensure_supports(std::span<const uint32_t> polygons);
  void ensure_edges(std::span<const PolygonEdge> edges);
  void ensure_planes(std::span<const uint32_t> polygons);
  /// The wall x_axis = m + 1/prime as a plane index.
  uint32_t wall(int axis, int64_t m);
  /// Smallest odd prime that divides no frame's determinant, and such that no plane of a boundary
  /// operand is a wall: walls at m + 1/prime hold no leaf vertex and no face.
  [[nodiscard]] int64_t prime() const { return prime_; }
  /// Chooses the prime anew so that none of these vertices lies in a wall made from now on.
  /// (Vertices of leaves never do.)
  void keep_walls_off(std::span<const uint32_t> vertices);
  /// Chooses a greater prime for walls made from now on.
  void move_walls();
  [[nodiscard]] const PlaneTable& planes() const { return planes_; }
  PlaneTable& planes() { return planes_; }

 private:
  struct Source {  ///< how the vertices of one operand are computed exactly
    uint32_t first_vertex;
    FrameMap map;  ///< one that mirrors turns loops round
  };

  Job(const std::vector<Operand>& operands, PlaneTable* planes, bool with_boxes,
      const NearFaces* near, const LiveFaces* live, const SomeFaces* some);
  [[nodiscard]] size_t face_count(size_t o) const;
  [[nodiscard]] size_t corner_count(size_t o) const;
  void make_room(size_t o);
  void add_vertices(uint32_t o, const Operand& operand);
  void add_faces(uint32_t o, const Operand& operand);
  void add_all_faces(uint32_t o, const Operand& operand);
  void add_face(uint32_t polygon, uint32_t o, const LeafGeometry& leaf, uint32_t face,
                uint32_t first);
  void add_some_faces(uint32_t o, const LeafGeometry& leaf, const std::vector<uint32_t>& faces);
  void add_boundary_planes(size_t o, const Operand& operand);
  void add_boundary(uint32_t o, const Operand& operand);
  void add_parts(uint32_t o, const Operand& operand);
  void add_part_vertices(const UntouchedPart& part, const IVec3& translation,
                         RawVector<uint32_t>& vertex_of);
  /// Whether a polygon is a face of a leaf, be it one that a boundary names: its planes are made
  /// when somebody asks.
  [[nodiscard]] bool is_face_of_leaf(const JobPolygon& p) const;
  void list_pieces(const PieceOperand& operand);
  [[nodiscard]] bool may_choose_faces() const;
  void choose_faces();
  void add_pieces(uint32_t o, PieceStore& store);
  template <class MayMeet>
  void take_parts(PieceStore& store, MayMeet&& may_meet);
  [[nodiscard]] PolygonBox box_of(const JobPolygon& polygon) const;
  [[nodiscard]] PolygonBox grid_box_of(const JobPolygon& polygon) const;
  /// The exact position of vertex `local` of operand `o`.
  [[nodiscard]] Point exact_of(uint32_t o, uint32_t local) const;
  [[nodiscard]] bool is_good_prime(int64_t p) const;
  [[nodiscard]] IVec3 leaf_corner(const JobPolygon& p, uint32_t i) const;
  /// Planes of polygons of leaves, and of pieces.
  [[nodiscard]] ReducedPlane reduced_support(uint32_t polygon) const;
  [[nodiscard]] ReducedPlane reduced_edge(uint32_t polygon, uint32_t edge) const;
  [[nodiscard]] PieceStore* store_of(const JobPolygon& p) const;
  bool find_support(uint32_t polygon);
  bool find_edge(const PolygonEdge& e);
  void take_support(uint32_t polygon, const ReducedPlane& plane);
  uint32_t take_edge(const PolygonEdge& e, const ReducedPlane& plane);

  const std::vector<Operand>* operands_;
  const NearFaces* near_;
  std::optional<NearFaces> own_near_;  ///< chosen by the pieces of another operand
  const LiveFaces* const live_;
  const SomeFaces* const some_;  ///< the live ones, or others
  const bool with_boxes_;
  std::optional<PlaneTable> own_planes_;
  PlaneTable& planes_;
  std::vector<Source> sources_;
  RawVector<JobPolygon> polygons_;
  RawVector<PolygonBox> boxes_;
  std::vector<PolygonBox> operand_boxes_;
  std::vector<uint32_t> polygon_starts_{0};
  std::vector<uint32_t> leaf_corner_starts_;  ///< per operand, if it is a leaf
  RawVector<uint32_t> corners_;
  RawVector<uint32_t> edge_planes_;
  RawVector<std::array<double, 3>> rounded_;
  std::vector<uint32_t> vertex_operand_starts_{0};
  /// Vertices of boundary operands: three planes of this job, by vertex - first vertex.
  std::vector<std::vector<std::array<uint32_t, 3>>> boundary_vertices_;
  /// Planes of boundary operands, by their number in the boundary; invalid where not needed.
  std::vector<std::vector<PlaneId>> boundary_planes_;
  std::vector<std::vector<NamedPart>> named_parts_;               ///< per operand
  std::vector<uint32_t> pieces_, version_pieces_, piece_points_;  ///< of the operand in pieces
  std::vector<PolygonBox> piece_boxes_;                           ///< if faces were chosen by them
  std::vector<OperandReach> reaches_;                             ///< of the operands beside it
  bool are_pieces_on_grid_ = true;                                ///< all of these points
  int64_t prime_ = 3;
};

}  // namespace csgrun
