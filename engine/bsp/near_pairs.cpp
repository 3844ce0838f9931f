#include "engine/bsp/near_pairs.h"

#include <algorithm>
#include <atomic>
#include <cstddef>

#include "engine/base/parallel.h"
#include "engine/bsp/cell_boxes.h"
#include "engine/bsp/packed_boxes.h"

namespace csgrun {
namespace {

/// When all that is in a cell with a face is more, on average, cells must be divided, which takes a
/// job.
constexpr uint64_t kMostBeside = 512;
/// With more pairs a face, on average, they are better looked at as they are found.
constexpr size_t kMostPairsEach = 2;
constexpr size_t kCellsPerPart = 64;

}  // namespace

std::optional<NearPairs> find_near_pairs(const PairCells& cells, std::span<const PolygonBox> boxes,
                                         uint32_t second) {
  using Pairs = std::vector<std::array<uint32_t, 2>>;
  const size_t count = cells.cells.size(), most = kMostPairsEach * boxes.size();
  uint64_t beside = 0;
  for (const PairCells::Cell& cell : cells.cells) beside += uint64_t{cell.count} * cell.count;
  if (beside > kMostBeside * boxes.size()) return std::nullopt;
  NearPairs result;
  result.starts.assign(count + 1, 0);  // the number of pairs first
  std::vector<Pairs> parts(part_count(count, kCellsPerPart));
  std::atomic<size_t> total = 0;
  for_each_part(count, kCellsPerPart, [&](size_t part, size_t begin, size_t end) {
    CellBoxes own;
    std::vector<uint32_t> faces;
    Pairs found;  // not beside those of other threads while it grows
    for (size_t c = begin; c < end && total.load(std::memory_order_relaxed) <= most; ++c) {
      const PairCells::Cell& cell = cells.cells[c];
      const size_t before = found.size();
      // Of either leaf, what is in the box of the other one.
      const std::span all(cells.polygons.data() + cell.first, cell.count);
      std::array<PolygonBox, 2> of_leaf{PolygonBox::none(), PolygonBox::none()};
      for (const uint32_t f : all) of_leaf[f >= second].include(boxes[f]);
      of_leaf[0].clip(of_leaf[1]);
      faces.clear();
      uint32_t firsts = 0;
      for (const uint32_t f : all) {
        if (!of_leaf[0].meets(boxes[f])) continue;
        faces.push_back(f);
        firsts += f < second ? 1 : 0;
      }
      const auto count_near = static_cast<uint32_t>(faces.size());
      own.load(cell.lo, count_near,
               [&](uint32_t i) -> const PolygonBox& { return boxes[faces[i]]; });
      for (uint32_t j = firsts; j < count_near; ++j) {
        for (uint32_t i = 0; i < firsts; i += CellBoxes::kAtOnce) {
          const uint32_t lanes = std::min(CellBoxes::kAtOnce, firsts - i);
          PackedBoxes::for_each_bit(own.compare(i, lanes, j), [&](uint32_t lane) {
            found.push_back({faces[i + lane], faces[j]});
          });
        }
      }
      result.starts[c + 1] = static_cast<uint32_t>(found.size() - before);
    }
    total += found.size();
    parts[part] = std::move(found);
  });
  if (total > most) return std::nullopt;
  for (size_t c = 0; c < count; ++c) result.starts[c + 1] += result.starts[c];
  result.pairs.reserve(total);
  for (const Pairs& part : parts) {
    result.pairs.insert(result.pairs.end(), part.begin(), part.end());
  }
  result.visited = cells.visited + count;
  result.surface = cells.surface + count;
  return result;
}

}  // namespace csgrun
