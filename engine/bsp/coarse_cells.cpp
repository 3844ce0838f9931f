#include "engine/bsp/coarse_cells.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <numeric>
#include <utility>

#include "engine/base/parallel.h"
#include "engine/base/raw_vector.h"
#include "engine/bsp/coarse_grid.h"

namespace csgrun {
namespace {

/// A smaller grid is not worth the while.
constexpr size_t kFewestCells = 1024;

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

/// Marks the cells by the operands of those polygons that are covered, or of those that are not,
/// and lists those of each. Covered ones mark only what others have. False when there are more than
/// `left`, which is lowered.
bool mark(const Job& job, std::span<const uint8_t> covered, bool are_covered,
          std::span<const uint8_t> left_out, CoarseGrid& grid, RawVector<CoarseGrid::Cells>& cells,
          size_t& left) {
  const size_t count = job.polygons().size();
  std::atomic<size_t> all = 0;
  std::atomic<bool> failed = false;
  for_each_range(count, [&](size_t begin, size_t end) {
    size_t sum = 0;
    uint32_t own = 0;  // the operand's number and one
    for (size_t p = begin; p < end; ++p) {
      while (p >= job.polygon_start(own)) ++own;
      if ((!covered.empty() && covered[p] != 0) != are_covered) continue;
      if (!left_out.empty() && left_out[p] != 0) {
        cells[p] = {};
        continue;
      }
      if (sum + all.load(std::memory_order_relaxed) > left ||
          !grid.find_cells(job.boxes()[p], cells[p])) {
        failed = true;
        return;
      }
      sum += cells[p].count();
      grid.each_cell(cells[p], [&](uint32_t& cell) { CoarseGrid::mark(cell, own, are_covered); });
    }
    all += sum;
  });
  if (failed || all > left) return false;
  left -= all;
  return true;
}

}  // namespace

PairCells find_coarse_cells(const Job& job, std::span<const uint8_t> covered, uint32_t limit,
                            std::span<const uint8_t> left_out) {
  const size_t count = job.polygons().size();
  const Bounds bounds = bounds_of(job);
  const size_t most_cells = CoarseGrid::most_cells(count, limit);
  if (most_cells < kFewestCells) return whole(job, bounds.all);
  if (bounds.common.is_empty()) return no_shared_cells(count, limit);
  CoarseGrid grid(bounds.common, most_cells);
  RawVector<CoarseGrid::Cells> cells(count);
  size_t left = CoarseGrid::kMostCellsEach * count;
  if (!mark(job, covered, false, left_out, grid, cells, left) ||
      (!covered.empty() && !mark(job, covered, true, left_out, grid, cells, left))) {
    return whole(job, bounds.all);
  }

  return list_shared_cells(grid, cells, 0, limit);
}

PairCells no_shared_cells(size_t polygons, uint32_t limit) {
  PairCells none;
  none.surface = cells_for(polygons, limit);
  return none;
}

PairCells list_shared_cells(CoarseGrid& grid, std::span<const CoarseGrid::Cells> cells, size_t far,
                            uint32_t limit) {
  const size_t count = cells.size();
  PairCells result;
  // From here on a cell holds its number among the shared ones, from the top down.
  const auto number = [](uint32_t cell) { return CoarseGrid::kSeveral - 1 - cell; };
  grid.each_shared([&](uint32_t& cell, const PolygonBox& box) {
    cell = number(static_cast<uint32_t>(result.cells.size()));
    result.cells.push_back({box.lo, box.hi, 0, 0});
  });
  struct Entry {
    uint32_t cell, polygon;
  };
  const auto shared = static_cast<uint32_t>(result.cells.size());
  // Each slice of the cells is filled by one thread.
  constexpr size_t kSlices = 8;
  const size_t slices = has_threads() ? kSlices : 1;
  unsigned shift = 0;
  while (shared >> shift >= slices) ++shift;
  struct Part {
    std::array<std::vector<Entry>, kSlices> entries;
    uint64_t alone = 0;
  };
  std::vector<Part> parts(part_count(count, kFewForThreads));
  for_each_part(count, kFewForThreads, [&](size_t part, size_t begin, size_t end) {
    Part own;
    for (size_t p = begin; p < end; ++p) {
      bool is_alone = true;
      grid.each_cell(cells[p], [&](uint32_t cell) {
        const uint32_t n = number(cell);
        if (n >= shared) return;
        own.entries[n >> shift].push_back({n, static_cast<uint32_t>(p)});
        is_alone = false;
      });
      own.alone += is_alone ? 1 : 0;
    }
    parts[part] = std::move(own);
  });
  std::array<uint32_t, kSlices> starts{};  // of the polygons of each slice
  uint32_t total = 0;
  for (size_t slice = 0; slice < kSlices; ++slice) {
    starts[slice] = total;
    for (const Part& part : parts) total += static_cast<uint32_t>(part.entries[slice].size());
  }
  result.polygons.resize(total);
  for_each_alone(kSlices, total > kFewForThreads, [&](size_t slice) {
    const auto each_entry = [&](auto&& visit) {
      for (const Part& part : parts) {
        for (const Entry& e : part.entries[slice]) visit(result.cells[e.cell], e.polygon);
      }
    };
    each_entry([](PairCells::Cell& cell, uint32_t) { ++cell.count; });
    uint32_t next = starts[slice];
    const size_t end = std::min<size_t>(shared, (slice + 1) << shift);
    for (size_t c = slice << shift; c < end; ++c) {
      PairCells::Cell& cell = result.cells[c];
      cell.first = next;
      next += std::exchange(cell.count, 0);
    }
    each_entry([&](PairCells::Cell& cell, uint32_t polygon) {
      result.polygons[cell.first + cell.count++] = polygon;
    });
  });
  uint64_t alone = far;
  for (const Part& part : parts) alone += part.alone;
  result.surface = cells_for(alone, limit);
  return result;
}

}  // namespace csgrun
