#include "engine/bsp/cut_parts.h"

#include <algorithm>
#include <atomic>
#include <cstddef>

#include "engine/base/parallel.h"

namespace csgrun {
namespace {

class PartJoiner {
 public:
  PartJoiner(const Job& job, const ContactTable& contacts, CellGeometry& geometry,
             PointIndex& index)
      : job_(job), contacts_(contacts), geometry_(geometry), index_(index) {}

  CutFaces join(const std::vector<CutPart>& parts) {
    std::vector<Place> places;
    Place end;
    for (const CutPart& part : parts) {
      places.push_back(end);
      end.loop += part.made.loops.loops.size();
      end.corner += part.made.loops.corner_point.size();
      end.fact += part.made.loops.facts.size();
      end.face += part.made.faces.size();
    }
    make_points(parts);
    CutFaces all;
    all.loops.loops.resize(end.loop);
    all.loops.corner_point.resize(end.corner);
    all.loops.corner_plane.resize(end.corner);
    all.loops.facts.resize(end.fact);
    all.first_crossing = first_new_, all.end_crossing = end_new_;
    all.faces.resize(end.face);
    for_each_part(parts.size(), kAtOnce, [&](size_t, size_t first, size_t last) {
      for (size_t p = first; p < last; ++p) copy(parts[p], points_[p], places[p], all);
    });
    for (const CutPart& part : parts) {
      all.left.insert(all.left.end(), part.left.begin(), part.left.end());
      all.by_value.insert(all.by_value.end(), part.by_value.begin(), part.by_value.end());
    }
    return all;
  }

 private:
  static constexpr size_t kAtOnce = 8;  ///< parts
  /// What the loops need of a vertex.
  static constexpr uint8_t kPoint = 1, kUnique = 2;

  /// Where what comes of a part stands.
  struct Place {
    size_t loop = 0, corner = 0, fact = 0, face = 0;
  };

  [[nodiscard]] bool is_by_value(uint32_t vertex, bool is_loose) const {
    return is_loose && contacts_.touched()[vertex];
  }

  void make_points(const std::vector<CutPart>& parts) {
    std::vector<uint8_t> needs(job_.vertex_count(), 0);
    for_each_part(parts.size(), kAtOnce, [&](size_t, size_t first, size_t last) {
      for (size_t p = first; p < last; ++p) note_needs(parts[p].made.loops, needs);
    });
    const std::vector<uint32_t> vertices = numbers_where(
        needs.size(), [&](uint32_t v) { return needs[v] != 0 && !geometry_.has_vertex_point(v); });
    geometry_.add_vertex_points(vertices);
    size_t count = 0;
    std::vector<size_t> starts;  // of the points of each part
    for (const CutPart& part : parts) {
      starts.push_back(count);
      count += part.made.points.size();
    }
    const uint32_t first = first_new_ = geometry_.add_points(count);
    end_new_ = first + static_cast<uint32_t>(count);
    points_.resize(parts.size());
    for_each_part(parts.size(), kAtOnce, [&](size_t, size_t begin, size_t end) {
      for (size_t p = begin; p < end; ++p) {
        auto number = first + static_cast<uint32_t>(starts[p]);
        for (const CutPart::Point& point : parts[p].made.points) {
          geometry_.set_point(number, point.planes, point.rounded);
          points_[p].push_back(number++);
        }
      }
    });
    make_unique(parts, needs);
  }

  /// Equal points of loose loops get one number.
  void make_unique(const std::vector<CutPart>& parts, const std::vector<uint8_t>& needs) {
    std::vector<uint32_t> asked =
        numbers_where(needs.size(), [&](uint32_t v) { return (needs[v] & kUnique) != 0; });
    for (uint32_t& v : asked) v = geometry_.made_vertex_point(v);
    const auto each_loose_point = [&](auto&& visit) {
      for (size_t p = 0; p < parts.size(); ++p) {
        for (size_t i = 0; i < points_[p].size(); ++i) {
          if (parts[p].made.points[i].is_loose) visit(points_[p][i]);
        }
      }
    };
    each_loose_point([&](uint32_t point) { asked.push_back(point); });
    index_.make_unique(asked);
    each_loose_point([&](uint32_t& point) { point = index_.known(point); });
  }

  void note_needs(const CutLoops& loops, std::vector<uint8_t>& needs) const {
    for (const CutLoops::Loop& loop : loops.loops) {
      for (uint32_t c = loop.first_corner; c < loop.first_corner + loop.corner_count; ++c) {
        const uint32_t code = loops.corner_point[c];
        if (!(code & CutPart::kVertex)) continue;
        const uint32_t vertex = code & ~CutPart::kVertex;
        const uint8_t need = is_by_value(vertex, loop.is_loose) ? kPoint | kUnique : kPoint;
        const std::atomic_ref<uint8_t> shared(needs[vertex]);
        if ((shared.load(std::memory_order_relaxed) & need) != need) {
          shared.fetch_or(need, std::memory_order_relaxed);
        }
      }
    }
  }

  void copy(const CutPart& part, const std::vector<uint32_t>& points, const Place& place,
            CutFaces& all) const {
    const auto at = [](auto& list, size_t first) {
      return list.begin() + static_cast<std::ptrdiff_t>(first);
    };
    const auto moved = [](uint32_t number, size_t by) {
      return number + static_cast<uint32_t>(by);
    };
    for (size_t l = 0; l < part.made.loops.loops.size(); ++l) {
      CutLoops::Loop loop = part.made.loops.loops[l];
      for (uint32_t c = loop.first_corner; c < loop.first_corner + loop.corner_count; ++c) {
        all.loops.corner_point[place.corner + c] =
            number(part.made.loops.corner_point[c], loop.is_loose, points);
      }
      loop.first_corner = moved(loop.first_corner, place.corner);
      loop.first_fact = moved(loop.first_fact, place.fact);
      all.loops.loops[place.loop + l] = loop;
    }
    std::copy(part.made.loops.corner_plane.begin(), part.made.loops.corner_plane.end(),
              at(all.loops.corner_plane, place.corner));
    std::copy(part.made.loops.facts.begin(), part.made.loops.facts.end(),
              at(all.loops.facts, place.fact));
    for (size_t f = 0; f < part.made.faces.size(); ++f) {
      const CutFaces::Face& face = part.made.faces[f];
      all.faces[place.face + f] = {face.polygon, moved(face.first_loop, place.loop),
                                   moved(face.end_loop, place.loop)};
    }
  }

  [[nodiscard]] uint32_t number(uint32_t code, bool is_loose,
                                const std::vector<uint32_t>& points) const {
    if (code & CutPart::kNew) return points[code & ~CutPart::kNew];
    if (!(code & CutPart::kVertex)) return code;
    const uint32_t vertex = code & ~CutPart::kVertex, point = geometry_.made_vertex_point(vertex);
    return is_by_value(vertex, is_loose) ? index_.known(point) : point;
  }

  const Job& job_;
  const ContactTable& contacts_;
  CellGeometry& geometry_;
  PointIndex& index_;
  std::vector<std::vector<uint32_t>> points_;  ///< per part: of its new points, in the geometry
  uint32_t first_new_ = 0, end_new_ = 0;       ///< all of these
};

}  // namespace

CutFaces join_parts(const Job& job, const ContactTable& contacts, const std::vector<CutPart>& parts,
                    CellGeometry& geometry, PointIndex& index) {
  return PartJoiner(job, contacts, geometry, index).join(parts);
}

}  // namespace csgrun
