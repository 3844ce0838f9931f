#include "engine/bsp/pair_cells.h"

#include <algorithm>
#include <limits>

namespace csgrun {
namespace {

/// Divisions in a row that thin out nothing before a cell is taken as it is.
constexpr int kPatience = 3;

using Corner = std::array<int32_t, 3>;

struct Bounds {
  Corner lo, hi;
  static Bounds none() {
    constexpr int32_t lo = std::numeric_limits<int32_t>::min(),
                      hi = std::numeric_limits<int32_t>::max();
    return {{hi, hi, hi}, {lo, lo, lo}};
  }
  void include(const PolygonBox& b) {
    for (int k = 0; k < 3; ++k) {
      lo[k] = std::min(lo[k], b.lo[k]);
      hi[k] = std::max(hi[k], b.hi[k]);
    }
  }
  void clip(const Bounds& o) {
    for (int k = 0; k < 3; ++k) {
      lo[k] = std::max(lo[k], o.lo[k]);
      hi[k] = std::min(hi[k], o.hi[k]);
    }
  }
  [[nodiscard]] bool meets(const PolygonBox& b) const {
    bool all = true;
    for (int k = 0; k < 3; ++k) all &= b.lo[k] <= hi[k] && b.hi[k] >= lo[k];
    return all;
  }
};

class CellFinder {
 public:
  CellFinder(const Job& job, const KernelOptions& options)
      : job_(job), limit_(std::max<uint32_t>(1, options.cell_limit)), cancel_(options.cancel) {}

  PairCells run() {
    // What is far from all other operands takes part in nothing.
    std::vector<Bounds> bounds(job_.operand_count(), Bounds::none());
    for (uint32_t o = 0; o < job_.operand_count(); ++o) {
      for (uint32_t p = job_.polygon_start(o); p < job_.polygon_start(o + 1); ++p) {
        bounds[o].include(job_.boxes()[p]);
      }
    }
    Bounds region = Bounds::none();
    for (uint32_t p = 0; p < job_.polygons().size(); ++p) list_.push_back(p);
    for (const Bounds& b : bounds) {
      if (b.lo[0] <= b.hi[0]) region.include({b.lo, b.hi});
    }
    visit(region, 0, static_cast<uint32_t>(list_.size()), 0);
    return std::move(result_);
  }

 private:
  [[nodiscard]] uint32_t operand(uint32_t i) const { return job_.polygons()[list_[i]].operand; }

  /// Of two operands, only what is in the box of the other one matters.
  uint32_t keep_near(uint32_t first, uint32_t count) {
    const uint32_t one = operand(first), other = operand(first + count - 1);
    Bounds of_one = Bounds::none(), of_other = Bounds::none();
    for (uint32_t i = first; i < first + count; ++i) {
      const uint32_t o = operand(i);
      if (o != one && o != other) return count;
      (o == one ? of_one : of_other).include(job_.boxes()[list_[i]]);
    }
    of_one.clip(of_other);
    uint32_t kept = first;
    for (uint32_t i = first; i < first + count; ++i) {
      if (of_one.meets(job_.boxes()[list_[i]])) list_[kept++] = list_[i];
    }
    return kept - first;
  }

  /// Handles list_[first, first + count), the top of the stack.
  void visit(Bounds cell, uint32_t first, uint32_t count, int stalled) {
    ++result_.visited;
    const auto has_one = [&] { return count == 0 || operand(first) == operand(first + count - 1); };
    if (has_one()) return leave_alone(count);
    if (count > limit_) {
      const uint32_t all = count;
      count = keep_near(first, count);
      leave_alone(all - count);
      if (has_one()) return leave_alone(count);
    }
    Bounds content = Bounds::none();
    for (uint32_t i = first; i < first + count; ++i) content.include(job_.boxes()[list_[i]]);
    cell.clip(content);
    int axis = 0;
    int64_t longest = -1;
    for (int k = 0; k < 3; ++k) {
      const int64_t size = static_cast<int64_t>(cell.hi[k]) - cell.lo[k];
      if (size > longest) longest = size, axis = k;
    }
    if (cancel_ && cancel_->load(std::memory_order_relaxed)) return;
    if (count <= limit_ || longest < 1 || stalled >= kPatience) {
      ++result_.surface;
      result_.cells.push_back(
          {cell.lo, cell.hi, static_cast<uint32_t>(result_.polygons.size()), count});
      result_.polygons.insert(result_.polygons.end(), list_.begin() + first,
                              list_.begin() + first + count);
      return;
    }
    const auto middle = static_cast<int32_t>(cell.lo[axis] + longest / 2);
    for (int upper = 0; upper < 2; ++upper) {
      list_.resize(first + count);
      Bounds child = cell;
      (upper ? child.lo : child.hi)[axis] = upper ? middle + 1 : middle;
      for (uint32_t i = first; i < first + count; ++i) {
        if (child.meets(job_.boxes()[list_[i]])) list_.push_back(list_[i]);
      }
      const auto child_count = static_cast<uint32_t>(list_.size()) - first - count;
      const bool thinner = child_count * 10 <= count * 9;
      visit(child, first + count, child_count, thinner ? 0 : stalled + 1);
    }
    list_.resize(first + count);
  }

  void leave_alone(uint32_t count) { result_.surface += (count + limit_ - 1) / limit_; }

  const Job& job_;
  const uint32_t limit_;
  const std::atomic<bool>* cancel_;
  PairCells result_;
  std::vector<uint32_t> list_;
};

}  // namespace

PairCells find_pair_cells(const Job& job, const KernelOptions& options) {
  return CellFinder(job, options).run();
}

}  // namespace csgrun
