#include "engine/mesh/level_section.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "engine/mesh/to_millimetres.h"

namespace csgrun {
namespace {

/// Where an edge of a face crosses the level.
struct Crossing {
  uint32_t plane;       ///< PlaneId::value of the face
  uint32_t edge_plane;  ///< which holds the edge, too
  int turn;             ///< what crossing it adds to the faces that there are
  glm::dvec2 at;        ///< in mm, correctly rounded
};

class Section {
 public:
  Section(const BoundaryMesh& boundary, int64_t level, const GridStep& step)
      : boundary_(boundary), level_(level), to_mm_(step), step_mm_(step.millimetres()) {
    level_plane_.c = 1;
    level_plane_.d = -static_cast<Int128>(level);
  }

  std::vector<SectionSegment> run() {
    find_above();
    for (const BoundaryMesh::Face& face : boundary_.faces) add(face);
    std::sort(crossings_.begin(), crossings_.end(),
              [](const Crossing& a, const Crossing& b) { return a.plane < b.plane; });
    for (size_t begin = 0; begin < crossings_.size();) {
      size_t end = begin + 1;
      while (end < crossings_.size() && crossings_[end].plane == crossings_[begin].plane) ++end;
      add_segments(std::span(crossings_).subspan(begin, end - begin));
      begin = end;
    }
    return std::move(segments_);
  }

 private:
  void find_above() {
    const auto level = static_cast<double>(level_);
    const Point on_level = grid_point(0, 0, level_);
    is_above_.resize(boundary_.point_rounded.size());
    for (uint32_t p = 0; p < is_above_.size(); ++p) {
      // Rounding is monotone, and the level has not more than 53 bits.
      const double z = boundary_.point_rounded[p][2];
      is_above_[p] =
          z != level ? z > level : compare_along(boundary_.exact_point(p), on_level, 2) > 0;
    }
  }

  [[nodiscard]] Point exact(const Crossing& c) const {
    return intersect(boundary_.planes[PlaneId::from_value(c.plane).index()],
                     boundary_.planes[c.edge_plane], level_plane_);
  }

  void add(const BoundaryMesh::Face& face) {
    for (uint32_t l = face.first_loop; l < face.first_loop + face.loop_count; ++l) {
      const uint32_t begin = boundary_.loop_starts[l], end = boundary_.loop_starts[l + 1];
      for (uint32_t c = begin; c < end; ++c) {
        const BoundaryMesh::Corner& corner = boundary_.corners[c];
        const uint32_t next = boundary_.corners[c + 1 < end ? c + 1 : begin].point;
        const bool rises = is_above_[next] != 0;
        if ((is_above_[corner.point] != 0) == rises) continue;
        Crossing crossing{face.plane.value(), corner.edge_plane, rises ? -1 : 1, {}};
        glm::dvec3 mm;
        std::array<float, 3> single{};
        to_mm_.position(exact(crossing), mm, single);
        crossing.at = {mm.x, mm.y};
        crossings_.push_back(crossing);
      }
    }
  }

  /// Seen from outside, the interior of a face is on the left of its edges: towards the left of who
  /// goes along the level with the solid on the left, an edge that falls begins it, and one that
  /// rises ends it.
  void add_segments(std::span<Crossing> all) {
    const PlaneId id = PlaneId::from_value(all[0].plane);
    Plane plane = boundary_.planes[id.index()];
    if (id.flipped()) plane = plane.reversed();
    // The way is (-b, a).
    const bool along_x = magnitude(plane.b) >= magnitude(plane.a);
    const int axis = along_x ? 0 : 1;
    const bool is_forward = along_x ? plane.b < 0 : plane.a > 0;
    const auto order = [&](const Crossing& p, const Crossing& q) {
      if (p.at[axis] != q.at[axis]) return p.at[axis] < q.at[axis] ? -1 : 1;
      if (p.edge_plane == q.edge_plane) return 0;
      return compare_along(exact(p), exact(q), axis);
    };
    std::sort(all.begin(), all.end(), [&](const Crossing& p, const Crossing& q) {
      const int o = order(p, q);
      return is_forward ? o < 0 : o > 0;
    });
    // A plane through three vertices is off by less than a step where they are.
    const double noise = step_mm_ * (1 + std::fabs(to_double(plane.c)) /
                                             std::hypot(to_double(plane.a), to_double(plane.b)));
    int faces = 0;
    glm::dvec2 from(0);
    for (size_t i = 0; i < all.size();) {
      const int before = faces;
      size_t same = i;
      while (same < all.size() && order(all[i], all[same]) == 0) faces += all[same++].turn;
      if (before == 0 && faces != 0) from = all[i].at;
      if (before != 0 && faces == 0) segments_.push_back({from, all[i].at, noise});
      i = same;
    }
  }

  const BoundaryMesh& boundary_;
  const int64_t level_;
  const ToMillimetres to_mm_;
  const double step_mm_;
  Plane level_plane_;
  std::vector<uint8_t> is_above_;  ///< per point
  std::vector<Crossing> crossings_;
  std::vector<SectionSegment> segments_;
};

}  // namespace

std::vector<SectionSegment> level_section(const BoundaryMesh& boundary, int64_t level,
                                          const GridStep& step) {
  return Section(boundary, level, step).run();
}

}  // namespace csgrun
