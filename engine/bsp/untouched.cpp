#include "engine/bsp/untouched.h"

#include <algorithm>
#include <bit>
#include <iterator>
#include <span>
#include <utility>

#include "engine/base/parallel.h"
#include "engine/base/scratch.h"
#include "engine/bsp/canonical_order.h"
#include "engine/bsp/cell_geometry.h"
#include "engine/bsp/corner_walk.h"
#include "engine/bsp/grid_planes.h"

namespace csgrun {
namespace {

/// Of a vertex at which faces are not one fan, instead of their common fate.
constexpr uint8_t kNoFan = 3;
constexpr auto kMixedAround = static_cast<uint8_t>(FaceFate::kMixed);

bool is_own_facet(const LeafGeometry& leaf, uint32_t f) {
  const FaceNumbers& facet = leaf.facet;
  return (f == 0 || facet[f - 1] != facet[f]) &&
         (f + 1 == leaf.face_count() || facet[f + 1] != facet[f]);
}

/// Whether no neighbour of a face of a convex leaf lies in its plane. REQUIRES: a triangle.
bool is_alone(const LeafGeometry& leaf, const CornerWalk& walk, uint32_t f) {
  const uint32_t first = leaf.face_starts[f];
  const auto at = [&](uint32_t corner) -> const IVec3& {
    return leaf.vertices[leaf.corners[corner]];
  };
  const Plane plane = plane_through(at(first), at(first + 1), at(first + 2));
  for (uint32_t c = first; c < first + 3; ++c) {
    // In one plane with an edge and another corner of the neighbour, unless that is a straight one.
    const uint32_t across = leaf.opposite[c];
    bool is_level = true;
    for (uint32_t d = walk.before(across); d != across && is_level; d = walk.before(d)) {
      const IVec3& p = at(d);
      is_level = plane.a * p[0] + plane.b * p[1] + plane.c * p[2] + plane.d == 0;
    }
    if (is_level) return false;
  }
  return true;
}

/// Finds the untouched faces of one leaf among those that a job has.
class UntouchedFaces {
 public:
  /// `near`: the faces; null: all. `fate`: of each of them. The other faces around a vertex of one
  /// have the same fate as these.
  UntouchedFaces(const LeafGeometry& leaf, const std::vector<uint32_t>* near, const FaceFate* fate)
      : leaf_(leaf),
        near_(near),
        count_(near ? near->size() : leaf.face_count()),
        fate_(fate),
        walk_(leaf),
        keeps_facets_(leaf.keeps_facets()),
        all_around_(leaf.may_touch) {
    if (all_around_ || asks_common_fates() || !leaf.has_single_fans ||
        (keeps_facets_ && !leaf.has_triangles_as_facets())) {
      look_at_vertices();
    }
  }
  /// Among the faces of a part, which were untouched so far. What becomes of the other faces of the
  /// boundary that share vertices with them is not known.
  UntouchedFaces(const UntouchedPart& part, const FaceFate* fate)
      : leaf_(*part.leaf),
        near_(&part.faces),
        shared_(part.shared),
        count_(part.faces.size()),
        fate_(fate),
        walk_(leaf_),
        keeps_facets_(leaf_.keeps_facets()),
        all_around_(false) {
    if (!asks_common_fates()) return;
    find_common_fates();
    for (const UntouchedPart::Shared& s : shared_) of_vertex_[s.vertex] = kMixedAround;
  }

  /// Those of one fate, marked in `taken` by their places, and `far`, which are faces that the job
  /// does not have; with their corners as vertices of the leaf.
  void collect(FaceFate fate, std::span<const uint32_t> far, UntouchedPart& part,
               uint8_t* taken) const {
    Scratch scratch;
    // By such a face: 1, by others: 2.
    const auto met = scratch.array<uint8_t>(leaf_.vertices.size(), 0);
    const auto room = scratch.array<uint32_t>(count_);
    size_t count = 0;
    for (size_t i = 0; i < count_; ++i) {
      const uint32_t f = face(i);
      const bool is_untouched = fate_[i] == fate && stays_apart(f);
      room[count] = f;
      count += static_cast<size_t>(is_untouched);
      taken[i] |= static_cast<uint8_t>(is_untouched);
      each_vertex(
          f, [&, by = static_cast<uint8_t>(is_untouched ? 1 : 2)](uint32_t v) { met[v] |= by; });
    }
    for (const UntouchedPart::Shared& s : shared_) met[s.vertex] |= 2;
    for (const uint32_t f : far) {
      // 2, by others only, becomes 3.
      each_vertex(f, [&](uint32_t v) { met[v] |= met[v] >> 1; });
    }
    for (uint32_t v = 0; v < met.size(); ++v) {
      if (met[v] == 3) part.shared.push_back({v, v});
    }
    const std::span<const uint32_t> found = room.first(count);
    if (far.empty()) {
      part.faces.assign(found.begin(), found.end());
      return;
    }
    part.faces.resize(found.size() + far.size());
    std::merge(found.begin(), found.end(), far.begin(), far.end(), part.faces.begin());
  }

 private:
  [[nodiscard]] uint32_t face(size_t place) const {
    return near_ ? (*near_)[place] : static_cast<uint32_t>(place);
  }

  /// Calls visit(v) for the vertices of a face.
  template <class Visit>
  void each_vertex(uint32_t f, Visit&& visit) const {
    if (has_triangles_) {
      const uint32_t* const v = leaf_.corners.data() + size_t{3} * f;
      visit(v[0]), visit(v[1]), visit(v[2]);
      return;
    }
    for (uint32_t c = leaf_.face_starts[f]; c < leaf_.face_starts[f + 1]; ++c) {
      visit(leaf_.corners[c]);
    }
  }

  /// Whether it matters if all faces at a vertex are whole, where this is not asked of all.
  [[nodiscard]] bool asks_common_fates() const {
    return keeps_facets_ && leaf_.may_have_flat_edges;
  }

  /// Whether a face that nothing met is a triangle that no other face is merged with, and shares
  /// each corner with one fan of faces.
  [[nodiscard]] bool stays_apart(uint32_t f) const {
    const uint32_t begin = leaf_.face_starts[f];
    if (!has_triangles_ && leaf_.face_starts[f + 1] - begin != 3) return false;
    bool all_whole = !of_vertex_.empty();
    if (all_whole) {
      for (uint32_t c = begin; c < begin + 3; ++c) {
        const uint8_t around = of_vertex_[leaf_.corners[c]];
        if (around == kNoFan) return false;
        all_whole = all_whole && around != kMixedAround;
      }
      if (all_around_ && !all_whole) return false;
    }
    return (keeps_facets_ && all_whole) || !leaf_.may_have_flat_edges || is_alone(leaf_, walk_, f);
  }

  /// The common fate of the faces at each vertex, or kMixed.
  void find_common_fates() {
    of_vertex_.assign(leaf_.vertices.size(), 0);
    for (size_t i = 0; i < count_; ++i) {
      const uint32_t f = face(i);
      const auto own = static_cast<uint8_t>(1u << static_cast<unsigned>(fate_[i]));
      each_vertex(f, [&](uint32_t v) { of_vertex_[v] |= own; });
    }
    for (uint8_t& fates : of_vertex_) {
      const bool all_same = std::has_single_bit(fates);
      fates = all_same ? static_cast<uint8_t>(std::countr_zero(fates)) : kMixedAround;
    }
  }

  /// The same of all faces of a leaf; kNoFan where they are more than one fan, and where a facet
  /// may have no corner: one in several pieces, or with a straight corner.
  void look_at_vertices() {
    find_common_fates();
    if (!leaf_.has_single_fans) {
      for (const uint32_t v : find_vertices_of_fans(leaf_)) of_vertex_[v] = kNoFan;
    }
    if (!keeps_facets_ || leaf_.has_triangles_as_facets()) return;
    for (uint32_t f = 0; f < leaf_.face_count(); ++f) {
      const uint32_t begin = leaf_.face_starts[f], end = leaf_.face_starts[f + 1];
      if (end - begin == 3 && is_own_facet(leaf_, f)) continue;
      for (uint32_t c = begin; c < end; ++c) of_vertex_[leaf_.corners[c]] = kNoFan;
    }
  }

  const LeafGeometry& leaf_;
  const std::vector<uint32_t>* const near_;
  const std::span<const UntouchedPart::Shared> shared_;
  const size_t count_;
  const FaceFate* fate_;
  const CornerWalk walk_;
  const bool keeps_facets_;
  const bool all_around_;  ///< faces are untouched only if all at their corners are whole
  const bool has_triangles_ = leaf_.consists_of_triangles();
  std::vector<uint8_t> of_vertex_;  ///< empty where nobody asks for it
};

/// Points and planes of a boundary, with its untouched faces, as they would be in a job.
class Expander {
 public:
  explicit Expander(const BoundaryMesh& mesh) : mesh_(mesh), geometry_(planes_, nullptr) {}

  BoundaryMesh run() {
    planes_.adopt(mesh_.planes);
    for (size_t p = 0; p < mesh_.point_planes.size(); ++p) {
      geometry_.add_point(mesh_.point_planes[p], mesh_.point_rounded[p]);
    }
    for (const BoundaryMesh::Face& face : mesh_.faces) add(face);
    for (const UntouchedPart& part : mesh_.parts) add(part);
    BoundaryMesh result = canonical(geometry_, planes_, std::move(draft_));
    result.may_touch = mesh_.may_touch;
    result.touches = mesh_.touches;
    return result;
  }

 private:
  void add(const BoundaryMesh::Face& face) {
    draft_.add_face(mesh_, face, face.label, 0, [](uint32_t p) { return PlaneId(p, false); });
  }

  void add(const UntouchedPart& part) {
    std::vector<uint32_t> point_of(part.leaf->vertices.size(), kNone);
    for (const UntouchedPart::Shared& s : part.shared) point_of[s.vertex] = s.point;
    for (const uint32_t f : part.faces) {
      const auto corners = part.triangle(f);
      const IVec3 at[3] = {part.vertex(corners[0]), part.vertex(corners[1]),
                           part.vertex(corners[2])};
      const Plane support = plane_through(at[0], at[1], at[2]);
      const PlaneId plane = planes_.intern(part.map.plane(support));
      const int axis = dominant_axis(support);
      std::array<uint32_t, 3> edge{};
      for (int i = 0; i < 3; ++i) {
        edge[i] = planes_.intern(part.map.plane(edge_plane(at[i], at[(i + 1) % 3], axis))).index();
      }
      for (int i = 0; i < 3; ++i) {
        uint32_t& point = point_of[corners[i]];
        if (point != kNone) continue;
        point = geometry_.add_point({plane.index(), edge[(i + 2) % 3], edge[i]},
                                    part.rounded_point(corners[i]));
      }
      const FaceLabel label = part.label(f);
      draft_.begin_face(plane, label, label.facet != 0, label.facet != 0);
      for (int i = 0; i < 3; ++i) {
        draft_.edges.push_back({point_of[corners[i]], point_of[corners[(i + 1) % 3]], edge[i]});
      }
      draft_.end_loop();
    }
  }

  const BoundaryMesh& mesh_;
  PlaneTable planes_;
  CellGeometry geometry_;
  DraftBoundary draft_;
};

/// Which sides have faces, of those with fates and of far ones.
struct Sides {
  Sides(std::span<const FaceFate> fates, const FarFaces& far)
      : kept(!far.kept.empty() || has(fates, FaceFate::kKept)),
        flipped(!far.flipped.empty() || has(fates, FaceFate::kFlipped)) {}
  static bool has(std::span<const FaceFate> fates, FaceFate fate) {
    return std::find(fates.begin(), fates.end(), fate) != fates.end();
  }

  bool kept, flipped;
};

/// The parts of these sides. `like`: one without faces, of the side that is not turned over now.
std::vector<UntouchedPart> parts_of(const Sides& sides, const UntouchedFaces& untouched,
                                    const UntouchedPart& like, const FarFaces& far,
                                    uint8_t* taken) {
  std::vector<UntouchedPart> parts;
  for (const FaceFate side : {FaceFate::kKept, FaceFate::kFlipped}) {
    const bool is_flipped = side == FaceFate::kFlipped;
    if (!(is_flipped ? sides.flipped : sides.kept)) continue;
    UntouchedPart part = like;
    part.flipped = like.flipped != is_flipped;
    untouched.collect(side, is_flipped ? far.flipped : far.kept, part, taken);
    if (!part.faces.empty()) parts.push_back(std::move(part));
  }
  return parts;
}

IVec3 moved_by(const IVec3& p, const IVec3& t) { return {p[0] + t[0], p[1] + t[1], p[2] + t[2]}; }

/// What is still untouched of a part of operand `o`, a boundary.
std::vector<UntouchedPart> parts_of_part(const Job& job, size_t o, size_t number,
                                         const FaceFate* fate, uint8_t* taken) {
  const Operand& operand = job.operand(o);
  const UntouchedPart& before = operand.boundary->parts[number];
  const Job::NamedPart& in_job = job.named_parts(o)[number];
  const FarFaces none;
  const std::span fates(fate + in_job.first_polygon, before.faces.size());
  const Sides sides(fates, none);
  if (!sides.kept && !sides.flipped) return {};
  UntouchedPart like;
  like.leaf = before.leaf;
  like.translation = moved_by(before.translation, operand.translation);
  like.source = before.source + operand.first_source;
  like.appearance = operand.appearance ? operand.appearance : before.appearance;
  like.flipped = before.flipped;
  auto parts = parts_of(sides, UntouchedFaces(before, fates.data()), like, none,
                        taken + in_job.first_polygon);
  for (UntouchedPart& part : parts) {
    for (UntouchedPart::Shared& s : part.shared) s.point = in_job.vertex_of[s.vertex];
  }
  return parts;
}

}  // namespace

std::vector<UntouchedPart> untouched_parts(const Operand& operand,
                                           const std::vector<uint32_t>* faces, const FaceFate* fate,
                                           const FarFaces& far, uint8_t* taken) {
  if (!operand.leaf) return {};
  const FrameMap map(operand.frame);
  if (map.is_mirrored()) return {};
  const LeafGeometry& leaf = *operand.leaf;
  // Faces that are parts of one facet must stand together.
  if (leaf.opposite.empty() || !leaf.facet.ascend()) return {};
  // Without facets of its own a face must be alone in its plane; that is easily told of convex
  // leaves.
  if (!leaf.keeps_facets() && !leaf.convex) return {};
  const Sides sides({fate, faces ? faces->size() : leaf.face_count()}, far);
  if (!sides.kept && !sides.flipped) return {};
  UntouchedPart like;
  like.leaf = operand.leaf;
  like.translation = operand.translation;
  like.map = map;
  like.source = operand.first_source;
  like.appearance = operand.appearance;
  return parts_of(sides, UntouchedFaces(leaf, faces, fate), like, far, taken);
}

void place_in_job(UntouchedPart& part, const Job& job, size_t o) {
  // The vertices of an operand stand together, in the order of the leaf.
  const uint32_t first_vertex = job.vertex_start(o);
  for (UntouchedPart::Shared& s : part.shared) s.point = first_vertex + s.vertex;
  if (part.map.is_identity() || part.leaf->vertices.empty()) return;
  const std::array<double, 3>* const world = &job.rounded(first_vertex);
  part.world.assign(world, world + part.leaf->vertices.size());
}

std::vector<UntouchedPart> take_untouched(const Job& job, const std::vector<Operand>& operands,
                                          const std::vector<FarFaces>& far,
                                          std::vector<WholePolygon>& whole,
                                          bool if_all_around_are) {
  std::vector<UntouchedPart> parts;
  std::vector<FaceFate> fate(job.polygons().size(), FaceFate::kMixed);
  std::vector<uint8_t> taken(job.polygons().size(), 0);
  for (const WholePolygon& w : whole) {
    if (!w.is_met) fate[w.polygon] = w.flip ? FaceFate::kFlipped : FaceFate::kKept;
  }
  std::vector<std::vector<UntouchedPart>> of_operand(operands.size());
  for_each_alone(operands.size(), job.polygons().size() > kFewForThreads, [&](size_t o) {
    if (operands[o].boundary) {
      for (size_t k = 0; k < operands[o].boundary->parts.size(); ++k) {
        auto some = parts_of_part(job, o, k, fate.data(), taken.data());
        std::move(some.begin(), some.end(), std::back_inserter(of_operand[o]));
      }
      return;
    }
    if (!operands[o].leaf || (operands[o].leaf->may_touch && !if_all_around_are)) return;
    const FarFaces none;
    const uint32_t start = job.polygon_start(o);
    of_operand[o] = untouched_parts(operands[o], job.some_faces(o), fate.data() + start,
                                    far.empty() ? none : far[o], taken.data() + start);
    for (UntouchedPart& part : of_operand[o]) place_in_job(part, job, o);
  });
  for (auto& some : of_operand) {
    std::move(some.begin(), some.end(), std::back_inserter(parts));
  }
  std::erase_if(whole, [&](const WholePolygon& w) { return taken[w.polygon] != 0; });
  return parts;
}

std::shared_ptr<const BoundaryMesh> expanded(std::shared_ptr<const BoundaryMesh> mesh) {
  if (mesh->parts.empty()) return mesh;
  return std::make_shared<BoundaryMesh>(Expander(*mesh).run());
}

bool can_stand_named(const Operand& operand) {
  constexpr size_t kFewParts = 8;  // labels of faces look through them
  if (!operand.boundary || operand.boundary->parts.empty()) return true;
  const auto& parts = operand.boundary->parts;
  return operand.frame.is_identity && parts.size() <= kFewParts &&
         std::all_of(parts.begin(), parts.end(), [](const UntouchedPart& part) {
           return part.map.is_identity() && part.leaf->has_triangles_as_facets();
         });
}

std::vector<Operand> with_standing_parts(std::vector<Operand> operands) {
  for (Operand& operand : operands) {
    if (!can_stand_named(operand)) operand.boundary = expanded(operand.boundary);
  }
  return operands;
}

std::vector<Operand> without_parts(std::vector<Operand> operands) {
  for (Operand& operand : operands) {
    if (operand.boundary) operand.boundary = expanded(operand.boundary);
  }
  return operands;
}

}  // namespace csgrun
