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

/// A polygon on the way down, with its box at hand.
struct Entry {
  PolygonBox box;
  uint32_t polygon, operand;
};

/// Entries [first, first + count) of the stack, by ascending operands.
struct List {
  static constexpr uint32_t kNobody = ~0u;
  uint32_t first = 0, count = 0;
  uint32_t lowest = kNobody, second = kNobody, last = kNobody;  ///< operands
  Bounds of_lowest = Bounds::none(), of_others = Bounds::none();

  void add(const Entry& e) {
    if (count++ == 0) lowest = e.operand;
    if (e.operand == lowest) {
      of_lowest.include(e.box);
      return;
    }
    if (second == kNobody) second = e.operand;
    last = e.operand;
    of_others.include(e.box);
  }
  [[nodiscard]] bool has_one_operand() const { return second == kNobody; }
  [[nodiscard]] bool has_two_operands() const { return second != kNobody && second == last; }
  [[nodiscard]] Bounds bounds() const {
    Bounds all = of_lowest;
    all.include({of_others.lo, of_others.hi});
    return all;
  }
};

class CellFinder {
 public:
  CellFinder(const Job& job, const KernelOptions& options)
      : job_(job), limit_(std::max<uint32_t>(1, options.cell_limit)), cancel_(options.cancel) {}

  PairCells run() {
    List all;
    for (uint32_t p = 0; p < job_.polygons().size(); ++p) {
      stack_.push_back({job_.boxes()[p], p, job_.polygons()[p].operand});
      all.add(stack_.back());
    }
    visit(all.bounds(), all, 0);
    return std::move(result_);
  }

 private:
  /// Of two operands, only what is in the box of the other one matters.
  List keep_near(const List& list) {
    Bounds common = list.of_lowest;
    common.clip(list.of_others);
    List kept;
    kept.first = list.first;
    for (uint32_t i = list.first; i < list.first + list.count; ++i) {
      if (!common.meets(stack_[i].box)) continue;
      stack_[kept.first + kept.count] = stack_[i];
      kept.add(stack_[i]);
    }
    return kept;
  }

  /// Handles the list, which is the top of the stack.
  void visit(Bounds cell, List list, int stalled) {
    ++result_.visited;
    if (list.count > limit_ && list.has_two_operands()) {
      const uint32_t all = list.count;
      list = keep_near(list);
      leave_alone(all - list.count);
    }
    if (list.has_one_operand()) return leave_alone(list.count);
    cell.clip(list.bounds());
    int axis = 0;
    int64_t longest = -1;
    for (int k = 0; k < 3; ++k) {
      const int64_t size = static_cast<int64_t>(cell.hi[k]) - cell.lo[k];
      if (size > longest) longest = size, axis = k;
    }
    if (cancel_ && cancel_->load(std::memory_order_relaxed)) return;
    if (list.count <= limit_ || longest < 1 || stalled >= kPatience) return add_cell(cell, list);
    const auto middle = static_cast<int32_t>(cell.lo[axis] + longest / 2);
    const uint32_t end = list.first + list.count;
    for (int upper = 0; upper < 2; ++upper) {
      stack_.resize(end);
      Bounds half = cell;
      (upper ? half.lo : half.hi)[axis] = upper ? middle + 1 : middle;
      List child;
      child.first = end;
      for (uint32_t i = list.first; i < end; ++i) {
        if (!half.meets(stack_[i].box)) continue;
        const Entry e = stack_[i];
        stack_.push_back(e);
        child.add(e);
      }
      const bool thinner = child.count * 10 <= list.count * 9;
      visit(half, child, thinner ? 0 : stalled + 1);
    }
    stack_.resize(end);
  }

  void add_cell(const Bounds& cell, const List& list) {
    ++result_.surface;
    result_.cells.push_back(
        {cell.lo, cell.hi, static_cast<uint32_t>(result_.polygons.size()), list.count});
    for (uint32_t i = list.first; i < list.first + list.count; ++i) {
      result_.polygons.push_back(stack_[i].polygon);
    }
  }

  void leave_alone(uint32_t count) { result_.surface += (count + limit_ - 1) / limit_; }

  const Job& job_;
  const uint32_t limit_;
  const std::atomic<bool>* cancel_;
  PairCells result_;
  std::vector<Entry> stack_;
};

}  // namespace

PairCells find_pair_cells(const Job& job, const KernelOptions& options) {
  return CellFinder(job, options).run();
}

}  // namespace csgrun
