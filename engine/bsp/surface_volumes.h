// Which of the volumes that a surface leaves are inside: by winding number, or by what can be
// reached from infinity.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "engine/bsp/self_resolution.h"
#include "engine/bsp/surface_cells.h"

namespace csgrun {

struct InsideLabels {
  std::vector<std::vector<uint8_t>> volumes;  ///< per run, per volume
  struct Patch {
    bool known = false, front = false, back = false;
  };
  std::vector<Patch> patches;  ///< per patch of the surface; known for those that were seen
};

/// Whether a place of some winding number is inside by kNonZero, kPositive or kEvenOdd.
bool is_inside(int32_t winding, InsideRule rule);

/// By kNonZero, kPositive or kEvenOdd. std::nullopt when a patch has two labels on one side: an
/// invariant of ours is broken.
std::optional<InsideLabels> label_by_winding(const std::vector<SurfaceCells>& runs,
                                             size_t patch_count, InsideRule rule);

/// Whether polygons of different planes, for all that is known, cross each other in a line of a
/// wall: then what runs on from cell to cell there is not what it seems, and the cells are to be
/// solved again with other walls. REQUIRES: wall edges were asked for.
bool crosses_in_wall(const Job& job, const std::vector<SurfaceCells>& runs);

/// By kOuterHull or kOrientedHull, for one class of polygons: volumes are joined along the surface,
/// from cell to cell and along patches, and flooded from the volume below `lowest`, the
/// lexicographically lowest vertex of the class. The complement of a connected surface consists of
/// volumes with connected boundaries, so that is all that is needed to join them. std::nullopt when
/// that vertex was not seen, or a patch has two labels on one side. REQUIRES: !crosses_in_wall(job,
/// runs).
std::optional<InsideLabels> label_by_reach(const Job& job, const std::vector<SurfaceCells>& runs,
                                           size_t patch_count, uint32_t lowest, InsideRule rule);

/// By kOuterHull, for a surface that may touch itself but nowhere crosses, and may hang together or
/// not: what a boundary component of the outside encloses is filled if it is the outer one. What
/// stands in a void that was filled keeps its own boundary. std::nullopt when the lowest vertex of
/// a component lies in a wall. REQUIRES: no patches; all volumes below vertices were asked for;
/// !crosses_in_wall(job, runs).
std::optional<InsideLabels> label_by_filling(const Job& job, const std::vector<SurfaceCells>& runs);

}  // namespace csgrun
