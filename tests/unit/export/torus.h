// A surface with one handle.
#pragma once

#include <cstdint>
#include <vector>

#include "export/half_edges.h"

namespace csgrun::test {

/// A torus of n x m vertices.
inline std::vector<Triangle> torus(uint32_t n, uint32_t m) {
  std::vector<Triangle> triangles;
  for (uint32_t i = 0; i < n; ++i) {
    for (uint32_t j = 0; j < m; ++j) {
      const uint32_t a = i * m + j, b = (i + 1) % n * m + j, c = (i + 1) % n * m + (j + 1) % m,
                     d = i * m + (j + 1) % m;
      triangles.push_back({a, b, c});
      triangles.push_back({a, c, d});
    }
  }
  return triangles;
}

}  // namespace csgrun::test
