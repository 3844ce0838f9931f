// One sweep, after Hertel and Mehlhorn: the face is seen as a planar graph of directed edges with
// the interior on their left. Between a lower edge and the upper edge above it lies one piece of
// the interior; what is left of it behind the sweep line is a chain of vertices that turns away
// from the interior (or runs straight) in every inner vertex, so that a new vertex sees a
// contiguous part of it. Triangles are cut off only where the turn is strict: collinear runs never
// make a flat one.
//
// Loops are dissolved into edges first. How they run through a vertex where they touch is thus
// without meaning, and so is where they start.
#include "engine/mesh/triangulate.h"

#include <algorithm>

#include "engine/base/none.h"
#include "engine/mesh/sweep_status.h"
#include "engine/mesh/triangulate_monotone.h"

namespace csgrun {
namespace {

/// Vertices are named by their rank along the sweep; `left < right`.
struct Edge {
  uint32_t left, right;
  bool lower;  ///< runs along the sweep: the interior lies above it
  // The chain of the interior above a lower edge, from the edge's left end to that of the upper
  // one.
  uint32_t head = kNone, tail = kNone;
  uint32_t newest = kNone;  ///< the chain's last vertex along the sweep; it sees all of the front
};

struct Link {
  uint32_t vertex, prev, next;
};

/// A point, by its position in the list of ids, and how far along the sweep it is.
struct Swept {
  double along;
  uint32_t position;
};

struct Chain {
  uint32_t head = kNone, tail = kNone, newest = kNone;
};

using Triangles = std::vector<std::array<uint32_t, 3>>;

Error broken(const char* what) {
  return {ErrorCode::kInternal, std::string("cannot triangulate a face: ") + what, {}};
}

}  // namespace

class Triangulator::Sweep {
 public:
  Status run(std::span<const std::vector<uint32_t>> loops, const PlanarOracle& oracle,
             Triangles& triangles) {
    loops_ = loops, oracle_ = &oracle, triangles_ = &triangles;
    ids_.clear(), edges_.clear(), links_.clear(), triangles.clear(), status_.clear();
    if (const char* what = collect_points()) return broken(what);
    if (const char* what = collect_edges()) return broken(what);
    for (uint32_t v = 0; v < ids_.size(); ++v) {
      if (const char* what = pass(v)) return broken(what);
    }
    if (!status_.empty()) return broken("its boundary is open");
    return std::monostate();
  }

 private:
  int orient(uint32_t a, uint32_t b, uint32_t c) const {
    return oracle_->orient(ids_[a], ids_[b], ids_[c]);
  }

  const char* collect_points() {
    size_t corners = 0;
    for (const auto& loop : loops_) {
      if (loop.size() < 2) return "a loop has fewer than two corners";
      corners += loop.size();
    }
    if (corners < 3) return "it has fewer than three corners";
    ids_.reserve(corners);
    for (const auto& loop : loops_) ids_.insert(ids_.end(), loop.begin(), loop.end());
    std::sort(ids_.begin(), ids_.end());
    ids_.erase(std::unique(ids_.begin(), ids_.end()), ids_.end());
    by_id_ = ids_;
    by_sweep_.clear();
    for (uint32_t i = 0; i < by_id_.size(); ++i) {
      by_sweep_.push_back({oracle_->along(by_id_[i]), i});
    }
    std::sort(by_sweep_.begin(), by_sweep_.end(), [&](const Swept& a, const Swept& b) {
      return a.along != b.along ? a.along < b.along
                                : oracle_->compare(by_id_[a.position], by_id_[b.position]) < 0;
    });
    rank_of_.resize(ids_.size());
    for (uint32_t rank = 0; rank < by_sweep_.size(); ++rank) {
      const Swept& at = by_sweep_[rank];
      ids_[rank] = by_id_[at.position];
      if (rank > 0 && by_sweep_[rank - 1].along == at.along &&
          oracle_->compare(ids_[rank - 1], ids_[rank]) == 0) {
        return "two of its vertices are one point";
      }
      rank_of_[at.position] = rank;
    }
    triangles_->reserve(corners);
    links_.reserve(2 * corners);
    edges_.reserve(corners);
    return nullptr;
  }

  size_t position_of(uint32_t id) const {
    return static_cast<size_t>(std::lower_bound(by_id_.begin(), by_id_.end(), id) - by_id_.begin());
  }

  /// Fills `edges_`, grouped by their left ends, each group from bottom to top.
  const char* collect_edges() {
    first_right_.assign(ids_.size() + 1, 0);
    left_count_.assign(ids_.size(), 0);
    slot_of_left_.assign(ids_.size(), kNone);
    for (const auto& loop : loops_) {
      uint32_t from = rank_of_[position_of(loop.back())];
      for (uint32_t id : loop) {
        const uint32_t to = rank_of_[position_of(id)];
        if (from == to) return "a corner occurs twice in a row";
        edges_.push_back({std::min(from, to), std::max(from, to), from < to});
        ++left_count_[std::max(from, to)];
        ++first_right_[std::min(from, to) + 1];
        from = to;
      }
    }
    for (size_t v = 0; v < ids_.size(); ++v) first_right_[v + 1] += first_right_[v];
    std::sort(edges_.begin(), edges_.end(),
              [](const Edge& a, const Edge& b) { return a.left < b.left; });
    for (size_t v = 0; v < ids_.size(); ++v) {
      const auto begin = edges_.begin() + first_right_[v],
                 end = edges_.begin() + first_right_[v + 1];
      if (end - begin < 2) continue;
      // An edge that occurs in both directions is a slit: a hole without width, the upper edge of
      // the interior below it first.
      std::sort(begin, end, [&](const Edge& a, const Edge& b) {
        if (a.right == b.right) return !a.lower && b.lower;
        return orient(static_cast<uint32_t>(v), a.right, b.right) > 0;
      });
      for (auto e = begin; e + 1 != end; ++e) {
        const Edge &a = e[0], &b = e[1];
        if (a.right == b.right ? a.lower == b.lower
                               : orient(static_cast<uint32_t>(v), a.right, b.right) <= 0) {
          return "two of its edges overlap";
        }
      }
    }
    return nullptr;
  }

  Chain chain_above(uint32_t slot) const {
    const Edge& e = edges_[status_.edge(slot)];
    return {e.head, e.tail, e.newest};
  }
  void set_chain(uint32_t edge, const Chain& chain) {
    edges_[edge].head = chain.head;
    edges_[edge].tail = chain.tail;
    edges_[edge].newest = chain.newest;
  }

  uint32_t new_link(uint32_t vertex, uint32_t prev, uint32_t next) {
    links_.push_back({vertex, prev, next});
    return static_cast<uint32_t>(links_.size() - 1);
  }

  /// Emits a, b, c unless it is flat or turned over; the smallest rank comes first.
  bool emit(uint32_t a, uint32_t b, uint32_t c) {
    if (orient(a, b, c) <= 0) return false;
    while (a > b || a > c) {
      const uint32_t first = a;
      a = b, b = c, c = first;
    }
    triangles_->push_back({ids_[a], ids_[b], ids_[c]});
    return true;
  }

  /// Continues a chain at its lower end, after cutting off what `v` sees from there.
  void append_low(Chain& chain, uint32_t v) {
    while (chain.head != chain.tail) {
      const uint32_t second = links_[chain.head].next;
      if (!emit(links_[chain.head].vertex, v, links_[second].vertex)) break;
      chain.head = second;
    }
    const uint32_t added = new_link(v, kNone, chain.head);
    links_[chain.head].prev = added;
    chain.head = chain.newest = added;
  }

  void append_high(Chain& chain, uint32_t v) {
    while (chain.head != chain.tail) {
      const uint32_t second = links_[chain.tail].prev;
      if (!emit(links_[second].vertex, v, links_[chain.tail].vertex)) break;
      chain.tail = second;
    }
    const uint32_t added = new_link(v, chain.tail, kNone);
    links_[chain.tail].next = added;
    chain.tail = chain.newest = added;
  }

  /// `v` closes a piece of the interior: it must see the whole chain.
  bool close(Chain chain, uint32_t v) {
    if (chain.head == chain.tail) return false;
    append_low(chain, v);
    return links_[chain.head].next == chain.tail;
  }

  /// Moves the sweep line over `v`.
  const char* pass(uint32_t v) {
    run_.clear();
    uint32_t after;
    if (left_count_[v] > 0) {
      if (const char* what = find_left_edges(v, after)) return what;
    } else {
      bool touches = false;
      after = status_.first_not([&](uint32_t edge) {
        const int side = orient(edges_[edge].left, edges_[edge].right, v);
        touches = touches || side == 0;
        return side > 0;
      });
      if (touches) return "a vertex lies on an edge";
    }
    const uint32_t before = status_.prev(run_.empty() ? after : run_.front());

    // What is left of the interior right below and right above `v`, if any.
    bool has_below = false, has_above = false;
    Chain below, above;
    if (run_.empty()) {
      if (before != kNone && edges_[status_.edge(before)].lower) {
        below = chain_above(before);
        above = split(below);
        append_high(below, v);
        append_low(above, v);
        has_below = has_above = true;
      }
    } else {
      size_t i = 0;
      if (!edges_[status_.edge(run_[0])].lower) {
        if (before == kNone || !edges_[status_.edge(before)].lower)
          return "its edges are disordered";
        below = chain_above(before);
        append_high(below, v);
        has_below = true;
        i = 1;
      }
      for (; i + 1 < run_.size(); i += 2) {
        if (!edges_[status_.edge(run_[i])].lower || edges_[status_.edge(run_[i + 1])].lower) {
          return "its edges are disordered";
        }
        if (!close(chain_above(run_[i]), v)) return "its edges cross";
      }
      if (i < run_.size()) {
        if (!edges_[status_.edge(run_[i])].lower) return "its edges are disordered";
        above = chain_above(run_[i]);
        append_low(above, v);
        has_above = true;
      }
    }

    // The edges that start in `v`, with the chains that they carry on.
    const uint32_t first = first_right_[v], last = first_right_[v + 1];
    uint32_t e = first;
    if (first == last) {
      if (has_below != has_above) return "its edges are disordered";
      if (has_below) set_chain(status_.edge(before), join(below, above));
    } else {
      if (has_below) {
        if (edges_[e].lower) return "its edges are disordered";
        set_chain(status_.edge(before), below);
        ++e;
      }
      for (; e + 1 < last; e += 2) {
        if (!edges_[e].lower || edges_[e + 1].lower) return "its edges are disordered";
        const uint32_t only = new_link(v, kNone, kNone);
        set_chain(e, {only, only, only});
      }
      if ((e < last) != has_above) return "its edges are disordered";
      if (has_above) {
        if (!edges_[e].lower) return "its edges are disordered";
        set_chain(e, above);
      }
    }
    exchange_edges(first, last, after);
    return nullptr;
  }

  /// Finds the edges that end in `v`, which lie side by side on the sweep line, and what is above.
  const char* find_left_edges(uint32_t v, uint32_t& after) {
    uint32_t slot = slot_of_left_[v];
    if (slot == kNone) return "its edges are disordered";
    const auto ends_here = [&](uint32_t at) {
      return at != kNone && edges_[status_.edge(at)].right == v;
    };
    while (status_.prev(slot) != kNone && ends_here(status_.prev(slot))) slot = status_.prev(slot);
    for (; ends_here(slot); slot = status_.next(slot)) run_.push_back(slot);
    after = slot;
    return run_.size() == left_count_[v] ? nullptr : "its edges cross";
  }

  /// Cuts a chain in its newest vertex, which both parts keep; `low` is left with the lower part.
  Chain split(Chain& low) {
    const uint32_t at = low.newest;
    Chain high{at, low.tail, at};
    const uint32_t copy = new_link(links_[at].vertex, kNone, links_[at].next);
    if (links_[copy].next != kNone) links_[links_[copy].next].prev = copy;
    high.head = high.newest = copy;
    if (high.tail == at) high.tail = copy;
    links_[at].next = kNone;
    low.tail = at;
    return high;
  }

  /// Joins two chains in the vertex where the lower one ends and the higher one begins.
  Chain join(const Chain& low, const Chain& high) {
    const uint32_t second = links_[high.head].next;
    links_[low.tail].next = second;
    links_[second].prev = low.tail;
    return {low.head, high.tail, low.tail};
  }

  /// Puts the edges [first, last) in the place of the run that ends.
  void exchange_edges(uint32_t first, uint32_t last, uint32_t after) {
    size_t used = 0;
    for (uint32_t e = first; e < last; ++e) {
      uint32_t slot;
      if (used < run_.size()) {
        slot = run_[used++];
        status_.replace(slot, e);
      } else {
        slot = status_.insert_before(after, e);
      }
      slot_of_left_[edges_[e].right] = slot;
    }
    for (; used < run_.size(); ++used) status_.erase(run_[used]);
  }

  std::span<const std::vector<uint32_t>> loops_;
  const PlanarOracle* oracle_ = nullptr;
  Triangles* triangles_ = nullptr;
  std::vector<uint32_t> ids_;              ///< by rank along the sweep
  std::vector<uint32_t> by_id_, rank_of_;  ///< sorted ids and their ranks
  std::vector<Swept> by_sweep_;            ///< while points are ranked
  std::vector<Edge> edges_;
  std::vector<uint32_t> first_right_;   ///< per vertex: its first edge to the right
  std::vector<uint32_t> left_count_;    ///< per vertex: how many edges end in it
  std::vector<uint32_t> slot_of_left_;  ///< per vertex: a slot of one of these
  std::vector<Link> links_;
  std::vector<uint32_t> run_;
  SweepStatus status_;
};

Triangulator::Triangulator() = default;
Triangulator::~Triangulator() = default;

Status Triangulator::face(std::span<const std::vector<uint32_t>> loops, const PlanarOracle& oracle,
                          Triangles& triangles) {
  triangles.clear();
  if (loops.size() == 1 && triangulate_monotone(loops[0], oracle, triangles)) {
    return std::monostate();
  }
  if (!sweep_) sweep_ = std::make_unique<Sweep>();
  return sweep_->run(loops, oracle, triangles);
}

Result<Triangles> triangulate_by_sweep(std::span<const std::vector<uint32_t>> loops,
                                       const PlanarOracle& oracle) {
  Triangles triangles;
  auto status = Triangulator::Sweep().run(loops, oracle, triangles);
  if (!status) return status.error();
  return triangles;
}

Result<Triangles> triangulate_face(std::span<const std::vector<uint32_t>> loops,
                                   const PlanarOracle& oracle) {
  Triangles triangles;
  auto status = Triangulator().face(loops, oracle, triangles);
  if (!status) return status.error();
  return triangles;
}

}  // namespace csgrun
