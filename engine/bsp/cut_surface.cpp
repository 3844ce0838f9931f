#include "engine/bsp/cut_surface.h"

#include <algorithm>
#include <cassert>
#include <numeric>
#include <tuple>

#include "engine/bsp/offset_sets.h"
#include "engine/bsp/piece_rays.h"
#include "engine/bsp/point_index.h"
#include "engine/bsp/sign_stats.h"
#include "engine/bsp/surface_cells.h"
#include "engine/bsp/surface_octree.h"
#include "engine/bsp/winding.h"

namespace csgrun {
namespace {

/// Polygons that cross others, and these.
class Partners {
 public:
  Partners(std::span<const std::array<uint32_t, 2>> crossings, std::span<const uint8_t> crosses)
      : place_(crosses.size(), kNone) {
    for (uint32_t p = 0; p < crosses.size(); ++p) {
      if (!crosses[p]) continue;
      place_[p] = static_cast<uint32_t>(polygons_.size());
      polygons_.push_back(p);
    }
    of_.resize(polygons_.size());
    for (const auto& [f, g] : crossings) {
      of_[place_[f]].push_back(g);
      of_[place_[g]].push_back(f);
    }
  }
  [[nodiscard]] const std::vector<uint32_t>& polygons() const { return polygons_; }
  /// Where a polygon stands among these; kNone for one that crosses nothing.
  [[nodiscard]] uint32_t place(uint32_t polygon) const { return place_[polygon]; }
  /// Those that cross the i-th of the polygons.
  [[nodiscard]] const std::vector<uint32_t>& of(uint32_t i) const { return of_[i]; }

 private:
  std::vector<uint32_t> place_, polygons_;
  std::vector<std::vector<uint32_t>> of_;
};

/// A directed edge of a piece, by unique points.
struct PieceEdge {
  uint32_t low, high;
  bool rises;  ///< runs from the lower number to the higher one
  uint32_t piece;

  [[nodiscard]] uint32_t from() const { return rises ? low : high; }
  [[nodiscard]] uint32_t to() const { return rises ? high : low; }
};

class SurfaceCutter {
 public:
  SurfaceCutter(Job& job, const LeafGeometry& leaf, std::span<const uint32_t> opposite,
                std::span<const std::array<uint32_t, 2>> crossings,
                std::span<const uint8_t> crosses, const KernelOptions& options)
      : job_(job),
        leaf_(leaf),
        opposite_(opposite),
        crosses_(crosses),
        options_(options),
        partners_(crossings, crosses),
        is_left_(partners_.polygons().size(), 0),
        geometry_(job.planes(), &job),
        index_(geometry_) {}

  Result<std::optional<CutSurface>> run(EvaluateStats& stats) {
    if (!cut_all()) return std::optional<CutSurface>();
    // Polygons, pieces, and what is at infinity.
    const auto polygons = static_cast<uint32_t>(job_.polygons().size());
    infinity_ = polygons + static_cast<uint32_t>(pieces_.size());
    OffsetSets windings(infinity_ + 1);
    bool agrees = join_polygons(windings);
    for (uint32_t i = 0; i < partners_.polygons().size() && agrees; ++i) {
      agrees = is_left_[i] || join_pieces(i, windings);
    }
    for (uint32_t i = 0; i < partners_.polygons().size() && agrees; ++i) {
      agrees = is_left_[i] || join_over_edges(i, windings);
    }
    if (!agrees) return std::optional<CutSurface>();
    if (is_closed()) {
      agrees = ask_rays(windings);
      if (is_cancelled()) {
        return Error{ErrorCode::kCancelled, "the evaluation was cancelled", {}};
      }
      if (!agrees) return std::optional<CutSurface>();
    } else {
      leave_what_hangs_together(windings);
    }
    leave_what_lies_upon();
    add_signs(stats, geometry_.counters);
    const std::vector<uint32_t> witnesses = choose_witnesses(windings);
    if (witnesses.empty() && std::find(is_left_.begin(), is_left_.end(), 1) == is_left_.end()) {
      return labelled(windings, {});
    }
    auto runs = solve_cells(witnesses, stats);
    if (!runs) return runs.error();
    for (const SurfaceCells& run : *runs) {
      for (const SurfaceCells::PatchSides& s : run.patches) {
        if (!windings.join(infinity_, s.patch, run.windings[s.front])) {
          return std::optional<CutSurface>();
        }
      }
    }
    return labelled(windings, std::move(*runs));
  }

 private:
  /// What is known of the i-th polygon that crosses others.
  struct Cut {
    uint32_t first_piece, end_piece;
    std::vector<uint32_t> crossing, coplanar;  ///< the polygons that it has contact with
    /// Per edge of the polygon: the edges of pieces at its start and at its end.
    std::vector<PieceEdge> at_start, at_end;
  };

  [[nodiscard]] uint32_t number(uint32_t piece) const {
    return static_cast<uint32_t>(job_.polygons().size()) + piece;
  }
  [[nodiscard]] bool is_cancelled() const {
    return options_.cancel && options_.cancel->load(std::memory_order_relaxed);
  }

  /// False when it was cancelled.
  bool cut_all() {
    for (const uint32_t p : partners_.polygons()) job_.ensure_planes(p);
    for (uint32_t i = 0; i < partners_.polygons().size(); ++i) {
      if (is_cancelled()) return false;
      cut(i);
    }
    return true;
  }

  void cut(uint32_t i) {
    const uint32_t polygon = partners_.polygons()[i];
    const uint32_t support = job_.polygons()[polygon].support.index();
    Cut& cut = cuts_.emplace_back();
    std::vector<uint32_t> planes;
    for (const uint32_t other : partners_.of(i)) {
      const JobPolygon& p = job_.polygons()[other];
      const bool is_coplanar = p.support.index() == support;
      (is_coplanar ? cut.coplanar : cut.crossing).push_back(other);
      if (is_coplanar) {
        const auto edges = job_.edge_planes(p);
        planes.insert(planes.end(), edges.begin(), edges.end());
      } else {
        planes.push_back(p.support.index());
      }
    }
    cut.first_piece = cut.end_piece = static_cast<uint32_t>(pieces_.size());
    if (planes.size() > kMostCuts) {
      is_left_[i] = 1;
      return;
    }
    pieces_.push_back(geometry_.load(polygon));
    for (const uint32_t plane : planes) {
      for (size_t k = cut.first_piece, end = pieces_.size(); k < end; ++k) {
        Fragment front, back;
        if (geometry_.split(pieces_[k], plane, front, back) != Side::kSplit) continue;
        pieces_[k] = front;
        pieces_.push_back(back);
      }
    }
    cut.end_piece = static_cast<uint32_t>(pieces_.size());
  }

  /// Over the edges of polygons that cross nothing, winding numbers stay.
  bool join_polygons(OffsetSets& windings) {
    bool agrees = true;
    for (uint32_t p = 0; p < crosses_.size(); ++p) {
      const JobPolygon& polygon = job_.polygons()[p];
      for (uint32_t c = polygon.first; c < polygon.first + polygon.count; ++c) {
        const uint32_t other = neighbour(c);
        if (other == kNone) continue;
        if (!crosses_[p] && !crosses_[other] && p < other) agrees &= windings.join(p, other, 0);
      }
    }
    return agrees;
  }

  /// The polygon on the other side of an edge; kNone where there are more than one.
  [[nodiscard]] uint32_t neighbour(uint32_t edge) {
    return opposite_[edge] == kNone ? kNone : face_of(opposite_[edge]);
  }
  [[nodiscard]] uint32_t face_of(uint32_t corner) {
    if (face_of_.empty()) {
      face_of_.resize(leaf_.corners.size());
      for (uint32_t f = 0; f < leaf_.face_count(); ++f) {
        std::fill(face_of_.begin() + leaf_.face_starts[f],
                  face_of_.begin() + leaf_.face_starts[f + 1], f);
      }
    }
    return face_of_[corner];
  }

  /// From piece to piece of a polygon; it is left where that cannot be told.
  bool join_pieces(uint32_t i, OffsetSets& windings) {
    std::vector<PieceEdge> edges;
    for (uint32_t k = cuts_[i].first_piece; k < cuts_[i].end_piece; ++k) {
      const Fragment& piece = pieces_[k];
      for (uint32_t c = 0; c < piece.count; ++c) {
        const uint32_t a = index_.unique(geometry_.corners(piece)[c]),
                       b = index_.unique(geometry_.corners(piece)[c + 1 < piece.count ? c + 1 : 0]);
        edges.push_back({std::min(a, b), std::max(a, b), a < b, k});
      }
    }
    std::sort(edges.begin(), edges.end(), [](const PieceEdge& a, const PieceEdge& b) {
      return std::tie(a.low, a.high, a.rises) < std::tie(b.low, b.high, b.rises);
    });
    std::vector<PieceEdge> rim;  // of the polygon
    for (size_t e = 0; e < edges.size(); ++e) {
      const PieceEdge& edge = edges[e];
      if (e + 1 == edges.size() || edges[e + 1].low != edge.low || edges[e + 1].high != edge.high) {
        rim.push_back(edge);
        continue;
      }
      ++e;
      const auto step = winding_step(i, edge);
      if (!step) {
        is_left_[i] = 1;
        return true;
      }
      if (!windings.join(number(edge.piece), number(edges[e].piece), *step)) return false;
    }
    return join_along_rim(i, rim, windings);
  }

  /// By how much the winding number just in front of a polygon changes over an edge between two of
  /// its pieces, from the given one to the other: by the polygons that stand there.
  std::optional<int32_t> winding_step(uint32_t i, const PieceEdge& edge) {
    const PlaneId support = job_.polygons()[partners_.polygons()[i]].support;
    int32_t step = 0;
    for (const uint32_t other : cuts_[i].crossing) {
      const PlaneId wall = job_.polygons()[other].support;
      if (geometry_.side(wall.index(), edge.low) != 0) continue;
      if (geometry_.side(wall.index(), edge.high) != 0) continue;
      const auto holds = holds_segment(other, edge.low, edge.high);
      if (!holds) return std::nullopt;
      if (!*holds || !reaches_front(other, support)) continue;
      step += side_of_piece(wall, pieces_[edge.piece]);
    }
    return step;
  }

  /// Whether a segment on a polygon's plane is in the polygon, boundary included; none where a part
  /// of it is.
  std::optional<bool> holds_segment(uint32_t polygon, uint32_t a, uint32_t b) {
    const JobPolygon& p = job_.polygons()[polygon];
    bool ends_inside = true;
    bool beyond = false;
    for (uint32_t e = 0; e < p.count; ++e) {
      const uint32_t plane = job_.edge_planes(p)[e];
      const int inner = inner_side(p, e);
      const int at_a = geometry_.side(plane, a) * inner, at_b = geometry_.side(plane, b) * inner;
      if (at_a >= 0 && at_b >= 0) continue;
      ends_inside = false;
      beyond |= at_a <= 0 && at_b <= 0;
    }
    if (ends_inside) return true;
    return beyond ? std::optional(false) : std::nullopt;
  }

  /// The side of an edge's plane on which a polygon lies.
  int inner_side(const JobPolygon& p, uint32_t edge) {
    for (uint32_t k = 2; k < p.count; ++k) {
      const uint32_t corner = job_.corners(p)[(edge + k) % p.count];
      const int side = geometry_.side_of_vertex(job_.edge_planes(p)[edge], corner);
      if (side != 0) return side;
    }
    return 0;  // not reached: the corners of a polygon are not on one line
  }

  /// Whether a polygon has a corner in front of a plane.
  bool reaches_front(uint32_t polygon, PlaneId plane) {
    const auto corners = job_.corners(job_.polygons()[polygon]);
    return std::any_of(corners.begin(), corners.end(), [&](uint32_t v) {
      return oriented_side(plane, geometry_.vertex_point(v)) > 0;
    });
  }
  int oriented_side(PlaneId plane, uint32_t point) {
    const int side = geometry_.side(plane.index(), point);
    return plane.flipped() ? -side : side;
  }
  /// Of a piece that the plane was used to cut.
  int side_of_piece(PlaneId plane, const Fragment& piece) {
    for (uint32_t c = 0; c < piece.count; ++c) {
      const int side = oriented_side(plane, geometry_.corners(piece)[c]);
      if (side != 0) return side;
    }
    return 0;  // not reached: the piece does not lie in the plane
  }

  /// Follows the rim of a polygon from edge to edge of it. Where the neighbour crosses nothing, all
  /// pieces along the edge have its winding number.
  bool join_along_rim(uint32_t i, std::vector<PieceEdge>& rim, OffsetSets& windings) {
    const auto before = [](const PieceEdge& a, const PieceEdge& b) { return a.from() < b.from(); };
    std::sort(rim.begin(), rim.end(), before);
    const uint32_t polygon = partners_.polygons()[i];
    const JobPolygon& p = job_.polygons()[polygon];
    Cut& cut = cuts_[i];
    for (uint32_t e = 0; e < p.count; ++e) {
      const uint32_t other = neighbour(p.first + e);
      uint32_t at = corner_point(p, e);
      const uint32_t end = corner_point(p, e + 1 < p.count ? e + 1 : 0);
      for (bool is_first = true; at != end; is_first = false) {
        const auto edge =
            std::lower_bound(rim.begin(), rim.end(), PieceEdge{at, at, true, 0}, before);
        assert(edge != rim.end() && edge->from() == at);  // pieces fill the polygon
        if (is_first) cut.at_start.push_back(*edge);
        if (edge->to() == end) cut.at_end.push_back(*edge);
        if (other != kNone && !crosses_[other] && !windings.join(other, number(edge->piece), 0)) {
          return false;
        }
        at = edge->to();
      }
    }
    return true;
  }
  uint32_t corner_point(const JobPolygon& p, uint32_t corner) {
    return index_.unique(geometry_.vertex_point(job_.corners(p)[corner]));
  }

  /// Near a corner, polygons that both cross others hang together over the edge that they share,
  /// unless a third one runs along it.
  bool join_over_edges(uint32_t i, OffsetSets& windings) {
    const uint32_t polygon = partners_.polygons()[i];
    const JobPolygon& p = job_.polygons()[polygon];
    // What runs along the edge crosses both.
    const auto join = [&](const PieceEdge& edge, const PieceEdge& back) {
      return runs_along(i, edge) || windings.join(number(edge.piece), number(back.piece), 0);
    };
    for (uint32_t e = 0; e < p.count; ++e) {
      const uint32_t back = opposite_[p.first + e];
      if (back == kNone) continue;
      const uint32_t other = face_of(back);
      if (!crosses_[other] || other < polygon) continue;
      const uint32_t k = partners_.place(other), b = back - leaf_.face_starts[other];
      if (is_left_[k]) continue;
      const Cut &own = cuts_[i], &its = cuts_[k];
      if (!join(own.at_start[e], its.at_end[b]) || !join(own.at_end[e], its.at_start[b])) {
        return false;
      }
    }
    return true;
  }
  /// Whether one of those that cross the i-th polygon may hold an edge of a piece of it.
  bool runs_along(uint32_t i, const PieceEdge& edge) {
    const auto& others = partners_.of(i);
    return std::any_of(others.begin(), others.end(), [&](uint32_t other) {
      const uint32_t plane = job_.polygons()[other].support.index();
      return geometry_.side(plane, edge.low) == 0 && geometry_.side(plane, edge.high) == 0 &&
             holds_segment(other, edge.low, edge.high).value_or(true);
    });
  }

  /// What hangs together with no polygon that crosses nothing is left.
  void leave_what_hangs_together(OffsetSets& windings) {
    std::vector<uint8_t> has_whole(infinity_ + 1, 0);
    for (uint32_t p = 0; p < crosses_.size(); ++p) {
      if (!crosses_[p]) has_whole[windings.find(p).root] = 1;
    }
    for (uint32_t i = 0; i < cuts_.size(); ++i) {
      for (uint32_t k = cuts_[i].first_piece; k < cuts_[i].end_piece; ++k) {
        if (!has_whole[windings.find(number(k)).root]) is_left_[i] = 1;
      }
    }
  }

  /// What lies upon a polygon that is left is left, too: cells find all layers of a place at once.
  void leave_what_lies_upon() {
    std::vector<uint32_t> open;
    for (uint32_t i = 0; i < cuts_.size(); ++i) {
      if (is_left_[i]) open.push_back(i);
    }
    while (!open.empty()) {
      const uint32_t i = open.back();
      open.pop_back();
      for (const uint32_t other : cuts_[i].coplanar) {
        const uint32_t k = partners_.place(other);
        if (is_left_[k]) continue;
        is_left_[k] = 1;
        open.push_back(k);
      }
    }
  }

  /// Whether each edge is run through as often one way as the other: an open surface has no winding
  /// numbers, which rays would not see.
  [[nodiscard]] bool is_closed() const {
    std::vector<std::array<uint32_t, 3>> open;  // the ends of an edge, the lower first; its way
    for (uint32_t f = 0; f < leaf_.face_count(); ++f) {
      const uint32_t first = leaf_.face_starts[f], end = leaf_.face_starts[f + 1];
      for (uint32_t c = first; c < end; ++c) {
        if (opposite_[c] != kNone) continue;
        const uint32_t from = leaf_.corners[c], to = leaf_.corners[c + 1 < end ? c + 1 : first];
        open.push_back({std::min(from, to), std::max(from, to), from < to ? 1u : 0u});
      }
    }
    std::sort(open.begin(), open.end());
    for (size_t i = 0; i < open.size();) {
      int sum = 0;
      const size_t begin = i;
      for (; i < open.size() && open[i][0] == open[begin][0] && open[i][1] == open[begin][1]; ++i) {
        sum += open[i][2] != 0 ? 1 : -1;
      }
      if (sum != 0) return false;
    }
    return true;
  }

  /// A ray for each set that is not known yet: from a polygon that crosses nothing if it has one,
  /// else from a piece. Of polygons that were cut, those are left of which a ray found no start.
  /// False if what is known contradicts a ray, or it was cancelled.
  bool ask_rays(OffsetSets& windings) {
    std::optional<PieceRays> rays;
    const auto ask = [&](const Fragment& piece) {
      if (!rays) rays.emplace(job_, geometry_);
      return rays->winding_in_front(piece);
    };
    size_t asked = 0;
    for (uint32_t p = 0; p < crosses_.size(); ++p) {
      if (crosses_[p] || is_known(p, windings)) continue;
      if (is_cancelled()) return false;
      std::optional<int32_t> winding;
      if (++asked > kFewRays) {
        job_.ensure_planes(p);
        winding = ask(geometry_.load(p));
      }
      if (!winding) winding = winding_in_front(leaf_, nullptr, p);
      if (!windings.join(infinity_, p, *winding)) return false;
    }
    for (uint32_t i = 0; i < cuts_.size(); ++i) {
      if (cuts_[i].first_piece == cuts_[i].end_piece) continue;  // too many would cut it
      if (is_cancelled()) return false;
      is_left_[i] = 0;
      for (uint32_t k = cuts_[i].first_piece; k < cuts_[i].end_piece; ++k) {
        if (is_known(number(k), windings)) continue;
        const auto winding = ask(pieces_[k]);
        if (!winding) {
          is_left_[i] = 1;
        } else if (!windings.join(infinity_, number(k), *winding)) {
          return false;
        }
      }
    }
    return true;
  }

  /// The cells of all that is left, and one for all that hangs together.
  Result<std::vector<SurfaceCells>> solve_cells(const std::vector<uint32_t>& witnesses,
                                                EvaluateStats& stats) {
    std::vector<uint32_t> all(crosses_.size());
    std::iota(all.begin(), all.end(), 0u);
    std::vector<uint8_t> is_solved(crosses_.size(), 0);
    for (uint32_t i = 0; i < is_left_.size(); ++i) {
      is_solved[partners_.polygons()[i]] = is_left_[i];
    }
    const SurfaceOctree tree = build_surface_octree(job_, all, is_solved, witnesses, options_);
    SurfacePatches each;  // polygon as a patch of its own
    each.patch_of = std::move(all);
    for (const uint32_t p : partners_.polygons()) each.patch_of[p] = kNone;
    return solve_surface_cells(job_, tree, each, {}, options_, stats);
  }

  bool is_known(uint32_t k, OffsetSets& windings) {
    return windings.find(k).root == windings.find(infinity_).root;
  }

  /// For each set that is not known a vertex of few polygons, of one that crosses nothing.
  std::vector<uint32_t> choose_witnesses(OffsetSets& windings) {
    std::vector<uint32_t> uses(leaf_.vertices.size(), 0);
    for (const uint32_t v : leaf_.corners) ++uses[v];
    std::vector<uint32_t> best(crosses_.size(), kNone);  // per root
    for (uint32_t p = 0; p < crosses_.size(); ++p) {
      if (crosses_[p] || is_known(p, windings)) continue;
      uint32_t& chosen = best[windings.find(p).root];
      for (const uint32_t v : job_.corners(job_.polygons()[p])) {
        if (chosen == kNone || uses[v] < uses[chosen]) chosen = v;
      }
    }
    best.erase(std::remove(best.begin(), best.end(), kNone), best.end());
    return best;
  }

  /// By how much the winding number behind a piece, and all that lies upon it, is above that in
  /// front; none where a polygon of a lower number lies there, which has it.
  std::optional<int32_t> layers_at(const Fragment& piece, const std::vector<uint32_t>& coplanar) {
    int32_t layers = 1;
    for (const uint32_t other : coplanar) {
      if (!lies_in(piece, other)) continue;
      if (other < piece.polygon) return std::nullopt;
      layers += job_.polygons()[other].support == piece.support ? 1 : -1;
    }
    return layers;
  }
  /// Whether a piece that was cut along the edges of a polygon of its plane is inside of it.
  bool lies_in(const Fragment& piece, uint32_t polygon) {
    const JobPolygon& p = job_.polygons()[polygon];
    for (uint32_t e = 0; e < p.count; ++e) {
      const int inner = inner_side(p, e);
      for (uint32_t c = 0; c < piece.count; ++c) {
        if (geometry_.side(job_.edge_planes(p)[e], geometry_.corners(piece)[c]) * inner < 0) {
          return false;
        }
      }
    }
    return true;
  }

  std::optional<CutSurface> labelled(OffsetSets& windings, std::vector<SurfaceCells> runs) {
    CutSurface result;
    const int32_t zero = windings.find(infinity_).offset;
    const auto winding = [&](uint32_t k) {
      assert(is_known(k, windings));
      return windings.find(k).offset - zero;
    };
    result.winding_of_polygon.resize(crosses_.size(), 0);
    for (uint32_t p = 0; p < crosses_.size(); ++p) {
      if (!crosses_[p]) result.winding_of_polygon[p] = winding(p);
    }
    std::vector<uint32_t> numbers;
    CutSurface::Pieces& cut_pieces = result.pieces.emplace_back();
    for (uint32_t i = 0; i < cuts_.size(); ++i) {
      if (is_left_[i]) continue;
      for (uint32_t k = cuts_[i].first_piece; k < cuts_[i].end_piece; ++k) {
        const auto layers = layers_at(pieces_[k], cuts_[i].coplanar);
        if (!layers) continue;
        cut_pieces.set.add(geometry_, pieces_[k], false, numbers);
        const int32_t front = winding(number(k));
        cut_pieces.windings.push_back({front, front + *layers});
      }
    }
    for (SurfaceCells& run : runs) result.pieces.push_back(pieces_left(run));
    return result;
  }

  /// The pieces in cells of polygons that are left.
  CutSurface::Pieces pieces_left(SurfaceCells& run) const {
    CutSurface::Pieces result{std::move(run.set), {}};
    std::vector<FragmentSet::Piece>& pieces = result.set.pieces;
    size_t kept = 0;
    for (size_t i = 0; i < pieces.size(); ++i) {
      if (!is_left_[partners_.place(pieces[i].polygon)]) continue;
      pieces[kept++] = pieces[i];
      result.windings.push_back(
          {run.windings[run.sides[i].front], run.windings[run.sides[i].back]});
    }
    pieces.resize(kept);
    return result;
  }

  Job& job_;
  const LeafGeometry& leaf_;
  const std::span<const uint32_t> opposite_;
  std::span<const uint8_t> crosses_;
  const KernelOptions& options_;
  const Partners partners_;
  std::vector<uint8_t> is_left_;  ///< as the partners' polygons: to cells
  CellGeometry geometry_;
  PointIndex index_;
  std::vector<uint32_t> face_of_;  ///< per corner
  std::vector<Fragment> pieces_;
  std::vector<Cut> cuts_;  ///< as the partners' polygons
  uint32_t infinity_ = 0;
};

}  // namespace

Result<std::optional<CutSurface>> cut_surface(Job& job, const LeafGeometry& leaf,
                                              std::span<const uint32_t> opposite,
                                              std::span<const std::array<uint32_t, 2>> crossings,
                                              std::span<const uint8_t> crosses,
                                              const KernelOptions& options, EvaluateStats& stats) {
  return SurfaceCutter(job, leaf, opposite, crossings, crosses, options).run(stats);
}

}  // namespace csgrun
