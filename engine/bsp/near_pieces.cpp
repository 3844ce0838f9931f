#include "engine/bsp/near_pieces.h"

#include <algorithm>
#include <array>
#include <bit>

#include "engine/bsp/piece_tree.h"
#include "engine/bsp/rounded_box.h"

namespace csgrun {
namespace {

/// A cell along each axis: a vector, of which the processor compares all numbers at once; the
/// fourth is not used.
using Place = int16_t __attribute__((vector_size(8)));

struct Range {
  Place lo, hi;

  void add(const Range& o) {
    lo = o.lo < lo ? o.lo : lo;
    hi = o.hi > hi ? o.hi : hi;
  }
  [[nodiscard]] bool meets(const Range& o) const {
    return std::bit_cast<uint64_t>((hi < o.lo) | (o.hi < lo)) == 0;
  }
};

/// Cells over a box, at most 32 along an axis, which something reaches or not: a row along the
/// first axis is the bits of an integer.
class CellBits {
 public:
  explicit CellBits(const PolygonBox& around) : around_(around) {
    for (size_t k = 0; k < 3; ++k) {
      while ((int64_t{around.hi[k]} - around.lo[k]) >> shift_[k] >= kCells) ++shift_[k];
    }
  }

  /// REQUIRES: the point is in the box.
  template <class Coordinate>
  [[nodiscard]] Place place_of(const std::array<Coordinate, 3>& point) const {
    Place place{};
    for (size_t k = 0; k < 3; ++k) {
      place[k] =
          static_cast<int16_t>((static_cast<int64_t>(point[k]) - around_.lo[k]) >> shift_[k]);
    }
    return place;
  }

  void mark(PolygonBox box) {
    box.clip(around_);
    if (box.is_empty()) return;
    const Place lo = place_of(box.lo), hi = place_of(box.hi);
    each_row({lo, hi}, [](uint32_t& row, uint32_t bits) { return row |= bits, false; });
    if (is_empty_) marked_ = {lo, hi};
    is_empty_ = false;
    marked_.add({lo, hi});
  }

  [[nodiscard]] bool is_marked(const Range& range) {
    return !is_empty_ && marked_.meets(range) &&
           each_row(range, [](uint32_t row, uint32_t bits) { return (row & bits) != 0; });
  }

 private:
  static constexpr int kCells = 32;

  /// Calls f(row, bits) for the rows of a range until it says true; whether it did.
  template <class F>
  bool each_row(const Range& range, F&& f) {
    const uint32_t bits = (~0u >> (kCells - 1 - range.hi[0])) & (~0u << range.lo[0]);
    for (int z = range.lo[2]; z <= range.hi[2]; ++z) {
      for (int y = range.lo[1]; y <= range.hi[1]; ++y) {
        if (f(rows_[static_cast<size_t>(z * kCells + y)], bits)) return true;
      }
    }
    return false;
  }

  const PolygonBox around_;
  std::array<int, 3> shift_{0, 0, 0};
  std::array<uint32_t, size_t{kCells * kCells}> rows_{};
  bool is_empty_ = true;
  Range marked_{};
};

}  // namespace

std::vector<uint32_t> faces_near(const LeafGeometry& leaf,
                                 std::span<const std::array<double, 3>> vertices, bool are_whole,
                                 const PolygonBox& around, std::span<const PolygonBox> boxes) {
  CellBits cells(around);
  for (const PolygonBox& box : boxes) cells.mark(box);
  std::vector<Range> places;
  places.reserve(vertices.size());
  for (const std::array<double, 3>& v : vertices) {
    if (are_whole) {
      const Place place = cells.place_of(v);
      places.push_back({place, place});
    } else {
      PieceBox box;
      box.add(v);
      const PolygonBox wide = rounded_outwards(box);
      places.push_back({cells.place_of(wide.lo), cells.place_of(wide.hi)});
    }
  }
  std::vector<uint32_t> faces;
  const auto look_at_each = [&](auto&& range_of) {
    const auto count = static_cast<uint32_t>(leaf.face_count());
    for (uint32_t f = 0; f < count; ++f) {
      if (cells.is_marked(range_of(f))) faces.push_back(f);
    }
  };
  if (leaf.consists_of_triangles()) {
    look_at_each([&, corners = leaf.corners.data()](uint32_t f) {
      Range range = places[corners[3 * f]];
      range.add(places[corners[3 * f + 1]]);
      range.add(places[corners[3 * f + 2]]);
      return range;
    });
  } else {
    look_at_each([&](uint32_t f) {
      const uint32_t begin = leaf.face_starts[f], end = leaf.face_starts[f + 1];
      Range range = places[leaf.corners[begin]];
      for (uint32_t c = begin + 1; c < end; ++c) range.add(places[leaf.corners[c]]);
      return range;
    });
  }
  return faces;
}

}  // namespace csgrun
