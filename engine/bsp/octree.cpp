#include "engine/bsp/octree.h"

#include <algorithm>
#include <cmath>

#include "engine/bsp/corner_trace.h"

namespace csgrun {
namespace {

/// Divisions that may pass without thinning out a cell before it is left as it is: two octree levels.
/// Many polygons through one point cannot be told apart by dividing.
constexpr int kPatience = 6;

/// Up to this many polygons the halves along all axes are counted before a cell is divided.
constexpr uint32_t kCountAtMost = 1024;

class OctreeBuilder {
 public:
  OctreeBuilder(Job& job, const KernelOptions& options)
      : job_(job), limit_(std::max<uint32_t>(1, options.cell_limit)), cancel_(options.cancel) {
    constant_.assign(job.operand_count(), Inside::kUnknown);
    mentioned_.assign(job.operand_count(), 0);
    tree_.fate.assign(job.polygons().size(), 0);
  }

  Octree run(const Expression& expression, const GridBox& region, const std::array<uint32_t, 3>& shift) {
    if (region.empty()) return std::move(tree_);
    CellBox box;
    int64_t extent = 1;
    for (int k = 0; k < 3; ++k) {
      box.lo[k] = region.lo[k] - 1 - shift[k];
      extent = std::max(extent, region.hi[k] + 1 - box.lo[k]);
    }
    int64_t size = 1;
    while (size < extent) size *= 2;
    for (int k = 0; k < 3; ++k) box.hi[k] = box.lo[k] + size;
    PrunedExpression whole(expression);
    for (uint32_t o = 0; o < job_.operand_count(); ++o) {
      Presence p{o, false, static_cast<uint32_t>(polygons_.size()), 0};
      bool reaches_out = false;
      for (uint32_t i = job_.polygon_start(o); i < job_.polygon_start(o + 1); ++i) {
        if (meets(i, box)) polygons_.push_back(i);
        reaches_out |= job_.boxes()[i].lo[0] <= box.lo[0];
      }
      p.count = static_cast<uint32_t>(polygons_.size()) - p.first_polygon;
      if (reaches_out) {
        for (uint32_t i = job_.polygon_start(o); i < job_.polygon_start(o + 1); ++i) {
          p.corner_inside ^= ray_crosses(job_, i, box.lo);
        }
      }
      presences_.push_back(p);
    }
    enter(box, 0, whole, 0);
    return std::move(tree_);
  }

 private:
  using Presence = CriticalCell::Presence;

  /// Whether the polygon may meet the cell: its box does and, for a polygon that reaches beyond the
  /// cell, so do its plane and its outline. Conservative.
  [[nodiscard]] bool meets(uint32_t polygon, const CellBox& cell) const {
    const PolygonBox& b = job_.boxes()[polygon];
    int larger = 0;
    for (int k = 0; k < 3; ++k) {
      if (b.hi[k] <= cell.lo[k] || b.lo[k] > cell.hi[k]) return false;
      larger += b.lo[k] < cell.lo[k] || b.hi[k] > cell.hi[k];
    }
    return larger == 0 || !separated(polygon, cell);
  }

  /// Separating axes in doubles: the polygon's normal, and in the projection along its longest
  /// component the normals of its edges. Margins cover the rounding: coordinates are off by 2^-23 at
  /// most (rounded vertices below 2^30), products by 2^-52 of their size.
  [[nodiscard]] bool separated(uint32_t polygon, const CellBox& cell) const {
    const auto corners = job_.corners(job_.polygons()[polygon]);
    double center[3], half[3], reach_of_cell = 0;
    for (int k = 0; k < 3; ++k) {
      half[k] = static_cast<double>(cell.hi[k] - cell.lo[k]) * 0.5 + 1;
      center[k] = static_cast<double>(cell.lo[k]) + half[k];
      reach_of_cell = std::max(reach_of_cell, half[k]);
    }
    const auto &a = job_.rounded(corners[0]), &b = job_.rounded(corners[1]),
               &c = job_.rounded(corners[2]);
    double u[3], v[3], n[3], length = 0, distance = 0;
    for (int k = 0; k < 3; ++k) {
      u[k] = b[k] - a[k];
      v[k] = c[k] - a[k];
      length = std::max({length, std::fabs(u[k]), std::fabs(v[k])});
      distance = std::max(distance, std::fabs(center[k] - a[k]));
    }
    double value = 0, reach = 0;
    const double normal_error = 0x1p-50 * length * length + 0x1p-21 * length;
    for (int k = 0; k < 3; ++k) {
      const int i = (k + 1) % 3, j = (k + 2) % 3;
      n[k] = u[i] * v[j] - u[j] * v[i];
      value += n[k] * (center[k] - a[k]);
      reach += std::fabs(n[k]) * (half[k] + 1);
    }
    if (std::fabs(value) >
        reach * (1 + 0x1p-40) + 4 * normal_error * (distance + reach_of_cell)) {
      return true;
    }
    const int axis = std::fabs(n[0]) >= std::fabs(n[1]) && std::fabs(n[0]) >= std::fabs(n[2]) ? 0
                     : std::fabs(n[1]) >= std::fabs(n[2])                                     ? 1
                                                                                              : 2;
    if (std::fabs(n[axis]) <= 4 * normal_error) return false;  // too thin to have a sure orientation
    const int i = (axis + 1) % 3, j = (axis + 2) % 3;
    const double sign = n[axis] > 0 ? 1 : -1;
    for (size_t k = 0; k < corners.size(); ++k) {
      const auto &p = job_.rounded(corners[k]), &q = job_.rounded(corners[k + 1 < corners.size() ? k + 1 : 0]);
      const double du = q[i] - p[i], dv = q[j] - p[j];
      // Left of the edge is inside: the cell is outside when its leftmost corner is right of it.
      const double left = sign * (du * (center[j] - p[j]) - dv * (center[i] - p[i]));
      const double spread = std::fabs(du) * (half[j] + 1) + std::fabs(dv) * (half[i] + 1);
      const double margin = (std::fabs(du) + std::fabs(dv)) * 0x1p-20 + 0x1p-20 * distance_to(center, p);
      if (left < -spread * (1 + 0x1p-40) - margin) return true;
    }
    return false;
  }

  static double distance_to(const double* center, const std::array<double, 3>& p) {
    return std::max({std::fabs(center[0] - p[0]), std::fabs(center[1] - p[1]),
                     std::fabs(center[2] - p[2])});
  }

  /// Handles a cell whose presences are presences_[first..] and may have lost their polygons or their
  /// mention; leaves both stacks as they were below `first`.
  void enter(const CellBox& box, size_t first, const PrunedExpression& outer, int stalled) {
    bool absent = false;
    for (size_t i = first; i < presences_.size(); ++i) {
      if (presences_[i].count) continue;
      absent = true;
      constant_[presences_[i].operand] = presences_[i].corner_inside ? Inside::kYes : Inside::kNo;
    }
    if (!absent) {
      visit(box, first, outer, stalled);
      return;
    }
    const PrunedExpression folded = outer.fold([this](uint32_t o) { return constant_[o]; });
    folded.each_operand([this](uint32_t o) { mentioned_[o] = 1; });
    size_t kept = first;
    for (size_t i = first; i < presences_.size(); ++i) {
      const Presence p = presences_[i];
      constant_[p.operand] = Inside::kUnknown;
      if (p.count && mentioned_[p.operand]) {
        presences_[kept++] = p;
      } else {
        mark(p, Copy::kDrop);
      }
      mentioned_[p.operand] = 0;
    }
    presences_.resize(kept);
    visit(box, first, folded, stalled);
  }

  void mark(const Presence& p, Copy copy) {
    for (uint32_t i = 0; i < p.count; ++i) {
      tree_.fate[polygons_[p.first_polygon + i]] |= static_cast<uint8_t>(copy);
    }
  }

  void visit(const CellBox& box, size_t first, const PrunedExpression& expression, int stalled) {
    ++tree_.cells;
    using Form = PrunedExpression::Form;
    switch (expression.form()) {
      case Form::kEmpty:
      case Form::kFull:
        for (size_t i = first; i < presences_.size(); ++i) mark(presences_[i], Copy::kDrop);
        return;
      case Form::kOperand:
      case Form::kComplement:
        copy(box, first, expression);
        return;
      case Form::kGeneral: break;
    }
    uint32_t total = 0;
    for (size_t i = first; i < presences_.size(); ++i) total += presences_[i].count;
    const int axis = choose_axis(box, first, total);
    const bool cancelled = cancel_ && cancel_->load(std::memory_order_relaxed);
    if (total <= limit_ || stalled >= kPatience || box.hi[axis] - box.lo[axis] < 2 || cancelled) {
      add_critical(box, first, expression);
      return;
    }
    divide(box, first, expression, stalled, axis, total);
  }

  /// The longest axis, as an octree has it, unless dividing another leaves clearly fewer polygons in
  /// the halves: faces that overlap in one plane thin out only across their edges.
  [[nodiscard]] int choose_axis(const CellBox& box, size_t first, uint32_t total) const {
    int longest = 0;
    for (int k = 1; k < 3; ++k) {
      if (box.hi[k] - box.lo[k] > box.hi[longest] - box.lo[longest]) longest = k;
    }
    if (total > kCountAtMost) return longest;
    std::array<uint32_t, 3> sum{};
    for (size_t i = first; i < presences_.size(); ++i) {
      const Presence& p = presences_[i];
      for (uint32_t k = p.first_polygon; k < p.first_polygon + p.count; ++k) {
        const PolygonBox& b = job_.boxes()[polygons_[k]];
        for (int a = 0; a < 3; ++a) {
          const int64_t middle = box.lo[a] + (box.hi[a] - box.lo[a]) / 2;
          sum[a] += (b.lo[a] <= middle) + (b.hi[a] > middle);
        }
      }
    }
    int best = longest;
    for (int a = 0; a < 3; ++a) {
      if (box.hi[a] - box.lo[a] >= 2 && sum[a] * 10 < sum[best] * 9) best = a;
    }
    return best;
  }

  void divide(const CellBox& box, size_t first, const PrunedExpression& expression, int stalled,
              int axis, uint32_t total) {
    const int64_t middle = box.lo[axis] + (box.hi[axis] - box.lo[axis]) / 2;
    const size_t end = presences_.size();
    const size_t polygons_end = polygons_.size();
    for (int upper = 0; upper < 2; ++upper) {
      CellBox child = box;
      (upper ? child.lo : child.hi)[axis] = middle;
      uint32_t child_total = 0;
      for (size_t i = first; i < end; ++i) {
        const Presence p = presences_[i];
        Presence q{p.operand, p.corner_inside, static_cast<uint32_t>(polygons_.size()), 0};
        for (uint32_t k = p.first_polygon; k < p.first_polygon + p.count; ++k) {
          const uint32_t polygon = polygons_[k];
          if (upper) q.corner_inside ^= segment_crosses(job_, polygon, box.lo, axis, middle);
          if (meets(polygon, child)) polygons_.push_back(polygon);
        }
        q.count = static_cast<uint32_t>(polygons_.size()) - q.first_polygon;
        child_total += q.count;
        presences_.push_back(q);
      }
      const bool thinner = child_total * 10 <= total * 9;
      enter(child, end, expression, thinner ? 0 : stalled + 1);
      presences_.resize(end);
      polygons_.resize(polygons_end);
    }
  }

  void copy(const CellBox& box, size_t first, const PrunedExpression& expression) {
    const bool flip = expression.form() == PrunedExpression::Form::kComplement;
    const auto cell = static_cast<uint32_t>(tree_.copied_cells.size());
    tree_.copied_cells.push_back(box);
    uint32_t polygons = 0;
    for (size_t i = first; i < presences_.size(); ++i) polygons += presences_[i].count;
    tree_.surface_cells += std::max<uint32_t>(1, (polygons + limit_ - 1) / limit_);
    for (size_t i = first; i < presences_.size(); ++i) {
      const Presence& p = presences_[i];
      if (p.operand != expression.single()) {
        mark(p, Copy::kDrop);
        continue;
      }
      mark(p, flip ? Copy::kFlip : Copy::kKeep);
      for (uint32_t k = 0; k < p.count; ++k) {
        tree_.copied.push_back({polygons_[p.first_polygon + k], cell, flip});
      }
    }
  }

  void add_critical(const CellBox& box, size_t first, const PrunedExpression& expression) {
    ++tree_.surface_cells;
    CriticalCell cell{box, static_cast<uint32_t>(tree_.presences.size()), 0, expression};
    for (size_t i = first; i < presences_.size(); ++i) {
      Presence p = presences_[i];
      mark(p, Copy::kCritical);
      const uint32_t* from = polygons_.data() + p.first_polygon;
      p.first_polygon = static_cast<uint32_t>(tree_.cell_polygons.size());
      tree_.cell_polygons.insert(tree_.cell_polygons.end(), from, from + p.count);
      tree_.presences.push_back(p);
      ++cell.presence_count;
    }
    tree_.critical.push_back(cell);
  }

  Job& job_;
  const uint32_t limit_;
  const std::atomic<bool>* cancel_;
  Octree tree_;
  std::vector<Presence> presences_;   ///< a stack: those of the cells on the way down
  std::vector<uint32_t> polygons_;    ///< likewise
  std::vector<Inside> constant_;
  std::vector<uint8_t> mentioned_;
};

}  // namespace

Octree build_octree(Job& job, const Expression& expression, const GridBox& region,
                    const KernelOptions& options) {
  return OctreeBuilder(job, options).run(expression, region, options.octree_shift);
}

}  // namespace csgrun
