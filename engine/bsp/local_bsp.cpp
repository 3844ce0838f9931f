#include "engine/bsp/local_bsp.h"

#include <algorithm>

namespace csgrun {
namespace {

/// Splitting planes that are tried at a node.
constexpr size_t kCandidates = 3;

}  // namespace

size_t choose_splitter(CellGeometry& geometry, const std::vector<Fragment>& polygons) {
  const size_t n = polygons.size();
  if (n < 4) return 0;
  size_t best = 0, best_cost = ~size_t{0};
  for (size_t c = 0; c < kCandidates; ++c) {
    const size_t candidate = c * (n - 1) / (kCandidates - 1);
    size_t front = 0, back = 0, split = 0;
    for (const Fragment& f : polygons) {
      switch (geometry.classify(f, polygons[candidate].support.index())) {
        case Side::kFront:
          ++front;
          break;
        case Side::kBack:
          ++back;
          break;
        case Side::kSplit:
          ++split;
          break;
        case Side::kOn:
          break;
      }
    }
    const size_t cost = 3 * split + (front > back ? front - back : back - front);
    if (cost < best_cost) best = candidate, best_cost = cost;
  }
  return best;
}

PartedPolygons part_polygons(CellGeometry& geometry, const std::vector<Fragment>& polygons,
                             uint32_t plane) {
  PartedPolygons parted;
  for (const Fragment& f : polygons) {
    Fragment a, b;
    switch (geometry.split(f, plane, a, b)) {
      case Side::kFront:
        parted.front.push_back(f);
        break;
      case Side::kBack:
        parted.back.push_back(f);
        break;
      case Side::kSplit:
        parted.front.push_back(a);
        parted.back.push_back(b);
        break;
      case Side::kOn:
        parted.on.push_back(f);
        break;
    }
  }
  return parted;
}

void LocalBsp::build(CellGeometry& geometry, const std::vector<Fragment>& polygons,
                     bool corner_inside) {
  nodes_.clear();
  root_ = polygons.empty() ? (corner_inside ? kInside : kOutside) : build_node(geometry, polygons);
}

int32_t LocalBsp::build_node(CellGeometry& geometry, std::vector<Fragment> polygons) {
  const PlaneId chosen = polygons[choose_splitter(geometry, polygons)].support;
  auto [front, back, on] = part_polygons(geometry, polygons, chosen.index());
  polygons = {};
  const auto index = static_cast<int32_t>(nodes_.size());
  nodes_.push_back({chosen.index(), kOutside, kInside});
  // A side without polygons is all of one kind: what the chosen polygon has on that side.
  if (chosen.flipped()) std::swap(nodes_.back().front, nodes_.back().back);
  if (!front.empty()) {
    const int32_t child = build_node(geometry, std::move(front));
    nodes_[index].front = child;
  }
  if (!back.empty()) {
    const int32_t child = build_node(geometry, std::move(back));
    nodes_[index].back = child;
  }
  return index;
}

void LocalBsp::classify(CellGeometry& geometry, const Fragment& f,
                        std::vector<Piece>& pieces) const {
  push(geometry, root_, f, pieces);
}

void LocalBsp::push(CellGeometry& geometry, int32_t node, const Fragment& f,
                    std::vector<Piece>& pieces) const {
  Fragment front, back;
  Side side = Side::kFront;
  while (node >= 0) {
    side = geometry.split(f, nodes_[node].plane, front, back);
    if (side == Side::kFront) {
      node = nodes_[node].front;
    } else if (side == Side::kBack) {
      node = nodes_[node].back;
    } else {
      break;
    }
  }
  if (node < 0) {
    pieces.push_back({f, node == kInside, node == kInside});
    return;
  }
  const size_t before = pieces.size();
  if (side == Side::kSplit) {
    push(geometry, nodes_[node].front, front, pieces);
    push(geometry, nodes_[node].back, back, pieces);
    if (pieces.size() == before + 2 &&
        pieces[before].front_inside == pieces[before + 1].front_inside &&
        pieces[before].back_inside == pieces[before + 1].back_inside) {
      pieces.pop_back();
      pieces.back().fragment = f;
    }
    return;
  }
  // In the plane of the node: the label on the positive side from the front subtree, and for each
  // piece that gives, the label on the negative side from the back subtree.
  std::vector<Piece> positive, negative;
  push(geometry, nodes_[node].front, f, positive);
  for (const Piece& p : positive) {
    negative.clear();
    push(geometry, nodes_[node].back, p.fragment, negative);
    for (const Piece& q : negative) {
      const bool above = p.front_inside, below = q.front_inside;
      const bool turned = f.support.flipped();
      pieces.push_back({q.fragment, turned ? below : above, turned ? above : below});
    }
  }
}

}  // namespace csgrun
