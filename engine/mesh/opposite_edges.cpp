#include "engine/mesh/opposite_edges.h"

#include <algorithm>
#include <bit>
#include <span>
#include <utility>

#include "engine/base/scratch.h"
#include "engine/mesh/leaf_shape.h"

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

namespace csgrun {
namespace {

constexpr uint32_t kNone = UINT32_MAX;

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

/// Numbers that are held against one at once.
constexpr uint32_t kLanes = 8;

/// A bit for each of kLanes numbers that equals `x`.
uint32_t equal_bits(const uint32_t* numbers, uint32_t x) {
#if defined(__SSE2__)
  const auto compare = [&](const uint32_t* four) {
    return _mm_cmpeq_epi32(_mm_loadu_si128(reinterpret_cast<const __m128i*>(four)),
                           _mm_set1_epi32(static_cast<int>(x)));
  };
  const __m128i halves = _mm_packs_epi32(compare(numbers), compare(numbers + 4));
  return static_cast<uint32_t>(_mm_movemask_epi8(_mm_packs_epi16(halves, _mm_setzero_si128())));
#else
  uint32_t bits = 0;
  for (uint32_t i = 0; i < kLanes; ++i) bits |= static_cast<uint32_t>(numbers[i] == x) << i;
  return bits;
#endif
}

/// std::has_single_bit counts bits, by a function where the processor need not know how.
bool is_single_bit(uint32_t bits) { return bits != 0 && (bits & (bits - 1)) == 0; }

/// The place of a number in a list, which has it once; else the end. What follows the list is
/// looked at, too.
uint32_t place_of_single(std::span<const uint32_t> list, uint32_t x) {
  const auto count = static_cast<uint32_t>(list.size());
  uint32_t place = count;
  for (uint32_t first = 0; first < count; first += kLanes) {
    uint32_t bits = equal_bits(list.data() + first, x);
    if (count - first < kLanes) bits &= (1u << (count - first)) - 1;
    if (bits == 0) continue;
    if (place != count || !is_single_bit(bits)) return count;
    place = first + static_cast<uint32_t>(std::countr_zero(bits));
  }
  return place;
}

/// Pairs edges where every directed edge is there once and its reverse too; else returns nothing.
///
/// The reverse of an edge that leaves a vertex is one of the edges that come to it, which are few
/// and stand side by side, by the vertex that they leave. Where each edge finds exactly one, each
/// is the reverse of one: two equal edges would both be found, at their end, by their reverse.
template <class Edges>
std::vector<uint32_t> pair_simple(const LeafGeometry& leaf, const Edges& edges) {
  constexpr uint32_t kMany = 64;  // edges at a vertex, where none looks for its reverse
  const size_t count = leaf.corners.size();
  Scratch scratch;
  // Where those that come to a vertex end, once they are there.
  const auto ends = scratch.array<uint32_t>(leaf.vertices.size() + 1, 0);
  uint32_t* const end_at = ends.data() + 1;
  edges.each([&](uint32_t, uint32_t, uint32_t to) { ++end_at[to]; });
  uint32_t sum = 0;
  for (uint32_t& end : ends.subspan(1)) sum += std::exchange(end, sum);
  const auto from_where = scratch.array<uint32_t>(count + kLanes),
             which = scratch.array<uint32_t>(count + kLanes);
  for (const auto list : {from_where, which}) {
    std::fill(list.end() - kLanes, list.end(), kNone);
  }
  edges.each([&](uint32_t edge, uint32_t from, uint32_t to) {
    const uint32_t place = end_at[to]++;
    from_where[place] = from;
    which[place] = edge;
  });
  std::vector<uint32_t> opposite(count);
  bool all_found = true, any_crowded = false;
  edges.each([&](uint32_t edge, uint32_t from, uint32_t to) {
    const uint32_t begin = ends[from], end = end_at[from];
    if (end - begin > kMany) {
      opposite[edge] = kNone;
      any_crowded = true;
      return;
    }
    uint32_t place = begin;
    if (end - begin <= kLanes) {
      const uint32_t bits = equal_bits(&from_where[begin], to) & ((1u << (end - begin)) - 1);
      all_found &= is_single_bit(bits);
      place += static_cast<uint32_t>(std::countr_zero(bits | 1u << kLanes)) % kLanes;
    } else {
      const std::span<const uint32_t> among(&from_where[begin], end - begin);
      place += place_of_single(among, to);
      all_found &= place < end;
    }
    opposite[edge] = which[place];
  });
  if (!all_found) return {};
  if (!any_crowded) return opposite;
  // Those that come to such a vertex found their reverse, which did not look.
  for (size_t v = 0; v < leaf.vertices.size(); ++v) {
    const uint32_t begin = ends[v], end = end_at[v];
    for (uint32_t place = begin; end - begin > kMany && place < end; ++place) {
      const uint32_t edge = which[place];
      if (opposite[edge] != kNone) opposite[opposite[edge]] = edge;
    }
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
  return consists_of_triangles(leaf) ? pair_edges(leaf, EdgesOfTriangles(leaf.corners))
                                     : pair_edges(leaf, EdgesOfFaces(leaf));
}

}  // namespace csgrun
