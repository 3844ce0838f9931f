#include "engine/mesh/single_sheets.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

#include "engine/base/chance_list.h"
#include "engine/base/parallel.h"
#include "engine/base/raw_vector.h"
#include "engine/base/subsets.h"
#include "engine/mesh/face_normal.h"
#include "engine/mesh/leaf_shape.h"

namespace csgrun {
namespace {

/// Fewer faces are compared with each other sooner.
constexpr size_t kFewForSheets = 2000;
constexpr size_t kSheetSample = 1024;
/// A cube is at least so many times as wide as a face on average,
constexpr double kLeastWidth = 2;
/// and the whole surface at least so many times: in coarser ones every column has an edge or a
/// bend.
constexpr double kLeastExtent = 40;
/// Cubes for each face, at most; in a row; and cubes that the box of a face reaches, on average
/// over a part and for one.
constexpr size_t kMostCubes = 16, kMostInRow = 4000, kMostReached = 8, kMostReachedByOne = 4096;
constexpr size_t kSheetFacesPerPart = 16384;
/// No longer column is looked at.
constexpr size_t kLongestColumn = 16;

/// What is known of a cube, as bits.
using Cube = uint16_t;
constexpr Cube kReached = 1, kSingle = 2;
/// A face that reaches the cube does not face up, or down, along the axis.
constexpr Cube not_up(size_t axis) { return static_cast<Cube>(1u << (4 + 4 * axis)); }
constexpr Cube not_down(size_t axis) { return static_cast<Cube>(1u << (5 + 4 * axis)); }
/// The line of the cube along the axis crosses faces here: any, more than one.
constexpr Cube crossed(size_t axis) { return static_cast<Cube>(1u << (6 + 4 * axis)); }
constexpr Cube crossed_again(size_t axis) { return static_cast<Cube>(1u << (7 + 4 * axis)); }

/// Where a point is along each axis, in eighths of cubes: a vector, of which the processor compares
/// all numbers at once; the fourth is not used.
using Place = int16_t __attribute__((vector_size(8)));
constexpr int kEighths = 3;  ///< the binary logarithm
static_assert((kMostInRow + 1) << kEighths <= INT16_MAX, "places and numbers of lines must fit");
/// The lines along an axis stand at so many eighths of a cube along the next axis, and along the
/// one after that, each half a step before: off all points, and off the diagonals of squares that
/// divide the cubes.
constexpr int kNext = 4, kAfterNext = 3;

/// The cube of a place along each axis.
inline Place cubes_of(Place place) { return place >> kEighths; }
/// The number of lines, which stand at so many eighths, before a place.
inline Place lines_before(Place place, int at) {
  return (place + static_cast<int16_t>((1 << kEighths) - at)) >> kEighths;
}

/// The cubes that the box of a face reaches.
struct Reach {
  uint32_t first;
  std::array<uint8_t, 4> more;  ///< how many after the first one along each axis; 0

  [[nodiscard]] uint32_t packed() const { return std::bit_cast<uint32_t>(more); }
  /// A bit for each axis along which there are two, if nowhere are more.
  static uint32_t axes(uint32_t packed) { return (packed | packed >> 7 | packed >> 14) & 7; }
};

GridBox box_of_face(const LeafGeometry& leaf, uint32_t begin, uint32_t end) {
  GridBox box;
  box.lo = box.hi = leaf.vertices[leaf.corners[begin]];
  for (uint32_t c = begin + 1; c < end; ++c) {
    const IVec3& p = leaf.vertices[leaf.corners[c]];
    for (size_t k = 0; k < 3; ++k) {
      box.lo[k] = std::min(box.lo[k], p[k]);
      box.hi[k] = std::max(box.hi[k], p[k]);
    }
  }
  return box;
}

/// The mean extent along the axes of the boxes of some faces.
double mean_extent(const LeafGeometry& leaf) {
  double sum = 0, count = 0;
  for (size_t f = 0, step = leaf.face_count() / kSheetSample + 1; f < leaf.face_count();
       f += step) {
    const GridBox box = box_of_face(leaf, leaf.face_starts[f], leaf.face_starts[f + 1]);
    for (size_t k = 0; k < 3; ++k) sum += static_cast<double>(box.hi[k] - box.lo[k]);
    ++count;
  }
  return sum / (3 * count);
}

class SheetFinder {
 public:
  SheetFinder(const LeafGeometry& leaf, const GridBox& box, double extent)
      : leaf_(leaf), origin_(box.lo) {
    while (static_cast<double>(width()) < kLeastWidth * extent) ++shift_;
    while (lay_out(box) > kMostCubes * leaf.face_count()) ++shift_;
    cubes_ = std::make_unique<std::atomic<Cube>[]>(lay_out(box));
    for (size_t axes = 0; axes < second_.size(); ++axes) {
      for (size_t k = 0; k < 3; ++k) {
        if (axes >> k & 1) second_[axes] += static_cast<uint32_t>(stride_[k]);
      }
    }
    places_.resize(leaf.vertices.size());
    for_each_range(places_.size(), [&](size_t begin, size_t end) {
      for (size_t v = begin; v < end; ++v) places_[v] = place_of(leaf.vertices[v]);
    });
    reach_.resize(leaf.face_count());
    reached_.resize(part_count(leaf.face_count(), kSheetFacesPerPart));
  }

  /// False if faces reach too many cubes.
  bool enter_faces() {
    std::atomic<bool> are_few = true;
    for_each_part(leaf_.face_count(), kSheetFacesPerPart,
                  [&](size_t part, size_t begin, size_t end) {
                    size_t left = kMostReached * (end - begin) + kMostReachedByOne;
                    ChanceList<uint32_t> reached;
                    for (size_t f = begin; f < end; ++f) {
                      const size_t count = enter(static_cast<uint32_t>(f), left, reached);
                      if (count == 0) {
                        are_few = false;
                        return;
                      }
                      left -= count;
                    }
                    reached_[part] = std::move(reached);
                  });
    return are_few;
  }

  void find_sheets() {
    for_each_part(reached_.size(), 1, [&](size_t part, size_t, size_t) {
      for (const uint32_t cube : reached_[part].view()) {
        for (size_t axis = 0; axis < 3 && (load(cube) & kSingle) == 0; ++axis) look(cube, axis);
      }
    });
  }

  [[nodiscard]] std::vector<uint32_t> faces_elsewhere() const {
    std::vector<RawVector<uint32_t>> found(reached_.size());
    for_each_part(leaf_.face_count(), kSheetFacesPerPart,
                  [&](size_t part, size_t begin, size_t end) {
                    ChanceList<uint32_t> own(end - begin);
                    for (size_t f = begin; f < end; ++f) {
                      own.add_if(!is_all_single(reach_[f]), static_cast<uint32_t>(f));
                    }
                    found[part] = own.take();
                  });
    std::vector<uint32_t> faces;
    for (const auto& some : found) faces.insert(faces.end(), some.begin(), some.end());
    return faces;
  }

 private:
  [[nodiscard]] int64_t width() const { return int64_t{1} << shift_; }

  /// The number of cubes that fill the box, with an empty one at either end of each row.
  size_t lay_out(const GridBox& box) {
    size_t count = 1;
    for (size_t k = 0; k < 3; ++k) {
      stride_[k] = count;
      const auto in_row = static_cast<size_t>((box.hi[k] - box.lo[k]) >> shift_) + 3;
      if (in_row > kMostInRow) return SIZE_MAX;
      count *= in_row;
    }
    return count;
  }

  [[nodiscard]] Place place_of(const IVec3& p) const {
    Place place{};
    for (size_t k = 0; k < 3; ++k) {
      place[k] = static_cast<int16_t>(((p[k] - origin_[k] + width()) << kEighths) >> shift_);
    }
    return place;
  }

  // Several threads set bits of a cube; the order makes no difference.
  [[nodiscard]] Cube load(size_t cube) const {
    return cubes_[cube].load(std::memory_order_relaxed);
  }
  /// What was known before.
  Cube set(size_t cube, Cube bits) {
    const Cube known = load(cube);
    if (is_alone_) {
      cubes_[cube].store(known | bits, std::memory_order_relaxed);
      return known;
    }
    if ((known & bits) == bits) return known;
    return cubes_[cube].fetch_or(bits, std::memory_order_relaxed);
  }

  /// Whether all cubes that a face reaches are in columns of a single sheet.
  [[nodiscard]] bool is_all_single(const Reach& reach) const {
    Cube all = kSingle;
    if (const uint32_t more = reach.packed(); (more & ~0x010101u) == 0) {
      // How many there are is chance: all are looked at, some of them several times.
      for (size_t some = 0; some < second_.size(); ++some) {
        all &= load(reach.first + second_[some & Reach::axes(more)]);
      }
    } else {
      for_each_cube(reach, [&](uint32_t cube) { all &= load(cube); });
    }
    return all != 0;
  }

  template <class Visit>
  void for_each_cube(const Reach& reach, Visit visit) const {
    if (const uint32_t more = reach.packed(); (more & ~0x010101u) == 0) {
      // Two along some axes. Nearly all are of this kind.
      for_each_subset(Reach::axes(more),
                      [&](uint32_t some) { visit(reach.first + second_[some]); });
      return;
    }
    for (size_t z = 0; z <= reach.more[2]; ++z) {
      for (size_t y = 0; y <= reach.more[1]; ++y) {
        const size_t row = reach.first + y * stride_[1] + z * stride_[2];
        for (size_t x = 0; x <= reach.more[0]; ++x) visit(static_cast<uint32_t>(row + x));
      }
    }
  }

  /// The number of cubes that the face reaches, or 0 and nothing done if it is more than `most`.
  size_t enter(uint32_t face, size_t most, ChanceList<uint32_t>& reached) {
    const uint32_t begin = leaf_.face_starts[face], end = leaf_.face_starts[face + 1];
    Place lo = places_[leaf_.corners[begin]], hi = lo;
    for (uint32_t c = begin + 1; c < end; ++c) {
      const Place at = places_[leaf_.corners[c]];
      lo = at < lo ? at : lo;
      hi = at > hi ? at : hi;
    }
    const Place cubes = cubes_of(lo), all_more = cubes_of(hi) - cubes;
    Reach reach{};
    size_t first = 0, count = 1, most_more = 0;
    for (size_t k = 0; k < 3; ++k) {
      const auto more = static_cast<size_t>(all_more[k]);
      first += static_cast<size_t>(cubes[k]) * stride_[k];
      count *= more + 1;
      most_more = std::max(most_more, more);
      reach.more[k] = static_cast<uint8_t>(more);
    }
    if (most_more > UINT8_MAX || count > most) return 0;
    reach.first = static_cast<uint32_t>(first);
    reach_[face] = reach;
    const IVec3 normal = face_normal(leaf_, begin, end);
    Cube bits = kReached;
    for (size_t k = 0; k < 3; ++k) {
      bits |= static_cast<Cube>(not_up(k) * static_cast<Cube>(normal[k] <= 0) |
                                not_down(k) * static_cast<Cube>(normal[k] >= 0));
    }
    reached.make_room(count);
    for_each_cube(reach, [&](uint32_t cube) { reached.add_if(set(cube, bits) == 0, cube); });
    const Lines next{lines_before(lo, kNext), lines_before(hi, kNext)},
        after_next{lines_before(lo, kAfterNext), lines_before(hi, kAfterNext)};
    // Per axis, whether lines pass through the face's box, and the face does not stand along them.
    const Place any = next.begin < next.end, any_after = after_next.begin < after_next.end;
    const Place across{static_cast<int16_t>(normal[0] != 0 ? -1 : 0),
                       static_cast<int16_t>(normal[1] != 0 ? -1 : 0),
                       static_cast<int16_t>(normal[2] != 0 ? -1 : 0), 0};
    const Place may_cross = __builtin_shufflevector(any, any, 1, 2, 0, 3) &
                            __builtin_shufflevector(any_after, any_after, 2, 0, 1, 3) & across;
    if (std::bit_cast<uint64_t>(may_cross) == 0) return count;
    if (may_cross[0] != 0) cross_lines<0>(face, normal, cubes, next, after_next);
    if (may_cross[1] != 0) cross_lines<1>(face, normal, cubes, next, after_next);
    if (may_cross[2] != 0) cross_lines<2>(face, normal, cubes, next, after_next);
    return count;
  }

  /// The lines that pass through the box of a face, by their numbers along each axis.
  struct Lines {
    Place begin, end;
  };
  /// Crosses the lines along an axis with a face that faces up or down there; `cubes`: of the lower
  /// end of its box.
  template <size_t axis>
  void cross_lines(uint32_t face, const IVec3& normal, Place cubes, const Lines& next,
                   const Lines& after_next) {
    constexpr size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
    for (int i = next.begin[u]; i < next.end[u]; ++i) {
      for (int j = after_next.begin[v]; j < after_next.end[v]; ++j) {
        if (!is_crossed<u, v>(face, normal[axis] > 0, line_at(i, kNext), line_at(j, kAfterNext)))
          continue;
        const size_t cube = static_cast<size_t>(i) * stride_[u] +
                            static_cast<size_t>(j) * stride_[v] +
                            static_cast<size_t>(cubes[axis]) * stride_[axis];
        const Cube known = set(cube, crossed(axis));
        if ((known & crossed(axis)) != 0) set(cube, crossed_again(axis));
      }
    }
  }
  /// Twice the coordinate, from the origin, of the line in a cube: half a step before the first
  /// points that are at its place.
  [[nodiscard]] int64_t line_at(int cube, int eighths) const {
    const int64_t place = (int64_t{cube - 1} << kEighths) + eighths;
    return 2 * ((place * width() + (1 << kEighths) - 1) >> kEighths) - 1;
  }

  /// Whether a line runs through a face or its rim: through an edge it crosses both faces, which is
  /// no less often than lines beside it do. It is given by twice its coordinates from the origin.
  /// Differences of coordinates are below 2^30, of twice the coordinates within the face's box
  /// below 2^31: a product fits 61 bits.
  template <size_t u, size_t v>
  [[nodiscard]] bool is_crossed(uint32_t face, bool is_up, int64_t at_u, int64_t at_v) const {
    const uint32_t begin = leaf_.face_starts[face], end = leaf_.face_starts[face + 1];
    for (uint32_t c = begin; c < end; ++c) {
      const IVec3& a = leaf_.vertices[leaf_.corners[c]];
      const IVec3& b = leaf_.vertices[leaf_.corners[c + 1 < end ? c + 1 : begin]];
      const int64_t left = (b[u] - a[u]) * (at_v - 2 * (a[v] - origin_[v])) -
                           (b[v] - a[v]) * (at_u - 2 * (a[u] - origin_[u]));
      if (is_up ? left < 0 : left > 0) return false;
    }
    return true;
  }

  /// Marks the column of a cube along an axis if the surface is a single sheet there.
  void look(size_t cube, size_t axis) {
    const size_t step = stride_[axis];
    const Cube both = not_up(axis) | not_down(axis);
    Cube faced = 0;
    size_t crossings = 0;
    const auto add = [&](Cube known) {
      faced |= known & both;
      crossings += ((known & crossed(axis)) != 0) + ((known & crossed_again(axis)) != 0);
    };
    add(load(cube));
    size_t begin = cube, end = cube + step;
    for (Cube known = 0; faced != both && crossings <= 1 && (known = load(begin - step)) != 0;) {
      begin -= step;
      if (end - begin > kLongestColumn * step) return;
      add(known);
    }
    for (Cube known = 0; faced != both && crossings <= 1 && (known = load(end)) != 0;) {
      end += step;
      if (end - begin > kLongestColumn * step) return;
      add(known);
    }
    if (faced == both || crossings > 1) return;
    for (; begin < end; begin += step) set(begin, kSingle);
  }

  const LeafGeometry& leaf_;
  const bool is_alone_ = threads_here() == 1;
  IVec3 origin_;
  int shift_ = 0;                     ///< the cubes are 2^shift steps wide
  std::array<size_t, 3> stride_{};    ///< from a cube to the next one along each axis
  std::array<uint32_t, 8> second_{};  ///< the same along several, by a bit for each axis
  std::unique_ptr<std::atomic<Cube>[]> cubes_;
  RawVector<Place> places_;                    ///< by vertex
  RawVector<Reach> reach_;                     ///< by face
  std::vector<ChanceList<uint32_t>> reached_;  ///< cubes, by the part of the face that came first
};

}  // namespace

std::optional<std::vector<uint32_t>> faces_off_single_sheets(const LeafGeometry& leaf) {
  if (leaf.face_count() < kFewForSheets) return std::nullopt;
  const GridBox box = box_of_points(leaf.vertices);
  if (!is_compact(box)) return std::nullopt;
  const double extent = mean_extent(leaf);
  int64_t longest = 0;
  for (size_t k = 0; k < 3; ++k) longest = std::max(longest, box.hi[k] - box.lo[k]);
  if (static_cast<double>(longest) < kLeastExtent * extent) return std::nullopt;
  SheetFinder finder(leaf, box, extent);
  if (!finder.enter_faces()) return std::nullopt;
  finder.find_sheets();
  return finder.faces_elsewhere();
}

}  // namespace csgrun
