#include "engine/bsp/surface_octree.h"

#include <algorithm>
#include <cmath>

#include "engine/bsp/corner_trace.h"

namespace csgrun {
namespace {

/// How many polygons a cell holds, and how many of them cross another one.
struct Counts {
  double polygons, crossing;
};

/// How many tests may be spent on dividing a cell: about what solving it costs, the square of its
/// polygons. Where many cross they are cut by one another's planes, and it costs up to their cube.
struct Budget {
  double polygons, crossing;

  static Budget of(const Counts& counts) {
    const double n = counts.polygons, c = counts.crossing;
    return {n * (n / 64 + 32), c * (c / 4 + 48)};
  }
  [[nodiscard]] double sum() const { return polygons + crossing; }
  [[nodiscard]] Budget at_most(const Budget& o) const {
    return {std::min(polygons, o.polygons), std::min(crossing, o.crossing)};
  }
  [[nodiscard]] Budget less(double tests) const {
    const double first = std::min(crossing, tests);
    return {polygons - (tests - first), crossing - first};
  }
  /// What is left for a half that holds `mine`, when the other holds `other`. For polygons that
  /// cross, by what it costs to solve them; but where the other half holds a third less, something
  /// has come apart, and nothing is taken away: the tip of a fan keeps them all, however often it
  /// is divided.
  [[nodiscard]] Budget share(const Counts& mine, const Counts& other) const {
    const auto part = [](double m, double o) { return m + o > 0 ? m / (m + o) : 0; };
    const double m = mine.crossing, o = other.crossing;
    return {polygons * part(mine.polygons, other.polygons),
            crossing * (3 * o <= 2 * m ? 1 : part(m * m, o * o))};
  }
};

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
    visit({root_cell(region, shift), 0, 0, 0, {HUGE_VAL, HUGE_VAL}});
    return std::move(tree_);
  }

 private:
  /// A cell on the way down; its polygons and witnesses end both stacks.
  struct Open {
    CellBox box;
    size_t first_polygon, first_witness;
    int32_t winding;
    Budget budget;  ///< for dividing it further
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
    const auto count = static_cast<uint32_t>(polygons_.size() - cell.first_polygon);
    const Counts held = counts(cell.first_polygon, polygons_.size());
    if (count == 0 || (held.crossing == 0 && witnesses_.size() == cell.first_witness)) return;
    const Budget budget = Budget::of(held).at_most(cell.budget);
    const double tests = 2 * held.polygons;
    const int axis = choose_axis(cell, count);
    const bool cancelled = cancel_ && cancel_->load(std::memory_order_relaxed);
    if (count <= limit_ || budget.sum() < tests || cell.box.hi[axis] - cell.box.lo[axis] < 2 ||
        cancelled) {
      tree_.cells.push_back(
          {cell.box, cell.winding, static_cast<uint32_t>(tree_.polygons.size()), count});
      tree_.polygons.insert(tree_.polygons.end(),
                            polygons_.begin() + static_cast<std::ptrdiff_t>(cell.first_polygon),
                            polygons_.end());
      return;
    }
    divide(cell, axis, budget.less(tests));
  }

  /// Of the polygons on the stack from `begin` to `end`.
  [[nodiscard]] Counts counts(size_t begin, size_t end) const {
    size_t crossing = 0;
    for (size_t i = begin; i < end; ++i) crossing += crosses_[polygons_[i]];
    return {static_cast<double>(end - begin), static_cast<double>(crossing)};
  }

  [[nodiscard]] int choose_axis(const Open& cell, uint32_t count) const {
    AxisChoice choice(cell.box);
    if (count > AxisChoice::kCountAtMost) return choice.longest();
    for (size_t i = cell.first_polygon; i < polygons_.size(); ++i) {
      choice.count(job_.boxes()[polygons_[i]]);
    }
    return choice.best();
  }

  void divide(const Open& cell, int axis, const Budget& budget) {
    const int64_t middle = cell.box.lo[axis] + (cell.box.hi[axis] - cell.box.lo[axis]) / 2;
    const size_t polygons_end = polygons_.size(), witnesses_end = witnesses_.size();
    const auto fill = [&](const CellBox& box) {
      for (size_t i = cell.first_polygon; i < polygons_end; ++i) {
        if (may_meet(job_, polygons_[i], box)) polygons_.push_back(polygons_[i]);
      }
      for (size_t i = cell.first_witness; i < witnesses_end; ++i) {
        if (may_hold(witnesses_[i], box)) witnesses_.push_back(witnesses_[i]);
      }
    };
    Open upper{cell.box, polygons_end, witnesses_end, cell.winding, {}};
    upper.box.lo[axis] = middle;
    for (size_t i = cell.first_polygon; i < polygons_end; ++i) {
      upper.winding += winding_step(job_, polygons_[i], cell.box.lo, axis, middle);
    }
    fill(upper.box);
    Open lower{cell.box, polygons_.size(), witnesses_.size(), cell.winding, {}};
    lower.box.hi[axis] = middle;
    fill(lower.box);
    const Counts above = counts(polygons_end, lower.first_polygon),
                 below = counts(lower.first_polygon, polygons_.size());
    lower.budget = budget.share(below, above);
    upper.budget = budget.share(above, below);
    visit(lower);
    polygons_.resize(lower.first_polygon);
    witnesses_.resize(lower.first_witness);
    visit(upper);
    polygons_.resize(polygons_end);
    witnesses_.resize(witnesses_end);
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
