#include "primitives/shape2d/inset_bands.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include <csgrun/primitives/roof.h>

#include "primitives/base/text.h"
#include "primitives/shape2d/profile.h"
#include "primitives/shape2d/roof_mend.h"
#include "primitives/solids/mesh_builder.h"

namespace csgrun {
namespace {

using Polygon = std::vector<uint32_t>;  // points by number
using Edge = std::array<uint32_t, 2>;   // from, to

/// Nodes of a skeleton are known to so much of the outline's extent: what is nearer to a layer is
/// on it.
constexpr double kNoise = 1e-8;
/// Parts of bands that are thinner than so much noise turn over when they are rounded.
constexpr double kThin = 8;

/// What is known of an edge of the outline.
struct Eaves {
  size_t region;
  uint32_t top, bottom, wall;  ///< surfaces
};

/// The roof, its floor and its faces apart.
struct Roof {
  std::vector<glm::dvec3> points;            ///< z is the inset
  std::vector<std::vector<Polygon>> floors;  ///< clockwise, looking down; the holes counter-
  std::vector<Polygon> faces;
  double noise;  ///< mm
};

Roof take_apart(const PolygonMesh& mesh) {
  Roof roof{mesh.points, {}, {}, 0};
  for (const glm::dvec3& p : mesh.points) {
    roof.noise = std::max({roof.noise, kNoise * std::fabs(p.x), kNoise * std::fabs(p.y)});
  }
  for (size_t f = 0; f < mesh.face_count(); ++f) {
    std::vector<Polygon> loops;
    bool is_floor = true;
    for (uint32_t l = mesh.face_starts[f]; l < mesh.face_starts[f + 1]; ++l) {
      const auto begin = mesh.corners.begin() + mesh.loop_starts[l];
      loops.emplace_back(begin, mesh.corners.begin() + mesh.loop_starts[l + 1]);
      for (const uint32_t p : loops.back()) is_floor = is_floor && mesh.points[p].z == 0;
    }
    if (is_floor) {
      roof.floors.push_back(std::move(loops));
    } else {
      roof.faces.push_back(std::move(loops[0]));
    }
  }
  return roof;
}

/// Calls `visit` for the edges of a closed loop.
template <class Visit>
void each_edge(const Polygon& loop, Visit visit) {
  for (size_t i = 0; i < loop.size(); ++i) visit(i, Edge{loop[i], loop[(i + 1) % loop.size()]});
}

/// By edges as the faces of the roof have them.
std::map<Edge, Eaves> find_eaves(const Roof& roof) {
  std::map<Edge, Eaves> eaves;
  uint32_t surface = 0;
  for (size_t region = 0; region < roof.floors.size(); ++region) {
    for (Polygon loop : roof.floors[region]) {
      std::reverse(loop.begin(), loop.end());
      Shape2D::Loop places;
      for (const uint32_t p : loop) places.emplace_back(roof.points[p].x, roof.points[p].y);
      uint32_t chains = 0;
      const std::vector<uint32_t> chain = smooth_chains(places, chains);
      const bool is_round = is_round_loop(loop.size(), chains);
      each_edge(loop, [&](size_t i, const Edge& edge) {
        const uint32_t top = surface + 1 + chain[i];
        eaves[edge] = is_round ? Eaves{region, top, top, top} : Eaves{region, top, top + chains, 0};
      });
      surface += is_round ? 1 : 2 * chains;
    }
  }
  return eaves;
}

const Eaves* eaves_of(const std::map<Edge, Eaves>& eaves, const Polygon& face) {
  const Eaves* found = nullptr;
  each_edge(face, [&](size_t, const Edge& edge) {
    const auto at = eaves.find(edge);
    if (at != eaves.end()) found = &at->second;
  });
  return found;
}

/// The furthest inset that each piece of the shape has.
double least_reach(const Roof& roof, const std::map<Edge, Eaves>& eaves) {
  std::vector<double> reach(roof.floors.size(), 0);
  for (const Polygon& face : roof.faces) {
    const Eaves* const own = eaves_of(eaves, face);
    if (own == nullptr) continue;
    for (const uint32_t p : face) {
      reach[own->region] = std::max(reach[own->region], roof.points[p].z);
    }
  }
  return *std::min_element(reach.begin(), reach.end());
}

/// Cuts the faces of a roof where they are as high as the layers of one end.
class BandCutter {
 public:
  BandCutter(const Roof& roof, const InsetEnd& end) : points_(roof.points), end_(end) {
    for (glm::dvec3& p : points_) {
      for (const InsetLayer& layer : end) {
        if (std::fabs(p.z - layer.inset) <= roof.noise) p.z = layer.inset;
      }
    }
  }

  /// What of a face is between one layer and the next, and at last what is beyond them all.
  std::vector<std::vector<Polygon>> cut(const Polygon& face) {
    std::vector<std::vector<Polygon>> bands;
    std::vector<Polygon> rest{face};
    const glm::dvec2 along = level_direction(face);
    for (size_t i = 1; i < end_.size(); ++i) {
      std::vector<Polygon> below, above;
      for (const Polygon& polygon : rest) split(polygon, i, along, below, above);
      bands.push_back(std::move(below));
      rest = std::move(above);
    }
    bands.push_back(std::move(rest));
    return bands;
  }

  /// Points of faces and those where edges have been cut; z is the inset.
  [[nodiscard]] const std::vector<glm::dvec3>& points() const { return points_; }

 private:
  /// Where a boundary goes through a layer.
  struct Crossing {
    double place;  ///< along the level
    uint32_t point;
    size_t corner;  ///< of the polygon, the one after it
  };

  /// The horizontal direction of a face that has what is higher on its left.
  [[nodiscard]] glm::dvec2 level_direction(const Polygon& face) const {
    glm::dvec2 normal(0);
    each_edge(face, [&](size_t, const Edge& edge) {
      const glm::dvec3 p = points_[edge[0]] - points_[face[0]];
      const glm::dvec3 q = points_[edge[1]] - points_[face[0]];
      normal += glm::dvec2(p.y * q.z - p.z * q.y, p.z * q.x - p.x * q.z);
    });
    return {-normal.y, normal.x};
  }

  uint32_t crossing(const Edge& edge, double inset) {
    for (const uint32_t p : edge) {
      if (points_[p].z == inset) return p;
    }
    const auto [low, high] = std::minmax(edge[0], edge[1]);
    const auto [at, is_new] =
        crossings_.try_emplace(Edge{low, high}, static_cast<uint32_t>(points_.size()));
    if (is_new) {
      const glm::dvec3 p = points_[low], q = points_[high];
      glm::dvec3 c = p + (q - p) * ((inset - p.z) / (q.z - p.z));
      c.z = inset;
      points_.push_back(c);
    }
    return at->second;
  }

  /// Each stretch of the level inside the polygon ends where the boundary comes down, on its left
  /// side, and where it goes up. What is below closes along it leftwards, what is above rightwards,
  /// so both are closed together with what they were cut from, wherever rounding put the points.
  void split(const Polygon& polygon, size_t layer, const glm::dvec2& along,
             std::vector<Polygon>& below, std::vector<Polygon>& above) {
    const double inset = end_[layer].inset;
    const auto is_above = [&](uint32_t p) { return points_[p].z >= inset; };
    std::vector<Crossing> down, up;
    each_edge(polygon, [&](size_t i, const Edge& edge) {
      if (is_above(edge[0]) == is_above(edge[1])) return;
      const uint32_t point = crossing(edge, inset);
      const double place = along.x * points_[point].x + along.y * points_[point].y;
      (is_above(edge[1]) ? up : down).push_back({place, point, (i + 1) % polygon.size()});
    });
    if (up.empty()) {
      (is_above(polygon[0]) ? above : below).push_back(polygon);
      return;
    }
    const auto by_place = [](const Crossing& a, const Crossing& b) {
      return std::pair(a.place, a.corner) < std::pair(b.place, b.corner);
    };
    std::sort(down.begin(), down.end(), by_place);
    std::sort(up.begin(), up.end(), by_place);
    collect(polygon, down, up, below);
    collect(polygon, up, down, above);
  }

  /// The polygons that consist of the chains from the crossings in `starts` on, up to one in
  /// `ends`, each followed by the start that is on the same stretch.
  static void collect(const Polygon& polygon, const std::vector<Crossing>& starts,
                      const std::vector<Crossing>& ends, std::vector<Polygon>& parts) {
    std::vector<bool> is_done(starts.size(), false);
    for (size_t first = 0; first < starts.size(); ++first) {
      Polygon part;
      const auto add = [&](uint32_t p) {
        if (part.empty() || part.back() != p) part.push_back(p);
      };
      for (size_t k = first; !is_done[k];) {
        is_done[k] = true;
        add(starts[k].point);
        size_t corner = starts[k].corner, end = ends.size();
        for (; end == ends.size(); corner = (corner + 1) % polygon.size()) {
          add(polygon[corner]);
          const size_t next = (corner + 1) % polygon.size();
          for (size_t e = 0; e < ends.size(); ++e) {
            if (ends[e].corner == next) end = e;
          }
        }
        add(ends[end].point);
        k = end;
      }
      while (part.size() > 1 && part.back() == part.front()) part.pop_back();
      if (part.size() > 2) parts.push_back(std::move(part));
    }
  }

  std::vector<glm::dvec3> points_;
  const InsetEnd& end_;
  std::map<Edge, uint32_t> crossings_;
};

double height_at(const InsetEnd& end, double inset) {
  const auto next = std::find_if(end.begin(), end.end(),
                                 [&](const InsetLayer& layer) { return layer.inset >= inset; });
  if (next == end.end()) return end.back().z;
  if (next->inset == inset) return next->z;
  const InsetLayer &a = next[-1], &b = *next;
  return a.z + (b.z - a.z) * ((inset - a.inset) / (b.inset - a.inset));
}

class BandExtruder {
 public:
  BandExtruder(const Roof& roof, const std::map<Edge, Eaves>& eaves) : roof_(roof), eaves_(eaves) {
    mesh_.kind = "linear_extrude";
  }

  PolygonMesh build(const InsetEnd& bottom, const InsetEnd& top) {
    std::vector<uint32_t> low, high;  // per point of the roof, its point at the end's wall
    add_eaves(bottom[0].z, low);
    if (top[0].z == bottom[0].z) {
      high = low;
    } else {
      add_eaves(top[0].z, high);
      for (const auto& [edge, own] : eaves_) {
        const auto [p, q] = edge;
        mesh_.add_face(Polygon{low[p], low[q], high[q], high[p]}, own.wall);
      }
    }
    if (bottom.size() == 1) add_flat_end(low, true);
    if (top.size() == 1) add_flat_end(high, false);
    const size_t walls = mesh_.face_count(), eaves = mesh_.points.size();
    if (bottom.size() > 1) add_bands(bottom, low, true);
    if (top.size() > 1) add_bands(top, high, false);
    // Where a node is just off a layer.
    mend_thin_parts(mesh_, eaves, walls, kThin * roof_.noise);
    return std::move(mesh_);
  }

 private:
  static constexpr uint32_t kNone = UINT32_MAX;

  void add_eaves(double z, std::vector<uint32_t>& at) {
    at.assign(roof_.points.size(), kNone);
    for (const auto& [edge, own] : eaves_) {
      const glm::dvec3& p = roof_.points[edge[0]];
      if (at[edge[0]] == kNone) at[edge[0]] = add_point(glm::dvec3(p.x, p.y, z));
    }
  }

  uint32_t add_point(const glm::dvec3& p) {
    mesh_.points.push_back(p);
    return static_cast<uint32_t>(mesh_.points.size() - 1);
  }

  void add_flat_end(const std::vector<uint32_t>& at, bool is_bottom) {
    for (std::vector<Polygon> loops : roof_.floors) {
      for (Polygon& loop : loops) {
        if (!is_bottom) std::reverse(loop.begin(), loop.end());
        for (uint32_t& p : loop) p = at[p];
      }
      add_face_with_holes(mesh_, loops);
    }
  }

  void add_bands(const InsetEnd& end, std::vector<uint32_t>& at, bool is_bottom) {
    BandCutter cutter(roof_, end);
    for (const Polygon& face : roof_.faces) {
      const Eaves* const own = eaves_of(eaves_, face);
      const uint32_t surface = own == nullptr ? 0 : is_bottom ? own->bottom : own->top;
      const std::vector<std::vector<Polygon>> bands = cutter.cut(face);
      at.resize(cutter.points().size(), kNone);
      for (size_t i = 0; i < bands.size(); ++i) {
        for (Polygon part : bands[i]) {
          for (uint32_t& p : part) {
            const glm::dvec3& c = cutter.points()[p];
            if (at[p] == kNone) at[p] = add_point(glm::dvec3(c.x, c.y, height_at(end, c.z)));
            p = at[p];
          }
          if (is_bottom) std::reverse(part.begin(), part.end());
          mesh_.add_face(part, i + 1 == bands.size() ? 0 : surface);
        }
      }
    }
  }

  const Roof& roof_;
  const std::map<Edge, Eaves>& eaves_;
  PolygonMesh mesh_;
};

}  // namespace

MeshResult extrude_inset_bands(const Shape2D& shape, const InsetEnd& bottom, const InsetEnd& top) {
  RoofOptions straight;
  straight.method = RoofMethod::kStraight;
  const MeshResult mesh = make_roof(shape, straight);
  if (!mesh) {
    Error error = mesh.error();
    error.message =
        "linear_extrude: round changes the form of this outline, which takes its " + error.message;
    return error;
  }
  const Roof roof = take_apart(*mesh);
  const std::map<Edge, Eaves> eaves = find_eaves(roof);
  const double wanted = std::max(bottom.back().inset, top.back().inset);
  const double reach = least_reach(roof, eaves);
  if (reach < wanted - roof.noise) {
    return invalid_argument(
        "linear_extrude: round must leave each piece some of its full height: " +
        number_text(wanted) + " does not fit, the most that does is about " +
        number_text(std::floor(reach * 1000) / 1000));
  }
  return BandExtruder(roof, eaves).build(bottom, top);
}

}  // namespace csgrun
