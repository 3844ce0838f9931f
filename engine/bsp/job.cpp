#include "engine/bsp/job.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "engine/base/parallel.h"
#include "engine/bsp/cell_geometry.h"
#include "engine/bsp/near_pieces.h"
#include "engine/bsp/operand_reach.h"
#include "engine/bsp/piece_store.h"
#include "engine/bsp/region_parts.h"
#include "engine/bsp/rounded_box.h"

namespace csgrun {
namespace {

constexpr uint32_t kNoVertexPlanes = ~0u;

/// Remainder of a signed wide integer by a small number, in [0, p).
template <int N>
int64_t remainder_of(const Int<N>& v, int64_t p) {
  const Int<N> m = v.magnitude();
  UInt128 r = 0;
  for (int i = N - 1; i >= 0; --i) r = ((r << 64) | m.limb[i]) % static_cast<uint64_t>(p);
  return static_cast<int64_t>(r);
}

bool is_prime(int64_t p) {
  for (int64_t d = 3; d * d <= p; d += 2) {
    if (p % d == 0) return false;
  }
  return true;
}

}  // namespace

Job::Job(const std::vector<Operand>& operands, PlaneTable* planes)
    : Job(operands, planes, true, nullptr, nullptr, nullptr) {}

Job::Job(const std::vector<Operand>& operands, const NearFaces& near)
    : Job(operands, nullptr, true, &near, nullptr, nullptr) {}

Job::Job(const std::vector<Operand>& operands, const LiveFaces& live)
    : Job(operands, nullptr, true, nullptr, &live, &live) {}

Job::Job(const std::vector<Operand>& operands, PlaneTable& planes, const SomeFaces& some)
    : Job(operands, &planes, false, nullptr, nullptr, &some) {}

Job::~Job() = default;

Job::Job(const std::vector<Operand>& operands, PlaneTable* planes, bool with_boxes,
         const NearFaces* near, const LiveFaces* live, const SomeFaces* some)
    : operands_(&operands),
      near_(near),
      live_(live),
      some_(some),
      with_boxes_(with_boxes),
      planes_(planes ? *planes : own_planes_.emplace()) {
  sources_.resize(operands.size());
  boundary_vertices_.resize(operands.size());
  for (size_t o = 0; o < operands.size(); ++o) sources_[o].map = FrameMap(operands[o].frame);
  boundary_planes_.resize(operands.size());
  named_parts_.resize(operands.size());
  for (size_t o = 0; o < operands.size(); ++o) {
    if (operands[o].boundary) add_boundary_planes(o, operands[o]);
  }
  while (!is_good_prime(prime_)) prime_ += 2;
  size_t vertices = 0, polygons = 0, corners = 0;
  for (size_t o = 0; o < operands.size(); ++o) {
    if (!operands[o].leaf) continue;
    vertices += operands[o].leaf->vertices.size();
    polygons += face_count(o);
    corners += corner_count(o);
  }
  rounded_.reserve(vertices);
  polygons_.reserve(polygons);
  if (with_boxes_) boxes_.reserve(polygons);
  corners_.reserve(corners);
  edge_planes_.reserve(corners);
  if (with_boxes_) operand_boxes_.assign(operands.size(), PolygonBox::none());
  leaf_corner_starts_.resize(operands.size());
  for (uint32_t o = 0; o < operands.size() && !operands[o].pieces; ++o) {
    sources_[o].first_vertex = static_cast<uint32_t>(rounded_.size());
    if (operands[o].leaf) {
      rounded_.resize(rounded_.size() + operands[o].leaf->vertices.size());
    } else if (operands[o].boundary) {
      add_boundary(o, operands[o]);
      for (size_t p = polygon_starts_.back(); p < boxes_.size(); ++p) {
        operand_boxes_[o].include(boxes_[p]);
      }
    }
    vertex_operand_starts_.push_back(static_cast<uint32_t>(rounded_.size()));
    if (operands[o].leaf) {
      if (may_choose_faces()) choose_faces();
      leaf_corner_starts_[o] = static_cast<uint32_t>(corners_.size());
      make_room(o);
    }
    polygon_starts_.push_back(static_cast<uint32_t>(polygons_.size()));
  }
  for_each_alone(operands.size(), polygons_.size() > kFewForThreads, [&](size_t o) {
    if (!operands[o].leaf) return;
    const auto number = static_cast<uint32_t>(o);
    if (!own_near_) add_vertices(number, operands[o]);
    add_faces(number, operands[o]);
  });
  if (operands.empty() || !operands.back().pieces) return;
  sources_.back().first_vertex = static_cast<uint32_t>(rounded_.size());
  if (!own_near_) list_pieces(*operands.back().pieces);
  add_pieces(static_cast<uint32_t>(operands.size() - 1), *operands.back().pieces->store);
  operand_boxes_.back() = rounded_outwards(operands.back().pieces->pieces.box());  // of all
  polygon_starts_.push_back(static_cast<uint32_t>(polygons_.size()));
  vertex_operand_starts_.push_back(static_cast<uint32_t>(rounded_.size()));
}

bool Job::is_good_prime(int64_t p) const {
  if (!is_prime(p)) return false;
  for (const Source& s : sources_) {
    if (remainder_of(s.map.determinant(), p) == 0) return false;
  }
  // A materialised result does not know the frames of its leaves: its planes are looked at
  // themselves.
  for (const auto& planes : boundary_planes_) {
    for (const PlaneId id : planes) {
      if (!id.valid()) continue;
      const Plane& s = planes_.plane(id.index());
      if (((s.a != 0) + (s.b != 0) + (s.c != 0)) == 1 && s.a + s.b + s.c == p) return false;
    }
  }
  return true;
}

void Job::keep_walls_off(std::span<const uint32_t> vertices) {
  // A coordinate m + 1/p has p in its denominator.
  const auto keeps_off = [&](int64_t p) {
    return std::none_of(vertices.begin(), vertices.end(),
                        [&](uint32_t v) { return remainder_of(exact(v).w, p) == 0; });
  };
  while (!keeps_off(prime_)) move_walls();
}

void Job::move_walls() {
  do prime_ += 2;
  while (!is_good_prime(prime_));
}

/// How many polygons the job has of a leaf.
size_t Job::face_count(size_t o) const {
  const std::vector<uint32_t>* const some = some_faces(o);
  return some ? some->size() : (*operands_)[o].leaf->face_count();
}

/// How many corners these have.
size_t Job::corner_count(size_t o) const {
  const LeafGeometry& leaf = *(*operands_)[o].leaf;
  const std::vector<uint32_t>* const some = some_faces(o);
  if (!some) return leaf.corners.size();
  if (leaf.consists_of_triangles()) return 3 * some->size();
  size_t count = 0;
  for (const uint32_t f : *some) count += leaf.face_starts[f + 1] - leaf.face_starts[f];
  return count;
}

/// For what add_faces sets.
void Job::make_room(size_t o) {
  polygons_.resize(polygons_.size() + face_count(o));
  if (with_boxes_) boxes_.resize(boxes_.size() + face_count(o));
  corners_.resize(corners_.size() + corner_count(o));
  edge_planes_.resize(corners_.size());
}

void Job::add_vertices(uint32_t o, const Operand& operand) {
  const LeafGeometry& leaf = *operand.leaf;
  const uint32_t first_vertex = sources_[o].first_vertex;
  const bool on_grid = operand.frame.is_identity;
  if (near_ && !near_->rounded.empty() && !on_grid) {
    const RoundedPoints& points = near_->rounded[o];
    for_each_range(points.size(), [&](size_t begin, size_t end) {
      std::copy(points.data() + begin, points.data() + end, rounded_.data() + first_vertex + begin);
    });
    return;
  }
  for_each_range(leaf.vertices.size(), [&](size_t begin, size_t end) {
    for (size_t v = begin; v < end; ++v) {
      std::array<double, 3>& at = rounded_[first_vertex + v];
      if (!on_grid) {
        at = csgrun::rounded(exact_of(o, static_cast<uint32_t>(v)));
        continue;
      }
      const IVec3& q = leaf.vertices[v];
      for (size_t k = 0; k < 3; ++k) at[k] = static_cast<double>(q[k] + operand.translation[k]);
    }
  });
}

void Job::add_faces(uint32_t o, const Operand& operand) {
  if (const std::vector<uint32_t>* const some = some_faces(o)) {
    add_some_faces(o, *operand.leaf, *some);
  } else {
    add_all_faces(o, operand);
  }
}

/// Sets polygon number `polygon`, a face of a leaf, whose corners stand from `first` on.
inline void Job::add_face(uint32_t polygon, uint32_t o, const LeafGeometry& leaf, uint32_t face,
                          uint32_t first) {
  const uint32_t begin = leaf.face_starts[face], count = leaf.face_starts[face + 1] - begin,
                 first_vertex = sources_[o].first_vertex;
  const uint32_t* const from = leaf.corners.data() + begin;
  uint32_t* const to = corners_.data() + first;
  uint32_t* const edges = edge_planes_.data() + first;
  if (count == 3) {
    for (size_t c = 0; c < 3; ++c) to[c] = first_vertex + from[c], edges[c] = kNone;
  } else {
    for (size_t c = 0; c < count; ++c) to[c] = first_vertex + from[c], edges[c] = kNone;
  }
  if (sources_[o].map.is_mirrored()) std::reverse(to, to + count);
  JobPolygon& made = polygons_[polygon];
  made = {o, face, first, count, PlaneId()};
  if (!with_boxes_) return;
  boxes_[polygon] = (*operands_)[o].frame.is_identity ? grid_box_of(made) : box_of(made);
}

void Job::add_all_faces(uint32_t o, const Operand& operand) {
  const LeafGeometry& leaf = *operand.leaf;
  const uint32_t first_polygon = polygon_starts_[o], first_corner = leaf_corner_starts_[o];
  std::vector<PolygonBox> boxes(part_count(leaf.face_count(), kFewForThreads), PolygonBox::none());
  for_each_part(leaf.face_count(), kFewForThreads, [&](size_t part, size_t begin, size_t end) {
    PolygonBox around = PolygonBox::none();
    for (size_t f = begin; f < end; ++f) {
      const uint32_t polygon = first_polygon + static_cast<uint32_t>(f);
      add_face(polygon, o, leaf, static_cast<uint32_t>(f), first_corner + leaf.face_starts[f]);
      if (with_boxes_) around.include(boxes_[polygon]);
    }
    boxes[part] = around;
  });
  if (!with_boxes_) return;
  for (const PolygonBox& box : boxes) operand_boxes_[o].include(box);
}

void Job::add_some_faces(uint32_t o, const LeafGeometry& leaf, const std::vector<uint32_t>& faces) {
  const uint32_t first_polygon = polygon_starts_[o], first_corner = leaf_corner_starts_[o];
  const auto add = [&](size_t i, uint32_t first) {
    add_face(first_polygon + static_cast<uint32_t>(i), o, leaf, faces[i], first);
  };
  if (leaf.consists_of_triangles()) {
    for_each_range(faces.size(), [&](size_t begin, size_t end) {
      for (size_t i = begin; i < end; ++i) add(i, static_cast<uint32_t>(first_corner + 3 * i));
    });
  } else {
    uint32_t next = first_corner;
    for (size_t i = 0; i < faces.size(); ++i) {
      add(i, next);
      next += polygons_[first_polygon + i].count;
    }
  }
  if (with_boxes_) operand_boxes_[o] = near_ ? near_->boxes[o] : live_->dead->operand_box(o);
}

/// Lists the pieces of the version, of regions and groups their parts, that others may meet.
template <class MayMeet>
void Job::take_parts(PieceStore& store, MayMeet&& may_meet) {
  RegionParts parts(store, [this](int axis, int64_t m) { return wall(axis, m); });
  std::vector<uint32_t> met;
  met.swap(version_pieces_);
  pieces_.reserve(met.size());
  version_pieces_.reserve(met.size());
  for (const uint32_t piece : met) {
    if (!store.is_region(piece) && !store.is_group(piece)) {
      pieces_.push_back(piece);
      version_pieces_.push_back(piece);
      continue;
    }
    const auto [first, count] = store.is_group(piece) ? store.group_parts(piece) : parts.of(piece);
    for (uint32_t part = first; part < first + count; ++part) {
      if (!may_meet(store.box(part))) continue;
      pieces_.push_back(part);
      version_pieces_.push_back(piece);
    }
  }
}

/// Lists the pieces of the version that others may meet.
void Job::list_pieces(const PieceOperand& operand) {
  PieceStore& store = *operand.store;
  reaches_.reserve(operands_->size() - 1);
  for (uint32_t other = 0; other + 1 < operands_->size(); ++other) {
    reaches_.emplace_back(rounded_of(other));
  }
  const auto may_meet = [this](const PieceBox& box) { return others_may_meet(box); };
  operand.pieces.each(may_meet, [&](uint32_t piece) {
    if (may_meet(store.box(piece))) version_pieces_.push_back(piece);
  });
  take_parts(store, may_meet);
}

bool Job::others_may_meet(const PieceBox& box) const {
  return std::any_of(reaches_.begin(), reaches_.end(),
                     [&](const OperandReach& other) { return other.may_meet(box); });
}

/// Whether those of the first operand are chosen by the pieces of the second.
bool Job::may_choose_faces() const {
  constexpr size_t kWorthChoosing = 64;
  return operands_->size() == 2 && is_leaf(0) && pieces(1) &&
         leaf(0)->face_count() >= kWorthChoosing;
}

/// Chooses those of the first operand that come near the pieces of the second, which are listed.
void Job::choose_faces() {
  add_vertices(0, operand(0));
  const bool are_whole = has_grid_vertices(0);
  const auto box =
      are_whole ? box_of_leaf(*leaf(0), operand(0).translation) : box_of_rounded(rounded_);
  if (!box) return;
  list_pieces(*pieces(1));
  piece_boxes_.reserve(pieces_.size());
  for (const uint32_t piece : pieces_) {
    piece_boxes_.push_back(rounded_outwards(pieces(1)->store->box(piece)));
  }
  own_near_.emplace();
  own_near_->faces = {faces_near(*leaf(0), rounded_, are_whole, *box, piece_boxes_), {}};
  own_near_->boxes = {*box, PolygonBox::none()};
  near_ = &*own_near_;
}

/// Makes polygons of the pieces that are listed.
void Job::add_pieces(uint32_t o, PieceStore& store) {
  std::vector<uint32_t>& vertex_of = store.scratch();
  polygons_.reserve(polygons_.size() + pieces_.size());
  boxes_.reserve(boxes_.size() + pieces_.size());
  constexpr size_t kMostlyCorners = 4;
  const size_t corners = corners_.size() + kMostlyCorners * pieces_.size();
  corners_.reserve(corners);
  edge_planes_.reserve(corners);
  for (uint32_t i = 0; i < pieces_.size(); ++i) {
    const auto first = static_cast<uint32_t>(corners_.size());
    for (const uint32_t point : store.corners(pieces_[i])) {
      if (vertex_of[point] == kNone) {
        vertex_of[point] = static_cast<uint32_t>(rounded_.size());
        rounded_.push_back(store.rounded(point));
        piece_points_.push_back(point);
        are_pieces_on_grid_ &= store.is_on_grid(point);
      }
      corners_.push_back(vertex_of[point]);
    }
    const auto edges = store.edges(pieces_[i]);
    edge_planes_.insert(edge_planes_.end(), edges.begin(), edges.end());
    const PieceStore::Piece& piece = store.piece(pieces_[i]);
    polygons_.push_back({o, i, first, piece.count, piece.support});
    boxes_.push_back(own_near_ ? piece_boxes_[i] : rounded_outwards(store.box(pieces_[i])));
  }
  for (const uint32_t point : piece_points_) vertex_of[point] = kNone;
}

uint32_t Job::piece(uint32_t polygon) const { return pieces_[polygons_[polygon].face]; }

uint32_t Job::version_piece(uint32_t polygon) const {
  return version_pieces_[polygons_[polygon].face];
}

uint32_t Job::piece_point(uint32_t vertex) const {
  return piece_points_[vertex - sources_.back().first_vertex];
}

PolygonBox Job::box_of(const JobPolygon& polygon) const {
  PieceBox box;
  for (const uint32_t v : corners(polygon)) box.add(rounded_[v]);
  return rounded_outwards(box);
}

/// Where vertices are whole numbers.
PolygonBox Job::grid_box_of(const JobPolygon& polygon) const {
  // Coordinates x, y and y, z: pairs, which the processor compares at once.
  using Pair = double __attribute__((vector_size(16)));
  struct Pairs {
    Pair xy, yz;
  };
  const auto load = [&](uint32_t v) {
    const std::array<double, 3>& at = rounded_[v];
    return Pairs{{at[0], at[1]}, {at[1], at[2]}};
  };
  const auto corners = this->corners(polygon);
  Pairs lo = load(corners[0]), hi = lo;
  for (const uint32_t v : corners.subspan(1)) {
    const Pairs at = load(v);
    lo.xy = at.xy < lo.xy ? at.xy : lo.xy;
    lo.yz = at.yz < lo.yz ? at.yz : lo.yz;
    hi.xy = at.xy > hi.xy ? at.xy : hi.xy;
    hi.yz = at.yz > hi.yz ? at.yz : hi.yz;
  }
  const auto whole = [](const Pairs& pairs) {
    const auto coordinate = [](double v) { return static_cast<int32_t>(clamp_to_box(v)); };
    return std::array<int32_t, 3>{coordinate(pairs.xy[0]), coordinate(pairs.xy[1]),
                                  coordinate(pairs.yz[1])};
  };
  return {whole(lo), whole(hi)};
}

uint32_t Job::operand_of_vertex(uint32_t vertex) const {
  const auto it =
      std::upper_bound(vertex_operand_starts_.begin(), vertex_operand_starts_.end(), vertex);
  return static_cast<uint32_t>(it - vertex_operand_starts_.begin()) - 1;
}

Point Job::exact(uint32_t vertex) const {
  const uint32_t o = operand_of_vertex(vertex);
  return exact_of(o, vertex - sources_[o].first_vertex);
}

bool Job::is_below(uint32_t vertex, uint32_t other) const {
  // Rounding keeps the order along each axis.
  const double x = rounded_[vertex][0], y = rounded_[other][0];
  return x != y ? x < y : compare(exact(vertex), exact(other)) < 0;
}

Point Job::exact_of(uint32_t o, uint32_t local) const {
  const Operand& operand = (*operands_)[o];
  const Source& source = sources_[o];
  if (operand.pieces) return operand.pieces->store->exact(piece_points_[local]);
  if (!operand.leaf) {
    const auto& own = boundary_vertices_[o];
    if (local >= own.size()) {  // of a named face
      const std::array<double, 3>& at = rounded_[source.first_vertex + local];
      return grid_point(static_cast<int64_t>(at[0]), static_cast<int64_t>(at[1]),
                        static_cast<int64_t>(at[2]));
    }
    const auto& t = own[local];
    return intersect(planes_.plane(t[0]), planes_.plane(t[1]), planes_.plane(t[2]));
  }
  return source.map.point(frame_point(o, source.first_vertex + local));
}

IVec3 Job::frame_point(size_t o, uint32_t vertex) const {
  const Operand& operand = (*operands_)[o];
  const IVec3 &q = operand.leaf->vertices[vertex - sources_[o].first_vertex],
              &t = operand.translation;
  return {q[0] + t[0], q[1] + t[1], q[2] + t[2]};
}

Job::VertexName Job::vertex_name(uint32_t vertex) const {
  const uint32_t o = operand_of_vertex(vertex);
  const Operand& operand = (*operands_)[o];
  if (operand.leaf) {
    return {{kNoVertexPlanes, kNoVertexPlanes, kNoVertexPlanes}, operand.frame.is_identity};
  }
  if (operand.pieces) {
    const PieceStore& store = *operand.pieces->store;
    return {store.point_planes(piece_point(vertex)), store.is_on_grid(piece_point(vertex))};
  }
  const auto& own = boundary_vertices_[o];
  const uint32_t local = vertex - sources_[o].first_vertex;
  if (local >= own.size()) return {{kNoVertexPlanes, kNoVertexPlanes, kNoVertexPlanes}, true};
  return {own[local], false};
}

FaceLabel Job::label(const JobPolygon& p) const {
  return label_of((*operands_)[p.operand], p.face);
}

bool Job::is_of_complete_facet(const JobPolygon& p) const {
  const Operand& operand = (*operands_)[p.operand];
  if (operand.leaf) return operand.leaf->facet[p.face] != 0;
  return is_face_of_leaf(p) || operand.boundary->faces[p.face].complete;
}

bool Job::is_of_whole_facet(const JobPolygon& p) const {
  const Operand& operand = (*operands_)[p.operand];
  if (operand.leaf) return operand.leaf->facet[p.face] != 0;
  return is_face_of_leaf(p) || operand.boundary->faces[p.face].whole;
}

uint32_t Job::wall(int axis, int64_t m) {
  Plane plane;
  (axis == 0 ? plane.a : axis == 1 ? plane.b : plane.c) = prime_;
  plane.d = -(static_cast<Int128>(prime_) * m + 1);
  return planes_.intern(plane).index();
}

}  // namespace csgrun
