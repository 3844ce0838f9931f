#include "primitives/solids/edge_rims.h"

#include <algorithm>
#include <cmath>

namespace csgrun {
namespace {

/// Differences between the angles of edges of one rim, degrees: what stays along one of them goes
/// deep enough for its neighbours' cuts.
constexpr double kAlikeRims = 0.1;

class RimFinder {
 public:
  explicit RimFinder(const EdgeFrames& frames)
      : frames_(frames), is_seen_(frames.frames().size(), false) {}

  std::vector<std::vector<uint32_t>> rims() {
    std::vector<std::vector<uint32_t>> result;
    for (uint32_t i = 0; i < is_seen_.size(); ++i) {
      for (int side = 0; side < 2 && !is_seen_[i]; ++side) {
        std::vector<uint32_t> rim = rim_from(i, side);
        if (rim.empty()) continue;
        for (const uint32_t k : rim) is_seen_[k] = true;
        result.push_back(std::move(rim));
      }
    }
    return result;
  }

 private:
  [[nodiscard]] const EdgeGraph::Edge& edge(uint32_t frame) const {
    return frames_.graph().edges()[frames_.frames()[frame].edge];
  }

  [[nodiscard]] bool is_of_rim(uint32_t frame, int side) const {
    const EdgeFrame& f = frames_.frames()[frame];
    for (int end = 0; end < 2; ++end) {
      const EdgeEnd below = frames_.kind(f, end, 1 - side);
      if (frames_.kind(f, end, side) != EdgeEnd::kInside || below == EdgeEnd::kMitre ||
          below == EdgeEnd::kInside || frames_.graph().degree(edge(frame).vertex[end]) != 3) {
        return false;
      }
    }
    return true;
  }

  /// The rim that an edge is of on a side; nothing if it is of none.
  [[nodiscard]] std::vector<uint32_t> rim_from(uint32_t first, int side) const {
    std::vector<uint32_t> rim;
    uint32_t at = first;
    int end = 1;
    do {
      const double turn = edge(at).line.turn - edge(first).line.turn;
      if (is_seen_[at] || !is_of_rim(at, side) || std::fabs(turn) > kAlikeRims) return {};
      rim.push_back(at);
      const EdgeGraph::Edge& own = edge(at);
      const uint32_t vertex = own.vertex[end], plane = own.side[side];
      at = static_cast<uint32_t>(frames_.frame_of(own.next[end][side]) - frames_.frames().data());
      end = edge(at).vertex[0] == vertex ? 1 : 0;
      side = edge(at).side[0] == plane ? 0 : 1;
    } while (at != first);
    return rim;
  }

  const EdgeFrames& frames_;
  std::vector<bool> is_seen_;
};

}  // namespace

std::vector<std::vector<uint32_t>> hole_rims(const EdgeFrames& frames) {
  return RimFinder(frames).rims();
}

}  // namespace csgrun
