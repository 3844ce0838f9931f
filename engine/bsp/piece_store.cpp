#include "engine/bsp/piece_store.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "engine/bsp/grid_planes.h"
#include "engine/exact/grid_meeting.h"

namespace csgrun {
namespace {

/// Planes of a face of a leaf that is in a frame, as its corners stand in the leaf.
class FramedFace {
 public:
  FramedFace(const Operand& operand, const FrameMap& map, uint32_t face)
      : leaf_(*operand.leaf),
        translation_(operand.translation),
        map_(map),
        begin_(leaf_.face_starts[face]),
        count_(leaf_.face_starts[face + 1] - begin_),
        own_(support_of_loop(count_, [this](uint32_t i) { return at(i); })) {}

  [[nodiscard]] uint32_t count() const { return count_; }
  [[nodiscard]] Plane support() const { return map_.plane(own_); }
  /// That of the edge from corner i to the next.
  [[nodiscard]] Plane edge(uint32_t i) const {
    return map_.plane(edge_plane(at(i), at(i + 1), dominant_axis(own_)));
  }
  [[nodiscard]] bool turns_at(uint32_t i) const {
    const auto n = normal_through(at(i + count_ - 1), at(i), at(i + 1));
    return n[0] != 0 || n[1] != 0 || n[2] != 0;
  }

 private:
  [[nodiscard]] IVec3 at(uint32_t i) const {
    const IVec3& v = leaf_.vertices[leaf_.corners[begin_ + i % count_]];
    return {v[0] + translation_[0], v[1] + translation_[1], v[2] + translation_[2]};
  }

  const LeafGeometry& leaf_;
  const IVec3& translation_;
  const FrameMap& map_;
  const uint32_t begin_, count_;
  const Plane own_;
};

/// For each vertex of a leaf in a frame a corner of the leaf that turns there; of other operands
/// none are needed. Nothing if a vertex of some face has no such corner.
std::optional<std::vector<uint32_t>> turning_corners(const Operand& operand, const FrameMap& map) {
  std::vector<uint32_t> corner_at;
  if (!operand.leaf || operand.frame.is_identity) return corner_at;
  const LeafGeometry& leaf = *operand.leaf;
  corner_at.assign(leaf.vertices.size(), PieceStore::kNoNumber);
  for (uint32_t f = 0; f < leaf.face_count(); ++f) {
    const FramedFace face(operand, map, f);
    for (uint32_t i = 0; i < face.count(); ++i) {
      const uint32_t corner = leaf.face_starts[f] + i;
      if (face.count() == 3 || face.turns_at(i)) corner_at[leaf.corners[corner]] = corner;
    }
  }
  const bool are_all_known = std::all_of(leaf.corners.begin(), leaf.corners.end(), [&](uint32_t v) {
    return corner_at[v] != PieceStore::kNoNumber;
  });
  if (!are_all_known) return std::nullopt;
  return corner_at;
}

}  // namespace

uint32_t PieceStore::add_operand(Job& job, const std::vector<Operand>& operands, uint32_t o) {
  const Operand& operand = operands[o];
  const auto first = static_cast<uint32_t>(rounded_.size());
  const auto number = static_cast<uint32_t>(operands_.size());
  const FrameMap map(operand.frame);
  auto corners = turning_corners(operand, map);
  if (!corners) return kNoNumber;
  operands_.push_back(operand);
  maps_.push_back(map);
  first_point_.push_back(first);
  corner_at_.push_back(*std::move(corners));
  const auto vertices = job.rounded_of(o);
  if (number == 0 && !vertices.empty()) {
    for (size_t k = 0; k < 3; ++k) origin_[k] = static_cast<int64_t>(vertices[0][k]);
  }
  rounded_.append(vertices);
  if (operand.leaf) {
    point_planes_.append(vertices.size(), {kNoNumber, kNoNumber, kNoNumber});
    is_on_grid_.resize(rounded_.size(), operand.frame.is_identity ? 1 : 0);
  } else {
    for (uint32_t v = job.vertex_start(o); v < job.vertex_start(o + 1); ++v) {
      point_planes_.push_back(job.vertex_name(v).planes);
      is_on_grid_.push_back(meet_on_grid_at(point_planes_.back(), job.rounded(v)));
    }
  }
  point_operand_.resize(rounded_.size(), number);
  return number;
}

void PieceStore::name(uint32_t point) {
  const uint32_t o = point_operand_[point];
  const LeafGeometry& leaf = *operands_[o].leaf;
  const uint32_t corner = corner_at_[o][point - first_point_[o]];
  const auto next = std::upper_bound(leaf.face_starts.begin(), leaf.face_starts.end(), corner);
  const auto face = static_cast<uint32_t>(next - leaf.face_starts.begin()) - 1;
  const FramedFace own(operands_[o], maps_[o], face);
  const uint32_t i = corner - leaf.face_starts[face], before = i > 0 ? i - 1 : own.count() - 1;
  point_planes_[point] = {planes.intern(own.support()).index(),
                          planes.intern(own.edge(before)).index(),
                          planes.intern(own.edge(i)).index()};
}

uint32_t PieceStore::add_point(const std::array<uint32_t, 3>& meeting,
                               const std::array<double, 3>& at) {
  rounded_.push_back(at);
  point_planes_.push_back(meeting);
  point_operand_.push_back(kNoNumber);
  is_on_grid_.push_back(meet_on_grid_at(meeting, at));
  return static_cast<uint32_t>(rounded_.size() - 1);
}

bool PieceStore::meet_on_grid_at(const std::array<uint32_t, 3>& meeting,
                                 const std::array<double, 3>& at) const {
  return meet_on_grid(planes.plane(meeting[0]), planes.plane(meeting[1]), planes.plane(meeting[2]),
                      at);
}

uint32_t PieceStore::add_piece(const Piece& piece) {
  pieces_.push_back(piece);
  const auto corners = this->corners(piece_count() - 1);
  PieceBox box;
  for (const uint32_t p : corners) box.add(rounded_[p]);
  boxes_.push_back(box);
  for (const uint32_t p : corners) ensure_name(p);
  return piece_count() - 1;
}

uint32_t PieceStore::add_region(Piece piece, std::span<const uint32_t> ends, uint32_t cell_count) {
  piece.region = static_cast<uint32_t>(regions_.size());
  regions_.push_back({static_cast<uint32_t>(loop_ends_.size()),
                      static_cast<uint32_t>(ends.size()),
                      piece.first + piece.count,
                      cell_count,
                      {}});
  loop_ends_.insert(loop_ends_.end(), ends.begin(), ends.end());
  for (uint32_t i = 0; i < cell_count; ++i) ensure_name(corners_[piece.first + piece.count + i]);
  return add_piece(piece);
}

uint32_t PieceStore::add_group(Piece piece, std::span<const uint32_t> faces) {
  piece.group = static_cast<uint32_t>(groups_.size());
  groups_.push_back(
      {static_cast<uint32_t>(group_faces_.size()), static_cast<uint32_t>(faces.size()), {}});
  group_faces_.insert(group_faces_.end(), faces.begin(), faces.end());
  pieces_.push_back(piece);
  PieceBox box;
  const LeafGeometry& leaf = *operands_[piece.operand].leaf;
  const uint32_t first_point = first_point_[piece.operand];
  for (const uint32_t f : faces) {
    for (uint32_t c = leaf.face_starts[f]; c < leaf.face_starts[f + 1]; ++c) {
      box.add(rounded_[first_point + leaf.corners[c]]);
    }
  }
  boxes_.push_back(box);
  return piece_count() - 1;
}

uint32_t PieceStore::add_face(Piece piece, uint32_t face) {
  piece.face = face;
  piece.first = static_cast<uint32_t>(corners_.size());
  append_corners(piece, face, corners_);
  piece.count = static_cast<uint32_t>(corners_.size()) - piece.first;
  edges_.resize(corners_.size(), kNoNumber);
  return add_piece(piece);
}

PieceStore::Parts PieceStore::group_parts(uint32_t piece) {
  const uint32_t number = pieces_[piece].group;
  if (groups_[number].parts.were_made()) return groups_[number].parts;
  const auto [first_face, face_count, none] = groups_[number];
  groups_[number].parts = {piece_count(), face_count};
  Piece part = pieces_[piece];
  part.group = kNoNumber;
  for (uint32_t i = first_face; i < first_face + face_count; ++i) add_face(part, group_faces_[i]);
  return groups_[number].parts;
}

Plane PieceStore::plane_of_corners(uint32_t piece) const {
  const Piece& p = pieces_[piece];
  return support_of_loop(p.count,
                         [&](uint32_t i) { return on_grid(corners_[p.first + i % p.count]); });
}

IVec3 PieceStore::on_grid(uint32_t point) const {
  const auto& at = rounded_[point];
  return {static_cast<int64_t>(at[0]), static_cast<int64_t>(at[1]), static_cast<int64_t>(at[2])};
}

// What has no planes yet is a face as it is: of grid points, or of a leaf in a frame. (Of a
// boundary in a frame a job has all planes.)

ReducedPlane PieceStore::reduced_support(uint32_t piece) const {
  const Piece& p = pieces_[piece];
  const FrameMap& map = maps_[p.operand];
  if (map.is_identity()) return reduce(plane_of_corners(piece));
  const Plane outwards = FramedFace(operands_[p.operand], map, p.face).support();
  return reduce(p.is_flipped ? outwards.reversed() : outwards);
}

ReducedPlane PieceStore::reduced_edge(uint32_t piece, uint32_t edge) const {
  const Piece& p = pieces_[piece];
  if (const FrameMap& map = maps_[p.operand]; !map.is_identity()) {
    const FramedFace own(operands_[p.operand], map, p.face);
    return reduce(own.edge(edge_place(edge, p.count, runs_back(p))));
  }
  const uint32_t next = edge + 1 < p.count ? edge + 1 : 0;
  return reduce(edge_plane(on_grid(corners_[p.first + edge]), on_grid(corners_[p.first + next]),
                           dominant_axis(plane_of_corners(piece))));
}

Point PieceStore::exact(uint32_t point) const {
  if (is_on_grid(point)) {
    const IVec3 at = on_grid(point);
    return grid_point(at[0], at[1], at[2]);
  }
  if (const uint32_t o = point_operand_[point]; o != kNoNumber && operands_[o].leaf) {
    const IVec3 &v = operands_[o].leaf->vertices[point - first_point_[o]],
                &t = operands_[o].translation;
    return maps_[o].point({v[0] + t[0], v[1] + t[1], v[2] + t[2]});
  }
  const auto& t = point_planes_[point];
  return intersect(planes.plane(t[0]), planes.plane(t[1]), planes.plane(t[2]));
}

}  // namespace csgrun
