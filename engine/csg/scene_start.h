// Scenes that go on from others. A script that looks at each result of a loop has scenes that grow
// by a tool: what is known of all before it is not looked at again.
#pragma once

#include <cstdint>
#include <functional>
#include <list>
#include <map>
#include <memory>
#include <optional>
#include <unordered_map>
#include <utility>
#include <vector>

#include "engine/csg/frames.h"
#include "engine/csg/scene.h"
#include "engine/csg/scene_step.h"

namespace csgrun {

using FrameNumbers = std::map<std::array<std::array<int64_t, 3>, 3>, uint32_t>;

/// What a scene of one root knows, for one with that root as its first operand.
struct SceneStart {
  KnownReach reach;  ///< `index` is the root
  BooleanOp op = BooleanOp::kUnion;
  Subtree subtree;  ///< of the root
  GridStep step;
  std::vector<Frame> frames;
  FrameNumbers frame_ids;
  RowTable rows;
  std::shared_ptr<OperandSet> met;  ///< Scene::met_before of what goes on by the same operator
  size_t operand_count = 0;
};

/// Those of the last few roots. Each is taken once: a scene that goes on from one adds to it.
class SceneStarts {
 public:
  /// `is_kept`: whether the value of a key is at hand.
  explicit SceneStarts(std::function<bool(const Key&)> is_kept) : is_kept_(std::move(is_kept)) {}

  std::optional<SceneStart> take(uint32_t root) {
    for (auto i = starts_.begin(); i != starts_.end(); ++i) {
      if (i->reach.index != root) continue;
      if (!is_kept_(i->subtree.id.key)) return std::nullopt;
      std::optional<SceneStart> start = std::move(*i);
      starts_.erase(i);
      return start;
    }
    return std::nullopt;
  }
  void put(std::optional<SceneStart> start) {
    constexpr size_t kMost = 8;
    if (!start) return;
    starts_.remove_if([&](const SceneStart& s) { return s.reach.index == start->reach.index; });
    starts_.push_front(*std::move(start));
    if (starts_.size() > kMost) starts_.pop_back();
  }
  void clear() { starts_.clear(); }

 private:
  std::function<bool(const Key&)> is_kept_;
  std::list<SceneStart> starts_;
};

}  // namespace csgrun
