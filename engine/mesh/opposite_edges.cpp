#include "engine/mesh/opposite_edges.h"

#include <algorithm>
#include <array>
#include <bit>
#include <span>
#include <utility>

#include "engine/base/none.h"
#include "engine/base/scratch.h"

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

namespace csgrun {
namespace {

/// A directed edge at its lower end.
struct Use {
  uint32_t high;  ///< the other end
  uint32_t edge;
  bool is_forward;  ///< from the lower end to the higher one
};

/// Pairs the uses that stand alone with their reverse. False when some other edge is not balanced;
/// `all_paired` becomes false when some other edge is.
bool pair_any(std::vector<Use>& uses, std::vector<uint32_t>& opposite, bool& all_paired) {
  std::sort(uses.begin(), uses.end(), [](const Use& a, const Use& b) { return a.high < b.high; });
  for (size_t i = 0; i < uses.size();) {
    size_t end = i;
    int64_t balance = 0;
    for (; end < uses.size() && uses[end].high == uses[i].high; ++end) {
      balance += uses[end].is_forward ? 1 : -1;
    }
    if (balance != 0) return false;
    if (end - i == 2) {
      opposite[uses[i].edge] = uses[i + 1].edge;
      opposite[uses[i + 1].edge] = uses[i].edge;
    } else {
      all_paired = false;
    }
    i = end;
  }
  return true;
}

/// The edges of triangles.
class EdgesOfTriangles {
 public:
  explicit EdgesOfTriangles(const std::vector<uint32_t>& corners) : corners_(corners) {}

  /// Calls f(edge, from, to) for all, which ascend.
  template <class F>
  void each(F&& f) const {
    for (uint32_t c = 0; c < corners_.size(); c += 3) {
      f(c, corners_[c], corners_[c + 1]);
      f(c + 1, corners_[c + 1], corners_[c + 2]);
      f(c + 2, corners_[c + 2], corners_[c]);
    }
  }
  [[nodiscard]] uint32_t end_of(uint32_t edge) const {
    return corners_[edge % 3 == 2 ? edge - 2 : edge + 1];
  }

 private:
  const std::vector<uint32_t>& corners_;
};

/// The same of faces of any numbers of corners.
class EdgesOfFaces {
 public:
  explicit EdgesOfFaces(const LeafGeometry& leaf) : corners_(leaf.corners) {
    ends_.reserve(corners_.size());
    for (size_t f = 0; f < leaf.face_count(); ++f) {
      const uint32_t begin = leaf.face_starts[f], end = leaf.face_starts[f + 1];
      ends_.insert(ends_.end(), corners_.begin() + begin + 1, corners_.begin() + end);
      ends_.push_back(corners_[begin]);
    }
  }

  template <class F>
  void each(F&& f) const {
    for (uint32_t c = 0; c < corners_.size(); ++c) f(c, corners_[c], ends_[c]);
  }
  [[nodiscard]] uint32_t end_of(uint32_t edge) const { return ends_[edge]; }

 private:
  const std::vector<uint32_t>& corners_;
  std::vector<uint32_t> ends_;
};

/// Edges that come to one vertex, which are looked at together.
struct Bunch {
  static constexpr uint32_t kSize = 8;
  std::array<uint32_t, kSize> from;  ///< where they start, or kNone
  std::array<uint32_t, kSize> edge;

  /// A bit for each that comes from `x`.
  [[nodiscard]] uint32_t bits_of(uint32_t x) const {
#if defined(__SSE2__)
    const auto compare = [&](const uint32_t* four) {
      return _mm_cmpeq_epi32(_mm_loadu_si128(reinterpret_cast<const __m128i*>(four)),
                             _mm_set1_epi32(static_cast<int>(x)));
    };
    const __m128i halves = _mm_packs_epi32(compare(from.data()), compare(from.data() + 4));
    return static_cast<uint32_t>(_mm_movemask_epi8(_mm_packs_epi16(halves, _mm_setzero_si128())));
#else
    uint32_t bits = 0;
    for (uint32_t i = 0; i < kSize; ++i) bits |= static_cast<uint32_t>(from[i] == x) << i;
    return bits;
#endif
  }
};

/// std::has_single_bit counts bits, by a function where the processor need not know how.
bool is_single_bit(uint32_t bits) { return bits != 0 && (bits & (bits - 1)) == 0; }

/// The edges of a surface by the vertices that they come to.
class IncomingEdges {
 public:
  /// `count` edges.
  IncomingEdges(size_t vertices, size_t count, Scratch& scratch)
      : vertices_(static_cast<uint32_t>(vertices)),
        bunches_(scratch.array<Bunch>(vertices + count / Bunch::kSize)),
        before_(scratch.array<uint32_t>(count / Bunch::kSize)),
        next_(scratch.array<uint32_t>(vertices)),
        used_(vertices_) {
    for (uint32_t v = 0; v < vertices_; ++v) {
      bunches_[v].from.fill(kNone);
      next_[v] = v * Bunch::kSize;
    }
  }

  void add(uint32_t edge, uint32_t from, uint32_t to) {
    const uint32_t place = next_[to], last = place / Bunch::kSize, at = place % Bunch::kSize;
    bunches_[last].from[at] = from;
    bunches_[last].edge[at] = edge;
    next_[to] = at + 1 < Bunch::kSize ? place + 1 : start_bunch(last);
  }

  /// Whether all that come to a vertex are in its first bunch.
  [[nodiscard]] bool has_one_bunch(uint32_t vertex) const {
    return next_[vertex] / Bunch::kSize == vertex;
  }
  [[nodiscard]] const Bunch& first_bunch(uint32_t vertex) const { return bunches_[vertex]; }

  /// The edge that comes to a vertex from another one, or kNone unless there is one. Sets
  /// `is_crowded` instead where many come to it.
  [[nodiscard]] uint32_t single(uint32_t from, uint32_t to, bool& is_crowded) const {
    constexpr uint32_t kMany = 8;  // bunches
    uint32_t edge = kNone, looks = 0;
    for (uint32_t bunch = next_[to] / Bunch::kSize;; bunch = before_[bunch - vertices_]) {
      if (++looks > kMany) {
        is_crowded = true;
        return kNone;
      }
      const uint32_t bits = bunches_[bunch].bits_of(from);
      if (bits != 0 && (edge != kNone || !is_single_bit(bits))) return kNone;
      if (bits != 0) edge = bunches_[bunch].edge[static_cast<uint32_t>(std::countr_zero(bits))];
      if (bunch == to) return edge;
    }
  }

 private:
  /// The first place in a new bunch, after one that is full.
  uint32_t start_bunch(uint32_t full) {
    before_[used_ - vertices_] = full;
    bunches_[used_].from.fill(kNone);
    return used_++ * Bunch::kSize;
  }

  const uint32_t vertices_;
  const std::span<Bunch> bunches_;    ///< first one for each vertex
  const std::span<uint32_t> before_;  ///< of each of the others: that of its vertex before it
  const std::span<uint32_t> next_;    ///< the place for the next edge to a vertex, in its last one
  uint32_t used_;
};

/// Pairs edges where every directed edge is there once and its reverse too; else returns nothing.
///
/// The reverse of an edge that leaves a vertex is one of the edges that come to it, which are few
/// and stand side by side. Where each edge finds exactly one, each is the reverse of one: two equal
/// edges would both be found, at their end, by their reverse.
template <class Edges>
std::vector<uint32_t> pair_simple(const LeafGeometry& leaf, const Edges& edges) {
  const size_t count = leaf.corners.size();
  Scratch scratch;
  IncomingEdges incoming(leaf.vertices.size(), count, scratch);
  edges.each([&](uint32_t edge, uint32_t from, uint32_t to) { incoming.add(edge, from, to); });
  std::vector<uint32_t> opposite(count);
  // Bits are left of what was not found, or more than once.
  constexpr uint32_t kNotFound = 1u << 31;
  uint32_t left = 0;
  bool any_crowded = false;
  edges.each([&](uint32_t edge, uint32_t from, uint32_t to) {
    if (incoming.has_one_bunch(from)) {
      const Bunch& bunch = incoming.first_bunch(from);
      const uint32_t bits = bunch.bits_of(to), marked = bits | kNotFound;
      left |= marked & (bits - 1);
      opposite[edge] = bunch.edge[static_cast<uint32_t>(std::countr_zero(marked)) % Bunch::kSize];
      return;
    }
    bool is_crowded = false;
    opposite[edge] = incoming.single(to, from, is_crowded);
    if (!is_crowded && opposite[edge] == kNone) left = kNotFound;
    any_crowded |= is_crowded;
  });
  if (left != 0) return {};
  if (!any_crowded) return opposite;
  // Those that come to a crowded vertex found their reverse, which did not look. As many leave it:
  // if two found the same one, another is not found.
  for (uint32_t edge = 0; edge < count; ++edge) {
    if (opposite[edge] != kNone) opposite[opposite[edge]] = edge;
  }
  if (std::find(opposite.begin(), opposite.end(), kNone) != opposite.end()) return {};
  return opposite;
}

template <class Edges>
EdgePairing pair_edges(const LeafGeometry& leaf, const Edges& edges) {
  EdgePairing result;
  result.opposite = pair_simple(leaf, edges);
  if (!result.opposite.empty()) {
    result.is_balanced = true;
    return result;
  }
  const std::vector<uint32_t>& corners = leaf.corners;
  // Until they are paired, the edges of one lower end are a chain.
  std::vector<uint32_t>& chain = result.opposite;
  chain.resize(corners.size());
  std::vector<uint32_t> first(leaf.vertices.size(), kNone);
  for (uint32_t edge = 0; edge < corners.size(); ++edge) {
    uint32_t& head = first[std::min(corners[edge], edges.end_of(edge))];
    chain[edge] = head;
    head = edge;
  }
  bool all_paired = true;
  std::vector<Use> uses;
  for (uint32_t v = 0; v < first.size(); ++v) {
    uses.clear();
    for (uint32_t edge = first[v]; edge != kNone; edge = chain[edge]) {
      const bool is_forward = corners[edge] == v;
      uses.push_back({is_forward ? edges.end_of(edge) : corners[edge], edge, is_forward});
    }
    if (!pair_any(uses, result.opposite, all_paired)) return {};
  }
  result.is_balanced = true;
  if (!all_paired) result.opposite.clear();
  return result;
}

}  // namespace

EdgePairing pair_edges(const LeafGeometry& leaf) {
  return leaf.consists_of_triangles() ? pair_edges(leaf, EdgesOfTriangles(leaf.corners))
                                      : pair_edges(leaf, EdgesOfFaces(leaf));
}

}  // namespace csgrun
