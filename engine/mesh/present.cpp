#include "engine/mesh/present.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <functional>
#include <numeric>
#include <optional>
#include <unordered_map>
#include <utility>

#include "engine/base/parallel.h"
#include "engine/base/sort_few.h"
#include "engine/mesh/canonical_hash.h"
#include "engine/mesh/conform.h"
#include "engine/mesh/cut_contacts.h"
#include "engine/mesh/divide_edges.h"
#include "engine/mesh/measure.h"
#include "engine/mesh/merge_faces.h"
#include "engine/mesh/near_contacts.h"
#include "engine/mesh/part_faces.h"
#include "engine/mesh/self_contact.h"
#include "engine/mesh/t_junctions.h"
#include "engine/mesh/to_millimetres.h"
#include "engine/mesh/triangle_normals.h"
#include "engine/mesh/triangulate_faces.h"
#include "engine/mesh/vertex_fans.h"
#include "engine/mesh/whole_order.h"

namespace csgrun {
namespace {

Error not_closed(const char* where) {
  return {ErrorCode::kInternal,
          std::string("the boundary of a result is not closed (") + where + ")",
          {}};
}

/// Connected surfaces and the sum of their genera, from V - E + F = 2 (components - genus).
void count_topology(Solid& solid) {
  std::vector<uint32_t> parent(solid.positions.size());
  std::iota(parent.begin(), parent.end(), 0u);
  const auto root = [&](uint32_t v) {
    while (parent[v] != v) v = parent[v] = parent[parent[v]];
    return v;
  };
  int64_t components = static_cast<int64_t>(parent.size());
  for (const auto& t : solid.triangles) {
    for (int k = 1; k < 3; ++k) {
      const uint32_t a = root(t[0]), b = root(t[k]);
      if (a != b) parent[std::max(a, b)] = std::min(a, b), --components;
    }
  }
  const auto triangles = static_cast<int64_t>(solid.triangles.size());
  const auto euler = static_cast<int64_t>(parent.size()) - triangles * 3 / 2 + triangles;
  solid.measures.components = components;
  solid.measures.genus = components - euler / 2;
}

/// Whether a point is exactly one of the grid. `near`: its coordinates, correctly rounded.
bool is_whole(const Point& p, const std::array<double, 3>& near) {
  if (p.w_bits == 1) return true;
  for (const double x : near) {
    if (std::fabs(x) >= 0x1p62 || x != std::trunc(x)) return false;
  }
  const auto whole = [&](int i) { return static_cast<int64_t>(near[i]); };
  return compare(p, grid_point(whole(0), whole(1), whole(2))) == 0;
}

/// Finds the corners of triangles that edges leave, by the ends of the edges.
class EdgeCorners {
 public:
  void clear() { all_.clear(); }
  /// Corners are added in ascending order.
  void add(uint32_t from, uint32_t to, uint32_t corner) {
    all_.push_back({together(from, to), corner});
  }
  /// To be called after the last add().
  void prepare() {
    if (all_.size() <= kFew) return;
    slots_.assign(std::bit_ceil(2 * all_.size()), kNone);
    shift_ = 64 - std::countr_zero(slots_.size());
    for (uint32_t i = 0; i < all_.size(); ++i) {
      uint32_t& slot = slots_[slot_of(all_[i].ends)];
      if (slot == kNone) slot = i;
    }
  }
  /// The lowest one. REQUIRES: there is one.
  [[nodiscard]] uint32_t find(uint32_t from, uint32_t to) const {
    const uint64_t ends = together(from, to);
    if (all_.size() > kFew) return all_[slots_[slot_of(ends)]].corner;
    return std::find_if(all_.begin(), all_.end(), [&](const Edge& e) { return e.ends == ends; })
        ->corner;
  }

 private:
  /// Of so many, all are looked at sooner than hashed.
  static constexpr size_t kFew = 36;
  struct Edge {
    uint64_t ends;
    uint32_t corner;
  };
  /// The slot of these ends, or an empty one: half of them are.
  [[nodiscard]] size_t slot_of(uint64_t ends) const {
    size_t at = ends * 0x9fb21c651e98df25ull >> shift_;
    while (slots_[at] != kNone && all_[slots_[at]].ends != ends) {
      at = (at + 1) & (slots_.size() - 1);
    }
    return at;
  }

  std::vector<Edge> all_;
  std::vector<uint32_t> slots_;  ///< numbers in all_: the lowest of equal ends
  int shift_ = 0;
};

class Presenter {
 public:
  Presenter(const BoundaryMesh& boundary, const PresentContext& context)
      : boundary_(boundary), context_(context), to_mm_(context.step), geometry_(planes_, nullptr) {}

  Result<SolidPtr> run() {
    const bool is_large = boundary_.faces.size() > kFewForThreads;
    run_both(
        is_large, [&] { planes_.adopt(boundary_.planes); },
        [&] {
          const auto count = static_cast<uint32_t>(boundary_.point_planes.size());
          geometry_.add_points(count);
          for (uint32_t p = 0; p < count; ++p) {
            geometry_.set_point(p, boundary_.point_planes[p], boundary_.point_rounded[p]);
          }
        });
    for_each_range(geometry_.point_count(), [&](size_t begin, size_t end) {
      for (size_t p = begin; p < end; ++p) geometry_.find_on_grid(static_cast<uint32_t>(p));
    });
    bool is_merged = false;
    run_both(
        is_large, [&] { whole_.emplace(boundary_, geometry_); },
        [&] { is_merged = merge_faces(boundary_, geometry_, planes_, faces_); });
    if (!is_merged) return not_closed("faces");
    if (is_cancelled()) return cancelled();
    const WholeOrder& whole = *whole_;
    std::vector<LowestEdge> lowest = lowest_edges();
    std::vector<uint32_t> near;
    if (boundary_.may_touch) near = faces_near(boundary_.touches, faces_, geometry_);
    break_at_own_corners(faces_, near, geometry_);
    if (!resolve_t_junctions(faces_, geometry_, planes_, whole)) return not_closed("edges");
    if (!near.empty() && cut_at_contacts(faces_, near, geometry_, planes_)) {
      lowest = lowest_edges();
      near = faces_near(boundary_.touches, faces_, geometry_);
      break_at_own_corners(faces_, near, geometry_);
      if (!resolve_t_junctions(faces_, geometry_, planes_, whole)) return not_closed("cut edges");
    }
    whole_->order_faces(lowest);
    auto solid = std::make_shared<Solid>();
    if (context_.measuring >= Measuring::kButTheCentre) {
      solid->canonical_hash = canonical_hash(faces_, whole, boundary_, geometry_, context_);
    }
    if (!near.empty()) conform_contacts(faces_, near, geometry_, planes_);
    if (is_cancelled()) return cancelled();
    if (auto status = triangulate_all(); !status) return status.error();
    if (is_cancelled()) return cancelled();
    if (auto status = make_vertices(); !status) return status.error();
    fill(*solid);
    if (context_.measuring >= Measuring::kTopology) count_topology(*solid);
    if (is_cancelled()) return cancelled();
    if (context_.measuring >= Measuring::kButTheCentre) {
      if (auto status = measure(*solid); !status) return status.error();
    }
    return SolidPtr(std::move(solid));
  }

 private:
  [[nodiscard]] bool is_cancelled() const {
    return context_.cancel && context_.cancel->load(std::memory_order_relaxed);
  }
  static Error cancelled() { return {ErrorCode::kCancelled, "the evaluation was cancelled", {}}; }

  /// By which the faces are sorted now.
  [[nodiscard]] std::vector<LowestEdge> lowest_edges() const {
    std::vector<LowestEdge> lowest;
    lowest.reserve(faces_.size());
    for (const MergedFace& f : faces_) lowest.push_back({f.loops[0][0].from, f.loops[0][0].to});
    return lowest;
  }

  Status make_vertices() {
    const ContactRule contacts =
        context_.join_contacts ? ContactRule::kJoin : ContactRule::kSeparate;
    // Solids that are joined along an edge have it twice, mostly between the same two vertices:
    // with points in the middle the two are apart.
    std::vector<std::array<uint32_t, 2>> doubled;
    while (context_.join_contacts) {
      if (!split_fans(set_, faces_, geometry_, planes_, *whole_, contacts, fans_, &doubled)) break;
      if (doubled.empty() || !divide_edges(faces_, geometry_, planes_, doubled)) break;
      if (auto status = triangulate_all(); !status) return status.error();
    }
    if (!split_fans(set_, faces_, geometry_, planes_, *whole_, contacts, fans_))
      return not_closed("vertices");
    return std::monostate();
  }

  Status triangulate_all() {
    auto set = triangulate_faces(faces_, geometry_, planes_, boundary_.point_planes.size());
    if (!set) return set.error();
    set_ = std::move(*set);
    return std::monostate();
  }

  void fill(Solid& solid) {
    fill_vertices(solid);
    fill_faces(solid);
    if (fans_.were_parted) part_faces(solid);
    solid.appearances = context_.appearances;
  }

  /// How many vertices come before a place in the order of points: of untouched triangles, and of
  /// explicit faces.
  struct VertexCount {
    size_t untouched = 0, own = 0;
  };

  /// Vertices in the order of points, several of one point in the order of their triangles.
  void fill_vertices(Solid& solid) {
    const size_t points = whole_->points().size();
    // The texts of points are appended one after another.
    const size_t each = context_.exact_points ? std::max<size_t>(1, points) : kFewForThreads;
    const size_t parts = part_count(points, each);
    // What comes before each part, and at last before points that were made since.
    std::vector<VertexCount> starts(parts + 1);
    for_each_part(points, each, [&](size_t part, size_t begin, size_t end) {
      starts[part] = count_vertices(begin, end);
    });
    starts[parts].own = first_own(static_cast<uint32_t>(boundary_.point_planes.size()));
    size_t untouched = 0;
    for (VertexCount& count : starts) untouched += std::exchange(count.untouched, untouched);
    for (size_t part = parts; part-- > 0;) {
      starts[part].own = std::min(starts[part].own, starts[part + 1].own);
    }
    const size_t all = fans_.point_of_vertex.size() + untouched;
    run_both(
        all > kFewForThreads, [&] { solid.positions.resize(all); },
        [&] {
          solid.positions_f32.resize(all);
          solid.point_of.resize(all);
          solid.on_grid.assign(all, 1);
        });
    first_vertex_.resize(points);
    number_of_own_.resize(fans_.point_of_vertex.size());
    for_each_part(points, each, [&](size_t part, size_t begin, size_t end) {
      fill_vertices(solid, starts[part], begin, end);
    });
    // Points that were made since: contacts and middles of edges.
    VertexCount count = starts[parts];
    for (size_t n = points; count.own < number_of_own_.size(); ++n) {
      add_own(solid, count, static_cast<uint32_t>(n));
    }
  }

  /// The first vertex of explicit faces at an explicit point, or after it.
  [[nodiscard]] size_t first_own(uint32_t explicit_point) const {
    const std::vector<uint32_t>& all = fans_.point_of_vertex;
    return std::lower_bound(all.begin(), all.end(), explicit_point) - all.begin();
  }

  /// The untouched ones at points [begin, end), and the first of the others from there on.
  [[nodiscard]] VertexCount count_vertices(size_t begin, size_t end) const {
    VertexCount count{0, SIZE_MAX};
    for (size_t n = begin; n < end; ++n) {
      const uint32_t p = whole_->points()[n].explicit_point;
      count.untouched += p == kNone;
      if (p != kNone && count.own == SIZE_MAX) count.own = first_own(p);
    }
    return count;
  }

  void fill_vertices(Solid& solid, VertexCount count, size_t begin, size_t end) {
    for (auto n = static_cast<uint32_t>(begin); n < end; ++n) {
      const size_t at = count.untouched + count.own;
      first_vertex_[n] = static_cast<uint32_t>(at);
      const WholeOrder::Place& place = whole_->points()[n];
      const uint32_t p = place.explicit_point;
      if (p != kNone) {
        const std::vector<uint32_t>& point_of_own = fans_.point_of_vertex;
        if (count.own < point_of_own.size() && point_of_own[count.own] == p) {
          add_own(solid, count, n);
        }
        continue;
      }
      const UntouchedPart& part = whole_->part(place);
      const uint32_t v = place.vertex;
      if (part.map.is_identity()) {
        to_mm_.position(part.vertex(v), solid.positions[at], solid.positions_f32[at]);
      } else {
        const Point point = part.point(v);
        to_mm_.position(point, solid.positions[at], solid.positions_f32[at]);
        solid.on_grid[at] = is_whole(point, part.rounded_point(v)) ? 1 : 0;
      }
      solid.point_of[at] = n;
      ++count.untouched;
      if (context_.exact_points) {
        solid.exact_points.resize(n + size_t{1});
        solid.exact_points[n] = to_mm_.text(part.point(v));
      }
    }
  }

  /// All explicit vertices of the point that comes next.
  void add_own(Solid& solid, VertexCount& count, uint32_t number) {
    const std::vector<uint32_t>& point_of_own = fans_.point_of_vertex;
    const uint32_t p = point_of_own[count.own];
    glm::dvec3 mm;
    std::array<float, 3> single;
    bool whole = geometry_.is_found_on_grid(p);
    if (whole) {
      to_mm_.position(geometry_.point(p).on_grid(), mm, single);
    } else {
      const Point exact = geometry_.value(p);
      to_mm_.position(exact, mm, single);
      whole = is_whole(exact, geometry_.point(p).rounded);
    }
    for (; count.own < point_of_own.size() && point_of_own[count.own] == p; ++count.own) {
      const size_t at = count.untouched + count.own;
      number_of_own_[count.own] = static_cast<uint32_t>(at);
      solid.positions[at] = mm;
      solid.positions_f32[at] = single;
      solid.point_of[at] = number;
      solid.on_grid[at] = whole ? 1 : 0;
    }
    if (context_.exact_points) {
      solid.exact_points.resize(number + size_t{1});
      solid.exact_points[number] = to_mm_.text(geometry_.value(p));
    }
  }

  /// Where what comes next goes in the arrays of faces.
  struct FacePlace {
    size_t triangle = 0, loop = 0, corner = 0;
  };

  /// The label, but for the facet, that all faces of a leaf have, if they do.
  static std::optional<FaceLabel> common_label(const UntouchedPart& part) {
    if (!part.leaf->surface.common()) return std::nullopt;
    if (!part.appearance && !part.leaf->appearance.common()) return std::nullopt;
    return part.label(0);
  }

  /// Triangles of explicit faces stand in the order of faces, and so do these faces in the whole.
  void fill_faces(Solid& solid) {
    const uint32_t own_count = whole_->explicit_face_count();
    const size_t count = whole_->faces().size();
    common_labels_.resize(boundary_.parts.size());
    for_each_alone(boundary_.parts.size(), count > kFewForThreads,
                   [&](size_t p) { common_labels_[p] = common_label(boundary_.parts[p]); });
    // Where each explicit face begins, were there no others.
    std::vector<FacePlace> own(own_count + size_t{1});
    const auto place_own = [&] {
      for (uint32_t f = 0; f < own_count; ++f) {
        FacePlace& next = own[f + 1];
        next = own[f];
        while (next.triangle < set_.face.size() && set_.face[next.triangle] == f) ++next.triangle;
        next.loop += faces_[f].loops.size();
        for (const auto& loop : faces_[f].loops) next.corner += loop.size();
      }
    };
    const size_t parts = part_count(count, kFewForThreads);
    std::vector<uint32_t> own_before(parts + 1, 0);
    const auto count_own = [&] {
      for_each_part(count, kFewForThreads, [&](size_t part, size_t begin, size_t end) {
        own_before[part + 1] = static_cast<uint32_t>(
            std::count_if(whole_->faces().begin() + begin, whole_->faces().begin() + end,
                          [&](uint32_t f) { return f < own_count; }));
      });
    };
    run_both(count > kFewForThreads, place_own, count_own);
    for (size_t part = 0; part < parts; ++part) own_before[part + 1] += own_before[part];
    const size_t others = count - own_count, triangles = own[own_count].triangle + others;
    // Fresh memory takes time, about as much in either half.
    run_both(
        count > kFewForThreads,
        [&] {
          solid.triangles.resize(triangles);
          solid.triangle_face.resize(triangles);
          solid.faces.resize(count);
        },
        [&] {
          solid.face_normals.resize(count);
          solid.loop_starts.resize(own[own_count].loop + others + 1);
          solid.loop_vertices.resize(own[own_count].corner + 3 * others);
        });
    for_each_part(count, kFewForThreads, [&](size_t part, size_t begin, size_t end) {
      uint32_t next_own = own_before[part];
      EdgeCorners edges;
      for (size_t n = begin; n < end; ++n) {
        fetch_ahead(n);
        const uint32_t f = whole_->faces()[n];
        const size_t before = n - next_own;  // untouched ones
        const FacePlace& first = own[next_own];
        const FacePlace at{first.triangle + before, first.loop + before, first.corner + 3 * before};
        if (f < own_count) {
          add_face(solid, f, first.triangle, at, static_cast<uint32_t>(n), edges);
          ++next_own;
        } else {
          add_untouched(solid, f, at, static_cast<uint32_t>(n));
        }
      }
    });
    number_surfaces(solid);
  }

  /// Asks for the memory of a face that comes soon: in their order they stand anywhere.
  void fetch_ahead(size_t n) const {
    constexpr size_t kAhead = 16;
    const std::vector<uint32_t>& faces = whole_->faces();
    if (n + kAhead >= faces.size()) return;
    const uint32_t f = faces[n + kAhead];
    if (f < whole_->explicit_face_count()) return;
    __builtin_prefetch(&whole_->triangle(f));
    __builtin_prefetch(&whole_->direction(f));
  }

  /// An explicit face and its triangles, from number t on. `edges` is working memory.
  void add_face(Solid& solid, uint32_t f, size_t t, FacePlace at, uint32_t number,
                EdgeCorners& edges) const {
    const auto vertex = [&](size_t corner) {
      return number_of_own_[fans_.vertex_of_corner[corner]];
    };
    // Vertices of loops: those of the triangle that has the loop's edge.
    edges.clear();
    for (; t < set_.triangles.size() && set_.face[t] == f; ++t, ++at.triangle) {
      solid.triangles[at.triangle] = {vertex(3 * t), vertex(3 * t + 1), vertex(3 * t + 2)};
      solid.triangle_face[at.triangle] = number;
      for (uint32_t k = 0; k < 3; ++k) {
        edges.add(set_.triangles[t][k], set_.triangles[t][(k + 1) % 3],
                  static_cast<uint32_t>(3 * t + k));
      }
    }
    edges.prepare();
    const MergedFace& face = faces_[f];
    solid.faces[number] = {static_cast<uint32_t>(at.loop), static_cast<uint32_t>(face.loops.size()),
                           face.appearance, face.surface, face.source};
    solid.face_normals[number] = direction(planes_.oriented(face.plane));
    for (const auto& loop : face.loops) {
      for (const DirectedEdge& e : loop) {
        solid.loop_vertices[at.corner++] = vertex(edges.find(e.from, e.to));
      }
      solid.loop_starts[++at.loop] = static_cast<uint32_t>(at.corner);
    }
  }

  void add_untouched(Solid& solid, uint32_t f, const FacePlace& at, uint32_t number) const {
    const UntouchedTriangle& t = whole_->triangle(f);
    const std::array<uint32_t, 3> vertices{first_vertex_[t.points[0]], first_vertex_[t.points[1]],
                                           first_vertex_[t.points[2]]};
    solid.triangles[at.triangle] = vertices;
    solid.triangle_face[at.triangle] = number;
    const std::optional<FaceLabel>& common = common_labels_[t.part];
    const FaceLabel label = common ? *common : boundary_.parts[t.part].label(t.face);
    solid.faces[number] = {static_cast<uint32_t>(at.loop), 1, label.appearance, label.surface,
                           label.source};
    solid.face_normals[number] = whole_->direction(f);
    std::copy(vertices.begin(), vertices.end(), solid.loop_vertices.begin() + at.corner);
    solid.loop_starts[at.loop + 1] = static_cast<uint32_t>(at.corner + 3);
  }

  /// Curved surfaces are numbered from 1 in the order of their first faces.
  static void number_surfaces(Solid& solid) {
    std::unordered_map<uint64_t, uint32_t> numbers;  // of the surfaces of each source
    uint64_t last = 0;
    uint32_t number = 0;
    for (Solid::Face& face : solid.faces) {
      if (face.surface == 0) continue;
      const uint64_t key = uint64_t{face.source} << 32 | face.surface;
      if (key != last) {
        number = numbers.try_emplace(key, static_cast<uint32_t>(numbers.size()) + 1).first->second;
        last = key;
      }
      face.surface = number;
    }
  }

  Status measure(Solid& solid) {
    if (solid.empty()) return std::monostate();
    // By vertex: several may be one point.
    const auto point = [&](uint32_t vertex) {
      const uint32_t number = solid.point_of[vertex];
      if (number >= whole_->points().size()) return geometry_.exact(own_point(vertex));
      const WholeOrder::Place& place = whole_->points()[number];
      if (place.explicit_point != kNone) return geometry_.exact(place.explicit_point);
      return whole_->part(place).point(place.vertex);
    };
    const Wanted wanted =
        context_.measuring == Measuring::kAll ? Wanted::kAll : Wanted::kVolumeAndArea;
    auto mass = measure_mesh(solid.positions.size(), point, solid.triangles, context_.step, wanted);
    if (!mass) return mass.error();
    Measures& m = solid.measures;
    m.volume = mass->volume;
    m.area = mass->area;
    m.centroid = mass->centroid;
    // Rounding is monotone: the box of the rounded positions is the rounded box.
    m.bbox = {solid.positions[0], solid.positions[0]};
    for (const glm::dvec3& p : solid.positions) {
      for (int k = 0; k < 3; ++k) {
        m.bbox[0][k] = std::min(m.bbox[0][k], p[k]);
        m.bbox[1][k] = std::max(m.bbox[1][k], p[k]);
      }
    }
    return std::monostate();
  }

  /// The explicit point of a vertex that is at none of the boundary's points: those come last.
  [[nodiscard]] uint32_t own_point(uint32_t vertex) const {
    return fans_
        .point_of_vertex[fans_.point_of_vertex.size() - (number_of_own_.back() + 1 - vertex)];
  }

  const BoundaryMesh& boundary_;
  const PresentContext& context_;
  const ToMillimetres to_mm_;
  PlaneTable planes_;
  CellGeometry geometry_;
  std::optional<WholeOrder> whole_;
  std::vector<MergedFace> faces_;
  TriangleSet set_;
  VertexFans fans_;
  std::vector<uint32_t> first_vertex_;   ///< per point of the whole
  std::vector<uint32_t> number_of_own_;  ///< per vertex of `fans_`: its number in the solid
  std::vector<std::optional<FaceLabel>> common_labels_;  ///< per part, see common_label
};

}  // namespace

Result<SolidPtr> present(const BoundaryMesh& boundary, const PresentContext& context) {
  return Presenter(boundary, context).run();
}

}  // namespace csgrun
