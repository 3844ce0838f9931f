#include "engine/bsp/piece_writer.h"

#include <algorithm>
#include <utility>

#include "engine/base/counting_order.h"

namespace csgrun {
namespace {

/// Of fewer faces a group costs what they do; the more there are, the more are made pieces of when
/// an operation comes near one of them.
constexpr size_t kLeastOfGroup = 8, kMostOfGroup = 64;

}  // namespace

bool PieceWriter::add_operands() {
  for (uint32_t o = 0; o < operands_.size(); ++o) {
    number_.push_back(kNone);
    if (operands_[o].pieces) continue;
    number_[o] = store_.add_operand(job_, operands_, o);
    if (number_[o] == PieceStore::kNoNumber) return false;
  }
  return true;
}

void PieceWriter::add_whole(std::span<const WholePolygon> whole, std::span<const FarFaces> far) {
  std::vector<FarFaces> grouped(operands_.size());
  std::copy(far.begin(), far.end(), grouped.begin());
  for (const WholePolygon& w : whole) {
    const auto& [o, face, first, count, support] = job_.polygons()[w.polygon];
    if (w.is_met || !operands_[o].leaf) {
      add_single(w);
    } else {
      (w.flip ? grouped[o].flipped : grouped[o].kept).push_back(face);
    }
  }
  for (uint32_t o = 0; o < grouped.size(); ++o) {
    add_groups(o, grouped[o].kept, false);
    add_groups(o, grouped[o].flipped, true);
  }
}

void PieceWriter::add_groups(uint32_t operand, std::span<const uint32_t> faces, bool flip) {
  PieceStore::Piece piece{number_[operand], 0, 0, 0, PlaneId(), true, flip};
  if (faces.size() < kLeastOfGroup) {
    for (const uint32_t f : faces) added.push_back(store_.add_face(piece, f));
    return;
  }
  if (faces.size() <= kMostOfGroup) {
    added.push_back(store_.add_group(piece, faces));
    return;
  }
  // By the octants around the middle of where they are.
  const LeafGeometry& leaf = *operands_[operand].leaf;
  const auto at = [&](uint32_t f) -> const IVec3& {
    return leaf.vertices[leaf.corners[leaf.face_starts[f]]];
  };
  GridBox box{at(faces[0]), at(faces[0])};
  for (const uint32_t f : faces) {
    const IVec3 p = at(f);
    for (size_t k = 0; k < 3; ++k) {
      box.lo[k] = std::min(box.lo[k], p[k]);
      box.hi[k] = std::max(box.hi[k], p[k]);
    }
  }
  std::vector<uint8_t> octant(faces.size());
  for (size_t i = 0; i < faces.size(); ++i) {
    const IVec3 p = at(faces[i]);
    uint32_t bits = 0;
    for (size_t k = 0; k < 3; ++k) bits |= uint32_t{2 * p[k] > box.lo[k] + box.hi[k]} << k;
    octant[i] = static_cast<uint8_t>(bits);
  }
  CountingOrder octants;
  octants.sort(faces.size(), 8, [&](size_t i) { return octant[i]; });
  std::vector<uint32_t> ordered;
  ordered.reserve(faces.size());
  for (const uint32_t i : octants.order) ordered.push_back(faces[i]);
  for (size_t i = 0; i < 8; ++i) {
    const uint32_t first = octants.starts[i];
    const auto own = std::span(ordered).subspan(first, octants.starts[i + 1] - first);
    if (own.size() < faces.size()) {
      add_groups(operand, own, flip);
      continue;
    }
    // All of them begin at one point.
    for (size_t j = 0; j < own.size(); j += kMostOfGroup) {
      add_groups(operand, own.subspan(j, std::min(kMostOfGroup, own.size() - j)), flip);
    }
  }
}

void PieceWriter::add_single(const WholePolygon& w) {
  const JobPolygon& p = job_.polygons()[w.polygon];
  const auto corners = job_.corners(p);
  const auto edges = job_.edge_planes(p);
  PieceStore::Piece piece = origin_of(w.polygon);
  piece.is_whole = piece.is_whole || operands_[p.operand].leaf;
  piece.is_flipped = piece.is_flipped != w.flip;
  piece.is_met = piece.is_met || w.is_met;  // one in pieces may have been before
  piece.first = static_cast<uint32_t>(store_.corners().size());
  piece.count = p.count;
  piece.support = p.support.valid() && w.flip ? p.support.flip() : p.support;
  for (uint32_t i = 0; i < p.count; ++i) {
    store_.corners().push_back(store_vertex(corners[corner_place(i, p.count, w.flip)]));
    store_.edges().push_back(edges[edge_place(i, p.count, w.flip)]);
  }
  added.push_back(store_.add_piece(piece));
}

bool PieceWriter::add_cut(const std::vector<FragmentSet>& sets) {
  struct Loop {
    uint32_t polygon;
    PlaneId plane;
    uint32_t set, piece;
  };
  std::vector<Loop> loops;
  for (uint32_t s = 0; s < sets.size(); ++s) {
    for (uint32_t i = 0; i < sets[s].pieces.size(); ++i) {
      loops.push_back({sets[s].pieces[i].polygon, sets[s].pieces[i].plane, s, i});
    }
  }
  std::stable_sort(loops.begin(), loops.end(), [](const Loop& a, const Loop& b) {
    return std::pair(a.polygon, a.plane) < std::pair(b.polygon, b.plane);
  });
  points_.resize(sets.size());
  for (size_t i = 0, j = 0; i < loops.size(); i = j) {
    edges_.clear();
    bool is_simple = false;
    for (j = i; j < loops.size() && loops[j].polygon == loops[i].polygon &&
                loops[j].plane == loops[i].plane;
         ++j) {
      const FragmentSet& set = sets[loops[j].set];
      add_edges(set, loops[j].piece, points_[loops[j].set]);
      is_simple = j == i && !set.pieces[loops[j].piece].is_loose;
    }
    if (!add_region(loops[i].polygon, loops[i].plane, is_simple)) return false;
  }
  return true;
}

PieceStore::Piece PieceWriter::origin_of(uint32_t polygon) const {
  const uint32_t o = job_.polygons()[polygon].operand;
  if (number_[o] == kNone) return store_.piece(job_.piece(polygon));
  return {number_[o], job_.polygons()[polygon].face, 0, 0, PlaneId(), false, false};
}

uint32_t PieceWriter::store_vertex(uint32_t vertex) {
  if (!same_.empty() && same_[vertex] != kNone) vertex = same_[vertex];
  const uint32_t o = job_.operand_of_vertex(vertex);
  if (number_[o] == kNone) return job_.piece_point(vertex);
  return store_.first_point(number_[o]) + vertex - job_.vertex_start(o);
}

uint32_t PieceWriter::store_point(uint32_t p) {
  const auto point = geometry_.point(p);
  if (point.vertex != kNone) return store_vertex(point.vertex);
  point_number_.resize(geometry_.point_count(), kNone);
  if (point_number_[p] == kNone) point_number_[p] = store_.add_point(point.planes, point.rounded);
  return point_number_[p];
}

void PieceWriter::add_edges(const FragmentSet& set, uint32_t piece, std::vector<uint32_t>& points) {
  if (points.empty()) {
    for (const FragmentSet::NamedPoint& p : set.points) {
      points.push_back(index_.unique(p.vertex != kNone ? geometry_.vertex_point(p.vertex)
                                                       : geometry_.add_point(p.planes, p.rounded)));
    }
  }
  const FragmentSet::Piece& p = set.pieces[piece];
  for (uint32_t i = 0; i < p.count; ++i) {
    const uint32_t next = i + 1 < p.count ? i + 1 : 0;
    edges_.push_back({points[set.corner_point[p.first + i]],
                      points[set.corner_point[p.first + next]], set.corner_plane[p.first + i]});
  }
}

Fragment PieceWriter::cell_of(uint32_t polygon, PlaneId plane) {
  const JobPolygon& p = job_.polygons()[polygon];
  const auto corners = job_.corners(p);
  const auto edges = job_.edge_planes(p);
  const bool flip = plane != p.support;
  cell_points_.clear();
  cell_edges_.clear();
  for (uint32_t i = 0; i < p.count; ++i) {
    cell_points_.push_back(geometry_.vertex_point(corners[corner_place(i, p.count, flip)]));
    cell_edges_.push_back(edges[edge_place(i, p.count, flip)]);
  }
  return geometry_.make_fragment(plane, cell_points_, cell_edges_);
}

bool PieceWriter::add_region(uint32_t polygon, PlaneId plane, bool is_simple) {
  const RegionLoops* loops = &loops_;
  if (is_simple) {
    loops_.clear();
    loops_.edges = edges_;
    loops_.starts.push_back(static_cast<uint32_t>(edges_.size()));
  } else if (!regions_.build(plane, edges_, loops_)) {
    return false;
  }
  job_.ensure_planes(polygon);
  boundary_.clear();
  for (const DirectedEdge& e : loops_.edges) boundary_.push_back({e.from, e.to, e.plane});
  fragments_.clear();
  const bool any_rest = cut_off_within(geometry_, job_.planes(), cell_of(polygon, plane), boundary_,
                                       wall_of_, fragments_, rest_);
  PieceStore::Piece piece = origin_of(polygon);
  piece.is_whole = false;
  piece.support = plane;
  for (const Fragment& f : fragments_) {
    piece.first = static_cast<uint32_t>(store_.corners().size());
    piece.count = f.count;
    for (uint32_t i = 0; i < f.count; ++i)
      add_corner(geometry_.corners(f)[i], geometry_.edges(f)[i]);
    added.push_back(store_.add_piece(piece));
  }
  if (!any_rest) return true;
  if (rest_.is_cut_off) {
    edges_.clear();
    for (const BoundaryEdge& e : rest_.edges) edges_.push_back({e.from, e.to, e.plane});
    if (!regions_.build_single(plane, edges_, rest_loops_)) return false;
    loops = &rest_loops_;
  }
  add_loops(piece, *loops, rest_.cell);
  return true;
}

void PieceWriter::add_loops(PieceStore::Piece piece, const RegionLoops& loops,
                            const Fragment& cell) {
  piece.first = static_cast<uint32_t>(store_.corners().size());
  piece.count = static_cast<uint32_t>(loops.edges.size());
  for (const DirectedEdge& e : loops.edges) add_corner(e.from, e.plane);
  for (uint32_t i = 0; i < cell.count; ++i) {
    add_corner(geometry_.corners(cell)[i], geometry_.edges(cell)[i]);
  }
  added.push_back(store_.add_region(piece, std::span(loops.starts).subspan(1), cell.count));
}

}  // namespace csgrun
