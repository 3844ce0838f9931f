// Whether the lists of a polygon mesh go together, so that its faces and loops may be walked.
#pragma once

#include <algorithm>
#include <vector>

#include <csgrun/engine/polygon_mesh.h>

namespace csgrun {

/// Whether the loops are consecutive ranges of the corners, and the faces of the loops. O(n).
inline bool has_sound_lists(const PolygonMesh& mesh) {
  const auto ranges = [](const std::vector<uint32_t>& starts, size_t size) {
    return !starts.empty() && starts.front() == 0 && starts.back() == size &&
           std::is_sorted(starts.begin(), starts.end());
  };
  return ranges(mesh.loop_starts, mesh.corners.size()) &&
         ranges(mesh.face_starts, mesh.loop_count());
}

}  // namespace csgrun
