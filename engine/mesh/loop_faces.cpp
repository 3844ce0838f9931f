#include "engine/mesh/loop_faces.h"

#include <tuple>

#include "engine/bsp/union_find.h"

namespace csgrun {

CollinearGroups::CollinearGroups(const std::vector<const std::vector<uint32_t>*>& loops) {
  UnionFind joined(loops.size());
  for (uint32_t l = 0; l < loops.size(); ++l) {
    const std::vector<uint32_t>& loop = *loops[l];
    for (size_t i = 0; i < loop.size(); ++i) {
      const auto [a, b] = std::minmax(loop[i], loop[(i + 1) % loop.size()]);
      edges_.push_back({a, b, l});
    }
  }
  const auto key = [](const Edge& e) { return std::tie(e.a, e.b); };
  std::sort(edges_.begin(), edges_.end(), [&](const Edge& e, const Edge& g) {
    return std::tie(e.a, e.b, e.group) < std::tie(g.a, g.b, g.group);
  });
  for (size_t i = 1; i < edges_.size(); ++i) {
    if (key(edges_[i]) == key(edges_[i - 1])) joined.join(edges_[i].group, edges_[i - 1].group);
  }
  std::vector<int64_t> number(loops.size(), -1);
  for (uint32_t l = 0; l < loops.size(); ++l) {
    int64_t& group = number[joined.find(l)];
    if (group < 0) {
      group = static_cast<int64_t>(vertices_.size());
      vertices_.emplace_back();
    }
    auto& vertices = vertices_[static_cast<size_t>(group)];
    vertices.insert(vertices.end(), loops[l]->begin(), loops[l]->end());
  }
  for (auto& vertices : vertices_) {
    std::sort(vertices.begin(), vertices.end());
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  }
  for (Edge& edge : edges_) edge.group = static_cast<uint32_t>(number[joined.find(edge.group)]);
}

int64_t CollinearGroups::group_of(uint32_t a, uint32_t b) const {
  const auto found = std::lower_bound(
      edges_.begin(), edges_.end(), std::tie(a, b),
      [](const Edge& e, const auto& wanted) { return std::tie(e.a, e.b) < wanted; });
  if (found == edges_.end() || found->a != a || found->b != b) return -1;
  return found->group;
}

void clean_loop(std::vector<uint32_t>& loop) {
  const bool is_triangle = loop.size() == 3;
  if (is_triangle && loop[0] != loop[1] && loop[1] != loop[2] && loop[2] != loop[0]) return;
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
  const auto is_split = [&](size_t i) {
    const uint32_t a = loop[i], b = loop[i + 1 < loop.size() ? i + 1 : 0];
    return splits.contains({std::min(a, b), std::max(a, b)});
  };
  size_t first = 0;
  while (first < loop.size() && !is_split(first)) ++first;
  if (first == loop.size()) return;
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
