#include "engine/bsp/cut_faces.h"

#include <algorithm>
#include <atomic>

#include "engine/base/parallel.h"
#include "engine/base/raw_vector.h"
#include "engine/bsp/cut_parts.h"
#include "engine/bsp/face_arrangement.h"
#include "engine/bsp/own_points.h"
#include "engine/bsp/parallel_runs.h"
#include "engine/bsp/sign_stats.h"

namespace csgrun {
namespace {

/// Polygons and their contacts, so many of both, are cut by one thread, if they are not of one
/// polygon.
constexpr size_t kWorkPerPart = 2048;

/// Lists what is on polygons.
void list(const Job& job, std::span<const uint32_t> polygons, const ContactTable& contacts,
          CutPart& part) {
  std::vector<uint32_t> flat;  // convex operands with a face in the polygon's plane
  part.polygons.reserve(polygons.size());
  for (const uint32_t p : polygons) {
    CutPart::Polygon& polygon = part.polygons.emplace_back();
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
    std::sort(flat.begin(), flat.end());
    for (const uint32_t i : contacts.of(p)) {
      const Contact& c = contacts[i];
      if (c.is_coplanar) continue;
      if (!flat.empty() && std::binary_search(flat.begin(), flat.end(), operand(c))) continue;
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
         std::span<const uint8_t> is_open, const CellGeometry& shared, const PointIndex& index)
      : job_(job),
        contacts_(contacts),
        ends_(ends),
        geometry_(job.planes(), &job),
        points_(shared, index, geometry_),
        cutter_(job, geometry_, is_open),
        arrangement_(job, geometry_, points_, contacts.touched(), is_open) {}

  /// Cuts polygons of a part: calls work(), which calls cut() for each. What is made of them is put
  /// together in memory of this thread's, which grows once, and the part has a copy without room to
  /// grow: threads wait for one another where they ask for memory.
  template <class Work>
  void cut_in(CutPart& part, Work&& work) {
    made_ = part.made;
    work();
    part.made = made_;
  }
  /// Cuts by name, or by value, for which the planes must have been made.
  void cut(const CutPart::Polygon& polygon, CutPart& part) {
    geometry_.clear();
    points_.clear();
    codes_.clear();
    CutLoops& loops = made_.loops;
    const auto first_loop = static_cast<uint32_t>(loops.loops.size());
    const size_t first_corner = loops.corner_point.size();
    bool is_done = false;
    if (polygon.is_plain) {
      list_segments(polygon, part);
      is_done = cutter_.cut(polygon.number, segments_, loops);
      if (!is_done) {
        part.again.push_back(polygon);
        part.again.back().is_plain = false;
        return;
      }
    } else {
      list_sheets(polygon, part);
      is_done = arrangement_.build(polygon.number, sheets_, coplanar(polygon, part), loops);
      part.by_value.push_back(polygon.number);
    }
    if (!is_done) {
      part.left.push_back(polygon.number);
      return;
    }
    for (size_t c = first_corner; c < loops.corner_point.size(); ++c) {
      loops.corner_point[c] = code(loops.corner_point[c], !polygon.is_plain);
    }
    made_.faces.push_back({polygon.number, first_loop, static_cast<uint32_t>(loops.loops.size())});
  }

  /// See FaceArrangement.
  uint64_t count_coplanar_crossings(const CutPart::Polygon& polygon, const CutPart& part) {
    geometry_.clear();
    points_.clear();
    return arrangement_.count_coplanar_crossings(polygon.number, coplanar(polygon, part));
  }

  [[nodiscard]] const SignCounters& counters() const { return geometry_.counters; }
  [[nodiscard]] uint64_t crowding() const { return arrangement_.crowding(); }

 private:
  static std::span<const uint32_t> coplanar(const CutPart::Polygon& polygon, const CutPart& part) {
    return {part.coplanar.data() + polygon.first_coplanar,
            polygon.end_coplanar - polygon.first_coplanar};
  }

  /// Calls add(contact, whether the polygon is its p, start, end) for the segments on a polygon.
  template <class Add>
  void for_each_segment(const CutPart::Polygon& polygon, const CutPart& part, Add&& add) {
    for (uint32_t i = polygon.first_contact; i < polygon.end_contact; ++i) {
      const Contact& c = contacts_[part.contacts[i]];
      const auto& [lower, upper] = ends_.of(part.contacts[i]);
      if (lower == upper) continue;
      const bool is_p = c.p == polygon.number;
      add(c, is_p, points_.of(is_p ? lower : upper), points_.of(is_p ? upper : lower));
    }
  }
  void list_segments(const CutPart::Polygon& polygon, const CutPart& part) {
    segments_.clear();
    for_each_segment(polygon, part, [&](const Contact& c, bool is_p, uint32_t from, uint32_t to) {
      const auto edge = [&](const Contact::End& e) { return e.on_p == is_p ? e.edge : kNone; };
      segments_.push_back({from, to, is_p ? c.q : c.p, edge(is_p ? c.lower : c.upper),
                           edge(is_p ? c.upper : c.lower)});
    });
  }
  void list_sheets(const CutPart::Polygon& polygon, const CutPart& part) {
    sheets_.clear();
    for_each_segment(polygon, part, [&](const Contact& c, bool is_p, uint32_t from, uint32_t to) {
      sheets_.push_back(
          {from, to, is_p ? c.q : c.p, is_p ? c.q_front : c.p_front, is_p ? c.q_back : c.p_back});
    });
  }

  /// What stands for a point in the loops of a part.
  uint32_t code(uint32_t own, bool is_loose) {
    if (own >= codes_.size()) codes_.resize(geometry_.point_count(), kNone);
    uint32_t& code = codes_[own];
    if (code != kNone) return code;
    if (const uint32_t shared = points_.shared_of(own); shared != kNone) return code = shared;
    const CellGeometry::StoredPoint& s = geometry_.point(own);
    if (s.vertex != kNone) return code = CutPart::kVertex | s.vertex;
    made_.points.push_back({s.rounded, s.planes, is_loose});
    return code = CutPart::kNew | static_cast<uint32_t>(made_.points.size() - 1);
  }

  const Job& job_;
  const ContactTable& contacts_;
  const ContactEnds& ends_;
  CellGeometry geometry_;
  OwnPoints points_;
  PolygonCutter cutter_;
  FaceArrangement arrangement_;
  CutPart::Made made_;  ///< of the part at hand
  std::vector<CutSegment> segments_;
  std::vector<SheetSegment> sheets_;
  std::vector<uint32_t> codes_;  ///< per own point, or kNone
};

class FaceCutter {
 public:
  FaceCutter(Job& job, const ContactTable& contacts, ContactEnds& ends,
             std::span<const uint8_t> is_open, CellGeometry& geometry, PointIndex& index,
             const KernelOptions& options)
      : job_(job),
        contacts_(contacts),
        ends_(ends),
        is_open_(is_open),
        geometry_(geometry),
        index_(index),
        options_(options) {
    options_.progress = nullptr;
  }

  CutFaces run(std::span<const uint32_t> polygons, std::span<const uint32_t> with_planes,
               EvaluateStats& stats) {
    const std::vector<uint32_t> contacts = list_parts(polygons);
    ends_.ask_vertices(contacts);
    run_both(
        contacts.size() > kFewForThreads, [&] { job_.ensure_supports(with_planes); },
        [&] { ends_.ask_crossings(contacts); });
    if (options_.stop_when_crowded && will_be_crowded()) return crowded();
    ends_.make();
    for (CutPart& part : parts_) {
      std::erase_if(part.polygons, [&](const CutPart::Polygon& p) { return stays_whole(p, part); });
    }
    cut_all(&CutPart::polygons);
    if (std::any_of(parts_.begin(), parts_.end(),
                    [](const CutPart& p) { return !p.again.empty(); })) {
      cut_all(&CutPart::again);
    }
    for (const CutPart& part : parts_) add_signs(stats, part.counters);
    if (is_crowded()) return crowded();
    return join_parts(job_, contacts_, parts_, geometry_, index_);
  }

 private:
  /// Divides polygons among parts. Returns the contacts of all that are not coplanar and matter, as
  /// polygons have them: points that are made in this order are near those of neighbours.
  std::vector<uint32_t> list_parts(std::span<const uint32_t> polygons) {
    const std::vector<size_t> starts = part_starts(polygons.size(), kWorkPerPart, [&](size_t i) {
      return 1 + contacts_.of(polygons[i]).size();
    });
    parts_.resize(starts.size() - 1);
    for_each_alone(parts_.size(), true, [&](size_t part) {
      const size_t count = starts[part + 1] - starts[part];
      list(job_, polygons.subspan(starts[part], count), contacts_, parts_[part]);
    });
    std::vector<uint32_t> listed;
    std::vector<uint8_t> is_listed(contacts_.all().size(), 0);
    for (const CutPart& part : parts_) {
      for (const uint32_t contact : part.contacts) {
        if (!std::exchange(is_listed[contact], 1)) listed.push_back(contact);
      }
    }
    return listed;
  }

  /// Whether so many coplanar polygons overlap that operands should rather be evaluated in groups.
  /// What was counted only grows, so that it makes no difference when somebody asks.
  [[nodiscard]] bool is_crowded() const {
    return options_.stop_when_crowded &&
           crowding_.load(std::memory_order_relaxed) > most_crowding();
  }
  /// Where groups begin to take less time than one job: those of spokes soon, those of operands
  /// that are scattered late. Results of groups take longer than leaves.
  [[nodiscard]] uint64_t most_crowding() const {
    constexpr uint64_t kFew = 20000, kMostEach = 768, kMostEachOfCrowd = 32;
    const uint64_t each = options_.is_of_crowd ? kMostEachOfCrowd : kMostEach;
    return std::max<uint64_t>(kFew, each * job_.polygons().size());
  }
  static CutFaces crowded() {
    CutFaces none;
    none.is_crowded = true;
    return none;
  }

  static size_t coplanar_count(const CutPart::Polygon& p) {
    return p.end_coplanar - p.first_coplanar;
  }
  /// Calls visit(polygon, part) for all of them.
  template <class Visit>
  void for_each_polygon(Visit&& visit) const {
    for (const CutPart& part : parts_) {
      for (const CutPart::Polygon& p : part.polygons) visit(p, part);
    }
  }

  /// Whether far too many overlap, told before any is cut, from the one that most are coplanar
  /// with: what crowds a polygon grows with the cube of their number.
  bool will_be_crowded() {
    constexpr size_t kFew = 4;
    constexpr double kSure = 2;  // the estimate is 0.5 to 2.3 times what will be counted
    const CutPart::Polygon* most = nullptr;
    const CutPart* its_part = nullptr;
    for_each_polygon([&](const CutPart::Polygon& p, const CutPart& part) {
      if (most && coplanar_count(p) <= coplanar_count(*most)) return;
      most = &p;
      its_part = &part;
    });
    if (!most || coplanar_count(*most) <= kFew) return false;
    double alike = 0;
    for_each_polygon([&](const CutPart::Polygon& p, const CutPart&) {
      const double share =
          static_cast<double>(coplanar_count(p)) / static_cast<double>(coplanar_count(*most));
      alike += share * share * share;
    });
    const std::span<const uint32_t> coplanar{its_part->coplanar.data() + most->first_coplanar,
                                             coplanar_count(*most)};
    std::vector<uint32_t> polygons(coplanar.begin(), coplanar.end()), operands;
    for (const uint32_t q : coplanar) operands.push_back(job_.polygons()[q].operand);
    std::sort(operands.begin(), operands.end());
    operands.erase(std::unique(operands.begin(), operands.end()), operands.end());
    polygons.push_back(most->number);
    job_.ensure_planes(polygons);
    Worker worker(job_, contacts_, ends_, is_open_, geometry_, index_);
    const uint64_t crossings = worker.count_coplanar_crossings(*most, *its_part);
    return alike * static_cast<double>(crossings) * static_cast<double>(operands.size()) >
           kSure * static_cast<double>(most_crowding());
  }

  /// Whether nothing cuts a polygon, and one of its corners tells what becomes of it.
  [[nodiscard]] bool stays_whole(const CutPart::Polygon& polygon, const CutPart& part) const {
    for (uint32_t i = polygon.first_contact; i < polygon.end_contact; ++i) {
      const auto& [lower, upper] = ends_.of(part.contacts[i]);
      if (lower != upper) return false;
    }
    const auto corners = job_.corners(job_.polygons()[polygon.number]);
    return std::any_of(corners.begin(), corners.end(),
                       [&](uint32_t v) { return !contacts_.touched()[v]; });
  }

  using List = std::vector<CutPart::Polygon> CutPart::*;

  /// All planes of those polygons in the lists of the parts that are cut by value, and of what is
  /// coplanar with them.
  void make_planes(List list) {
    std::vector<uint32_t> polygons;
    for (const CutPart& part : parts_) {
      for (const CutPart::Polygon& p : part.*list) {
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
        parts_.size(), options_,
        [&] { return Worker(job_, contacts_, ends_, is_open_, geometry_, index_); },
        [&](Worker& worker, size_t run) {
          const SignCounters before = worker.counters();
          worker.cut_in(parts_[run], [&] { cut_part(parts_[run], list, worker); });
          SignCounters own = worker.counters();
          own.subtract(before);
          parts_[run].counters.add(own);
        });
  }

  void cut_part(CutPart& part, List list, Worker& worker) {
    for (const CutPart::Polygon& polygon : part.*list) {
      if (options_.cancel && options_.cancel->load(std::memory_order_relaxed)) break;
      if (is_crowded()) break;
      const uint64_t crowding = worker.crowding();
      worker.cut(polygon, part);
      crowding_.fetch_add(worker.crowding() - crowding, std::memory_order_relaxed);
    }
  }

  Job& job_;
  const ContactTable& contacts_;
  ContactEnds& ends_;
  const std::span<const uint8_t> is_open_;
  CellGeometry& geometry_;
  PointIndex& index_;
  KernelOptions options_;
  std::vector<CutPart> parts_;
  std::atomic<uint64_t> crowding_ = 0;
};

}  // namespace

CutFaces cut_faces(Job& job, std::span<const uint32_t> polygons,
                   std::span<const uint32_t> with_planes, const ContactTable& contacts,
                   ContactEnds& ends, std::span<const uint8_t> is_open, CellGeometry& geometry,
                   PointIndex& index, const KernelOptions& options, EvaluateStats& stats) {
  return FaceCutter(job, contacts, ends, is_open, geometry, index, options)
      .run(polygons, with_planes, stats);
}

}  // namespace csgrun
