#include "engine/mesh/loop_faces.h"

namespace csgrun {

void clean_loop(std::vector<uint32_t>& loop) {
  bool changed = true;
  while (changed && !loop.empty()) {
    changed = false;
    std::vector<uint32_t> kept;
    for (uint32_t v : loop) {
      if (!kept.empty() && kept.back() == v) continue;
      if (kept.size() >= 2 && kept[kept.size() - 2] == v) {
        kept.pop_back();
        continue;
      }
      kept.push_back(v);
    }
    while (kept.size() >= 2) {
      if (kept.front() == kept.back()) {
        kept.pop_back();
      } else if (kept.size() >= 3 && kept[kept.size() - 2] == kept.front()) {
        kept.pop_back();
      } else if (kept.size() >= 3 && kept.back() == kept[1]) {
        kept.erase(kept.begin());
      } else {
        break;
      }
    }
    changed = kept.size() != loop.size();
    loop = std::move(kept);
  }
  if (loop.size() < 3) loop.clear();
}

void drop_empty_loops(std::vector<LoopFace>& faces) {
  for (LoopFace& face : faces) {
    std::erase_if(face.loops, [](const std::vector<uint32_t>& loop) { return loop.empty(); });
  }
  std::erase_if(faces, [](const LoopFace& face) { return face.loops.empty(); });
}

void apply_splits(const EdgeSplits& splits, std::vector<uint32_t>& loop) {
  std::vector<uint32_t> result;
  for (size_t i = 0; i < loop.size(); ++i) {
    const uint32_t a = loop[i], b = loop[(i + 1) % loop.size()];
    result.push_back(a);
    const auto found = splits.find({std::min(a, b), std::max(a, b)});
    if (found == splits.end()) continue;
    if (a < b) {
      result.insert(result.end(), found->second.begin(), found->second.end());
    } else {
      result.insert(result.end(), found->second.rbegin(), found->second.rend());
    }
  }
  loop = std::move(result);
}

}  // namespace csgrun
