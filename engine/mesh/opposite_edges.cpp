#include "engine/mesh/opposite_edges.h"

#include <algorithm>

#include "engine/mesh/leaf_shape.h"

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

/// Pairs edges as they come, where every directed edge is there once and its reverse too and no
/// vertex is the lower end of many; else returns nothing.
///
/// The edges that came first of their two are chained at their lower ends. Until all are paired,
/// such a one has the next of the chain, and whether its reverse has come; the other one has the
/// first one.
template <class Next>
std::vector<uint32_t> pair_simple(const LeafGeometry& leaf, Next next) {
  constexpr uint32_t kIsPaired = 1u << 31, kIsSecond = 1u << 30, kNumber = kIsSecond - 1;
  constexpr int kMany = 128;
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
  std::vector<Use> uses;
  for (uint32_t v = 0; v < first.size(); ++v) {
    uses.clear();
    for (uint32_t edge = first[v]; edge != kNone; edge = chain[edge]) {
      const bool is_forward = corners[edge] == v;
      uses.push_back({is_forward ? corners[next(edge)] : corners[edge], edge, is_forward});
    }
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
