#include "engine/bsp/assemble.h"

#include <algorithm>
#include <cassert>
#include <numeric>

#include "engine/bsp/canonical_order.h"
#include "engine/bsp/point_index.h"
#include "engine/bsp/regions.h"

namespace csgrun {
namespace {

class Assembler {
 public:
  explicit Assembler(Job& job)
      : job_(job),
        geometry_(job.planes(), &job),
        index_(geometry_),
        builder_(geometry_, job.planes()) {}

  Result<std::shared_ptr<const BoundaryMesh>> run(const std::vector<FragmentSet>& sets,
                                                  const std::vector<WholePolygon>& whole) {
    gather(sets, whole);
    std::sort(pieces_.begin(), pieces_.end(), [](const Piece& a, const Piece& b) {
      return std::tie(a.plane, a.label, a.polygon, a.first) <
             std::tie(b.plane, b.label, b.polygon, b.first);
    });
    for (size_t i = 0; i < pieces_.size();) {
      size_t j = i + 1;
      while (j < pieces_.size() && pieces_[j].plane == pieces_[i].plane &&
             pieces_[j].label == pieces_[i].label) {
        ++j;
      }
      if (!add_face(i, j)) {
        return Error{ErrorCode::kInternal,
                     "the pieces of a face do not close up (plane " +
                         std::to_string(pieces_[i].plane.index()) + ")",
                     {}};
      }
      i = j;
    }
    return std::shared_ptr<const BoundaryMesh>(
        std::make_shared<BoundaryMesh>(canonical(geometry_, job_.planes(), std::move(draft_))));
  }

 private:
  struct Piece {
    PlaneId plane;
    FaceLabel label;
    uint32_t polygon, first, count;
    bool whole;
  };

  void gather(const std::vector<FragmentSet>& sets, const std::vector<WholePolygon>& whole) {
    std::vector<uint32_t> number;
    for (const FragmentSet& set : sets) {
      number.clear();
      for (const FragmentSet::NamedPoint& p : set.points) {
        number.push_back(p.vertex != kNone ? vertex(p.vertex)
                                           : index_.unique(geometry_.add_point(p.planes, p.rounded)));
      }
      for (const FragmentSet::Piece& p : set.pieces) {
        pieces_.push_back({p.plane, job_.label(job_.polygons()[p.polygon]), p.polygon,
                           static_cast<uint32_t>(corners_.size()), p.count, false});
        for (uint32_t i = 0; i < p.count; ++i) {
          corners_.push_back(number[set.corner_point[p.first + i]]);
          planes_.push_back(set.corner_plane[p.first + i]);
        }
      }
    }
    for (const WholePolygon& w : whole) {
      job_.ensure_planes(w.polygon);
      const JobPolygon& p = job_.polygons()[w.polygon];
      pieces_.push_back({w.flip ? p.support.flip() : p.support, job_.label(p), w.polygon,
                         static_cast<uint32_t>(corners_.size()), p.count, true});
      add_polygon(p, w.flip);
    }
  }

  void add_polygon(const JobPolygon& p, bool flip) {
    const auto corners = job_.corners(p);
    const auto edges = job_.edge_planes(p);
    for (uint32_t i = 0; i < p.count; ++i) {
      corners_.push_back(vertex(corners[flip ? p.count - 1 - i : i]));
      planes_.push_back(edges[flip ? (2 * p.count - 2 - i) % p.count : i]);
    }
  }

  uint32_t vertex(uint32_t v) {
    if (vertex_number_.empty()) vertex_number_.assign(job_.vertex_count(), kNone);
    if (vertex_number_[v] == kNone) vertex_number_[v] = index_.unique(geometry_.vertex_point(v));
    return vertex_number_[v];
  }

  void edges_of(const Piece& p, std::vector<DirectedEdge>& edges) const {
    for (uint32_t i = 0; i < p.count; ++i) {
      const uint32_t next = i + 1 < p.count ? i + 1 : 0;
      edges.push_back({corners_[p.first + i], corners_[p.first + next], planes_[p.first + i]});
    }
  }

  /// Makes one face of pieces [begin, end), which share plane, side and label.
  bool add_face(size_t begin, size_t end) {
    edges_.clear();
    for (size_t i = begin; i < end; ++i) edges_of(pieces_[i], edges_);
    const Piece first = pieces_[begin];
    if (!builder_.build(first.plane, edges_, loops_)) return false;
    if (loops_.loop_count() == 0) return true;
    draft_.faces.push_back({first.plane, first.label, false, loops_});
    if (job_.is_whole_facet(job_.polygons()[first.polygon])) {
      draft_.faces.back().whole = is_whole(begin, end);
    }
    return true;
  }

  /// Whether the face just made is the whole facet that its pieces come from.
  bool is_whole(size_t begin, size_t end) {
    const Piece first = pieces_[begin];
    // The polygons of a facet stand together in the job.
    const auto same = [&](uint32_t q) {
      const JobPolygon& a = job_.polygons()[first.polygon];
      const JobPolygon& b = job_.polygons()[q];
      return a.operand == b.operand && job_.label(b) == first.label;
    };
    uint32_t lo = first.polygon, hi = first.polygon + 1;
    while (lo > 0 && same(lo - 1)) --lo;
    while (hi < job_.polygons().size() && same(hi)) ++hi;
    facet_.clear();
    uint32_t polygons = 0;
    const size_t mark = corners_.size();
    for (uint32_t q = lo; q < hi; ++q) {
      job_.ensure_planes(q);
      const JobPolygon& p = job_.polygons()[q];
      if (p.support.index() != first.plane.index()) continue;
      ++polygons;
      const bool flip = p.support != first.plane;
      const Piece piece{first.plane, first.label, q, static_cast<uint32_t>(corners_.size()), p.count,
                        true};
      add_polygon(p, flip);
      edges_of(piece, facet_);
    }
    corners_.resize(mark);
    planes_.resize(mark);
    if (polygons == end - begin &&
        std::all_of(pieces_.begin() + begin, pieces_.begin() + end,
                    [](const Piece& p) { return p.whole; })) {
      return true;
    }
    if (!builder_.build(first.plane, facet_, facet_loops_)) return false;
    return same_loops(facet_loops_, loops_);
  }

  static bool same_loops(const RegionLoops& a, const RegionLoops& b) {
    if (a.starts.size() != b.starts.size() || a.edges.size() != b.edges.size()) return false;
    const auto sorted_edges = [](const RegionLoops& l) {
      std::vector<std::pair<uint32_t, uint32_t>> e;
      for (const DirectedEdge& d : l.edges) e.emplace_back(d.from, d.to);
      std::sort(e.begin(), e.end());
      return e;
    };
    return sorted_edges(a) == sorted_edges(b);
  }

  Job& job_;
  CellGeometry geometry_;
  PointIndex index_;
  RegionBuilder builder_;
  std::vector<uint32_t> vertex_number_;
  std::vector<Piece> pieces_;
  std::vector<uint32_t> corners_, planes_;
  std::vector<DirectedEdge> edges_, facet_;
  RegionLoops loops_, facet_loops_;
  DraftBoundary draft_;
};

}  // namespace

Result<std::shared_ptr<const BoundaryMesh>> assemble(Job& job, const std::vector<FragmentSet>& sets,
                                                     const std::vector<WholePolygon>& whole) {
  return Assembler(job).run(sets, whole);
}

}  // namespace csgrun
