#include "export/edge_splits.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include <glm/geometric.hpp>

#include "export/half_edges.h"

namespace csgrun {
namespace {

class Divider {
 public:
  Divider(RoundedMesh& mesh, std::span<const uint32_t> triangles, double tolerance)
      : mesh_(mesh), open_(triangles.begin(), triangles.end()), tolerance_(tolerance) {
    for (const uint32_t t : triangles) {
      for (const uint32_t v : mesh.triangles[t]) points_.push_back(mesh.positions[v]);
    }
    const auto key = [](const glm::dvec3& p) { return std::array{p.x, p.y, p.z}; };
    std::sort(points_.begin(), points_.end(),
              [&](const auto& p, const auto& q) { return key(p) < key(q); });
    points_.erase(std::unique(points_.begin(), points_.end()), points_.end());
  }

  uint64_t run() {
    uint64_t count = 0;
    std::vector<uint32_t> now;
    for (int generation = 0; generation < kGenerations; ++generation) {
      now.swap(open_);
      open_.clear();
      std::sort(now.begin(), now.end());
      now.erase(std::unique(now.begin(), now.end()), now.end());
      for (const uint32_t t : now) count += divide_edge(t) || divide_inside(t) ? 1 : 0;
    }
    return count;
  }

 private:
  [[nodiscard]] const glm::dvec3& at(uint32_t v) const { return mesh_.positions[v]; }

  /// Calls visit(point) for the points within the tolerance of a triangle's box.
  template <class Visit>
  void for_each_near(const Triangle& triangle, Visit visit) const {
    glm::dvec3 lo = at(triangle[0]), hi = lo;
    for (const uint32_t v : triangle) {
      for (int k = 0; k < 3; ++k) {
        lo[k] = std::min(lo[k], at(v)[k] - tolerance_);
        hi[k] = std::max(hi[k], at(v)[k] + tolerance_);
      }
    }
    auto p = std::lower_bound(points_.begin(), points_.end(), lo.x,
                              [](const glm::dvec3& a, double x) { return a.x < x; });
    for (; p != points_.end() && p->x <= hi.x; ++p) {
      if (p->y >= lo.y && p->y <= hi.y && p->z >= lo.z && p->z <= hi.z) visit(*p);
    }
  }

  /// The distance of a point from the inside of a segment, none if it is next to an end.
  [[nodiscard]] std::optional<double> distance_from(const glm::dvec3& p, const glm::dvec3& a,
                                                    const glm::dvec3& b) const {
    if (glm::distance(p, a) <= tolerance_ || glm::distance(p, b) <= tolerance_) return std::nullopt;
    const double t = glm::dot(p - a, b - a) / glm::dot(b - a, b - a);
    if (!(t > 0 && t < 1)) return std::nullopt;
    return glm::distance(p, a + t * (b - a));
  }

  /// The corner across from an edge.
  [[nodiscard]] const glm::dvec3& opposite(uint32_t h) const {
    return at(mesh_.triangles[h / 3][previous_in_triangle(h) % 3]);
  }

  bool divide_edge(uint32_t t) {
    double least = tolerance_;
    std::optional<glm::dvec3> nearest;
    uint32_t edge = 0;
    for_each_near(mesh_.triangles[t], [&](const glm::dvec3& p) {
      for (uint32_t h = 3 * t; h < 3 * t + 3; ++h) {
        const uint32_t a = mesh_.triangles[t][h % 3], b = mesh_.triangles[t][(h + 1) % 3];
        if (p == opposite(h) || p == opposite(mesh_.twins[h])) continue;
        const auto distance = distance_from(p, at(a), at(b));
        if (!distance || *distance > least || (nearest && *distance == least)) continue;
        least = *distance;
        nearest = p;
        edge = h;
      }
    });
    return nearest && split_edge(edge, *nearest);
  }

  bool divide_inside(uint32_t t) {
    const Triangle corners = mesh_.triangles[t];
    const glm::dvec3 &a = at(corners[0]), &b = at(corners[1]), &c = at(corners[2]);
    const glm::dvec3 normal = glm::cross(b - a, c - a);
    const double length = glm::length(normal);
    if (!(length > 0)) return false;
    std::optional<glm::dvec3> nearest;
    double least = tolerance_;
    for_each_near(corners, [&](const glm::dvec3& p) {
      const double height = std::fabs(glm::dot(normal, p - a)) / length;
      if (height > least || (nearest && height == least)) return;
      for (size_t i = 0; i < 3; ++i) {
        const glm::dvec3 &from = at(corners[i]), &to = at(corners[(i + 1) % 3]);
        const double beside =
            glm::dot(glm::cross(to - from, p - from), normal) / (length * glm::length(to - from));
        if (!(beside > tolerance_)) return;
      }
      least = height;
      nearest = p;
    });
    if (!nearest) return false;
    split_inside(t, *nearest);
    return true;
  }

  uint32_t add_vertex(const glm::dvec3& p) {
    mesh_.positions.push_back(p);
    return static_cast<uint32_t>(mesh_.positions.size() - 1);
  }
  uint32_t add_triangle(const Triangle& triangle, uint32_t face) {
    mesh_.triangles.push_back(triangle);
    mesh_.triangle_face.push_back(face);
    mesh_.twins.resize(3 * mesh_.triangles.size());
    return static_cast<uint32_t>(mesh_.triangles.size() - 1);
  }
  void glue(uint32_t g, uint32_t h) {
    mesh_.twins[g] = h;
    mesh_.twins[h] = g;
  }

  /// a b c and b a d become a w c, w b c, b w d and w a d.
  bool split_edge(uint32_t h, const glm::dvec3& p) {
    const uint32_t g = mesh_.twins[h], t = h / 3, u = g / 3;
    const uint32_t bc = next_in_triangle(h), ca = previous_in_triangle(h);
    const uint32_t ad = next_in_triangle(g), db = previous_in_triangle(g);
    const std::array<uint32_t, 4> outer{mesh_.twins[bc], mesh_.twins[ca], mesh_.twins[ad],
                                        mesh_.twins[db]};
    for (const uint32_t o : outer) {
      if (o / 3 == t || o / 3 == u) return false;
    }
    const auto from = [&](uint32_t k) { return mesh_.triangles[k / 3][k % 3]; };
    const uint32_t a = from(h), b = from(bc), c = from(ca), d = from(db), w = add_vertex(p);
    const uint32_t t2 = add_triangle({w, b, c}, mesh_.triangle_face[t]);
    const uint32_t u2 = add_triangle({w, a, d}, mesh_.triangle_face[u]);
    mesh_.triangles[t] = {a, w, c};
    mesh_.triangles[u] = {b, w, d};
    glue(3 * t, 3 * u2);
    glue(3 * t + 1, 3 * t2 + 2);
    glue(3 * t + 2, outer[1]);
    glue(3 * t2, 3 * u);
    glue(3 * t2 + 1, outer[0]);
    glue(3 * u + 1, 3 * u2 + 2);
    glue(3 * u + 2, outer[3]);
    glue(3 * u2 + 1, outer[2]);
    open_.insert(open_.end(), {t, u, t2, u2});
    return true;
  }

  /// a b c becomes a b w, b c w and c a w.
  void split_inside(uint32_t t, const glm::dvec3& p) {
    const auto [a, b, c] = mesh_.triangles[t];
    const uint32_t face = mesh_.triangle_face[t], w = add_vertex(p);
    const uint32_t bc = mesh_.twins[3 * t + 1], ca = mesh_.twins[3 * t + 2];
    const uint32_t second = add_triangle({b, c, w}, face), third = add_triangle({c, a, w}, face);
    mesh_.triangles[t] = {a, b, w};
    glue(3 * second, bc);
    glue(3 * third, ca);
    glue(3 * t + 1, 3 * second + 2);
    glue(3 * second + 1, 3 * third + 2);
    glue(3 * third + 1, 3 * t + 2);
    open_.insert(open_.end(), {t, second, third});
  }

  RoundedMesh& mesh_;
  std::vector<uint32_t> open_;  ///< triangles to look at next
  double tolerance_;
  std::vector<glm::dvec3> points_;  ///< ascending, distinct
};

}  // namespace

uint64_t divide_at_near_corners(RoundedMesh& mesh, std::span<const uint32_t> triangles,
                                double tolerance) {
  return Divider(mesh, triangles, tolerance).run();
}

}  // namespace csgrun
