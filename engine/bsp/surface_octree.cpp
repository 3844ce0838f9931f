#include "engine/bsp/surface_octree.h"

#include <algorithm>

#include "engine/bsp/corner_trace.h"

namespace csgrun {
namespace {

/// Slivers that cross in a tangle cost the cube of their number, and come apart late: six octree levels.
constexpr int kLongPatience = 18;

class SurfaceOctreeBuilder {
 public:
  SurfaceOctreeBuilder(Job& job, std::span<const uint8_t> crosses, const KernelOptions& options)
      : job_(job),
        crosses_(crosses),
        limit_(std::max<uint32_t>(1, options.cell_limit)),
        cancel_(options.cancel) {}

  SurfaceOctree run(std::span<const uint32_t> polygons, std::span<const uint32_t> witnesses,
                    const std::array<uint32_t, 3>& shift) {
    if (polygons.empty()) return std::move(tree_);
    GridBox region;
    region.lo = {INT64_MAX, INT64_MAX, INT64_MAX};
    region.hi = {INT64_MIN, INT64_MIN, INT64_MIN};
    for (const uint32_t p : polygons) {
      for (int k = 0; k < 3; ++k) {
        region.lo[k] = std::min<int64_t>(region.lo[k], job_.boxes()[p].lo[k]);
        region.hi[k] = std::max<int64_t>(region.hi[k], job_.boxes()[p].hi[k]);
      }
    }
    polygons_.assign(polygons.begin(), polygons.end());
    witnesses_.assign(witnesses.begin(), witnesses.end());
    // The root's lowest corner is outside of everything.
    visit({root_cell(region, shift), 0, 0, 0, 0});
    return std::move(tree_);
  }

 private:
  /// A cell on the way down; its polygons and witnesses end both stacks.
  struct Open {
    CellBox box;
    size_t first_polygon, first_witness;
    int32_t winding;
    int stalled;
  };

  /// Whether a vertex may be in the cell: certain for one of the cells around it.
  [[nodiscard]] bool may_hold(uint32_t vertex, const CellBox& box) const {
    for (int k = 0; k < 3; ++k) {
      const double c = job_.rounded(vertex)[k];
      const double lo = static_cast<double>(box.lo[k]), hi = static_cast<double>(box.hi[k]);
      if (c < lo || c > hi + 1) return false;
    }
    return true;
  }

  void visit(const Open& cell) {
    ++tree_.visited;
    const uint32_t count = static_cast<uint32_t>(polygons_.size() - cell.first_polygon);
    const auto crossing = std::count_if(polygons_.begin() + cell.first_polygon, polygons_.end(),
                                        [&](uint32_t p) { return crosses_[p] != 0; });
    if (count == 0 || (crossing == 0 && witnesses_.size() == cell.first_witness)) return;
    const int patience = crossing > limit_ ? kLongPatience : kDivisionPatience;
    const int axis = choose_axis(cell, count);
    const bool cancelled = cancel_ && cancel_->load(std::memory_order_relaxed);
    if (count <= limit_ || cell.stalled >= patience ||
        cell.box.hi[axis] - cell.box.lo[axis] < 2 || cancelled) {
      tree_.cells.push_back(
          {cell.box, cell.winding, static_cast<uint32_t>(tree_.polygons.size()), count});
      tree_.polygons.insert(tree_.polygons.end(), polygons_.begin() + cell.first_polygon,
                            polygons_.end());
      return;
    }
    divide(cell, axis, count);
  }

  [[nodiscard]] int choose_axis(const Open& cell, uint32_t count) const {
    AxisChoice choice(cell.box);
    if (count > AxisChoice::kCountAtMost) return choice.longest();
    for (size_t i = cell.first_polygon; i < polygons_.size(); ++i) {
      choice.count(job_.boxes()[polygons_[i]]);
    }
    return choice.best();
  }

  void divide(const Open& cell, int axis, uint32_t count) {
    const CellBox& box = cell.box;
    const int64_t middle = box.lo[axis] + (box.hi[axis] - box.lo[axis]) / 2;
    const size_t polygons_end = polygons_.size(), witnesses_end = witnesses_.size();
    for (int upper = 0; upper < 2; ++upper) {
      Open child{box, polygons_end, witnesses_end, cell.winding, 0};
      (upper ? child.box.lo : child.box.hi)[axis] = middle;
      for (size_t i = cell.first_polygon; i < polygons_end; ++i) {
        const uint32_t polygon = polygons_[i];
        if (upper) child.winding += winding_step(job_, polygon, box.lo, axis, middle);
        if (may_meet(job_, polygon, child.box)) polygons_.push_back(polygon);
      }
      for (size_t i = cell.first_witness; i < witnesses_end; ++i) {
        if (may_hold(witnesses_[i], child.box)) witnesses_.push_back(witnesses_[i]);
      }
      const size_t left = polygons_.size() - polygons_end;
      child.stalled = left * 10 <= count * size_t{9} ? 0 : cell.stalled + 1;
      visit(child);
      polygons_.resize(polygons_end);
      witnesses_.resize(witnesses_end);
    }
  }

  Job& job_;
  std::span<const uint8_t> crosses_;
  const uint32_t limit_;
  const std::atomic<bool>* cancel_;
  SurfaceOctree tree_;
  std::vector<uint32_t> polygons_, witnesses_;  ///< stacks: those of the cells on the way down
};

}  // namespace

SurfaceOctree build_surface_octree(Job& job, std::span<const uint32_t> polygons,
                                   std::span<const uint8_t> crosses,
                                   std::span<const uint32_t> witnesses,
                                   const KernelOptions& options) {
  return SurfaceOctreeBuilder(job, crosses, options).run(polygons, witnesses, options.octree_shift);
}

}  // namespace csgrun
