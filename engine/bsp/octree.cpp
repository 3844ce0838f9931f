#include "engine/bsp/octree.h"

#include <algorithm>

#include "engine/bsp/corner_trace.h"

namespace csgrun {
namespace {

class OctreeBuilder {
 public:
  OctreeBuilder(Job& job, const KernelOptions& options, const std::vector<uint8_t>* wanted)
      : job_(job), limit_(std::max<uint32_t>(1, options.cell_limit)), cancel_(options.cancel) {
    tree_.wanted = wanted;
    constant_.assign(job.operand_count(), Inside::kUnknown);
    mentioned_.assign(job.operand_count(), 0);
    tree_.fate.assign(job.polygons().size(), 0);
  }

  Octree run(const Expression& expression, const GridBox& region,
             const std::array<uint32_t, 3>& shift) {
    if (region.empty()) return std::move(tree_);
    const CellBox box = root_cell(region, shift);
    PrunedExpression whole(expression);
    for (uint32_t o = 0; o < job_.operand_count(); ++o) {
      Presence p{o, false, static_cast<uint32_t>(polygons_.size()), 0};
      bool reaches_out = false;
      for (uint32_t i = job_.polygon_start(o); i < job_.polygon_start(o + 1); ++i) {
        if (may_meet(job_, i, box)) polygons_.push_back(i);
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

  /// Handles a cell whose presences are presences_[first..] and may have lost their polygons or
  /// their mention; leaves both stacks as they were below `first`.
  void enter(const CellBox& box, size_t first, const PrunedExpression& outer, int stalled) {
    if (!any_wanted(first)) return;
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

  [[nodiscard]] bool any_wanted(size_t first) const {
    if (!tree_.wanted) return true;
    return std::any_of(presences_.begin() + first, presences_.end(), [&](const Presence& p) {
      const auto begin = polygons_.begin() + p.first_polygon;
      return std::any_of(begin, begin + p.count, [&](uint32_t i) { return tree_.is_wanted(i); });
    });
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
      case Form::kGeneral:
        break;
    }
    uint32_t total = 0;
    for (size_t i = first; i < presences_.size(); ++i) total += presences_[i].count;
    const int axis = choose_axis(box, first, total);
    const bool cancelled = cancel_ && cancel_->load(std::memory_order_relaxed);
    if (total <= limit_ || stalled >= kDivisionPatience || box.hi[axis] - box.lo[axis] < 2 ||
        cancelled) {
      add_critical(box, first, expression);
      return;
    }
    divide(box, first, expression, stalled, axis, total);
  }

  [[nodiscard]] int choose_axis(const CellBox& box, size_t first, uint32_t total) const {
    AxisChoice choice(box);
    if (total > AxisChoice::kCountAtMost) return choice.longest();
    for (size_t i = first; i < presences_.size(); ++i) {
      const Presence& p = presences_[i];
      for (uint32_t k = p.first_polygon; k < p.first_polygon + p.count; ++k) {
        choice.count(job_.boxes()[polygons_[k]]);
      }
    }
    return choice.best();
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
          if (may_meet(job_, polygon, child)) polygons_.push_back(polygon);
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
        const uint32_t polygon = polygons_[p.first_polygon + k];
        if (tree_.is_wanted(polygon)) tree_.copied.push_back({polygon, cell, flip});
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
  std::vector<Presence> presences_;  ///< a stack: those of the cells on the way down
  std::vector<uint32_t> polygons_;   ///< likewise
  std::vector<Inside> constant_;
  std::vector<uint8_t> mentioned_;
};

}  // namespace

Octree build_octree(Job& job, const Expression& expression, const GridBox& region,
                    const KernelOptions& options, const std::vector<uint8_t>* wanted) {
  return OctreeBuilder(job, options, wanted).run(expression, region, options.octree_shift);
}

}  // namespace csgrun
