#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <unordered_map>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>

#include <csgrun/engine/validate.h>
#include <csgrun/primitives/freeform.h>

#include "primitives/base/text.h"
#include "primitives/solids/mesh_builder.h"

namespace csgrun {
namespace {

using Triangle = std::array<uint32_t, 3>;

/// Numbers for edges, whichever way they are run.
class EdgeNumbers {
 public:
  explicit EdgeNumbers(size_t expected) { numbers_.reserve(expected); }
  /// The value of an edge, made by `make` the first time.
  template <class Make>
  uint32_t get(uint32_t a, uint32_t b, Make make) {
    const uint64_t key = uint64_t{std::min(a, b)} << 32 | std::max(a, b);
    const auto [entry, is_new] = numbers_.try_emplace(key, 0);
    if (is_new) entry->second = make(std::min(a, b), std::max(a, b));
    return entry->second;
  }

 private:
  std::unordered_map<uint64_t, uint32_t> numbers_;  // only looked up
};

Triangle triangle(const PolygonMesh& mesh, size_t face) {
  return {mesh.corners[3 * face], mesh.corners[3 * face + 1], mesh.corners[3 * face + 2]};
}

/// The mesh without its faces.
PolygonMesh without_faces(const PolygonMesh& mesh) {
  PolygonMesh result;
  result.points = mesh.points;
  result.appearances = mesh.appearances;
  result.fill = mesh.fill;
  result.kind = mesh.kind;
  result.keep_facets = true;
  return result;
}

void add_part(PolygonMesh& mesh, const Triangle& t, const PolygonMesh& from, size_t face) {
  mesh.add_face(t, from.surface[face]);
  mesh.appearance_of.push_back(from.appearance_of[face]);
}

}  // namespace

PolygonMesh mesh_of_solid(const Solid& solid, std::span<const uint32_t> triangles,
                          std::string kind) {
  PolygonMesh mesh;
  mesh.kind = std::move(kind);
  mesh.appearances = solid.appearances;
  std::vector<uint32_t> number(solid.positions.size(), UINT32_MAX);
  for (const uint32_t t : triangles) {
    Triangle face{};
    for (size_t i = 0; i < 3; ++i) {
      uint32_t& n = number[solid.triangles[t][i]];
      if (n == UINT32_MAX) {
        n = static_cast<uint32_t>(mesh.points.size());
        mesh.points.push_back(solid.positions[solid.triangles[t][i]]);
      }
      face[i] = n;
    }
    const Solid::Face& from = solid.faces[solid.triangle_face[t]];
    mesh.add_face(face, from.surface);
    mesh.appearance_of.push_back(from.appearance);
  }
  return mesh;
}

PolygonMesh mesh_of_solid(const Solid& solid, std::string kind) {
  std::vector<uint32_t> all(solid.triangles.size());
  for (uint32_t t = 0; t < all.size(); ++t) all[t] = t;
  return mesh_of_solid(solid, all, std::move(kind));
}

MeshResult refine_mesh(PolygonMesh mesh, double length) {
  if (!std::isfinite(length)) return not_finite("refine", "length", length);
  if (!(length > 0)) return not_positive("refine", "length", length);
  mesh.keep_facets = true;
  const Error too_many{ErrorCode::kLimit, "refine: makes more than 16777216 points", {}};
  // A triangle without longer edges has at most the area of the one with all edges of that length.
  double area = 0;
  for (size_t f = 0; f < mesh.face_count(); ++f) {
    const Triangle t = triangle(mesh, f);
    area += glm::length(glm::cross(mesh.points[t[1]] - mesh.points[t[0]],
                                   mesh.points[t[2]] - mesh.points[t[0]])) /
            2;
  }
  if (area / (std::sqrt(3.0) / 4 * length * length) > 2 * kMostPoints) return too_many;
  while (true) {
    PolygonMesh next = without_faces(mesh);
    bool is_done = true;
    // An edge is halved or not whichever triangle looks at it, so that they still fit together.
    EdgeNumbers middles(mesh.corners.size());
    const auto middle = [&](uint32_t a, uint32_t b) {
      return middles.get(a, b, [&](uint32_t low, uint32_t high) {
        const glm::dvec3 p = mesh.points[low], q = mesh.points[high];
        if (glm::length(q - p) <= length) return UINT32_MAX;
        next.points.push_back(p + (q - p) / 2.0);
        return static_cast<uint32_t>(next.points.size() - 1);
      });
    };
    for (size_t f = 0; f < mesh.face_count(); ++f) {
      Triangle t = triangle(mesh, f);
      Triangle m{};
      int halved = 0;
      for (size_t i = 0; i < 3; ++i) {
        m[i] = middle(t[i], t[(i + 1) % 3]);
        halved += m[i] != UINT32_MAX ? 1 : 0;
      }
      if (halved > 0) is_done = false;
      if (halved == 3) {
        for (const Triangle& part : {Triangle{t[0], m[0], m[2]}, Triangle{m[0], t[1], m[1]},
                                     Triangle{m[2], m[1], t[2]}, Triangle{m[0], m[1], m[2]}}) {
          add_part(next, part, mesh, f);
        }
        continue;
      }
      // Turned so that the one edge that is halved, or that is not, comes first.
      for (int turn = 0; turn < 2 && (m[0] != UINT32_MAX) != (halved == 1); ++turn) {
        std::rotate(t.begin(), t.begin() + 1, t.end());
        std::rotate(m.begin(), m.begin() + 1, m.end());
      }
      if (halved == 0) {
        add_part(next, t, mesh, f);
      } else if (halved == 1) {
        add_part(next, {t[0], m[0], t[2]}, mesh, f);
        add_part(next, {m[0], t[1], t[2]}, mesh, f);
      } else {
        add_part(next, {m[2], m[1], t[2]}, mesh, f);
        add_part(next, {t[0], t[1], m[1]}, mesh, f);
        add_part(next, {t[0], m[1], m[2]}, mesh, f);
      }
    }
    if (is_done) return mesh;
    if (static_cast<double>(next.points.size()) > kMostPoints) return too_many;
    mesh = std::move(next);
  }
}

MeshResult smooth_mesh(PolygonMesh mesh, int rounds) {
  if (rounds < 1) return invalid_argument("smooth: rounds must be at least 1");
  for (int round = 0; round < rounds; ++round) {
    const size_t count = mesh.points.size();
    if (static_cast<double>(mesh.points.size() + mesh.corners.size() / 2) > kMostPoints) {
      return Error{ErrorCode::kLimit, "smooth: makes more than 16777216 points", {}};
    }
    PolygonMesh next = without_faces(mesh);
    // An edge's point: three eighths of both ends and an eighth of both corners beside it. A
    // corner's: itself and the mean of its neighbours, by how many these are (Warren's weights).
    EdgeNumbers middles(mesh.corners.size());
    std::vector<glm::dvec3> around(count, glm::dvec3(0));
    std::vector<uint32_t> valence(count, 0);
    const auto middle = [&](uint32_t a, uint32_t b) {
      return middles.get(a, b, [&](uint32_t low, uint32_t high) {
        next.points.push_back((mesh.points[low] + mesh.points[high]) * 0.375);
        return static_cast<uint32_t>(next.points.size() - 1);
      });
    };
    for (size_t f = 0; f < mesh.face_count(); ++f) {
      const Triangle t = triangle(mesh, f);
      Triangle m{};
      for (size_t i = 0; i < 3; ++i) {
        const uint32_t a = t[i], b = t[(i + 1) % 3], opposite = t[(i + 2) % 3];
        m[i] = middle(a, b);
        next.points[m[i]] += mesh.points[opposite] * 0.125;
        around[a] += mesh.points[b];  // each neighbour once, over all triangles around
        ++valence[a];
      }
      for (const Triangle& part : {Triangle{t[0], m[0], m[2]}, Triangle{m[0], t[1], m[1]},
                                   Triangle{m[2], m[1], t[2]}, Triangle{m[0], m[1], m[2]}}) {
        next.add_face(part, 1);
        next.appearance_of.push_back(mesh.appearance_of[f]);
      }
    }
    for (size_t v = 0; v < count; ++v) {
      const auto n = static_cast<double>(valence[v]);
      const double beta = valence[v] == 3 ? 3.0 / 16 : 3.0 / (8 * n);
      next.points[v] = mesh.points[v] * (1 - n * beta) + around[v] * beta;
    }
    mesh = std::move(next);
  }
  return mesh;
}

MeshResult warp_mesh(PolygonMesh mesh,
                     const std::function<Result<glm::dvec3>(const glm::dvec3&)>& move) {
  for (glm::dvec3& p : mesh.points) {
    const Result<glm::dvec3> moved = move(p);
    if (!moved) return moved.error();
    for (int i = 0; i < 3; ++i) {
      if (!std::isfinite((*moved)[i])) return not_finite("warp", "a moved point", (*moved)[i]);
    }
    p = *moved;
  }
  const double volume = signed_volume(mesh);
  if (volume == 0) return invalid_argument("warp: the moved points enclose no volume");
  if (volume < 0) reverse_faces(mesh);
  return mesh;
}

namespace {

/// Marching tetrahedra over a grid of samples.
class LevelSet {
 public:
  LevelSet(const LevelSetOptions& options, const std::array<size_t, 3>& samples)
      : options_(options), samples_(samples) {}

  std::optional<Error> sample(const std::function<Result<double>(const glm::dvec3&)>& function) {
    values_.resize(samples_[0] * samples_[1] * samples_[2]);
    for (size_t i = 0; i < values_.size(); ++i) {
      const Result<double> value = function(place(i));
      if (!value) return value.error();
      if (!std::isfinite(*value)) return not_finite("levelset", "the function's value", *value);
      values_[i] = *value - options_.level;
      // The surface is closed where the samples end.
      if (is_border(i)) values_[i] = std::max(values_[i], std::fabs(options_.step) / 2);
    }
    return std::nullopt;
  }

  PolygonMesh surface() {
    mesh_.kind = "levelset";
    const size_t dy = samples_[0], dz = samples_[0] * samples_[1];
    const std::array<size_t, 3> stride{1, dy, dz};
    constexpr std::array<std::array<int, 3>, 6> kOrders{
        {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}}};
    for (size_t z = 0; z + 1 < samples_[2]; ++z) {
      for (size_t y = 0; y + 1 < samples_[1]; ++y) {
        for (size_t x = 0; x + 1 < samples_[0]; ++x) {
          const size_t corner = x + y * dy + z * dz;
          if (!has_surface(corner, dy, dz)) continue;
          for (size_t k = 0; k < kOrders.size(); ++k) {
            // From the cube's lowest corner to its highest, one axis after another: six tetrahedra.
            const auto& order = kOrders[k];
            std::array<size_t, 4> tetrahedron{corner, 0, 0, 0};
            for (size_t i = 0; i < 3; ++i) {
              tetrahedron[i + 1] = tetrahedron[i] + stride[static_cast<size_t>(order[i])];
            }
            if (k >= 3) std::swap(tetrahedron[2], tetrahedron[3]);  // now they are all positive
            cut(tetrahedron);
          }
        }
      }
    }
    return std::move(mesh_);
  }

 private:
  [[nodiscard]] glm::dvec3 place(size_t sample) const {
    const std::array<size_t, 3> at{sample % samples_[0], sample / samples_[0] % samples_[1],
                                   sample / (samples_[0] * samples_[1])};
    glm::dvec3 p;
    for (int i = 0; i < 3; ++i) {
      // One sample before the bounds, one after them.
      const double cells = static_cast<double>(samples_[static_cast<size_t>(i)] - 3);
      const double t = (static_cast<double>(at[static_cast<size_t>(i)]) - 1) / cells;
      p[i] = options_.low[i] * (1 - t) + options_.high[i] * t;
    }
    return p;
  }
  [[nodiscard]] bool is_border(size_t sample) const {
    const std::array<size_t, 3> at{sample % samples_[0], sample / samples_[0] % samples_[1],
                                   sample / (samples_[0] * samples_[1])};
    for (size_t i = 0; i < 3; ++i) {
      if (at[i] == 0 || at[i] + 1 == samples_[i]) return true;
    }
    return false;
  }
  [[nodiscard]] bool has_surface(size_t corner, size_t dy, size_t dz) const {
    int inside = 0;
    for (const size_t i : {corner, corner + 1, corner + dy, corner + dy + 1, corner + dz,
                           corner + dz + 1, corner + dz + dy, corner + dz + dy + 1}) {
      inside += values_[i] < 0 ? 1 : 0;
    }
    return inside > 0 && inside < 8;
  }

  /// Where the surface crosses the line between two samples.
  uint32_t crossing(size_t a, size_t b) {
    return crossings_.get(static_cast<uint32_t>(a), static_cast<uint32_t>(b),
                          [&](uint32_t low, uint32_t high) {
                            const double t = values_[low] / (values_[low] - values_[high]);
                            const double within = std::clamp(t, 1.0 / 256, 255.0 / 256);
                            const glm::dvec3 p = place(low), q = place(high);
                            mesh_.points.push_back(p + (q - p) * within);
                            return static_cast<uint32_t>(mesh_.points.size() - 1);
                          });
  }

  /// The piece of the surface in a tetrahedron of positive volume.
  void cut(const std::array<size_t, 4>& corners) {
    std::array<size_t, 4> order{};  // inside ones first
    size_t inside = 0;
    for (size_t i = 0; i < 4; ++i) {
      if (values_[corners[i]] < 0) order[inside++] = i;
    }
    if (inside == 0 || inside == 4) return;
    for (size_t i = 0, at = inside; i < 4; ++i) {
      if (!(values_[corners[i]] < 0)) order[at++] = i;
    }
    if (inside == 3) std::rotate(order.begin(), order.begin() + 3, order.end());
    int inversions = 0;
    for (size_t i = 0; i < 4; ++i) {
      for (size_t k = i + 1; k < 4; ++k) inversions += order[i] > order[k] ? 1 : 0;
    }
    if (inversions % 2 != 0) std::swap(order[2], order[3]);
    const size_t a = corners[order[0]], b = corners[order[1]], c = corners[order[2]],
                 d = corners[order[3]];
    if (inside == 1) {
      mesh_.add_face(Triangle{crossing(a, b), crossing(a, c), crossing(a, d)}, 1);
    } else if (inside == 3) {
      mesh_.add_face(Triangle{crossing(a, b), crossing(a, d), crossing(a, c)}, 1);
    } else {
      const uint32_t ac = crossing(a, c), ad = crossing(a, d), bd = crossing(b, d),
                     bc = crossing(b, c);
      mesh_.add_face(Triangle{ac, ad, bd}, 1);
      mesh_.add_face(Triangle{ac, bd, bc}, 1);
    }
  }

  const LevelSetOptions& options_;
  std::array<size_t, 3> samples_;
  std::vector<double> values_;
  EdgeNumbers crossings_{1024};
  PolygonMesh mesh_;
};

}  // namespace

MeshResult make_level_set(const std::function<Result<double>(const glm::dvec3&)>& function,
                          const LevelSetOptions& options) {
  if (!std::isfinite(options.step)) return not_finite("levelset", "step", options.step);
  if (!(options.step > 0)) return not_positive("levelset", "step", options.step);
  if (!std::isfinite(options.level)) return not_finite("levelset", "level", options.level);
  constexpr double kMostSamples = 0x1p22;
  std::array<size_t, 3> samples{};
  double all = 1;
  for (int i = 0; i < 3; ++i) {
    const double length = options.high[i] - options.low[i];
    if (!std::isfinite(length) || !(length > 0)) {
      return invalid_argument("levelset: the bounds must be finite and increase along each axis");
    }
    const double cells = std::ceil(length / options.step * (1 - 1e-12));
    all *= cells + 3;
    if (all > kMostSamples) {
      return Error{ErrorCode::kLimit,
                   "levelset: the bounds hold more than 4194304 samples at this step",
                   {}};
    }
    samples[static_cast<size_t>(i)] = static_cast<size_t>(cells) + 3;
  }
  LevelSet set(options, samples);
  if (auto error = set.sample(function)) return *std::move(error);
  return set.surface();
}

}  // namespace csgrun
