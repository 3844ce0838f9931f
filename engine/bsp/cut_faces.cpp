#include "engine/bsp/cut_faces.h"

#include <algorithm>
#include <atomic>
#include <cstddef>

#include "engine/base/in_order.h"
#include "engine/base/raw_vector.h"
#include "engine/bsp/face_arrangement.h"
#include "engine/bsp/parallel_runs.h"
#include "engine/bsp/sign_stats.h"

namespace csgrun {
namespace {

/// So many polygons are cut by one thread.
constexpr size_t kPolygonsPerPart = 256;

/// Corners of the loops of a part are points of the geometry by their numbers, vertices of the job
/// (kVertex + number), or new points of the part (kNew + number).
constexpr uint32_t kVertex = 1u << 30, kNew = 1u << 31;

/// Some of the polygons, what meets them, and what comes of it.
struct Part {
  struct Polygon {
    uint32_t number;
    uint32_t first_contact, end_contact, first_coplanar, end_coplanar;
    bool is_plain;  ///< all contacts are, and names may do
  };
  struct Point {
    std::array<double, 3> rounded;
    std::array<uint32_t, 3> planes;
    bool is_loose;  ///< of loops that are
  };

  std::vector<Polygon> polygons;
  /// Of the polygons, but for those with convex operands that have a face in the polygon's plane:
  /// that one tells all.
  std::vector<uint32_t> contacts;
  std::vector<uint32_t> coplanar;  ///< polygons
  std::vector<Polygon> again;      ///< not cut by name after all
  CutLoops loops;
  std::vector<Point> points;
  std::vector<CutFaces::Face> faces;
  std::vector<uint32_t> left, by_value;
  SignCounters counters;
};

/// Lists what is on polygons.
void list(const Job& job, std::span<const uint32_t> polygons, const ContactTable& contacts,
          Part& part) {
  std::vector<uint32_t> flat;  // convex operands with a face in the polygon's plane
  for (const uint32_t p : polygons) {
    Part::Polygon& polygon = part.polygons.emplace_back();
    polygon = {p, static_cast<uint32_t>(part.contacts.size()),
               0, static_cast<uint32_t>(part.coplanar.size()),
               0, true};
    flat.clear();
    const auto operand = [&](const Contact& c) {
      return job.polygons()[c.p == p ? c.q : c.p].operand;
    };
    for (const uint32_t i : contacts.of(p)) {
      const Contact& c = contacts[i];
      polygon.is_plain &= c.is_plain;
      if (!c.is_coplanar) continue;
      part.coplanar.push_back(c.p == p ? c.q : c.p);
      if (job.is_convex(operand(c))) flat.push_back(operand(c));
    }
    for (const uint32_t i : contacts.of(p)) {
      const Contact& c = contacts[i];
      if (c.is_coplanar) continue;
      if (!flat.empty() && std::find(flat.begin(), flat.end(), operand(c)) != flat.end()) continue;
      part.contacts.push_back(i);
    }
    polygon.end_contact = static_cast<uint32_t>(part.contacts.size());
    polygon.end_coplanar = static_cast<uint32_t>(part.coplanar.size());
  }
}

/// Cuts one polygon after another, each in a geometry that holds nothing else.
class Worker {
 public:
  Worker(const Job& job, const ContactTable& contacts, const ContactEnds& ends,
         const CellGeometry& shared)
      : job_(job),
        contacts_(contacts),
        ends_(ends),
        shared_(shared),
        geometry_(job.planes(), &job),
        index_(geometry_),
        cutter_(job, geometry_),
        arrangement_(job, geometry_, index_, contacts.touched()),
        stamp_of_(shared.point_count(), 0),
        local_(shared.point_count()) {}

  /// Cuts by name, or by value, for which the planes must have been made.
  void cut(const Part::Polygon& polygon, Part& part) {
    geometry_.clear();
    codes_.clear();
    ++stamp_;
    const auto first_loop = static_cast<uint32_t>(part.loops.loops.size());
    const size_t first_corner = part.loops.corner_point.size();
    bool is_done = false;
    if (polygon.is_plain) {
      list_segments(polygon, part);
      is_done = cutter_.cut(polygon.number, segments_, part.loops);
      if (!is_done) {
        part.again.push_back(polygon);
        part.again.back().is_plain = false;
        return;
      }
    } else {
      index_.clear();
      list_sheets(polygon, part);
      is_done = arrangement_.build(polygon.number, sheets_, coplanar(polygon, part), part.loops);
      part.by_value.push_back(polygon.number);
    }
    if (!is_done) {
      part.left.push_back(polygon.number);
      return;
    }
    for (size_t c = first_corner; c < part.loops.corner_point.size(); ++c) {
      part.loops.corner_point[c] = code(part.loops.corner_point[c], !polygon.is_plain, part);
    }
    part.faces.push_back(
        {polygon.number, first_loop, static_cast<uint32_t>(part.loops.loops.size())});
  }

  [[nodiscard]] const SignCounters& counters() const { return geometry_.counters; }

 private:
  static std::span<const uint32_t> coplanar(const Part::Polygon& polygon, const Part& part) {
    return {part.coplanar.data() + polygon.first_coplanar,
            polygon.end_coplanar - polygon.first_coplanar};
  }

  /// Calls add(contact, whether the polygon is its p, start, end) for the segments on a polygon.
  template <class Add>
  void for_each_segment(const Part::Polygon& polygon, const Part& part, Add&& add) {
    for (uint32_t i = polygon.first_contact; i < polygon.end_contact; ++i) {
      const Contact& c = contacts_[part.contacts[i]];
      const auto& [lower, upper] = ends_.of(part.contacts[i]);
      if (lower == upper) continue;
      const bool is_p = c.p == polygon.number;
      add(c, is_p, own_point(is_p ? lower : upper), own_point(is_p ? upper : lower));
    }
  }
  void list_segments(const Part::Polygon& polygon, const Part& part) {
    segments_.clear();
    for_each_segment(polygon, part, [&](const Contact& c, bool is_p, uint32_t from, uint32_t to) {
      const auto edge = [&](const Contact::End& e) { return e.on_p == is_p ? e.edge : kNone; };
      segments_.push_back({from, to, is_p ? c.q : c.p, edge(is_p ? c.lower : c.upper),
                           edge(is_p ? c.upper : c.lower)});
    });
  }
  void list_sheets(const Part::Polygon& polygon, const Part& part) {
    sheets_.clear();
    for_each_segment(polygon, part, [&](const Contact& c, bool is_p, uint32_t from, uint32_t to) {
      sheets_.push_back({index_.unique(from), index_.unique(to), is_p ? c.q : c.p,
                         is_p ? c.q_front : c.p_front, is_p ? c.q_back : c.p_back});
    });
  }

  /// The number here of a point of the shared geometry.
  uint32_t own_point(uint32_t shared) {
    if (stamp_of_[shared] == stamp_) return local_[shared];
    stamp_of_[shared] = stamp_;
    const CellGeometry::StoredPoint& s = shared_.point(shared);
    const uint32_t own = s.vertex != kNone ? geometry_.vertex_point(s.vertex)
                                           : geometry_.add_point(s.planes, s.rounded);
    code_of(own) = shared;
    return local_[shared] = own;
  }

  uint32_t& code_of(uint32_t own) {
    if (own >= codes_.size()) codes_.resize(geometry_.point_count(), kNone);
    return codes_[own];
  }
  /// What stands for a point in the loops of a part.
  uint32_t code(uint32_t own, bool is_loose, Part& part) {
    uint32_t& code = code_of(own);
    if (code != kNone) return code;
    const CellGeometry::StoredPoint& s = geometry_.point(own);
    if (s.vertex != kNone) return code = kVertex | s.vertex;
    part.points.push_back({s.rounded, s.planes, is_loose});
    return code = kNew | static_cast<uint32_t>(part.points.size() - 1);
  }

  const Job& job_;
  const ContactTable& contacts_;
  const ContactEnds& ends_;
  const CellGeometry& shared_;
  CellGeometry geometry_;
  PointIndex index_;
  PolygonCutter cutter_;
  FaceArrangement arrangement_;
  std::vector<CutSegment> segments_;
  std::vector<SheetSegment> sheets_;
  /// Per point of the shared geometry: the polygon for which it has a number here, and that one.
  std::vector<uint32_t> stamp_of_;
  RawVector<uint32_t> local_;
  uint32_t stamp_ = 0;
  std::vector<uint32_t> codes_;  ///< per own point, or kNone
};

/// Puts together what came of the parts, with points of the shared geometry.
class PartJoiner {
 public:
  PartJoiner(const Job& job, const ContactTable& contacts, CellGeometry& geometry,
             PointIndex& index)
      : job_(job), contacts_(contacts), geometry_(geometry), index_(index) {}

  CutFaces join(const std::vector<Part>& parts) {
    std::vector<Place> places;
    Place end;
    for (const Part& part : parts) {
      places.push_back(end);
      end.loop += part.loops.loops.size();
      end.corner += part.loops.corner_point.size();
      end.fact += part.loops.facts.size();
      end.face += part.faces.size();
    }
    make_points(parts);
    CutFaces all;
    all.loops.loops.resize(end.loop);
    all.loops.corner_point.resize(end.corner);
    all.loops.corner_plane.resize(end.corner);
    all.loops.facts.resize(end.fact);
    all.faces.resize(end.face);
    for_each_part(parts.size(), kAtOnce, [&](size_t, size_t first, size_t last) {
      for (size_t p = first; p < last; ++p) copy(parts[p], points_[p], places[p], all);
    });
    for (const Part& part : parts) {
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

  void make_points(const std::vector<Part>& parts) {
    std::vector<uint8_t> needs(job_.vertex_count(), 0);
    for_each_part(parts.size(), kAtOnce, [&](size_t, size_t first, size_t last) {
      for (size_t p = first; p < last; ++p) note_needs(parts[p].loops, needs);
    });
    const std::vector<uint32_t> vertices = numbers_where(
        needs.size(), [&](uint32_t v) { return needs[v] != 0 && !geometry_.has_vertex_point(v); });
    size_t count = vertices.size();
    std::vector<size_t> starts;  // of the points of each part
    for (const Part& part : parts) {
      starts.push_back(count);
      count += part.points.size();
    }
    const uint32_t first = geometry_.add_points(count);
    for_each_range(vertices.size(), [&](size_t begin, size_t end) {
      for (size_t i = begin; i < end; ++i) {
        geometry_.set_vertex_point(first + static_cast<uint32_t>(i), vertices[i]);
      }
    });
    points_.resize(parts.size());
    for_each_part(parts.size(), kAtOnce, [&](size_t, size_t begin, size_t end) {
      for (size_t p = begin; p < end; ++p) {
        auto number = first + static_cast<uint32_t>(starts[p]);
        for (const Part::Point& point : parts[p].points) {
          geometry_.set_point(number, point.planes, point.rounded);
          points_[p].push_back(number++);
        }
      }
    });
    make_unique(parts, needs);
  }

  /// Equal points of loose loops get one number.
  void make_unique(const std::vector<Part>& parts, const std::vector<uint8_t>& needs) {
    for (const uint32_t v :
         numbers_where(needs.size(), [&](uint32_t v) { return (needs[v] & kUnique) != 0; })) {
      index_.unique(geometry_.made_vertex_point(v));
    }
    for (size_t p = 0; p < parts.size(); ++p) {
      for (size_t i = 0; i < points_[p].size(); ++i) {
        if (parts[p].points[i].is_loose) points_[p][i] = index_.unique(points_[p][i]);
      }
    }
  }

  void note_needs(const CutLoops& loops, std::vector<uint8_t>& needs) const {
    for (const CutLoops::Loop& loop : loops.loops) {
      for (uint32_t c = loop.first_corner; c < loop.first_corner + loop.corner_count; ++c) {
        const uint32_t code = loops.corner_point[c];
        if (code & kNew || !(code & kVertex)) continue;
        const uint32_t vertex = code & ~kVertex;
        const uint8_t need = is_by_value(vertex, loop.is_loose) ? kPoint | kUnique : kPoint;
        const std::atomic_ref<uint8_t> shared(needs[vertex]);
        if ((shared.load(std::memory_order_relaxed) & need) != need) {
          shared.fetch_or(need, std::memory_order_relaxed);
        }
      }
    }
  }

  void copy(const Part& part, const std::vector<uint32_t>& points, const Place& place,
            CutFaces& all) const {
    const auto at = [](auto& list, size_t first) {
      return list.begin() + static_cast<std::ptrdiff_t>(first);
    };
    const auto moved = [](uint32_t number, size_t by) {
      return number + static_cast<uint32_t>(by);
    };
    for (size_t l = 0; l < part.loops.loops.size(); ++l) {
      CutLoops::Loop loop = part.loops.loops[l];
      for (uint32_t c = loop.first_corner; c < loop.first_corner + loop.corner_count; ++c) {
        all.loops.corner_point[place.corner + c] =
            number(part.loops.corner_point[c], loop.is_loose, points);
      }
      loop.first_corner = moved(loop.first_corner, place.corner);
      loop.first_fact = moved(loop.first_fact, place.fact);
      all.loops.loops[place.loop + l] = loop;
    }
    std::copy(part.loops.corner_plane.begin(), part.loops.corner_plane.end(),
              at(all.loops.corner_plane, place.corner));
    std::copy(part.loops.facts.begin(), part.loops.facts.end(), at(all.loops.facts, place.fact));
    for (size_t f = 0; f < part.faces.size(); ++f) {
      const CutFaces::Face& face = part.faces[f];
      all.faces[place.face + f] = {face.polygon, moved(face.first_loop, place.loop),
                                   moved(face.end_loop, place.loop)};
    }
  }

  [[nodiscard]] uint32_t number(uint32_t code, bool is_loose,
                                const std::vector<uint32_t>& points) const {
    if (code & kNew) return points[code & ~kNew];
    if (!(code & kVertex)) return code;
    const uint32_t vertex = code & ~kVertex, point = geometry_.made_vertex_point(vertex);
    return is_by_value(vertex, is_loose) ? index_.known(point) : point;
  }

  const Job& job_;
  const ContactTable& contacts_;
  CellGeometry& geometry_;
  PointIndex& index_;
  std::vector<std::vector<uint32_t>> points_;  ///< per part: of its new points, in the geometry
};

class FaceCutter {
 public:
  FaceCutter(Job& job, const ContactTable& contacts, ContactEnds& ends, CellGeometry& geometry,
             PointIndex& index, const KernelOptions& options)
      : job_(job),
        contacts_(contacts),
        ends_(ends),
        geometry_(geometry),
        index_(index),
        options_(options) {
    options_.progress = nullptr;
  }

  CutFaces run(std::span<const uint32_t> polygons, EvaluateStats& stats) {
    parts_.resize(part_count(polygons.size(), kPolygonsPerPart));
    make_parts_in_order(
        parts_.size(),
        [&](size_t part) {
          const size_t begin = part * kPolygonsPerPart,
                       end = std::min(polygons.size(), begin + kPolygonsPerPart);
          list(job_, polygons.subspan(begin, end - begin), contacts_, parts_[part]);
        },
        [&](size_t part) {
          for (const uint32_t contact : parts_[part].contacts) ends_.ask(contact);
        });
    ends_.make();
    for (Part& part : parts_) {
      std::erase_if(part.polygons, [&](const Part::Polygon& p) { return stays_whole(p, part); });
    }
    cut_all(&Part::polygons);
    if (std::any_of(parts_.begin(), parts_.end(), [](const Part& p) { return !p.again.empty(); })) {
      cut_all(&Part::again);
    }
    for (const Part& part : parts_) add_signs(stats, part.counters);
    return PartJoiner(job_, contacts_, geometry_, index_).join(parts_);
  }

 private:
  /// Whether nothing cuts a polygon, and one of its corners tells what becomes of it.
  [[nodiscard]] bool stays_whole(const Part::Polygon& polygon, const Part& part) const {
    for (uint32_t i = polygon.first_contact; i < polygon.end_contact; ++i) {
      const auto& [lower, upper] = ends_.of(part.contacts[i]);
      if (lower != upper) return false;
    }
    const auto corners = job_.corners(job_.polygons()[polygon.number]);
    return std::any_of(corners.begin(), corners.end(),
                       [&](uint32_t v) { return !contacts_.touched()[v]; });
  }

  using List = std::vector<Part::Polygon> Part::*;

  /// All planes of those polygons in the lists of the parts that are cut by value, and of what is
  /// coplanar with them.
  void make_planes(List list) {
    std::vector<uint32_t> polygons;
    for (const Part& part : parts_) {
      for (const Part::Polygon& p : part.*list) {
        if (p.is_plain) continue;
        polygons.push_back(p.number);
        polygons.insert(polygons.end(), part.coplanar.begin() + p.first_coplanar,
                        part.coplanar.begin() + p.end_coplanar);
      }
    }
    job_.ensure_planes(polygons);
  }

  void cut_all(List list) {
    make_planes(list);
    for_each_run(
        parts_.size(), options_, [&] { return Worker(job_, contacts_, ends_, geometry_); },
        [&](Worker& worker, size_t run) {
          const SignCounters before = worker.counters();
          for (const Part::Polygon& polygon : parts_[run].*list) {
            if (options_.cancel && options_.cancel->load(std::memory_order_relaxed)) break;
            worker.cut(polygon, parts_[run]);
          }
          SignCounters own = worker.counters();
          own.subtract(before);
          parts_[run].counters.add(own);
        });
  }

  Job& job_;
  const ContactTable& contacts_;
  ContactEnds& ends_;
  CellGeometry& geometry_;
  PointIndex& index_;
  KernelOptions options_;
  std::vector<Part> parts_;
};

}  // namespace

CutFaces cut_faces(Job& job, std::span<const uint32_t> polygons, const ContactTable& contacts,
                   ContactEnds& ends, CellGeometry& geometry, PointIndex& index,
                   const KernelOptions& options, EvaluateStats& stats) {
  return FaceCutter(job, contacts, ends, geometry, index, options).run(polygons, stats);
}

}  // namespace csgrun
