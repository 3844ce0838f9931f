#include "engine/mesh/star_surface.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "engine/base/parallel.h"
#include "engine/mesh/centre_view.h"
#include "engine/mesh/leaf_shape.h"

namespace csgrun {
namespace {

/// Fewer faces are compared with each other sooner.
constexpr size_t kFewForStars = 128;
/// The centre is sought for so many faces at first, by so many reflections in all, and no more than
/// one for so many faces.
constexpr size_t kStarSample = 512, kMostReflections = 100, kFacesForEach = 16;
/// Then all are looked at, so often.
constexpr size_t kMostLooks = 4;
constexpr size_t kStarFacesPerPart = 16384;

class Star {
 public:
  Star(const LeafGeometry& leaf, const GridBox& box) : leaf_(leaf), view_(leaf, box) {
    for (size_t k = 0; k < 3; ++k) {
      lo_[k] = box.lo[k] - view_.origin()[k];
      hi_[k] = box.hi[k] - view_.origin()[k];
    }
  }

  /// Moves the centre until it is behind all faces. False if it was not found.
  bool find_centre() {
    const size_t count = leaf_.face_count(), step = count / kStarSample + 1;
    for (size_t looks = 0; looks < kMostLooks; ++looks) {
      size_t behind = 0;  // so many faces of the sample, the last ones that were looked at
      for (size_t f = 0; behind * step < count; f = f + step < count ? f + step : 0) {
        if (view_.has_behind(f, view_.normal(f))) {
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

  /// How many faces a ray from the centre that was found crosses.
  [[nodiscard]] size_t ray_crossings() const { return ray_crossings_; }

 private:
  /// Puts the centre as far behind a face as it is in front, and a bit further, within the box.
  bool reflect(size_t face) {
    if (++reflections_ > std::min(kMostReflections, leaf_.face_count() / kFacesForEach)) {
      return false;
    }
    const IVec3 n = view_.normal(face), way = view_.way_to(leaf_.face_starts[face]);
    double height = 0, square = 0;
    for (size_t k = 0; k < 3; ++k) {
      height -= static_cast<double>(n[k]) * static_cast<double>(way[k]);
      square += static_cast<double>(n[k]) * static_cast<double>(n[k]);
    }
    const double back = (2 * height + std::sqrt(square)) / square;
    std::array<double, 3> to{};
    for (size_t k = 0; k < 3; ++k) {
      to[k] = std::clamp(static_cast<double>(view_.centre()[k]) - back * static_cast<double>(n[k]),
                         static_cast<double>(2 * lo_[k]), static_cast<double>(2 * hi_[k] - 1));
    }
    view_.move_to(to);
    return true;
  }

  struct Look {
    size_t face_without;   ///< the first face that does not have the centre behind it, or the count
    size_t ray_crossings;  ///< if there is no such face
  };
  [[nodiscard]] Look look_at_all() const {
    const size_t count = leaf_.face_count();
    std::vector<Look> parts(part_count(count, kStarFacesPerPart));
    for_each_part(count, kStarFacesPerPart, [&](size_t part, size_t begin, size_t end) {
      Look own{count, 0};
      for (size_t f = begin; f < end; ++f) {
        const IVec3 normal = view_.normal(f);
        if (!view_.has_behind(f, normal)) {
          own.face_without = f;
          break;
        }
        own.ray_crossings += view_.is_crossed(f, normal) ? 1 : 0;
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

  const LeafGeometry& leaf_;
  CentreView view_;
  IVec3 lo_{}, hi_{};  ///< the box, from the view's origin
  size_t reflections_ = 0, ray_crossings_ = 0;
};

}  // namespace

bool is_star_surface(const LeafGeometry& leaf) {
  if (leaf.face_count() < kFewForStars) return false;
  const GridBox box = box_of_points(leaf.vertices);
  const auto is_flat = [&](size_t k) { return box.lo[k] == box.hi[k]; };
  if (!is_compact(box) || is_flat(0) || is_flat(1) || is_flat(2)) return false;
  Star star(leaf, box);
  return star.find_centre() && star.ray_crossings() == 1;
}

}  // namespace csgrun
