#include "engine/mesh/present.h"

#include <algorithm>
#include <functional>
#include <numeric>
#include <optional>

#include "engine/base/sort_few.h"
#include "engine/mesh/canonical_hash.h"
#include "engine/mesh/conform.h"
#include "engine/mesh/cut_contacts.h"
#include "engine/mesh/divide_edges.h"
#include "engine/mesh/improve_triangles.h"
#include "engine/mesh/insert_points.h"
#include "engine/mesh/measure.h"
#include "engine/mesh/merge_faces.h"
#include "engine/mesh/near_contacts.h"
#include "engine/mesh/plane_oracle.h"
#include "engine/mesh/self_contact.h"
#include "engine/mesh/stitch.h"
#include "engine/mesh/to_millimetres.h"
#include "engine/mesh/triangle_normals.h"
#include "engine/mesh/triangulate.h"
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

class Presenter {
 public:
  Presenter(const BoundaryMesh& boundary, const PresentContext& context)
      : boundary_(boundary), context_(context), geometry_(planes_, nullptr) {}

  Result<SolidPtr> run() {
    planes_.adopt(boundary_.planes);
    for (size_t p = 0; p < boundary_.point_planes.size(); ++p) {
      geometry_.add_point(boundary_.point_planes[p], boundary_.point_rounded[p]);
    }
    const WholeOrder& whole = whole_.emplace(boundary_, geometry_);
    if (!merge_faces(boundary_, geometry_, planes_, faces_)) return not_closed("faces");
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
    if (context_.measure) {
      solid->canonical_hash = canonical_hash(faces_, whole, boundary_, geometry_, context_);
    }
    if (!near.empty()) conform_contacts(faces_, near, geometry_, planes_);
    if (auto status = triangulate_all(); !status) return status.error();
    if (auto status = make_vertices(); !status) return status.error();
    fill(*solid);
    if (context_.measure) {
      if (auto status = measure(*solid); !status) return status.error();
    }
    return SolidPtr(std::move(solid));
  }

 private:
  /// By which the faces are sorted now.
  [[nodiscard]] std::vector<LowestEdge> lowest_edges() const {
    std::vector<LowestEdge> lowest;
    lowest.reserve(faces_.size());
    for (const MergedFace& f : faces_) lowest.push_back({f.loops[0][0].from, f.loops[0][0].to});
    return lowest;
  }

  Status make_vertices() {
    const Contacts contacts = context_.join_contacts ? Contacts::kJoin : Contacts::kSeparate;
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
    set_ = {};
    const RoundedPosition position = [this](uint32_t p) -> const std::array<double, 3>& {
      return geometry_.point(p).rounded;
    };
    std::vector<std::vector<uint32_t>> loops;
    for (uint32_t f = 0; f < faces_.size(); ++f) {
      const MergedFace& face = faces_[f];
      if (face.loops.size() == 1 && face.loops[0].size() == 3 && face.points.empty() &&
          face.slits.empty()) {
        add_triangle({face.loops[0][0].from, face.loops[0][1].from, face.loops[0][2].from}, f);
        continue;
      }
      // The memory of loops is kept.
      loops.resize(face.loops.size());
      for (size_t l = 0; l < loops.size(); ++l) {
        loops[l].clear();
        for (const DirectedEdge& e : face.loops[l]) loops[l].push_back(e.from);
      }
      for (const auto& [p, q] : face.slits) loops.push_back({p, q});
      const PlaneOracle oracle(geometry_, planes_, faces_[f].plane);
      auto triangles = triangulate_face(loops, oracle);
      if (!triangles) return triangles.error();
      if (!insert_points(faces_[f].points, oracle, *triangles)) return not_closed("contacts");
      improve_triangles(loops, oracle, position, *triangles);
      for (const auto& t : *triangles) add_triangle(t, f);
    }
    return std::monostate();
  }

  void add_triangle(std::array<uint32_t, 3> t, uint32_t face) {
    std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
    set_.triangles.push_back(t);
    set_.face.push_back(face);
  }

  void fill(Solid& solid) {
    fill_vertices(solid);
    fill_faces(solid);
    solid.appearances = context_.appearances;
    solid.sources = context_.sources;
  }

  /// Vertices in the order of points, several of one point in the order of their triangles.
  void fill_vertices(Solid& solid) {
    const std::vector<WholeOrder::Place>& points = whole_->points();
    const std::vector<uint32_t>& point_of_own = fans_.point_of_vertex;
    const size_t most = point_of_own.size() + points.size();
    solid.positions.reserve(most);
    solid.positions_f32.reserve(most);
    solid.point_of.reserve(most);
    first_vertex_.resize(points.size());
    number_of_own_.resize(point_of_own.size());
    const ToMillimetres to_mm(context_.step);
    size_t own = 0;
    // All explicit vertices of the point that comes next.
    const auto add_own = [&](uint32_t number) {
      const uint32_t p = point_of_own[own];
      glm::dvec3 mm;
      std::array<float, 3> single;
      to_mm.position(geometry_.exact(p), mm, single);
      for (; own < point_of_own.size() && point_of_own[own] == p; ++own) {
        number_of_own_[own] = static_cast<uint32_t>(solid.positions.size());
        solid.positions.push_back(mm);
        solid.positions_f32.push_back(single);
        solid.point_of.push_back(number);
      }
      if (context_.exact_points) {
        solid.exact_points.resize(number + size_t{1});
        solid.exact_points[number] = to_mm.text(geometry_.exact(p));
      }
    };
    for (uint32_t n = 0; n < points.size(); ++n) {
      first_vertex_[n] = static_cast<uint32_t>(solid.positions.size());
      const uint32_t p = points[n].explicit_point;
      if (p != kNone) {
        if (own < point_of_own.size() && point_of_own[own] == p) add_own(n);
        continue;
      }
      const UntouchedPart& part = whole_->part(points[n]);
      const uint32_t v = points[n].vertex;
      glm::dvec3 mm;
      std::array<float, 3> single;
      if (part.map.is_identity()) {
        to_mm.position(part.vertex(v), mm, single);
      } else {
        to_mm.position(part.point(v), mm, single);
      }
      solid.positions.push_back(mm);
      solid.positions_f32.push_back(single);
      solid.point_of.push_back(n);
      if (context_.exact_points) {
        solid.exact_points.resize(n + size_t{1});
        solid.exact_points[n] = to_mm.text(part.point(v));
      }
    }
    // Points that were made since: contacts and middles of edges.
    for (auto n = static_cast<uint32_t>(points.size()); own < point_of_own.size(); ++n) add_own(n);
  }

  void fill_faces(Solid& solid) {
    const size_t triangles = set_.triangles.size() + whole_->triangles().size();
    const size_t faces = whole_->faces().size();
    solid.triangles.reserve(triangles);
    solid.triangle_face.reserve(triangles);
    solid.faces.reserve(faces);
    solid.face_normals.reserve(faces);
    solid.loop_starts.reserve(faces + 1);
    solid.loop_vertices.reserve(triangles * 3);
    // Triangles of explicit faces stand in the order of faces.
    size_t t = 0;
    for (const uint32_t f : whole_->faces()) {
      if (f < whole_->explicit_face_count()) {
        t = add_face(solid, f, t);
      } else {
        add_untouched(solid, whole_->triangle(f));
      }
    }
  }

  /// An explicit face and its triangles, from number t on. Returns where they end.
  size_t add_face(Solid& solid, uint32_t f, size_t t) {
    const auto number = static_cast<uint32_t>(solid.faces.size());
    const auto vertex = [&](size_t corner) {
      return number_of_own_[fans_.vertex_of_corner[corner]];
    };
    // Vertices of loops: those of the triangle that has the loop's edge.
    edges_.clear();
    for (; t < set_.triangles.size() && set_.face[t] == f; ++t) {
      solid.triangles.push_back({vertex(3 * t), vertex(3 * t + 1), vertex(3 * t + 2)});
      solid.triangle_face.push_back(number);
      for (uint32_t k = 0; k < 3; ++k) {
        edges_.push_back({set_.triangles[t][k], set_.triangles[t][(k + 1) % 3],
                          static_cast<uint32_t>(3 * t + k)});
      }
    }
    sort_few(edges_.begin(), edges_.end(), std::less<>());
    const MergedFace& face = faces_[f];
    solid.faces.push_back({static_cast<uint32_t>(solid.loop_starts.size() - 1),
                           static_cast<uint32_t>(face.loops.size()), face.appearance,
                           surface_number(face.source, face.surface), face.source});
    solid.face_normals.push_back(direction(planes_.oriented(face.plane)));
    for (const auto& loop : face.loops) {
      for (const DirectedEdge& e : loop) {
        const auto at = std::lower_bound(edges_.begin(), edges_.end(),
                                         std::array<uint32_t, 3>{e.from, e.to, 0});
        solid.loop_vertices.push_back(vertex((*at)[2]));
      }
      solid.loop_starts.push_back(static_cast<uint32_t>(solid.loop_vertices.size()));
    }
    return t;
  }

  void add_untouched(Solid& solid, const UntouchedTriangle& t) {
    const UntouchedPart& part = boundary_.parts[t.part];
    const auto number = static_cast<uint32_t>(solid.faces.size());
    const std::array<uint32_t, 3> vertices{first_vertex_[t.points[0]], first_vertex_[t.points[1]],
                                           first_vertex_[t.points[2]]};
    solid.triangles.push_back(vertices);
    solid.triangle_face.push_back(number);
    const FaceLabel label = part.label(t.face);
    solid.faces.push_back({static_cast<uint32_t>(solid.loop_starts.size() - 1), 1, label.appearance,
                           surface_number(label.source, label.surface), label.source});
    solid.face_normals.push_back(outward_direction(part, t.face));
    solid.loop_vertices.insert(solid.loop_vertices.end(), vertices.begin(), vertices.end());
    solid.loop_starts.push_back(static_cast<uint32_t>(solid.loop_vertices.size()));
  }

  Status measure(Solid& solid) {
    count_topology(solid);
    if (solid.empty()) return std::monostate();
    // By vertex: several may be one point.
    const auto point = [&](uint32_t vertex) {
      const uint32_t number = solid.point_of[vertex];
      if (number >= whole_->points().size()) return geometry_.exact(own_point(vertex));
      const WholeOrder::Place& place = whole_->points()[number];
      if (place.explicit_point != kNone) return geometry_.exact(place.explicit_point);
      return whole_->part(place).point(place.vertex);
    };
    auto mass = measure_mesh(solid.positions.size(), point, solid.triangles, context_.step);
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

  /// Curved surfaces are numbered from 1 in the order of their first faces.
  uint32_t surface_number(uint32_t source, uint32_t surface) {
    if (surface == 0) return 0;
    const std::pair<uint32_t, uint32_t> key{source, surface};
    if (last_surface_ > 0 && surfaces_[last_surface_ - 1] == key) return last_surface_;
    const auto at = std::find(surfaces_.begin(), surfaces_.end(), key);
    last_surface_ = static_cast<uint32_t>(at - surfaces_.begin()) + 1;
    if (at == surfaces_.end()) surfaces_.push_back(key);
    return last_surface_;
  }

  const BoundaryMesh& boundary_;
  const PresentContext& context_;
  PlaneTable planes_;
  CellGeometry geometry_;
  std::optional<WholeOrder> whole_;
  std::vector<MergedFace> faces_;
  TriangleSet set_;
  VertexFans fans_;
  std::vector<uint32_t> first_vertex_;          ///< per point of the whole
  std::vector<uint32_t> number_of_own_;         ///< per vertex of `fans_`: its number in the solid
  std::vector<std::array<uint32_t, 3>> edges_;  ///< of one face: from, to, corner; sorted
  std::vector<std::pair<uint32_t, uint32_t>> surfaces_;
  uint32_t last_surface_ = 0;
};

}  // namespace

Result<SolidPtr> present(const BoundaryMesh& boundary, const PresentContext& context) {
  return Presenter(boundary, context).run();
}

}  // namespace csgrun
