#include "engine/bsp/near_pieces.h"

#include <algorithm>
#include <array>

namespace csgrun {
namespace {

/// Three small numbers, of which minima, maxima and comparisons are few steps: below 2^7, in a byte
/// each, the highest bit of which is free to tell which is greater.
struct Place {
  uint32_t packed = 0;

  static constexpr uint32_t kFree = 0x808080;

  /// The free bits, where one is no less than the other.
  [[nodiscard]] uint32_t no_less_than(Place other) const {
    return ((packed | kFree) - other.packed) & kFree;
  }
  /// All bits of the bytes of which the free one is set.
  static uint32_t whole_bytes(uint32_t free) { return free | (free - (free >> 7)); }
  [[nodiscard]] Place min(Place other) const {
    const uint32_t others = whole_bytes(no_less_than(other));
    return {(packed & ~others) | (other.packed & others)};
  }
  [[nodiscard]] Place max(Place other) const {
    const uint32_t own = whole_bytes(no_less_than(other));
    return {(packed & own) | (other.packed & ~own)};
  }
  [[nodiscard]] uint32_t operator[](size_t axis) const { return packed >> (8 * axis) & 0xff; }
};

struct Range {
  Place lo, hi;

  void add(Place p) { lo = lo.min(p), hi = hi.max(p); }
  [[nodiscard]] bool meets(const Range& o) const {
    return (hi.no_less_than(o.lo) & o.hi.no_less_than(lo)) == Place::kFree;
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
  [[nodiscard]] Place place_of(const IVec3& point) const {
    Place place;
    for (size_t k = 0; k < 3; ++k) {
      place.packed |= static_cast<uint32_t>((point[k] - around_.lo[k]) >> shift_[k]) << (8 * k);
    }
    return place;
  }

  void mark(PolygonBox box) {
    box.clip(around_);
    if (box.is_empty()) return;
    const Place lo = place_of({box.lo[0], box.lo[1], box.lo[2]}),
                hi = place_of({box.hi[0], box.hi[1], box.hi[2]});
    each_row({lo, hi}, [](uint32_t& row, uint32_t bits) { return row |= bits, false; });
    if (is_empty_) marked_ = {lo, lo};
    is_empty_ = false;
    marked_.add(lo);
    marked_.add(hi);
  }

  [[nodiscard]] bool is_marked(const Range& range) {
    return !is_empty_ && marked_.meets(range) &&
           each_row(range, [](uint32_t row, uint32_t bits) { return (row & bits) != 0; });
  }

 private:
  static constexpr unsigned kCells = 32;

  /// Calls f(row, bits) for the rows of a range until it says true; whether it did.
  template <class F>
  bool each_row(const Range& range, F&& f) {
    const uint32_t bits = (~0u >> (kCells - 1 - range.hi[0])) & (~0u << range.lo[0]);
    const uint32_t last = range.hi[1] - range.lo[1];
    for (uint32_t z = range.lo[2]; z <= range.hi[2]; ++z) {
      uint32_t* const row = &rows_[z * kCells + range.lo[1]];
      for (uint32_t y = 0; y <= last; ++y) {
        if (f(row[y], bits)) return true;
      }
    }
    return false;
  }

  const PolygonBox around_;
  std::array<int, 3> shift_{0, 0, 0};
  std::array<uint32_t, size_t{kCells} * kCells> rows_{};
  bool is_empty_ = true;
  Range marked_;
};

}  // namespace

std::vector<uint32_t> faces_near(const LeafGeometry& leaf, const IVec3& translation,
                                 const PolygonBox& around, std::span<const PolygonBox> boxes) {
  CellBits cells(around);
  for (const PolygonBox& box : boxes) cells.mark(box);
  std::vector<Place> places;
  places.reserve(leaf.vertices.size());
  for (const IVec3& v : leaf.vertices) {
    places.push_back(
        cells.place_of({v[0] + translation[0], v[1] + translation[1], v[2] + translation[2]}));
  }
  std::vector<uint32_t> faces;
  for (uint32_t f = 0; f < leaf.face_count(); ++f) {
    const uint32_t begin = leaf.face_starts[f], end = leaf.face_starts[f + 1];
    const Place first = places[leaf.corners[begin]];
    Range range{first, first};
    for (uint32_t c = begin + 1; c < end; ++c) range.add(places[leaf.corners[c]]);
    if (cells.is_marked(range)) faces.push_back(f);
  }
  return faces;
}

}  // namespace csgrun
