#include "engine/mesh/star_surface.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "engine/base/parallel.h"
#include "engine/mesh/face_normal.h"
#include "engine/mesh/leaf_shape.h"

namespace csgrun {
namespace {

/// Fewer faces are compared with each other sooner.
constexpr size_t kFewFaces = 128;
/// The centre is sought for so many faces at first, by so many reflections in all, and no more than
/// one for so many faces.
constexpr size_t kSample = 512, kMostReflections = 100, kFacesForEach = 16;
/// Then all are looked at, so often.
constexpr size_t kMostLooks = 4;
constexpr size_t kFacesPerPart = 16384;

class Star {
 public:
  Star(const LeafGeometry& leaf, const GridBox& box)
      : leaf_(leaf), origin_(leaf.vertices[leaf.corners[0]]) {
    for (size_t k = 0; k < 3; ++k) {
      lo_[k] = box.lo[k] - origin_[k];
      hi_[k] = box.hi[k] - origin_[k];
      centre_[k] = odd(static_cast<double>(lo_[k] + hi_[k]));
    }
  }

  /// Moves the centre until it is behind all faces. False if it was not found.
  bool find_centre() {
    const size_t count = leaf_.face_count(), step = count / kSample + 1;
    for (size_t looks = 0; looks < kMostLooks; ++looks) {
      size_t behind = 0;  // so many faces of the sample, the last ones that were looked at
      for (size_t f = 0; behind * step < count; f = f + step < count ? f + step : 0) {
        if (has_behind(f)) {
          ++behind;
          continue;
        }
        if (!reflect(f)) return false;
        behind = 0;
      }
      const Look all = look_at_all();
      if (all.face_without == count) {
        ray_crossings_ = all.ray_crossings;
        return true;
      }
      if (!reflect(all.face_without)) return false;
    }
    return false;
  }

  /// How many faces a ray from the centre that was found crosses; through an edge it crosses one of
  /// its faces.
  [[nodiscard]] size_t ray_crossings() const { return ray_crossings_; }

 private:
  static int64_t odd(double x) { return 2 * static_cast<int64_t>(std::floor(x / 2)) + 1; }

  /// The way from the centre to a corner, in halves of steps: below 2^32.
  [[nodiscard]] IVec3 way_to(uint32_t corner) const {
    const IVec3& p = leaf_.vertices[leaf_.corners[corner]];
    IVec3 way;
    for (size_t k = 0; k < 3; ++k) way[k] = 2 * (p[k] - origin_[k]) - centre_[k];
    return way;
  }

  [[nodiscard]] IVec3 normal(size_t face) const {
    return face_normal(leaf_, leaf_.face_starts[face], leaf_.face_starts[face + 1]);
  }

  /// Whether a face has the centre behind it. The sum fits 97 bits.
  [[nodiscard]] bool has_behind(size_t face) const {
    const IVec3 n = normal(face), way = way_to(leaf_.face_starts[face]);
    __int128 sum = 0;
    for (size_t k = 0; k < 3; ++k) sum += static_cast<__int128>(n[k]) * way[k];
    return sum > 0;
  }

  /// Puts the centre as far behind a face as it is in front, and a bit further, within the box.
  bool reflect(size_t face) {
    if (++reflections_ > std::min(kMostReflections, leaf_.face_count() / kFacesForEach)) {
      return false;
    }
    const IVec3 n = normal(face), way = way_to(leaf_.face_starts[face]);
    double height = 0, square = 0;
    for (size_t k = 0; k < 3; ++k) {
      height -= static_cast<double>(n[k]) * static_cast<double>(way[k]);
      square += static_cast<double>(n[k]) * static_cast<double>(n[k]);
    }
    const double back = (2 * height + std::sqrt(square)) / square;
    for (size_t k = 0; k < 3; ++k) {
      const double to = static_cast<double>(centre_[k]) - back * static_cast<double>(n[k]);
      centre_[k] =
          odd(std::clamp(to, static_cast<double>(2 * lo_[k]), static_cast<double>(2 * hi_[k] - 1)));
    }
    return true;
  }

  struct Look {
    size_t face_without;   ///< the first face that does not have the centre behind it, or the count
    size_t ray_crossings;  ///< if there is no such face
  };
  [[nodiscard]] Look look_at_all() const {
    const size_t count = leaf_.face_count();
    std::vector<Look> parts(part_count(count, kFacesPerPart));
    for_each_part(count, kFacesPerPart, [&](size_t part, size_t begin, size_t end) {
      Look own{count, 0};
      for (size_t f = begin; f < end; ++f) {
        if (!has_behind(f)) {
          own.face_without = f;
          break;
        }
        own.ray_crossings += is_crossed(f) ? 1 : 0;
      }
      parts[part] = own;
    });
    Look all{count, 0};
    for (const Look& own : parts) {
      all.face_without = std::min(all.face_without, own.face_without);
      all.ray_crossings += own.ray_crossings;
    }
    return all;
  }

  /// Whether the ray from the centre along the first axis crosses a face. As the centre is behind
  /// it, the ray does not cross one that faces the other way. A product is below 2^64.
  [[nodiscard]] bool is_crossed(size_t face) const {
    const uint32_t begin = leaf_.face_starts[face], end = leaf_.face_starts[face + 1];
    IVec3 from = way_to(end - 1);
    for (uint32_t c = begin; c < end; ++c) {
      const IVec3 to = way_to(c);
      const auto left =
          static_cast<__int128>(from[1]) * to[2] - static_cast<__int128>(from[2]) * to[1];
      // A ray through an edge is moved a little, so that it crosses the one that runs this way.
      if (left < 0 || (left == 0 && (from[1] != to[1] ? from[1] > to[1] : from[2] > to[2]))) {
        return false;
      }
      from = to;
    }
    return normal(face)[0] > 0;
  }

  const LeafGeometry& leaf_;
  IVec3 origin_, lo_{}, hi_{};  ///< a vertex; from there the box
  /// From the origin in halves of steps; odd: a line through it along an axis misses all vertices.
  IVec3 centre_{};
  size_t reflections_ = 0, ray_crossings_ = 0;
};

}  // namespace

bool is_star_surface(const LeafGeometry& leaf) {
  if (leaf.face_count() < kFewFaces) return false;
  const GridBox box = box_of_points(leaf.vertices);
  const auto is_flat = [&](size_t k) { return box.lo[k] == box.hi[k]; };
  if (!is_compact(box) || is_flat(0) || is_flat(1) || is_flat(2)) return false;
  Star star(leaf, box);
  return star.find_centre() && star.ray_crossings() == 1;
}

}  // namespace csgrun
