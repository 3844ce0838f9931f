#include "engine/mesh/simple_fans.h"

#include <algorithm>
#include <span>
#include <utility>
#include <vector>

#include "engine/base/none.h"
#include "engine/base/sort_few.h"
#include "engine/mesh/fan_parts.h"

namespace csgrun {
namespace {

/// The ends of a triangle's edges that leave a corner and come to it.
struct OtherCorners {
  uint32_t next, previous;
};

OtherCorners other_corners(const TriangleSet& set, uint32_t corner) {
  const auto& t = set.triangles[corner / 3];
  switch (corner % 3) {
    case 0:
      return {t[1], t[2]};
    case 1:
      return {t[2], t[0]};
    default:
      return {t[0], t[1]};
  }
}

/// The triangles around one point.
class AroundPoint {
 public:
  /// `corners`: all those at the point. False unless each triangle has one neighbour across each of
  /// its two edges there: the one that comes back along it.
  bool link(const TriangleSet& set, std::span<const uint32_t> corners) {
    around_.clear();
    for (const uint32_t c : corners) around_.push_back(other_corners(set, c));
    next_.resize(around_.size());
    return around_.size() <= kFew ? link_few() : link_many();
  }

  /// Calls each(i, is_first) for all triangles by their places among the corners, fan after fan:
  /// fans by their first triangles.
  template <class Each>
  void each_in_fans(Each&& each) {
    for (uint32_t first = 0; first < next_.size(); ++first) {
      for (uint32_t i = first; next_[i] != kNone;) {
        each(i, i == first);
        i = std::exchange(next_[i], kNone);
      }
    }
  }

 private:
  static constexpr size_t kFew = 32;  ///< bits below
  bool link_few() {
    const auto count = static_cast<uint32_t>(around_.size());
    uint32_t linked = 0;
    for (uint32_t i = 0; i < count; ++i) {
      uint32_t found = 0, matches = 0;
      for (uint32_t j = 0; j < count; ++j) {
        const bool is_match = around_[j].next == around_[i].previous;
        found = is_match ? j : found;
        matches += is_match;
      }
      if (matches != 1) return false;
      next_[i] = found;
      linked |= 1u << found;
    }
    return linked == (uint64_t{1} << count) - 1;
  }

  bool link_many() {
    leaving_.clear();
    for (uint32_t i = 0; i < around_.size(); ++i) leaving_.emplace_back(around_[i].next, i);
    std::sort(leaving_.begin(), leaving_.end(), pair_less);
    const auto same_end = [](const auto& a, const auto& b) { return a.first == b.first; };
    if (std::adjacent_find(leaving_.begin(), leaving_.end(), same_end) != leaving_.end()) {
      return false;
    }
    std::vector<uint8_t> is_linked(around_.size(), 0);
    for (uint32_t i = 0; i < around_.size(); ++i) {
      const auto at = std::lower_bound(leaving_.begin(), leaving_.end(),
                                       std::pair(around_[i].previous, uint32_t{0}), pair_less);
      if (at == leaving_.end() || at->first != around_[i].previous) return false;
      if (std::exchange(is_linked[at->second], 1)) return false;
      next_[i] = at->second;
    }
    return true;
  }

  std::vector<OtherCorners> around_;
  std::vector<uint32_t> next_;  ///< per triangle: the next one around the point
  std::vector<std::pair<uint32_t, uint32_t>> leaving_;
};

/// The edges between points that untouched triangles have, too. Points are asked about in their
/// order.
class SharedEdges {
 public:
  SharedEdges(const TriangleSet& set, const WholeOrder& whole, uint32_t first_point)
      : set_(set), whole_(whole) {
    const auto is_before = [](const RimEdge& e, uint32_t point) { return low_of(e) < point; };
    rim_ = std::lower_bound(whole.rim().begin(), whole.rim().end(), first_point, is_before);
  }

  /// Whether those at a point that go to higher ones are each there twice, once each way. Others
  /// are seen from their other ends. `corners`: all those at the point.
  bool are_paired(uint32_t point, std::span<const uint32_t> corners) {
    uses_.clear();
    const auto add = [&](uint32_t other, bool is_forward) {
      if (other > point && whole_.is_shared(other)) uses_.push_back({other, is_forward});
    };
    for (const uint32_t c : corners) {
      const auto [next, previous] = other_corners(set_, c);
      add(next, true);
      add(previous, false);
    }
    // Untouched triangles have both ends of each edge of the rim.
    for (; rim_ != whole_.rim().end() && low_of(*rim_) == point; ++rim_) {
      uses_.push_back({std::max(rim_->from, rim_->to), rim_->from == point});
    }
    sort_few(uses_.begin(), uses_.end(),
             [](const Use& a, const Use& b) { return a.high < b.high; });
    if (uses_.size() % 2 != 0) return false;
    for (size_t i = 0; i < uses_.size(); i += 2) {
      const Use &a = uses_[i], &b = uses_[i + 1];
      if (a.high != b.high || a.is_forward == b.is_forward) return false;
      if (i > 0 && uses_[i - 1].high == a.high) return false;
    }
    return true;
  }

 private:
  /// An edge at its lower end.
  struct Use {
    uint32_t high;
    bool is_forward;  ///< to the higher end
  };
  static uint32_t low_of(const RimEdge& e) { return std::min(e.from, e.to); }

  const TriangleSet& set_;
  const WholeOrder& whole_;
  std::vector<RimEdge>::const_iterator rim_;  ///< the first one of the points to come
  std::vector<Use> uses_;
};

}  // namespace

bool make_simple_fans(const TriangleSet& set, const CountingOrder& by_point,
                      const WholeOrder& whole, VertexFans& fans) {
  fans.vertex_of_corner.resize(3 * set.triangles.size());
  return walk_in_parts(
      by_point, fans, [&](size_t begin, size_t end, std::vector<uint32_t>& points) {
        AroundPoint around;
        SharedEdges shared(set, whole, static_cast<uint32_t>(begin));
        for (auto point = static_cast<uint32_t>(begin); point < end; ++point) {
          const std::span<const uint32_t> corners(
              by_point.order.data() + by_point.starts[point],
              by_point.order.data() + by_point.starts[point + 1]);
          const bool is_shared = whole.is_shared(point);
          if (!(is_shared ? shared.are_paired(point, corners) : around.link(set, corners))) {
            return false;
          }
          if (is_shared) {
            const auto vertex = static_cast<uint32_t>(points.size());
            for (const uint32_t c : corners) fans.vertex_of_corner[c] = vertex;
            if (!corners.empty()) points.push_back(point);
            continue;
          }
          around.each_in_fans([&](uint32_t i, bool is_first) {
            if (is_first) points.push_back(point);
            fans.vertex_of_corner[corners[i]] = static_cast<uint32_t>(points.size() - 1);
          });
        }
        return true;
      });
}

}  // namespace csgrun
