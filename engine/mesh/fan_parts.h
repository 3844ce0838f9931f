// Fans point by point, on several threads: vertices are numbered as if one thread had gone through.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "engine/base/counting_order.h"
#include "engine/base/parallel.h"
#include "engine/mesh/vertex_fans.h"

namespace csgrun {

/// Calls walk(begin, end, points) for ranges of points, which sets the vertices of the corners
/// there, numbered from 0 in each, and appends their points. False if it returns false for any:
/// then the fans are not made. `by_point`: corners by their points.
template <class Walk>
bool walk_in_parts(const CountingOrder& by_point, VertexFans& fans, Walk&& walk) {
  const size_t points = by_point.starts.size() - 1;
  // Fans do not leave a point. Numbers are made anew if there is more than one part.
  const size_t each = has_threads() ? kFewForThreads : std::max<size_t>(1, points);
  std::vector<std::vector<uint32_t>> parts(part_count(points, each));
  std::atomic<bool> are_all_made = true;
  for_each_part(points, each, [&](size_t part, size_t begin, size_t end) {
    std::vector<uint32_t> own;
    if (!are_all_made || !walk(begin, end, own)) are_all_made = false;
    parts[part] = std::move(own);
  });
  if (!are_all_made) return false;
  std::vector<uint32_t> firsts;  // vertices of the parts
  fans.point_of_vertex.clear();
  for (const auto& part : parts) {
    firsts.push_back(static_cast<uint32_t>(fans.point_of_vertex.size()));
    fans.point_of_vertex.insert(fans.point_of_vertex.end(), part.begin(), part.end());
  }
  if (parts.size() <= 1) return true;
  for_each_part(points, each, [&](size_t part, size_t begin, size_t end) {
    for (uint32_t i = by_point.starts[begin]; i < by_point.starts[end]; ++i) {
      fans.vertex_of_corner[by_point.order[i]] += firsts[part];
    }
  });
  return true;
}

}  // namespace csgrun
