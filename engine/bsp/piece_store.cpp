#include "engine/bsp/piece_store.h"

#include <algorithm>

#include "engine/bsp/grid_planes.h"
#include "engine/exact/grid_meeting.h"

namespace csgrun {
namespace {

/// Whether a face of a leaf turns at its corner `i`.
bool turns_at(const LeafGeometry& leaf, uint32_t face, uint32_t i) {
  const uint32_t begin = leaf.face_starts[face], count = leaf.face_starts[face + 1] - begin;
  const auto at = [&](uint32_t k) -> const IVec3& {
    return leaf.vertices[leaf.corners[begin + k % count]];
  };
  const Plane plane = plane_through(at(i + count - 1), at(i), at(i + 1));
  return plane.a != 0 || plane.b != 0 || plane.c != 0;
}

}  // namespace

uint32_t PieceStore::add_operand(Job& job, const std::vector<Operand>& operands, uint32_t o) {
  const Operand& operand = operands[o];
  const auto first = static_cast<uint32_t>(rounded_.size());
  const auto number = static_cast<uint32_t>(operands_.size());
  const uint32_t begin = job.vertex_start(o), end = job.vertex_start(o + 1);
  if (operands_.empty() && begin < end) {
    for (size_t k = 0; k < 3; ++k) origin_[k] = static_cast<int64_t>(job.rounded(begin)[k]);
  }
  for (uint32_t v = begin; v < end; ++v) {
    rounded_.push_back(job.rounded(v));
    point_planes_.push_back(job.vertex_name(v).planes);
    is_on_grid_.push_back(operand.leaf ? operand.frame.is_identity
                                       : meet_on_grid_at(point_planes_.back(), rounded_.back()));
  }
  point_operand_.resize(rounded_.size(), number);
  const uint32_t first_polygon = job.polygon_start(o), end_polygon = job.polygon_start(o + 1);
  if (operand.leaf && !operand.frame.is_identity) {
    for (uint32_t p = first_polygon; p < end_polygon; ++p) {
      job.ensure_planes(p);
      const JobPolygon& polygon = job.polygons()[p];
      const auto corners = job.corners(polygon);
      const auto edges = job.edge_planes(polygon);
      for (uint32_t i = 0; i < polygon.count; ++i) {
        auto& meeting = point_planes_[first + corners[i] - begin];
        if (meeting[0] != kNoNumber) continue;
        const uint32_t before = i > 0 ? i - 1 : polygon.count - 1;
        // A mirrored loop runs backwards: its corner i is the leaf's corner n - 1 - i.
        const uint32_t in_leaf =
            corners[0] - begin == operand.leaf->corners[operand.leaf->face_starts[polygon.face]]
                ? i
                : polygon.count - 1 - i;
        if (!turns_at(*operand.leaf, polygon.face, in_leaf)) continue;
        meeting = {polygon.support.index(), edges[before], edges[i]};
      }
    }
    const bool all_known = std::all_of(point_planes_.begin() + first, point_planes_.end(),
                                       [](const auto& p) { return p[0] != kNoNumber; });
    if (!all_known) return kNoNumber;
  }
  operands_.push_back(operand);
  first_point_.push_back(first);
  return number;
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
  PieceBox box;
  for (const uint32_t p : corners(piece_count() - 1)) box.add(rounded_[p]);
  boxes_.push_back(box);
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
  return add_piece(piece);
}

uint32_t PieceStore::add_group(Piece piece, std::span<const uint32_t> faces) {
  piece.group = static_cast<uint32_t>(groups_.size());
  groups_.push_back(
      {static_cast<uint32_t>(group_faces_.size()), static_cast<uint32_t>(faces.size()), {}});
  group_faces_.insert(group_faces_.end(), faces.begin(), faces.end());
  pieces_.push_back(piece);
  PieceBox box;
  each_face(piece_count() - 1, [&](std::span<const uint32_t> corners) {
    for (const uint32_t p : corners) box.add(rounded_[p]);
  });
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

PlaneId PieceStore::ensure_support(uint32_t piece) {
  Piece& p = pieces_[piece];
  if (!p.support.valid()) p.support = planes.intern(plane_of_corners(piece));
  return p.support;
}

uint32_t PieceStore::ensure_edge(uint32_t piece, uint32_t edge) {
  const Piece& p = pieces_[piece];
  uint32_t& plane = edges_[p.first + edge];
  if (plane == kNoNumber) {
    const uint32_t next = edge + 1 < p.count ? edge + 1 : 0;
    plane =
        planes
            .intern(edge_plane(on_grid(corners_[p.first + edge]), on_grid(corners_[p.first + next]),
                               dominant_axis(plane_of_corners(piece))))
            .index();
  }
  return plane;
}

Point PieceStore::exact(uint32_t point) const {
  if (is_on_grid(point)) {
    const IVec3 at = on_grid(point);
    return grid_point(at[0], at[1], at[2]);
  }
  const auto& t = point_planes_[point];
  return intersect(planes.plane(t[0]), planes.plane(t[1]), planes.plane(t[2]));
}

}  // namespace csgrun
