#include "engine/bsp/job_triangles.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace csgrun {

JobTriangles::JobTriangles(const Job& job, std::span<const uint32_t> polygons) {
  for (uint32_t i = 0; i < 8; ++i) {
    const auto loop = i < polygons.size() ? job.corners(job.polygons()[polygons[i]])
                                          : std::span<const uint32_t>();
    const bool is_triangle = loop.size() == 3;
    which |= static_cast<uint32_t>(is_triangle) << i;
    for (size_t c = 0; c < 3; ++c) {
      for (size_t k = 0; k < 3; ++k) {
        corners.at[c][k][i] = is_triangle ? static_cast<float>(job.rounded(loop[c])[k]) : 0;
      }
    }
  }
}

Slabs slabs_of(const Job& job, uint32_t polygon, double reach) {
  const auto corners = job.corners(job.polygons()[polygon]);
  return Slabs({job.rounded(corners[0]), job.rounded(corners[1]), job.rounded(corners[2])}, reach);
}

double reach_of(const Job& job) {
  double reach = 0;
  for (size_t v = 0; v < job.vertex_count(); ++v) {
    for (const double x : job.rounded(static_cast<uint32_t>(v))) {
      reach = std::max(reach, std::fabs(x));
    }
  }
  return reach;
}

}  // namespace csgrun
