#include "engine/mesh/repair_patches.h"

#include <algorithm>
#include <cstdlib>
#include <span>

#include "engine/base/none.h"

namespace csgrun {
namespace {

/// Faces beside each other over edges of two uses; `against` when they run through it alike.
struct Neighbour {
  uint32_t face;
  bool against;
};

struct Adjacency {
  std::vector<size_t> starts;
  std::vector<Neighbour> neighbours;
};

Adjacency adjacency_of(size_t face_count, const EdgeUses& edges) {
  Adjacency result;
  result.starts.assign(face_count + 1, 0);
  edges.for_each_edge([&](std::span<const EdgeUse> uses) {
    if (uses.size() != 2) return;
    ++result.starts[uses[0].face + 1];
    ++result.starts[uses[1].face + 1];
  });
  for (size_t f = 0; f < face_count; ++f) result.starts[f + 1] += result.starts[f];
  result.neighbours.resize(result.starts.back());
  std::vector<size_t> next = result.starts;
  edges.for_each_edge([&](std::span<const EdgeUse> uses) {
    if (uses.size() != 2) return;
    const bool against = uses[0].forward == uses[1].forward;
    result.neighbours[next[uses[0].face]++] = {uses[1].face, against};
    result.neighbours[next[uses[1].face]++] = {uses[0].face, against};
  });
  return result;
}

/// The search for signs of patches, depth first without recursion.
class SignSearch {
 public:
  SignSearch(uint32_t patch_count, const std::vector<Junction>& junctions)
      : junctions_(junctions), at_patch_(patch_count), turned_(patch_count, false) {
    for (uint32_t j = 0; j < junctions.size(); ++j) {
      State state;
      for (const auto& [patch, left] : junctions[j].left) {
        at_patch_[patch].emplace_back(j, left);
        state.open += std::abs(left);
      }
      state.parity = junctions[j].parity();
      states_.push_back(state);
    }
  }

  /// Decides the patches in an order in which junctions are complete early.
  bool run(const Junction** failed) {
    const std::vector<uint32_t> order = patch_order();
    // Per patch in the order: how many of the two choices were tried.
    std::vector<uint8_t> tried(order.size(), 0);
    size_t depth = 0;
    uint64_t steps = 0;
    constexpr uint64_t kMostSteps = 2'000'000;
    while (depth < order.size()) {
      const uint32_t patch = order[depth];
      if (tried[depth] > 0) withdraw(patch);
      if (tried[depth] == 2 || ++steps > kMostSteps) {
        if (depth == 0 || steps > kMostSteps) {
          *failed = &junctions_[blocked_];
          return false;
        }
        tried[depth--] = 0;
        continue;
      }
      turned_[patch] = tried[depth]++ == 1;
      if (decide(patch)) ++depth;
    }
    return true;
  }

  std::vector<bool> take() { return std::move(turned_); }

 private:
  struct State {
    int64_t sum = 0, open = 0, parity = 0;
    [[nodiscard]] bool is_possible() const { return std::abs(sum) - open <= parity; }
  };

  [[nodiscard]] std::vector<uint32_t> patch_order() const {
    std::vector<uint32_t> order;
    std::vector<bool> seen(at_patch_.size(), false);
    for (uint32_t start = 0; start < at_patch_.size(); ++start) {
      if (seen[start] || at_patch_[start].empty()) continue;
      seen[start] = true;
      order.push_back(start);
      for (size_t i = order.size() - 1; i < order.size(); ++i) {
        for (const auto& [j, unused] : at_patch_[order[i]]) {
          for (const auto& [other, left] : junctions_[j].left) {
            if (seen[other]) continue;
            seen[other] = true;
            order.push_back(other);
          }
        }
      }
    }
    return order;
  }

  bool decide(uint32_t patch) {
    bool possible = true;
    for (const auto& [j, left] : at_patch_[patch]) {
      State& state = states_[j];
      state.sum += turned_[patch] ? -left : left;
      state.open -= std::abs(left);
      if (state.is_possible()) continue;
      possible = false;
      blocked_ = j;
    }
    return possible;
  }
  void withdraw(uint32_t patch) {
    for (const auto& [j, left] : at_patch_[patch]) {
      states_[j].sum -= turned_[patch] ? -left : left;
      states_[j].open += std::abs(left);
    }
  }

  const std::vector<Junction>& junctions_;
  std::vector<std::vector<std::pair<uint32_t, int64_t>>> at_patch_;
  std::vector<bool> turned_;
  std::vector<State> states_;
  uint32_t blocked_ = 0;
};

}  // namespace

Patches find_patches(const std::vector<LoopFace>& faces, const EdgeUses& edges) {
  const Adjacency adjacency = adjacency_of(faces.size(), edges);
  Patches patches;
  patches.of_face.assign(faces.size(), kNone);
  patches.turned.assign(faces.size(), false);
  std::vector<uint32_t> members;
  for (uint32_t seed = 0; seed < faces.size(); ++seed) {
    if (patches.of_face[seed] != kNone) continue;
    members.assign(1, seed);
    patches.of_face[seed] = patches.count;
    size_t turned = 0;
    for (size_t i = 0; i < members.size(); ++i) {
      const uint32_t face = members[i];
      turned += patches.turned[face];
      for (size_t k = adjacency.starts[face]; k < adjacency.starts[face + 1]; ++k) {
        const Neighbour& neighbour = adjacency.neighbours[k];
        if (patches.of_face[neighbour.face] != kNone) continue;
        patches.of_face[neighbour.face] = patches.count;
        patches.turned[neighbour.face] = patches.turned[face] != neighbour.against;
        members.push_back(neighbour.face);
      }
    }
    if (2 * turned > members.size()) {
      for (const uint32_t face : members) patches.turned[face] = !patches.turned[face];
    }
    ++patches.count;
  }
  edges.for_each_edge([&](std::span<const EdgeUse> uses) {
    if (uses.size() != 2 || patches.twisted) return;
    const bool against = uses[0].forward == uses[1].forward;
    if (against != (patches.turned[uses[0].face] != patches.turned[uses[1].face])) {
      patches.twisted = {uses[0].low, uses[0].high};
    }
  });
  return patches;
}

int64_t Junction::parity() const {
  int64_t sum = 0;
  for (const auto& [patch, uses] : left) sum += uses;
  return std::abs(sum) % 2;
}

std::vector<Junction> find_junctions(const Patches& patches, const EdgeUses& edges) {
  std::vector<Junction> junctions;
  edges.for_each_edge([&](std::span<const EdgeUse> uses) {
    if (uses.size() <= 2) return;
    Junction junction{{}, uses[0].low, uses[0].high};
    for (const EdgeUse& use : uses) {
      junction.left.emplace_back(patches.of_face[use.face],
                                 use.forward != patches.turned[use.face] ? 1 : -1);
    }
    auto& left = junction.left;
    std::sort(left.begin(), left.end());
    size_t kept = 0;
    for (size_t i = 0; i < left.size();) {
      std::pair<uint32_t, int64_t> sum{left[i].first, 0};
      for (; i < left.size() && left[i].first == sum.first; ++i) sum.second += left[i].second;
      if (sum.second != 0) left[kept++] = sum;
    }
    left.resize(kept);
    if (left.empty()) return;
    if (left[0].second < 0) {  // the edge seen from its other end
      for (auto& [patch, sum] : left) sum = -sum;
    }
    junctions.push_back(std::move(junction));
  });
  std::stable_sort(junctions.begin(), junctions.end(),
                   [](const Junction& a, const Junction& b) { return a.left < b.left; });
  junctions.erase(
      std::unique(junctions.begin(), junctions.end(),
                  [](const Junction& a, const Junction& b) { return a.left == b.left; }),
      junctions.end());
  return junctions;
}

std::optional<std::vector<bool>> balance_junctions(uint32_t patch_count,
                                                   const std::vector<Junction>& junctions,
                                                   const Junction** failed) {
  SignSearch search(patch_count, junctions);
  if (!search.run(failed)) return std::nullopt;
  return search.take();
}

}  // namespace csgrun
