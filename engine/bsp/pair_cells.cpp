#include "engine/bsp/pair_cells.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <utility>
#include <vector>

#include "engine/base/parallel.h"
#include "engine/bsp/coarse_cells.h"

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

namespace csgrun {
namespace {

/// Divisions on the way to a cell that did not thin it out before it is taken as it is. All of them
/// count: each may double the work.
constexpr int kPatience = 3;
/// A cell of the grid, or of two operands, is not divided for so many times the limit: that costs
/// more than its pairs.
constexpr uint32_t kPatientLimit = 8;
/// So many times what is in a cell there is room for on the way down, for a start.
constexpr size_t kRoomForEach = 3;

/// A corner of a box: a vector, of which the processor takes all numbers at once; the fourth is 0.
using Corner = int32_t __attribute__((vector_size(16)));

bool is_any(Corner compared) {
#if defined(__SSE2__)
  return _mm_movemask_epi8(std::bit_cast<__m128i>(compared)) != 0;
#else
  return (compared[0] | compared[1] | compared[2] | compared[3]) != 0;
#endif
}

/// A box as two vectors.
struct WideBox {
  Corner lo, hi;

  explicit WideBox(const PolygonBox& box)
      : lo{box.lo[0], box.lo[1], box.lo[2], 0}, hi{box.hi[0], box.hi[1], box.hi[2], 0} {}

  void include(const WideBox& o) {
    lo = o.lo < lo ? o.lo : lo;
    hi = o.hi > hi ? o.hi : hi;
  }
  void clip(const WideBox& o) {
    lo = o.lo > lo ? o.lo : lo;
    hi = o.hi < hi ? o.hi : hi;
  }
  [[nodiscard]] bool meets(const WideBox& o) const { return !is_any((o.lo > hi) | (lo > o.hi)); }
  [[nodiscard]] PolygonBox narrow() const { return {{lo[0], lo[1], lo[2]}, {hi[0], hi[1], hi[2]}}; }
};

/// A polygon on the way down, with its box at hand.
struct Entry {
  WideBox box;
  uint32_t polygon, operand;
  bool is_covered;
};

/// Entries [first, first + count) of the stack, by ascending operands.
struct List {
  static constexpr uint32_t kNobody = ~0u;
  uint32_t first = 0, count = 0;
  uint32_t lowest = kNobody, second = kNobody, last = kNobody;  ///< operands
  WideBox of_lowest{PolygonBox::none()}, of_others{PolygonBox::none()};
  bool is_covered = true;  ///< all of them

  void add(const Entry& e) {
    is_covered &= e.is_covered;
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
  [[nodiscard]] bool has_two_operands_at_most() const { return second == last; }
  [[nodiscard]] PolygonBox bounds() const {
    WideBox all = of_lowest;
    all.include(of_others);
    return all.narrow();
  }
};

class CellFinder {
 public:
  CellFinder(const Job& job, std::span<const uint8_t> covered, std::span<const uint8_t> left_out,
             uint32_t limit, const std::atomic<bool>* cancel)
      : job_(job), covered_(covered), left_out_(left_out), limit_(limit), cancel_(cancel) {}

  /// Divides coarse cells [begin, end).
  PairCells run(const PairCells& coarse, size_t begin, size_t end) {
    for (const PairCells::Cell& cell : std::span(coarse.cells).subspan(begin, end - begin)) {
      const std::span<const uint32_t> polygons =
          wanted({coarse.polygons.data() + cell.first, cell.count});
      if (polygons.empty()) {
        ++result_.visited;
        continue;
      }
      const auto count = static_cast<uint32_t>(polygons.size());
      if (coarse.cells.size() > 1 && count <= kPatientLimit * limit_) {
        ++result_.visited, ++result_.surface;
        result_.cells.push_back(
            {cell.lo, cell.hi, static_cast<uint32_t>(result_.polygons.size()), count});
        result_.polygons.insert(result_.polygons.end(), polygons.begin(), polygons.end());
        continue;
      }
      List list;
      stack_.clear();
      stack_.reserve(kRoomForEach * size_t{count});
      for (const uint32_t p : polygons) {
        stack_.push_back({WideBox(job_.boxes()[p]), p, job_.polygons()[p].operand, is_covered(p)});
        list.add(stack_.back());
      }
      visit({cell.lo, cell.hi}, list, 0);
    }
    return std::move(result_);
  }

 private:
  /// Those that are not left out, unless they are of one operand.
  std::span<const uint32_t> wanted(std::span<const uint32_t> polygons) {
    if (left_out_.empty()) return polygons;
    wanted_.clear();
    for (const uint32_t p : polygons) {
      if (!left_out_[p]) wanted_.push_back(p);
    }
    const auto operand = [&](uint32_t p) { return job_.polygons()[p].operand; };
    if (!wanted_.empty() && operand(wanted_.front()) == operand(wanted_.back())) wanted_.clear();
    return wanted_;
  }

  /// Those of a list whose boxes are wanted, from place `first` of the stack on: that of the list
  /// itself, or the end.
  template <class Wanted>
  List take(const List& list, uint32_t first, Wanted&& is_wanted) {
    stack_.resize(std::max<size_t>(stack_.size(), size_t{first} + list.count));
    List taken;
    taken.first = first;
    Entry* to = stack_.data() + first;
    for (const Entry& e : std::span(stack_).subspan(list.first, list.count)) {
      if (!is_wanted(e.box)) continue;
      const Entry own = e;
      *to++ = own;
      taken.add(own);
    }
    stack_.resize(taken.first + taken.count);
    return taken;
  }

  /// Of two operands, only what is in the box of the other one matters; of one, nothing.
  List keep_near(const List& list) {
    WideBox common = list.of_lowest;
    common.clip(list.of_others);
    return take(list, list.first, [&](const WideBox& box) { return common.meets(box); });
  }

  /// Where to halve a cell.
  struct Cut {
    int axis;
    int32_t middle;
    bool thins_out;  ///< the halves hold clearly fewer pairs
  };

  /// Along the longest axis on which the halves hold fewer pairs, or else along the longest: a few
  /// long polygons among many small ones would be copied into ever smaller cells, as often as there
  /// is room in their boxes. Needs a side that is longer than one.
  [[nodiscard]] Cut find_cut(const PolygonBox& cell, const List& list) const {
    const auto length = [&](int k) { return static_cast<int64_t>(cell.hi[k]) - cell.lo[k]; };
    const auto middle = [&](int k) { return static_cast<int32_t>(cell.lo[k] + length(k) / 2); };
    const std::array<bool, 3> thin = thins_out(list, Corner{middle(0), middle(1), middle(2), 0});
    int longest = 0, best = -1;
    for (int axis = 0; axis < 3; ++axis) {
      if (length(axis) > length(longest)) longest = axis;
      if (length(axis) < 1 || !thin[axis]) continue;
      if (best < 0 || length(axis) > length(best)) best = axis;
    }
    if (best >= 0) return {best, middle(best), true};
    return {longest, middle(longest), false};
  }

  /// For each axis, whether halves on either side of a place do.
  [[nodiscard]] std::array<bool, 3> thins_out(const List& list, Corner middle) const {
    Corner lower{}, upper{};  // a comparison that holds is -1
    for (const Entry& e : std::span(stack_).subspan(list.first, list.count)) {
      lower -= e.box.lo <= middle;
      upper -= e.box.hi > middle;
    }
    const uint64_t all = list.count;
    std::array<bool, 3> result{};
    for (size_t k = 0; k < 3; ++k) {
      const auto low = static_cast<uint64_t>(lower[k]), high = static_cast<uint64_t>(upper[k]);
      result[k] = (low * low + high * high) * 10 <= all * all * 9;
    }
    return result;
  }

  /// Handles the list, which is the top of the stack.
  void visit(PolygonBox cell, List list, int stalled) {
    ++result_.visited;
    if (list.count > limit_ && list.has_two_operands_at_most()) {
      const uint32_t all = list.count;
      list = keep_near(list);
      leave_alone(all - list.count);
    }
    if (list.has_one_operand() || list.is_covered) return leave_alone(list.count);
    cell.clip(list.bounds());
    if (cancel_ && cancel_->load(std::memory_order_relaxed)) return;
    const uint32_t limit = list.has_two_operands_at_most() ? kPatientLimit * limit_ : limit_;
    if (list.count <= limit || cell.lo == cell.hi) return add_cell(cell, list);
    const Cut cut = find_cut(cell, list);
    if (!cut.thins_out && ++stalled > kPatience) return add_cell(cell, list);
    const uint32_t end = list.first + list.count;
    for (int upper = 0; upper < 2; ++upper) {
      stack_.resize(end);
      PolygonBox half = cell;
      (upper ? half.lo : half.hi)[cut.axis] = upper ? cut.middle + 1 : cut.middle;
      const WideBox wide(half);
      const List child = take(list, end, [&](const WideBox& box) { return wide.meets(box); });
      visit(half, child, stalled);
    }
    stack_.resize(end);
  }

  void add_cell(const PolygonBox& cell, const List& list) {
    ++result_.surface;
    result_.cells.push_back(
        {cell.lo, cell.hi, static_cast<uint32_t>(result_.polygons.size()), list.count});
    for (uint32_t i = list.first; i < list.first + list.count; ++i) {
      result_.polygons.push_back(stack_[i].polygon);
    }
  }

  [[nodiscard]] bool is_covered(uint32_t polygon) const {
    return !covered_.empty() && covered_[polygon] != 0;
  }

  void leave_alone(uint32_t count) { result_.surface += (count + limit_ - 1) / limit_; }

  const Job& job_;
  const std::span<const uint8_t> covered_, left_out_;  ///< per polygon, or empty
  const uint32_t limit_;
  const std::atomic<bool>* cancel_;
  PairCells result_;
  RawVector<Entry> stack_;
  std::vector<uint32_t> wanted_;
};

/// The cells of all parts of space.
PairCells join(std::vector<PairCells> parts) {
  if (parts.size() == 1) return std::move(parts[0]);
  PairCells all;
  std::vector<std::array<size_t, 2>> starts;  // of the cells and polygons of each
  size_t cells = 0, polygons = 0;
  for (const PairCells& part : parts) {
    starts.push_back({cells, polygons});
    cells += part.cells.size();
    polygons += part.polygons.size();
    all.visited += part.visited;
    all.surface += part.surface;
  }
  all.cells.resize(cells);
  all.polygons.resize(polygons);
  for_each_part(parts.size(), 1, [&](size_t p, size_t, size_t) {
    const auto [first_cell, first_polygon] = starts[p];
    for (size_t c = 0; c < parts[p].cells.size(); ++c) {
      all.cells[first_cell + c] = parts[p].cells[c];
      all.cells[first_cell + c].first += static_cast<uint32_t>(first_polygon);
    }
    std::copy(parts[p].polygons.begin(), parts[p].polygons.end(),
              all.polygons.begin() + static_cast<long>(first_polygon));
  });
  return all;
}

}  // namespace

/// Of the polygons those that are held against others: not of the first operand.
void add_slabs(const Job& job, PairCells& all) {
  const uint32_t crowd = crowd_of(job);
  std::vector<uint32_t> triangles;
  for (const PairCells::Cell& cell : all.cells) {
    if (cell.count < crowd) continue;
    if (all.slabs_at.empty()) all.slabs_at.assign(job.polygons().size(), PairCells::kNoSlabs);
    for (uint32_t i = 0; i < cell.count; ++i) {
      const uint32_t p = all.polygons[cell.first + i];
      const JobPolygon& polygon = job.polygons()[p];
      uint32_t& at = all.slabs_at[p];
      if (polygon.operand == 0 || polygon.count != 3 || at != PairCells::kNoSlabs) continue;
      at = static_cast<uint32_t>(triangles.size());
      triangles.push_back(p);
    }
  }
  if (triangles.empty()) return;
  const double reach = reach_of(job);
  all.slabs.resize(triangles.size());
  for_each_range(triangles.size(), [&](size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) all.slabs[i] = slabs_of(job, triangles[i], reach);
  });
}

void CellPairs::load(const Job& job, const PairCells& all, const PairCells::Cell& cell) {
  polygons_ = all.polygons.data() + cell.first;
  boxes_.load(cell.lo, cell.count,
              [&](uint32_t i) -> const PolygonBox& { return job.boxes()[polygons_[i]]; });
  operands_.resize(cell.count);
  for (uint32_t i = 0; i < cell.count; ++i) {
    operands_[i] = job.polygons()[polygons_[i]].operand;
  }
  triangles_.clear();
  if (all.slabs.empty() || cell.count < crowd_of(job)) return;
  for (uint32_t i = 0; i < cell.count; i += 8) {
    triangles_.emplace_back(job, std::span(polygons_ + i, std::min(8u, cell.count - i)));
  }
}

uint32_t CellPairs::sift(const PairCells& all, uint32_t first, uint32_t j, uint32_t meets) const {
  const uint32_t slabs = all.slabs_at[polygons_[j]];
  if (slabs == PairCells::kNoSlabs) return meets;
  for (uint32_t begin = 0; begin < CellBoxes::kAtOnce; begin += 8) {
    if ((meets >> begin & 0xff) == 0) continue;  // there may be no polygons at all
    const JobTriangles& triangles = triangles_[(first + begin) / 8];
    const uint32_t which = meets >> begin & triangles.which;
    if (which == 0) continue;
    meets &= ~(all.slabs[slabs].apart_in_space(triangles.corners, which) << begin);
  }
  return meets;
}

PairCells find_pair_cells(const Job& job, std::span<const uint8_t> covered,
                          const KernelOptions& options, std::span<const uint8_t> left_out) {
  constexpr size_t kEach = 64;
  const uint32_t limit = std::max<uint32_t>(1, options.cell_limit);
  const NearFaces* const near = job.near_faces();
  assert(!near || !near->pairs);
  const bool was_found = near && near->cells;
  PairCells found;
  if (!was_found) found = find_coarse_cells(job, covered, limit, left_out);
  const PairCells& coarse = was_found ? *near->cells : found;
  std::vector<PairCells> parts(part_count(coarse.cells.size(), kEach));
  for_each_part(coarse.cells.size(), kEach, [&](size_t part, size_t begin, size_t end) {
    parts[part] = CellFinder(job, covered, left_out, limit, options.cancel).run(coarse, begin, end);
  });
  PairCells all = join(std::move(parts));
  all.surface += coarse.surface;
  add_slabs(job, all);
  return all;
}

}  // namespace csgrun
