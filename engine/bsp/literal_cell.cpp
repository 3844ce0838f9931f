#include "engine/bsp/literal_cell.h"

#include <algorithm>
#include <cassert>

#include "engine/bsp/literal_merge.h"

namespace csgrun {
namespace {

class LiteralCell {
 public:
  LiteralCell(CellGeometry& geometry, const CriticalCell& cell,
              const std::array<uint32_t, 6>& walls, FragmentSet& out)
      : geometry_(geometry),
        cell_(cell),
        walls_(walls),
        out_(out),
        points_(geometry),
        merged_(points_, walls) {}

  void run(const Octree& tree) {
    for (uint32_t i = 0; i < cell_.presence_count; ++i) {
      const CriticalCell::Presence& presence = tree.presences[cell_.first_presence + i];
      Operand operand{presence.operand, {}};
      for (uint32_t k = 0; k < presence.count; ++k) {
        Fragment f = geometry_.load(tree.cell_polygons[presence.first_polygon + k]);
        if (clip_to_cell(f)) operand.polygons.push_back(f);
      }
      LocalBsp bsp;
      bsp.build(geometry_, operand.polygons, presence.corner_inside);
      merged_.add(bsp);
      operands_.push_back(std::move(operand));
    }
    extract(merged_.root(), merged_.cell());
  }

 private:
  struct Operand {
    uint32_t id;
    std::vector<Fragment> polygons;
  };
  /// A piece of a sub-hyperplane that borders on one leaf.
  struct Bordering {
    Fragment fragment;
    int32_t leaf;
  };

  /// Keeps the part of `f` on the side of the plane that `sign` names; false when there is none.
  bool clip(Fragment& f, uint32_t plane, int sign) {
    Fragment front, back;
    const Side side = geometry_.split(f, plane, front, back);
    if (side == Side::kSplit) f = sign > 0 ? front : back;
    return side == Side::kSplit || side == (sign > 0 ? Side::kFront : Side::kBack);
  }

  bool clip_to_cell(Fragment& f) {
    for (int w = 0; w < 6; ++w) {
      if (!clip(f, walls_[w], w % 2 ? -1 : 1)) return false;
    }
    return true;
  }

  /// Thibault's extraction: the sub-hyperplane of each node goes down both of its subtrees.
  void extract(int32_t node, const ConvexRegion& region) {
    if (node < 0) return;
    const MergedBsp::Node n = merged_.node(node);
    ConvexRegion front, back;
    region.split(points_, n.plane, front, back);
    // Seen from the front it is counter-clockwise as the face of the part behind.
    const ConvexRegion::Face& face = back.face_in(n.plane);
    const Fragment whole =
        geometry_.make_fragment(PlaneId(n.plane, false), face.points, face.neighbours);
    std::vector<Bordering> above, below;
    push(n.front, whole, above);
    for (const Bordering& a : above) {
      below.clear();
      push(n.back, a.fragment, below);
      for (const Bordering& b : below) emit(b.fragment, a.leaf, b.leaf);
    }
    extract(n.front, front);
    extract(n.back, back);
  }

  void push(int32_t node, const Fragment& f, std::vector<Bordering>& pieces) {
    if (node < 0) {
      pieces.push_back({f, node});
      return;
    }
    const MergedBsp::Node n = merged_.node(node);
    Fragment front, back;
    switch (geometry_.split(f, n.plane, front, back)) {
      case Side::kFront:
        push(n.front, f, pieces);
        break;
      case Side::kBack:
        push(n.back, f, pieces);
        break;
      case Side::kSplit:
        push(n.front, front, pieces);
        push(n.back, back, pieces);
        break;
      case Side::kOn:
        assert(false);
        break;  // f bounds this node's region, whose interior is cut
    }
  }

  /// `f` separates two leaves; the first lies on the positive side of its plane.
  void emit(const Fragment& f, int32_t front, int32_t back) {
    const auto is_inside = [this](const MergedBsp::Labels& labels) {
      return [&](uint32_t operand) { return static_cast<bool>(labels[slot(operand)]); };
    };
    const auto boundary = cell_.expression.boundary(is_inside(merged_.labels(front)),
                                                    is_inside(merged_.labels(back)), scratch_);
    if (boundary.operand == PrunedExpression::kNoOperand) return;
    for (const Fragment& polygon : operands_[slot(boundary.operand)].polygons) {
      if (polygon.support.index() != f.support.index()) continue;
      Fragment piece = f;
      if (!clip_to_polygon(piece, polygon)) continue;
      piece.polygon = polygon.polygon;
      out_.add(geometry_, piece, boundary.front, numbers_);
    }
  }

  /// Clips a fragment to a convex polygon in the same plane.
  bool clip_to_polygon(Fragment& f, const Fragment& polygon) {
    for (uint32_t e = 0; e < polygon.count; ++e) {
      const uint32_t plane = geometry_.edges(polygon)[e];
      int inside = 0;
      for (uint32_t c = 0; c < polygon.count && inside == 0; ++c) {
        inside = geometry_.side(plane, geometry_.corners(polygon)[c]);
      }
      if (!clip(f, plane, inside)) return false;
    }
    return true;
  }

  [[nodiscard]] size_t slot(uint32_t operand) const {
    const auto it = std::lower_bound(operands_.begin(), operands_.end(), operand,
                                     [](const Operand& o, uint32_t id) { return o.id < id; });
    return static_cast<size_t>(it - operands_.begin());
  }

  CellGeometry& geometry_;
  const CriticalCell& cell_;
  const std::array<uint32_t, 6>& walls_;
  FragmentSet& out_;
  NamedPoints points_;
  MergedBsp merged_;
  std::vector<Operand> operands_;  ///< ascending ids
  std::vector<PrunedExpression::Boundary> scratch_;
  std::vector<uint32_t> numbers_;
};

}  // namespace

void solve_literal_cell(CellGeometry& geometry, const Octree& tree, const CriticalCell& cell,
                        const std::array<uint32_t, 6>& walls, FragmentSet& out) {
  geometry.clear();
  LiteralCell(geometry, cell, walls, out).run(tree);
}

}  // namespace csgrun
