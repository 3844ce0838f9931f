// What turning an edge of a mesh would make of the two triangles at it.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "export/half_edges.h"
#include "export/rounding.h"

namespace csgrun {

/// a b c and b a d become c a d and d b c.
struct EdgeTurn {
  uint32_t t, u;                  ///< the two triangles
  Triangle first, second;         ///< what they become, both of the face of u
  std::array<uint32_t, 4> outer;  ///< half-edges of their neighbours: beyond ca, ad, db and bc

  /// Calls glue(g, h) for the half-edges that belong together then.
  template <class Glue>
  void glue_all(Glue&& glue) const {
    glue(3 * t, outer[0]);
    glue(3 * t + 1, outer[1]);
    glue(3 * u, outer[2]);
    glue(3 * u + 1, outer[3]);
    glue(3 * t + 2, 3 * u + 2);
  }
};

/// Of half-edge `h`; nothing if the new edge is there already, or a triangle is its own neighbour.
inline std::optional<EdgeTurn> edge_turn(const RoundedMesh& mesh, uint32_t h) {
  const auto from = [&](uint32_t k) { return mesh.triangles[k / 3][k % 3]; };
  const uint32_t g = mesh.twins[h], t = h / 3, u = g / 3;
  const uint32_t bc = next_in_triangle(h), ca = previous_in_triangle(h);
  const uint32_t ad = next_in_triangle(g), db = previous_in_triangle(g);
  const uint32_t a = from(h), b = from(bc), c = from(ca), d = from(db);
  if (c == d) return std::nullopt;
  const std::array<uint32_t, 4> outer{mesh.twins[ca], mesh.twins[ad], mesh.twins[db],
                                      mesh.twins[bc]};
  for (const uint32_t o : outer) {
    if (o / 3 == t || o / 3 == u) return std::nullopt;
  }
  uint32_t k = ca;
  do {
    if (from(next_in_triangle(k)) == d) return std::nullopt;
    k = mesh.twins[previous_in_triangle(k)];
  } while (k != ca);
  return EdgeTurn{t, u, {c, a, d}, {d, b, c}, outer};
}

}  // namespace csgrun
