#include "engine/mesh/opposite_edges.h"

#include <algorithm>
#include <bit>
#include <utility>

#include "engine/mesh/leaf_shape.h"

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

namespace csgrun {
namespace {

constexpr uint32_t kNone = UINT32_MAX;

/// The directed edges of one lower end.
struct Uses {
  static constexpr uint32_t kFew = 16;

  std::vector<uint32_t> high;  ///< the ends of greater number; at least kFew, kNone where none are
  std::vector<uint32_t> edge;
  std::vector<uint8_t> forward;  ///< from the lower end to the higher one
  uint32_t count = 0;

  Uses() : high(kFew, kNone), edge(kFew), forward(kFew) {}

  void add(uint32_t end, uint32_t index, bool is_forward) {
    if (count == high.size()) {
      high.resize(2 * count, kNone);
      edge.resize(2 * count);
      forward.resize(2 * count);
    }
    high[count] = end;
    edge[count] = index;
    forward[count++] = is_forward;
  }
  void clear() {
    std::fill(high.begin(), high.begin() + count, kNone);
    count = 0;
  }
};

/// A bit for each of the first kFew that leads to this end.
uint32_t uses_to(const Uses& uses, uint32_t end) {
#if defined(__SSE2__)
  const auto equal = [&](size_t first) {
    const auto* const lanes = reinterpret_cast<const __m128i*>(uses.high.data() + first);
    const __m128i same =
        _mm_cmpeq_epi32(_mm_loadu_si128(lanes), _mm_set1_epi32(static_cast<int>(end)));
    return static_cast<uint32_t>(_mm_movemask_ps(_mm_castsi128_ps(same)));
  };
  return equal(0) | equal(4) << 4 | equal(8) << 8 | equal(12) << 12;
#else
  uint32_t bits = 0;
  for (uint32_t i = 0; i < Uses::kFew; ++i) bits |= static_cast<uint32_t>(uses.high[i] == end) << i;
  return bits;
#endif
}

/// Pairs at most kFew uses, as long as each has one other use that is its reverse.
bool pair_few(const Uses& uses, std::vector<uint32_t>& opposite) {
  for (uint32_t i = 0; i < uses.count; ++i) {
    const uint32_t others = uses_to(uses, uses.high[i]) & ~(1u << i);
    if (others == 0 || (others & (others - 1)) != 0) return false;
    const auto other = static_cast<uint32_t>(std::countr_zero(others));
    if (uses.forward[i] == uses.forward[other]) return false;
    opposite[uses.edge[i]] = uses.edge[other];
  }
  return true;
}

/// Pairs the uses that stand alone with their reverse. False when some other edge is not balanced;
/// `all_paired` becomes false when some other edge is.
bool pair_any(const Uses& uses, std::vector<uint32_t>& opposite, bool& all_paired) {
  std::vector<std::pair<uint32_t, uint32_t>> order;
  for (uint32_t i = 0; i < uses.count; ++i) order.emplace_back(uses.high[i], i);
  std::sort(order.begin(), order.end());
  for (size_t i = 0; i < order.size();) {
    size_t end = i;
    int64_t balance = 0;
    for (; end < order.size() && order[end].first == order[i].first; ++end) {
      balance += uses.forward[order[end].second] != 0 ? 1 : -1;
    }
    if (balance != 0) return false;
    if (end - i == 2) {
      const uint32_t one = uses.edge[order[i].second], other = uses.edge[order[i + 1].second];
      opposite[one] = other;
      opposite[other] = one;
    } else {
      all_paired = false;
    }
    i = end;
  }
  return true;
}

/// Pairs edges as they come, where every directed edge is there once and its reverse too and no
/// vertex is the lower end of many; else returns nothing.
///
/// The edges that came first of their two are chained at their lower ends. Until all are paired,
/// such a one has the next of the chain, and whether its reverse has come; the other one has the
/// first one.
template <class Next>
std::vector<uint32_t> pair_simple(const LeafGeometry& leaf, Next next) {
  constexpr uint32_t kIsPaired = 1u << 31, kIsSecond = 1u << 30, kNumber = kIsSecond - 1;
  constexpr int kMany = 32;
  const std::vector<uint32_t>& corners = leaf.corners;
  if (corners.size() >= kNumber) return {};
  std::vector<uint32_t> known(corners.size());
  std::vector<uint32_t> first(leaf.vertices.size(), kNumber);
  size_t pairs = 0;
  for (uint32_t edge = 0; edge < corners.size(); ++edge) {
    const uint32_t from = corners[edge], to = corners[next(edge)];
    const uint32_t low = std::min(from, to), both = from ^ to;
    uint32_t& head = first[low];
    uint32_t other = head;
    for (int steps = 0; other != kNumber; other = known[other] & kNumber) {
      if ((corners[other] ^ corners[next(other)]) == both) break;
      if (++steps > kMany) return {};
    }
    if (other == kNumber) {
      known[edge] = head;
      head = edge;
      continue;
    }
    if ((known[other] & kIsPaired) || corners[other] == from) return {};
    known[other] |= kIsPaired;
    known[edge] = other | kIsSecond;
    ++pairs;
  }
  if (2 * pairs != corners.size()) return {};
  for (uint32_t edge = 0; edge < corners.size(); ++edge) {
    // The first of the two came before, and is paired.
    if ((known[edge] & (kIsPaired | kIsSecond)) != kIsSecond) continue;
    const uint32_t other = known[edge] & kNumber;
    known[edge] = other;
    known[other] = edge;
  }
  return known;
}

/// `next(corner)` is the corner that follows in its face.
template <class Next>
EdgePairing pair_edges(const LeafGeometry& leaf, Next next) {
  EdgePairing result;
  result.opposite = pair_simple(leaf, next);
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
    uint32_t& head = first[std::min(corners[edge], corners[next(edge)])];
    chain[edge] = head;
    head = edge;
  }
  bool all_paired = true;
  Uses uses;
  for (uint32_t v = 0; v < first.size(); ++v) {
    uses.clear();
    for (uint32_t edge = first[v]; edge != kNone; edge = chain[edge]) {
      const bool forward = corners[edge] == v;
      uses.add(forward ? corners[next(edge)] : corners[edge], edge, forward);
    }
    if (uses.count <= Uses::kFew && pair_few(uses, result.opposite)) continue;
    if (!pair_any(uses, result.opposite, all_paired)) return {};
  }
  result.is_balanced = true;
  if (!all_paired) result.opposite.clear();
  return result;
}

}  // namespace

EdgePairing pair_edges(const LeafGeometry& leaf) {
  if (consists_of_triangles(leaf)) {
    return pair_edges(leaf,
                      [](uint32_t corner) { return corner % 3 == 2 ? corner - 2 : corner + 1; });
  }
  std::vector<uint32_t> next(leaf.corners.size());
  for (size_t f = 0; f < leaf.face_count(); ++f) {
    const uint32_t begin = leaf.face_starts[f], end = leaf.face_starts[f + 1];
    for (uint32_t c = begin; c < end; ++c) next[c] = c + 1 < end ? c + 1 : begin;
  }
  return pair_edges(leaf, [&](uint32_t corner) { return next[corner]; });
}

}  // namespace csgrun
