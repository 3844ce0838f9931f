#include "engine/bsp/coarse_cells.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <numeric>

#include "engine/base/parallel.h"
#include "engine/base/raw_vector.h"
#include "engine/base/subsets.h"

namespace csgrun {
namespace {

/// The grid's cells are so many times as many as would do if polygons were evenly spread: surfaces
/// are not.
constexpr size_t kCellsOverLimit = 8;
/// A smaller grid is not worth the while, a larger one not the memory.
constexpr size_t kFewestCells = 1024, kMostCells = size_t{1} << 21;
/// Polygons that are in more cells than this on the average are too large for the grid.
constexpr size_t kMostCellsEach = 16;

constexpr uint32_t kNobody = 0, kSeveral = ~0u;  ///< in a cell; else an operand's number and one

/// The box of all operands, and what those of two have in common, if there are no more.
struct Bounds {
  PolygonBox all = PolygonBox::none(), common = PolygonBox::none();
};

Bounds bounds_of(const Job& job) {
  Bounds bounds;
  size_t operands = 0;
  for (size_t o = 0; o < job.operand_count(); ++o) {
    const PolygonBox& own = job.operand_box(o);
    if (own.is_empty()) continue;
    bounds.all.include(own);
    if (operands++ == 0) bounds.common = own;
    bounds.common.clip(own);
  }
  if (operands > 2) bounds.common = bounds.all;
  return bounds;
}

/// Boxes whose sides are powers of two and differ by a factor of two at most.
class Grid {
 public:
  Grid(const PolygonBox& bounds, size_t most_cells) : bounds_(bounds) {
    constexpr unsigned kWhole = 31;
    shift_.fill(kWhole);
    for (size_t k = 0; k < 3; ++k) count_[k] = place(k, bounds.hi[k]) + 1;
    while (true) {
      const size_t k = std::max_element(shift_.begin(), shift_.end()) - shift_.begin();
      if (shift_[k] == 0) break;
      --shift_[k];
      const size_t before = count_[k];
      count_[k] = place(k, bounds.hi[k]) + 1;
      if (count_[0] * count_[1] * count_[2] <= most_cells) continue;
      ++shift_[k];
      count_[k] = before;
      break;
    }
    for (size_t axes = 0; axes < second_.size(); ++axes) {
      second_[axes] =
          (axes & 1) + (axes >> 1 & 1) * count_[0] + (axes >> 2) * count_[0] * count_[1];
    }
    cells_.resize(count_[0] * count_[1] * count_[2]);
    for_each_range(cells_.size(), [&](size_t begin, size_t end) {
      std::fill(cells_.data() + begin, cells_.data() + end, kNobody);
    });
  }

  /// The cells that a box meets: in rows of `count[0]`, from `first` on.
  struct Cells {
    uint32_t first;
    std::array<uint8_t, 3> more;  ///< along each axis, so many more than one
    bool any;
  };
  /// False when there are too many to name.
  bool find_cells(const PolygonBox& box, Cells& cells) const {
    constexpr uint32_t kMostMore = 255;
    uint32_t stride = 1, most = 0;
    cells = {0, {}, true};
    for (size_t k = 0; k < 3; ++k) {
      const int32_t lo = std::max(box.lo[k], bounds_.lo[k]),
                    hi = std::min(box.hi[k], bounds_.hi[k]);
      cells.any &= lo <= hi;
      const auto first = static_cast<uint32_t>(place(k, lo)),
                 more = static_cast<uint32_t>(place(k, hi)) - first;
      cells.first += stride * first;
      cells.more[k] = static_cast<uint8_t>(more);
      most = std::max(most, more);
      stride *= static_cast<uint32_t>(count_[k]);
    }
    return !cells.any || most <= kMostMore;
  }
  /// Calls visit(cell) for each.
  template <class Visit>
  void each_cell(const Cells& cells, Visit&& visit) {
    if (!cells.any) return;
    const uint32_t more =
        cells.more[0] | uint32_t{cells.more[1]} << 8 | uint32_t{cells.more[2]} << 16;
    if ((more & ~0x010101u) == 0) {
      // Two along some axes: a bit for each of these. Nearly all are of this kind.
      const uint32_t axes = (more | more >> 7 | more >> 14) & 7;
      for_each_subset(axes, [&](uint32_t some) { visit(cells_[cells.first + second_[some]]); });
      return;
    }
    uint32_t* layer = cells_.data() + cells.first;
    for (size_t z = 0; z <= cells.more[2]; ++z, layer += count_[0] * count_[1]) {
      uint32_t* row = layer;
      for (size_t y = 0; y <= cells.more[1]; ++y, row += count_[0]) {
        for (size_t x = 0; x <= cells.more[0]; ++x) visit(row[x]);
      }
    }
  }
  /// Calls visit(cell, bounds) for all cells with kSeveral.
  template <class Visit>
  void each_shared(Visit&& visit) {
    size_t at = 0;
    for (size_t z = 0; z < count_[2]; ++z) {
      for (size_t y = 0; y < count_[1]; ++y) {
        for (size_t x = 0; x < count_[0]; ++x, ++at) {
          if (cells_[at] == kSeveral) visit(cells_[at], bounds_of_cell({x, y, z}));
        }
      }
    }
  }

 private:
  [[nodiscard]] size_t place(size_t axis, int32_t coordinate) const {
    // Boxes are within 2^30: differences fit.
    return (static_cast<uint32_t>(coordinate) - static_cast<uint32_t>(bounds_.lo[axis])) >>
           shift_[axis];
  }
  [[nodiscard]] PolygonBox bounds_of_cell(const std::array<size_t, 3>& cell) const {
    PolygonBox box{};
    for (size_t k = 0; k < 3; ++k) {
      const int64_t lo = bounds_.lo[k] + static_cast<int64_t>(cell[k] << shift_[k]);
      const int64_t hi = lo + (int64_t{1} << shift_[k]) - 1;
      box.lo[k] = static_cast<int32_t>(lo);
      box.hi[k] = static_cast<int32_t>(std::min<int64_t>(hi, bounds_.hi[k]));
    }
    return box;
  }

  const PolygonBox bounds_;
  std::array<unsigned, 3> shift_{};
  std::array<size_t, 3> count_{};
  std::array<size_t, 8> second_{};  ///< from a cell to the next along several axes, a bit for each
  RawVector<uint32_t> cells_;
};

uint64_t cells_for(uint64_t polygons, uint32_t limit) { return (polygons + limit - 1) / limit; }

/// One cell with everything.
PairCells whole(const Job& job, const PolygonBox& all) {
  const auto count = static_cast<uint32_t>(job.polygons().size());
  PairCells result;
  result.polygons.resize(count);
  std::iota(result.polygons.begin(), result.polygons.end(), 0u);
  if (count > 0) result.cells.push_back({all.lo, all.hi, 0, count});
  return result;
}

/// Marks a cell with the surface of an operand. What is there after all of them does not depend on
/// who comes first.
void mark_cell(uint32_t& cell, uint32_t own, bool are_covered) {
  const std::atomic_ref<uint32_t> shared(cell);
  uint32_t known = shared.load(std::memory_order_relaxed);
  while (known != own && known != kSeveral) {
    if (known == kNobody && are_covered) return;
    const uint32_t then = known == kNobody ? own : kSeveral;
    if (shared.compare_exchange_weak(known, then, std::memory_order_relaxed)) return;
  }
}

/// Marks the cells by the operands of those polygons that are covered, or of those that are not,
/// and lists those of each. Covered ones mark only what others have. False when there are more than
/// `left`, which is lowered.
bool mark(const Job& job, std::span<const uint8_t> covered, bool are_covered, Grid& grid,
          RawVector<Grid::Cells>& cells, size_t& left) {
  const size_t count = job.polygons().size();
  std::atomic<size_t> all = 0;
  std::atomic<bool> failed = false;
  for_each_range(count, [&](size_t begin, size_t end) {
    size_t sum = 0;
    uint32_t own = 0;  // the operand's number and one
    for (size_t p = begin; p < end; ++p) {
      while (p >= job.polygon_start(own)) ++own;
      if ((!covered.empty() && covered[p] != 0) != are_covered) continue;
      if (sum + all.load(std::memory_order_relaxed) > left ||
          !grid.find_cells(job.boxes()[p], cells[p])) {
        failed = true;
        return;
      }
      if (!cells[p].any) continue;
      const auto& more = cells[p].more;
      sum += (more[0] + size_t{1}) * (more[1] + size_t{1}) * (more[2] + size_t{1});
      grid.each_cell(cells[p], [&](uint32_t& cell) { mark_cell(cell, own, are_covered); });
    }
    all += sum;
  });
  if (failed || all > left) return false;
  left -= all;
  return true;
}

}  // namespace

PairCells find_coarse_cells(const Job& job, std::span<const uint8_t> covered, uint32_t limit) {
  const size_t count = job.polygons().size();
  const Bounds bounds = bounds_of(job);
  const size_t most_cells = std::min(kMostCells, kCellsOverLimit * count / limit);
  if (most_cells < kFewestCells) return whole(job, bounds.all);
  PairCells result;
  result.surface = cells_for(count, limit);
  if (bounds.common.is_empty()) return result;
  Grid grid(bounds.common, most_cells);
  RawVector<Grid::Cells> cells(count);
  size_t left = kMostCellsEach * count;
  if (!mark(job, covered, false, grid, cells, left) ||
      (!covered.empty() && !mark(job, covered, true, grid, cells, left))) {
    return whole(job, bounds.all);
  }

  // From here on a cell holds its number among the shared ones, from the top down.
  const auto number = [](uint32_t cell) { return kSeveral - 1 - cell; };
  grid.each_shared([&](uint32_t& cell, const PolygonBox& box) {
    cell = number(static_cast<uint32_t>(result.cells.size()));
    result.cells.push_back({box.lo, box.hi, 0, 0});
  });
  struct Entry {
    uint32_t cell, polygon;
  };
  const auto shared = static_cast<uint32_t>(result.cells.size());
  struct Part {
    std::vector<Entry> entries;
    uint64_t alone = 0;
  };
  std::vector<Part> parts(part_count(count, kFewForThreads));
  for_each_part(count, kFewForThreads, [&](size_t part, size_t begin, size_t end) {
    std::vector<Entry> entries;
    uint64_t alone = 0;
    for (size_t p = begin; p < end; ++p) {
      const size_t before = entries.size();
      grid.each_cell(cells[p], [&](uint32_t cell) {
        if (number(cell) < shared) entries.push_back({number(cell), static_cast<uint32_t>(p)});
      });
      alone += entries.size() == before;
    }
    parts[part] = {std::move(entries), alone};
  });
  const auto each_entry = [&](auto&& visit) {
    for (const Part& part : parts) {
      for (const Entry& e : part.entries) visit(e);
    }
  };
  each_entry([&](const Entry& e) { ++result.cells[e.cell].count; });
  uint32_t total = 0;
  for (PairCells::Cell& cell : result.cells) {
    cell.first = total;
    total += cell.count;
    cell.count = 0;
  }
  result.polygons.resize(total);
  each_entry([&](const Entry& e) {
    PairCells::Cell& cell = result.cells[e.cell];
    result.polygons[cell.first + cell.count++] = e.polygon;
  });
  uint64_t alone = 0;
  for (const Part& part : parts) alone += part.alone;
  result.surface = cells_for(alone, limit);
  return result;
}

}  // namespace csgrun
