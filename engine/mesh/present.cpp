#include "engine/mesh/present.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>

#include "engine/exact/rounding.h"
#include "engine/mesh/canonical_hash.h"
#include "engine/mesh/conform.h"
#include "engine/mesh/cut_contacts.h"
#include "engine/mesh/divide_edges.h"
#include "engine/mesh/improve_triangles.h"
#include "engine/mesh/insert_points.h"
#include "engine/mesh/measure.h"
#include "engine/mesh/merge_faces.h"
#include "engine/mesh/plane_oracle.h"
#include "engine/mesh/rational_text.h"
#include "engine/mesh/self_contact.h"
#include "engine/mesh/stitch.h"
#include "engine/mesh/triangulate.h"

namespace csgrun {
namespace {

Error not_closed(const char* where) {
  return {ErrorCode::kInternal,
          std::string("the boundary of a result is not closed (") + where + ")",
          {}};
}

/// Millimetres from grid coordinates: coordinate * numerator / denominator * 2^exponent.
class ToMillimetres {
 public:
  explicit ToMillimetres(const GridStep& step) : step_(step) {}

  void position(const Point& p, glm::dvec3& mm, std::array<float, 3>& single) const {
    using Q = Int<kQuotientLimbs>;
    static_assert(widths::kMaxPointXyz + 63 < 64 * kQuotientLimbs);
    const Q denominator = multiply<kQuotientLimbs>(p.w, Int<1>(step_.denominator));
    const Int<kPointLimbs>* coordinate[3] = {&p.x, &p.y, &p.z};
    for (int k = 0; k < 3; ++k) {
      const Q numerator = multiply<kQuotientLimbs>(*coordinate[k], Int<1>(step_.numerator));
      mm[k] = round_to_double(numerator, denominator, step_.exponent);
      single[k] = round_to_float(numerator, denominator, step_.exponent);
    }
  }

  [[nodiscard]] std::array<std::string, 3> text(const Point& p) const {
    const Natural denominator = multiply(natural(p.w), natural(Int<1>(step_.denominator)));
    const Natural numerator = natural(Int<1>(step_.numerator));
    const auto of = [&](const Int<kPointLimbs>& coordinate) {
      return rational_text(multiply(signed_value(coordinate), numerator), denominator,
                           step_.exponent);
    };
    return {of(p.x), of(p.y), of(p.z)};
  }

 private:
  GridStep step_;
};

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
    std::vector<PlaneId> plane_of;
    plane_of.reserve(boundary_.planes.size());
    for (const Plane& p : boundary_.planes) plane_of.push_back(planes_.intern(p));
    for (size_t p = 0; p < boundary_.point_planes.size(); ++p) {
      const auto& t = boundary_.point_planes[p];
      geometry_.add_point({plane_of[t[0]].index(), plane_of[t[1]].index(), plane_of[t[2]].index()},
                          boundary_.point_rounded[p]);
    }
    if (!merge_faces(boundary_, geometry_, planes_, plane_of, faces_)) return not_closed("faces");
    break_at_own_corners(faces_, geometry_);
    if (!resolve_t_junctions(faces_, geometry_, planes_)) return not_closed("edges");
    if (cut_at_contacts(faces_, geometry_, planes_)) {
      break_at_own_corners(faces_, geometry_);
      if (!resolve_t_junctions(faces_, geometry_, planes_)) return not_closed("cut edges");
    }
    auto solid = std::make_shared<Solid>();
    if (context_.measure) solid->canonical_hash = canonical_hash(faces_, geometry_, context_);
    if (boundary_.may_touch) conform_contacts(faces_, geometry_, planes_);
    if (auto status = triangulate_all(); !status) return status.error();
    if (auto status = make_vertices(); !status) return status.error();
    fill(*solid);
    if (context_.measure) {
      if (auto status = measure(*solid); !status) return status.error();
    }
    return SolidPtr(std::move(solid));
  }

 private:
  Status make_vertices() {
    const Contacts contacts = context_.join_contacts ? Contacts::kJoin : Contacts::kSeparate;
    // Solids that are joined along an edge have it twice, mostly between the same two vertices:
    // with points in the middle the two are apart.
    std::vector<std::array<uint32_t, 2>> doubled;
    while (context_.join_contacts) {
      if (!split_fans(set_, faces_, geometry_, planes_, contacts, fans_, &doubled)) break;
      if (doubled.empty() || !divide_edges(faces_, geometry_, planes_, doubled)) break;
      if (auto status = triangulate_all(); !status) return status.error();
    }
    if (!split_fans(set_, faces_, geometry_, planes_, contacts, fans_))
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
      loops.clear();
      for (const auto& loop : faces_[f].loops) {
        loops.emplace_back();
        for (const DirectedEdge& e : loop) loops.back().push_back(e.from);
      }
      for (const auto& [p, q] : faces_[f].slits) loops.push_back({p, q});
      if (loops.size() == 1 && loops[0].size() == 3 && faces_[f].points.empty()) {
        add_triangle({loops[0][0], loops[0][1], loops[0][2]}, f);
        continue;
      }
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
    const ToMillimetres to_mm(context_.step);
    solid.positions.resize(fans_.point_of_vertex.size());
    solid.positions_f32.resize(fans_.point_of_vertex.size());
    solid.point_of = fans_.point_of_vertex;
    for (size_t v = 0; v < solid.positions.size(); ++v) {
      const uint32_t p = fans_.point_of_vertex[v];
      if (v > 0 && fans_.point_of_vertex[v - 1] == p) {
        solid.positions[v] = solid.positions[v - 1];
        solid.positions_f32[v] = solid.positions_f32[v - 1];
      } else {
        to_mm.position(geometry_.exact(p), solid.positions[v], solid.positions_f32[v]);
      }
    }
    for (size_t t = 0; t < set_.triangles.size(); ++t) {
      solid.triangles.push_back({fans_.vertex_of_corner[3 * t], fans_.vertex_of_corner[3 * t + 1],
                                 fans_.vertex_of_corner[3 * t + 2]});
    }
    solid.triangle_face = set_.face;
    fill_faces(solid);
    if (context_.exact_points) {
      solid.exact_points.resize(geometry_.point_count());
      for (const uint32_t p : solid.point_of) {
        if (solid.exact_points[p][0].empty())
          solid.exact_points[p] = to_mm.text(geometry_.exact(p));
      }
    }
    solid.appearances = context_.appearances;
    solid.sources = context_.sources;
  }

  Status measure(Solid& solid) {
    count_topology(solid);
    if (solid.empty()) return std::monostate();
    auto mass = measure_mesh(
        geometry_.point_count(), [this](uint32_t p) { return geometry_.exact(p); }, set_.triangles,
        context_.step);
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

  void fill_faces(Solid& solid) {
    // Vertices of loops: those of the triangle that has the loop's edge.
    std::vector<std::array<uint32_t, 3>> edges;  // (from, to, corner), sorted for each face
    size_t t = 0;
    for (uint32_t f = 0; f < faces_.size(); ++f) {
      edges.clear();
      for (; t < set_.triangles.size() && set_.face[t] == f; ++t) {
        for (uint32_t k = 0; k < 3; ++k) {
          edges.push_back({set_.triangles[t][k], set_.triangles[t][(k + 1) % 3],
                           static_cast<uint32_t>(3 * t + k)});
        }
      }
      std::sort(edges.begin(), edges.end());
      const MergedFace& face = faces_[f];
      solid.faces.push_back({static_cast<uint32_t>(solid.loop_starts.size() - 1),
                             static_cast<uint32_t>(face.loops.size()), face.appearance,
                             surface_number(face), face.source});
      const auto& plane = planes_.approximate(face.plane.index());
      const glm::dvec3 normal(plane[0], plane[1], plane[2]);
      solid.face_normals.push_back(face.plane.flipped() ? -normal : normal);
      for (const auto& loop : face.loops) {
        for (const DirectedEdge& e : loop) {
          const auto at = std::lower_bound(edges.begin(), edges.end(),
                                           std::array<uint32_t, 3>{e.from, e.to, 0});
          solid.loop_vertices.push_back(fans_.vertex_of_corner[(*at)[2]]);
        }
        solid.loop_starts.push_back(static_cast<uint32_t>(solid.loop_vertices.size()));
      }
    }
  }

  /// Curved surfaces are numbered from 1 in the order of their first faces.
  uint32_t surface_number(const MergedFace& face) {
    if (face.surface == 0) return 0;
    const std::pair<uint32_t, uint32_t> key{face.source, face.surface};
    const auto at = std::find(surfaces_.begin(), surfaces_.end(), key);
    if (at != surfaces_.end()) return static_cast<uint32_t>(at - surfaces_.begin()) + 1;
    surfaces_.push_back(key);
    return static_cast<uint32_t>(surfaces_.size());
  }

  const BoundaryMesh& boundary_;
  const PresentContext& context_;
  PlaneTable planes_;
  CellGeometry geometry_;
  std::vector<MergedFace> faces_;
  TriangleSet set_;
  VertexFans fans_;
  std::vector<std::pair<uint32_t, uint32_t>> surfaces_;
};

}  // namespace

Result<SolidPtr> present(const BoundaryMesh& boundary, const PresentContext& context) {
  return Presenter(boundary, context).run();
}

}  // namespace csgrun
