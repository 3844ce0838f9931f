#include "tests/support/fuzz/shrink.h"

#include <algorithm>
#include <map>
#include <set>

#include "engine/mesh/leaf_check.h"

namespace csgrun::test {

bool is_valid(const FuzzLeaf& leaf) {
  if (leaf.faces.empty()) return false;
  std::map<std::pair<IVec3, IVec3>, int> edges;
  for (const Loop& l : leaf.faces) {
    IVec3 normal{0, 0, 0};
    for (size_t i = 1; i + 1 < l.size(); ++i) {
      const IVec3 n = cross_of(sub(l[i], l[0]), sub(l[i + 1], l[0]));
      for (int k = 0; k < 3; ++k) normal[k] += n[k];
    }
    if (normal == IVec3{0, 0, 0}) return false;
    for (size_t i = 0; i < l.size(); ++i) {
      const IVec3 &a = l[i], &b = l[(i + 1) % l.size()];
      if (a == b || dot_of(normal, sub(a, l[0])) != 0) return false;
      for (const IVec3& p : l) {
        if (dot_of(normal, cross_of(sub(b, a), sub(p, a))) < 0) return false;
      }
      ++edges[{a, b}];
      --edges[{b, a}];
    }
    if (std::set<IVec3>(l.begin(), l.end()).size() != l.size()) return false;
  }
  for (const auto& [edge, count] : edges) {
    if (count != 0) return false;
  }
  if (leaf.may_cross) return true;
  return six_volumes(leaf.faces) > 0 && find_self_intersections(geometry_of(leaf)).empty();
}

FuzzCase Shrinker::run() {
  for (bool smaller = true; smaller && budget_ > 0;) {
    smaller = simplify_options() || shrink_tree() || simplify_leaves() || pull_together();
  }
  return best_;
}

bool Shrinker::take(FuzzCase c) {
  drop_unused(c);
  if (budget_-- <= 0 || text(c) == text(best_)) return false;
  for (const FuzzLeaf& l : c.leaves) {
    if (!is_valid(l)) return false;
  }
  if (!fails_(c)) return false;
  best_ = std::move(c);
  return true;
}

void Shrinker::drop_unused(FuzzCase& c) {
  std::vector<FuzzLeaf> leaves;
  std::function<void(FuzzNode&)> number = [&](FuzzNode& n) {
    if (n.leaf >= 0) {
      leaves.push_back(c.leaves[static_cast<size_t>(n.leaf)]);
      n.leaf = static_cast<int>(leaves.size()) - 1;
    }
    for (FuzzNode& child : n.children) number(child);
  };
  number(c.tree);
  c.leaves = std::move(leaves);
  std::vector<Frame> frames{Frame()};
  std::map<uint32_t, uint32_t> numbers{{0, 0}};
  for (FuzzLeaf& l : c.leaves) {
    const auto [at, is_new] = numbers.emplace(l.frame, static_cast<uint32_t>(frames.size()));
    if (is_new) frames.push_back(c.frames[l.frame]);
    l.frame = at->second;
  }
  c.frames = std::move(frames);
}

bool Shrinker::simplify_options() {
  const auto with = [&](auto&& change) {
    FuzzCase c = best_;
    change(c);
    return take(std::move(c));
  };
  bool any = with([](FuzzCase& c) { c.nest = 0; });
  any |= with([](FuzzCase& c) { c.options.literal_cells = false; });
  any |= with([](FuzzCase& c) { c.options.octree_shift = {0, 0, 0}; });
  any |= with([](FuzzCase& c) { c.options.cell_limit = KernelOptions().cell_limit; });
  return any;
}

void Shrinker::inner_nodes(FuzzNode& n, std::vector<FuzzNode*>& out) {
  if (n.leaf < 0) out.push_back(&n);
  for (FuzzNode& c : n.children) inner_nodes(c, out);
}

bool Shrinker::shrink_tree() {
  std::vector<FuzzNode*> nodes;
  inner_nodes(best_.tree, nodes);
  for (size_t i = 0; i < nodes.size(); ++i) {
    for (size_t child = 0; child < nodes[i]->children.size(); ++child) {
      for (const bool replace : {true, false}) {
        FuzzCase c = best_;
        std::vector<FuzzNode*> copy;
        inner_nodes(c.tree, copy);
        if (replace) {  // the node by its child
          FuzzNode kept = copy[i]->children[child];
          *copy[i] = std::move(kept);
        } else {  // the node without its child
          if (copy[i]->children.size() < 3) continue;
          copy[i]->children.erase(copy[i]->children.begin() + static_cast<std::ptrdiff_t>(child));
        }
        if (take(std::move(c))) return true;
      }
    }
  }
  return false;
}

bool Shrinker::simplify_leaves() {
  bool any = false;
  for (size_t i = 0; i < best_.leaves.size(); ++i) {
    const auto with = [&](auto&& change) {
      FuzzCase c = best_;
      change(c.leaves[i]);
      any |= take(std::move(c));
    };
    with([](FuzzLeaf& l) { l.frame = 0; });
    with([](FuzzLeaf& l) { l.move = {0, 0, 0}; });
    with([](FuzzLeaf& l) { l.keep_facets = false; });
    with([](FuzzLeaf& l) { l.appearance = 0; });
    with([](FuzzLeaf& l) { l.fill = FillRule::kNonZero; });
    with([](FuzzLeaf& l) { l.may_cross = false; });
    with([](FuzzLeaf& l) { l.faces = enclosing_box(l.faces); });
    for (size_t part = 0; part < parts(best_.leaves[i].faces).size(); ++part) {
      with([&](FuzzLeaf& l) {
        auto all = parts(l.faces);
        if (part < all.size()) all.erase(all.begin() + static_cast<std::ptrdiff_t>(part));
        l.faces.clear();
        for (auto& p : all) l.faces.insert(l.faces.end(), p.begin(), p.end());
      });
    }
    // One corner onto another one.
    std::set<IVec3> corners;
    for (const Loop& l : best_.leaves[i].faces) corners.insert(l.begin(), l.end());
    for (const IVec3& from : corners) {
      for (const IVec3& to : corners) {
        if (from != to) with([&](FuzzLeaf& l) { l.faces = merged(l.faces, from, to); });
      }
    }
  }
  return any;
}

std::vector<Loop> Shrinker::enclosing_box(const std::vector<Loop>& faces) {
  IVec3 lo = faces[0][0], hi = lo;
  for (const Loop& l : faces) {
    for (const IVec3& p : l) {
      for (int k = 0; k < 3; ++k) lo[k] = std::min(lo[k], p[k]), hi[k] = std::max(hi[k], p[k]);
    }
  }
  return box_loops(lo, hi);
}

std::vector<std::vector<Loop>> Shrinker::parts(const std::vector<Loop>& faces) {
  std::vector<std::vector<Loop>> all;
  std::vector<std::set<IVec3>> corners;
  for (const Loop& l : faces) {
    std::vector<Loop> part{l};
    std::set<IVec3> own(l.begin(), l.end());
    for (size_t i = all.size(); i-- > 0;) {
      if (std::none_of(l.begin(), l.end(), [&](const IVec3& p) { return corners[i].count(p); })) {
        continue;
      }
      part.insert(part.end(), all[i].begin(), all[i].end());
      own.insert(corners[i].begin(), corners[i].end());
      all.erase(all.begin() + static_cast<std::ptrdiff_t>(i));
      corners.erase(corners.begin() + static_cast<std::ptrdiff_t>(i));
    }
    all.push_back(std::move(part));
    corners.push_back(std::move(own));
  }
  return all;
}

std::vector<Loop> Shrinker::merged(const std::vector<Loop>& faces, const IVec3& from,
                                   const IVec3& to) {
  std::vector<Loop> result;
  for (Loop l : faces) {
    for (IVec3& p : l) p = p == from ? to : p;
    l.erase(std::unique(l.begin(), l.end()), l.end());
    while (l.size() > 1 && l.front() == l.back()) l.pop_back();
    if (l.size() >= 3) result.push_back(std::move(l));
  }
  return result;
}

bool Shrinker::pull_together() {
  bool any = false;
  for (int axis = 0; axis < 3; ++axis) {
    for (int64_t beyond = -4; beyond < 12; ++beyond) {
      FuzzCase c = best_;
      for (FuzzLeaf& l : c.leaves) {
        for (Loop& loop : l.faces) {
          for (IVec3& p : loop) {
            if (p[axis] > beyond) --p[axis];
          }
        }
      }
      any |= take(std::move(c));
    }
  }
  return any;
}

}  // namespace csgrun::test
