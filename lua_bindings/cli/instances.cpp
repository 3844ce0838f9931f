#include "lua_bindings/cli/instances.h"

#include <map>

namespace csgrun {
namespace {

struct Bare {
  NodePtr node;
  const Appearance* appearance = nullptr;  // the outermost one
  Affine placement;
};

Bare bare(const NodePtr& part) {
  Bare result{part, nullptr, {}};
  while (true) {
    const Node& node = *result.node;
    if (node.kind() == NodeKind::kTransform) {
      result.placement = Affine::compose(result.placement, node.transform());
    } else if (node.kind() == NodeKind::kAppearance) {
      if (result.appearance == nullptr) result.appearance = &node.appearance();
    } else {
      return result;
    }
    result.node = NodePtr(node.children()[0]);
  }
}

}  // namespace

Instances find_instances(const std::vector<NodePtr>& parts) {
  struct Group {
    Bare first;
    std::vector<size_t> members;
  };
  std::vector<Bare> bares;
  std::vector<Group> groups;                         // in the order of their first parts
  std::map<const Node*, std::vector<size_t>> known;  // groups by their node; only looked up
  for (size_t i = 0; i < parts.size(); ++i) {
    bares.push_back(bare(parts[i]));
    std::vector<size_t>& candidates = known[bares[i].node.get()];
    size_t group = groups.size();
    for (const size_t candidate : candidates) {
      const Appearance *a = bares[i].appearance, *b = groups[candidate].first.appearance;
      if (a == b || (a != nullptr && b != nullptr && *a == *b)) group = candidate;
    }
    if (group == groups.size()) {
      groups.push_back({bares[i], {}});
      candidates.push_back(group);
    }
    groups[group].members.push_back(i);
  }
  Instances result;
  result.of_part.resize(parts.size());
  for (const Group& group : groups) {
    if (group.members.size() < 2) continue;
    for (const size_t member : group.members) {
      result.of_part[member] = Instance{result.bases.size(), bares[member].placement};
    }
    const Bare& first = group.first;
    result.bases.push_back(
        first.appearance == nullptr ? first.node : Node::painted(*first.appearance, first.node));
  }
  return result;
}

}  // namespace csgrun
