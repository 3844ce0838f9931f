#include "engine/bsp/result_pieces.h"

#include <algorithm>
#include <functional>
#include <utility>

#include "engine/bsp/convexify.h"
#include "engine/bsp/evaluate_job.h"
#include "engine/bsp/point_index.h"
#include "engine/bsp/pruned_expression.h"
#include "engine/bsp/regions.h"
#include "engine/bsp/untouched.h"
#include "engine/bsp/whole_faces.h"

namespace csgrun {
namespace {

/// Puts what a job gives into a store.
class PieceWriter {
 public:
  PieceWriter(Job& job, const std::vector<Operand>& operands, PieceStore& store)
      : job_(job),
        operands_(operands),
        store_(store),
        geometry_(job.planes(), &job),
        index_(geometry_),
        regions_(geometry_, job.planes()),
        wall_of_([&job](int axis, int64_t m) { return job.wall(axis, m); }) {}

  /// Tells the store of operands that are not in pieces; false if one cannot be.
  bool add_operands() {
    for (uint32_t o = 0; o < operands_.size(); ++o) {
      number_.push_back(kNone);
      if (operands_[o].pieces) continue;
      number_[o] = store_.add_operand(job_, operands_, o);
      if (number_[o] == PieceStore::kNoNumber) return false;
    }
    return true;
  }

  /// A polygon that is kept. One in pieces must be turned over; others are there already.
  void add_whole(const WholePolygon& w) {
    const JobPolygon& p = job_.polygons()[w.polygon];
    const auto corners = job_.corners(p);
    const auto edges = job_.edge_planes(p);
    PieceStore::Piece piece = origin_of(w.polygon);
    piece.is_whole = piece.is_whole || operands_[p.operand].leaf;
    piece.is_flipped = piece.is_flipped != w.flip;
    piece.is_met = w.is_met;
    piece.first = static_cast<uint32_t>(store_.corners().size());
    piece.count = p.count;
    piece.support = p.support.valid() && w.flip ? p.support.flip() : p.support;
    for (uint32_t i = 0; i < p.count; ++i) {
      store_.corners().push_back(store_vertex(corners[w.flip ? p.count - 1 - i : i]));
      store_.edges().push_back(edges[w.flip ? (2 * p.count - 2 - i) % p.count : i]);
    }
    added.push_back(store_.add_piece(piece));
  }

  /// Pieces of polygons that were cut; false if they do not close up.
  bool add_cut(const std::vector<FragmentSet>& sets) {
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
      bool is_simple = true;
      for (j = i; j < loops.size() && loops[j].polygon == loops[i].polygon &&
                  loops[j].plane == loops[i].plane;
           ++j) {
        is_simple = is_simple && j == i;
        add_edges(sets[loops[j].set], loops[j].piece, points_[loops[j].set]);
        is_simple = is_simple && !sets[loops[j].set].pieces[loops[j].piece].is_loose;
      }
      if (!add_region(loops[i].polygon, loops[i].plane, is_simple)) return false;
    }
    return true;
  }

  std::vector<uint32_t> added;  ///< pieces

 private:
  /// Where a polygon of the job comes from.
  PieceStore::Piece origin_of(uint32_t polygon) const {
    const uint32_t o = job_.polygons()[polygon].operand;
    if (number_[o] == kNone) return store_.piece(job_.piece(polygon));
    return {number_[o], job_.polygons()[polygon].face, 0, 0, PlaneId(), false, false};
  }

  uint32_t store_vertex(uint32_t vertex) {
    const uint32_t o = job_.operand_of_vertex(vertex);
    if (number_[o] == kNone) return job_.piece_point(vertex);
    return store_.first_point(number_[o]) + vertex - job_.vertex_start(o);
  }

  uint32_t store_point(uint32_t p) {
    const auto point = geometry_.point(p);
    if (point.vertex != kNone) return store_vertex(point.vertex);
    point_number_.resize(geometry_.point_count(), kNone);
    if (point_number_[p] == kNone) point_number_[p] = store_.add_point(point.planes, point.rounded);
    return point_number_[p];
  }

  void add_edges(const FragmentSet& set, uint32_t piece, std::vector<uint32_t>& points) {
    if (points.empty()) {
      for (const FragmentSet::NamedPoint& p : set.points) {
        points.push_back(index_.unique(p.vertex != kNone
                                           ? geometry_.vertex_point(p.vertex)
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

  /// A polygon of the job, seen from one side of its plane.
  Fragment cell_of(uint32_t polygon, PlaneId plane) {
    const JobPolygon& p = job_.polygons()[polygon];
    const auto corners = job_.corners(p);
    const auto edges = job_.edge_planes(p);
    const bool flip = plane != p.support;
    cell_points_.clear();
    cell_edges_.clear();
    for (uint32_t i = 0; i < p.count; ++i) {
      cell_points_.push_back(geometry_.vertex_point(corners[flip ? p.count - 1 - i : i]));
      cell_edges_.push_back(edges[flip ? (2 * p.count - 2 - i) % p.count : i]);
    }
    return geometry_.make_fragment(plane, cell_points_, cell_edges_);
  }

  /// What is left of a polygon on one side of its plane, given by edges_.
  bool add_region(uint32_t polygon, PlaneId plane, bool is_simple) {
    std::vector<DirectedEdge>* outline = &edges_;
    if (!is_simple) {
      if (!regions_.build(plane, edges_, loops_)) return false;
      outline = &loops_.edges;
    }
    job_.ensure_planes(polygon);
    boundary_.clear();
    for (const DirectedEdge& e : *outline) boundary_.push_back({e.from, e.to, e.plane});
    fragments_.clear();
    convexify_within(geometry_, job_.planes(), cell_of(polygon, plane), boundary_, wall_of_,
                     fragments_);
    PieceStore::Piece piece = origin_of(polygon);
    piece.is_whole = false;
    // (Of a polygon in pieces the job has the support as the piece has it.)
    piece.is_flipped = piece.is_flipped != (plane != job_.polygons()[polygon].support);
    piece.support = plane;
    for (const Fragment& f : fragments_) {
      piece.first = static_cast<uint32_t>(store_.corners().size());
      piece.count = f.count;
      for (uint32_t i = 0; i < f.count; ++i) {
        store_.corners().push_back(store_point(geometry_.corners(f)[i]));
        store_.edges().push_back(geometry_.edges(f)[i]);
      }
      added.push_back(store_.add_piece(piece));
    }
    return true;
  }

  Job& job_;
  const std::vector<Operand>& operands_;
  PieceStore& store_;
  CellGeometry geometry_;
  PointIndex index_;
  RegionBuilder regions_;
  const std::function<uint32_t(int, int64_t)> wall_of_;
  std::vector<uint32_t> number_;               ///< per operand: that in the store, or kNone
  std::vector<std::vector<uint32_t>> points_;  ///< per set: the geometry's
  std::vector<uint32_t> point_number_;         ///< per constructed point: the store's
  std::vector<DirectedEdge> edges_;
  std::vector<BoundaryEdge> boundary_;
  std::vector<Fragment> fragments_;
  RegionLoops loops_;
  std::vector<uint32_t> cell_points_, cell_edges_;
};

Error not_closed() { return {ErrorCode::kInternal, "the pieces of a face do not close up", {}}; }

/// The expression with other numbers for the operands.
template <class Number>
Expression renumbered(Expression expression, Number&& number) {
  for (Expression::Node& node : expression.nodes) {
    if (node.is_operand) node.operand = number(node.operand);
  }
  return expression;
}

/// Bytes of the store and the tree for pieces and points that are new.
size_t bytes_of(size_t pieces, size_t points) {
  constexpr size_t kPiece = 300, kPoint = 250;  // with their planes and their share of nodes
  return sizeof(ResultPieces) + pieces * kPiece + points * kPoint;
}

/// The first polygon of a job that is of a face of an operand.
uint32_t first_polygon(const Job& job, uint32_t operand, uint32_t face) {
  const uint32_t begin = job.polygon_start(operand), end = job.polygon_start(operand + 1);
  if (job.is_leaf(operand)) return begin + face;
  // How a boundary's face is made convex depends on the other operands of a job.
  const auto first = job.polygons().begin();
  const auto found = std::lower_bound(first + begin, first + end, face,
                                      [](const JobPolygon& p, uint32_t f) { return p.face < f; });
  return static_cast<uint32_t>(found - first);
}

/// Whether a point is named by a leaf. (How many vertices a boundary has in a job depends on the
/// job; its points are named by their planes.)
bool is_leaf_vertex(const PieceStore& store, uint32_t point) {
  const uint32_t o = store.operand_of(point);
  return o != kNone && store.operands()[o].leaf;
}

enum class Outside : uint8_t { kKept, kDropped, kTurned };

/// What becomes of an operand where it is outside all others.
Outside fate_outside(const Expression& expression, uint32_t operand) {
  std::vector<PrunedExpression::Boundary> scratch;
  const auto boundary = PrunedExpression(expression)
                            .boundary([](uint32_t) { return false; },
                                      [&](uint32_t o) { return o == operand; }, scratch);
  if (boundary.operand != operand) return Outside::kDropped;
  return boundary.front ? Outside::kTurned : Outside::kKept;
}

}  // namespace

Result<PiecesPtr> evaluate_pieces(const std::vector<Operand>& operands,
                                  const Expression& expression, const GridBox& region,
                                  const KernelOptions& options, EvaluateStats& stats) {
  auto result = std::make_shared<ResultPieces>();
  result->store = std::make_shared<PieceStore>();
  PieceStore& store = *result->store;
  Job job(operands, &store.planes);
  auto evaluated = evaluate_job(job, operands, expression, region, options, stats);
  if (!evaluated) return evaluated.error();
  PieceWriter writer(job, operands, store);
  if (!writer.add_operands()) return PiecesPtr();
  for (const WholePolygon& w : evaluated->whole) writer.add_whole(w);
  if (!writer.add_cut(evaluated->sets)) return not_closed();
  result->touching = std::move(evaluated->touching);
  result->bytes = bytes_of(store.piece_count(), store.point_count());
  result->tree = PieceTree().changed(
      {}, [](uint32_t) { return false; }, std::move(writer.added),
      [&](uint32_t p) -> const PieceBox& { return store.box(p); });
  return PiecesPtr(std::move(result));
}

Result<PiecesPtr> change_pieces(const ResultPieces& version, const std::vector<Operand>& others,
                                const Expression& expression, const GridBox& region,
                                const KernelOptions& options, EvaluateStats& stats) {
  const auto own = static_cast<uint32_t>(others.size());
  const Expression own_last =
      renumbered(expression, [&](uint32_t o) { return o == 0 ? own : o - 1; });
  const Outside outside = fate_outside(own_last, own);
  if (outside == Outside::kTurned) return PiecesPtr();
  std::vector<Operand> operands = others;
  operands.emplace_back();
  operands.back().pieces =
      std::make_shared<PieceOperand>(PieceOperand{version.store, version.tree});
  PieceStore& store = *version.store;
  Job job(operands, &store.planes);
  auto faces = evaluate_whole_faces(job, own_last, options, stats);
  if (!faces) return faces.error();
  if (faces->any_general) {
    // Cells need closed surfaces: all of it.
    auto boundary = assemble_pieces(version, false);
    if (!boundary) return boundary.error();
    operands.assign(1, {});
    operands[0].boundary = *boundary;
    operands.insert(operands.end(), others.begin(), others.end());
    return evaluate_pieces(operands, expression, region, options, stats);
  }

  const size_t pieces_before = store.piece_count(), points_before = store.point_count();
  PieceWriter writer(job, operands, store);
  if (!writer.add_operands()) return PiecesPtr();
  const uint32_t first = job.polygon_start(own);
  std::vector<uint32_t> kept;
  for (const WholePolygon& w : faces->whole) {
    if (w.polygon < first || w.flip) {
      writer.add_whole(w);
      continue;
    }
    kept.push_back(job.piece(w.polygon));
    if (w.is_met) store.set_met(kept.back());
  }
  std::vector<FragmentSet> cut;
  cut.push_back(std::move(faces->cut));
  if (!writer.add_cut(cut)) return not_closed();

  auto result = std::make_shared<ResultPieces>();
  result->store = version.store;
  result->bytes =
      bytes_of(store.piece_count() - pieces_before, store.point_count() - points_before);
  result->touching = version.touching;
  Touching more = touching_before(others);
  result->touching.anywhere |= more.anywhere;
  add_touching(result->touching, more.boxes);
  add_touching(result->touching, faces->touching);
  const auto box_of = [&](uint32_t p) -> const PieceBox& { return store.box(p); };
  if (outside == Outside::kDropped) {
    kept.insert(kept.end(), writer.added.begin(), writer.added.end());
    result->tree = PieceTree().changed(
        {}, [](uint32_t) { return false; }, std::move(kept), box_of);
    return PiecesPtr(std::move(result));
  }
  // Gone are the pieces of the job that were not kept.
  std::sort(kept.begin(), kept.end());
  std::vector<uint32_t> gone;
  PieceBox gone_box;
  for (uint32_t p = first; p < job.polygons().size(); ++p) {
    const uint32_t piece = job.piece(p);
    if (std::binary_search(kept.begin(), kept.end(), piece)) continue;
    gone.push_back(piece);
    gone_box.add(store.box(piece));
  }
  std::sort(gone.begin(), gone.end());
  const auto is_gone = [&](uint32_t p) { return std::binary_search(gone.begin(), gone.end(), p); };
  result->tree = version.tree.changed(
      gone.empty() ? std::span<const PieceBox>() : std::span<const PieceBox>(&gone_box, 1), is_gone,
      std::move(writer.added), box_of);
  return PiecesPtr(std::move(result));
}

Result<std::shared_ptr<const BoundaryMesh>> assemble_pieces(const ResultPieces& version,
                                                            bool name_untouched) {
  PieceStore& store = *version.store;
  std::vector<uint32_t> pieces;
  version.tree.each([](const PieceBox&) { return true; }, [&](uint32_t p) { pieces.push_back(p); });
  std::sort(pieces.begin(), pieces.end());
  // The operands that have pieces or corners of pieces, in the order of their sources, as one
  // operation would have them.
  std::vector<uint32_t> order;
  std::vector<uint8_t> is_used(store.operands().size(), 0);
  for (const uint32_t p : pieces) {
    is_used[store.piece(p).operand] = 1;
    for (const uint32_t point : store.corners(p)) {
      if (is_leaf_vertex(store, point)) is_used[store.operand_of(point)] = 1;
    }
  }
  for (uint32_t o = 0; o < is_used.size(); ++o) {
    if (is_used[o]) order.push_back(o);
  }
  std::stable_sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) {
    return store.operands()[a].first_source < store.operands()[b].first_source;
  });
  std::vector<Operand> operands;
  std::vector<uint32_t> number(store.operands().size(), kNone);
  for (const uint32_t o : order) {
    number[o] = static_cast<uint32_t>(operands.size());
    operands.push_back(store.operands()[o]);
  }
  Job job(operands, &store.planes);
  std::vector<WholePolygon> whole;
  std::vector<FragmentSet> sets(1);
  FragmentSet& set = sets.front();
  std::vector<uint32_t>& number_of = store.scratch();
  std::vector<uint32_t> named;
  for (const uint32_t p : pieces) {
    const PieceStore::Piece& piece = store.piece(p);
    const uint32_t polygon = first_polygon(job, number[piece.operand], piece.face);
    if (piece.is_whole) {
      whole.push_back({polygon, piece.is_flipped, piece.is_met});
      continue;
    }
    set.pieces.push_back({piece.support, polygon, static_cast<uint32_t>(set.corner_point.size()),
                          piece.count, false});
    const auto corners = store.corners(p);
    const auto edges = store.edges(p);
    for (uint32_t i = 0; i < piece.count; ++i) {
      const uint32_t point = corners[i];
      if (number_of[point] == kNone) {
        number_of[point] = static_cast<uint32_t>(set.points.size());
        named.push_back(point);
        uint32_t vertex = kNone;
        if (is_leaf_vertex(store, point)) {
          const uint32_t o = store.operand_of(point);
          vertex = job.vertex_start(number[o]) + point - store.first_point(o);
        }
        set.points.push_back({store.rounded(point), store.point_planes(point), vertex});
      }
      set.corner_point.push_back(number_of[point]);
      set.corner_plane.push_back(edges[i]);
    }
  }
  for (const uint32_t point : named) number_of[point] = kNone;
  // A piece is at most a part of its polygon; its planes stand for all of it.
  for (const FragmentSet::Piece& p : set.pieces) job.ensure_planes(p.polygon);
  std::vector<UntouchedPart> parts;
  if (name_untouched) parts = take_untouched(job, operands, whole);
  return assemble(job, sets, whole, version.touching, std::move(parts));
}

}  // namespace csgrun
