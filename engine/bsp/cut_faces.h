// Polygons cut along what other operands' polygons have in common with them: each by itself, with
// points of its own, so that several can be cut at the same time.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <csgrun/engine/evaluate.h>

#include "engine/bsp/contact_table.h"
#include "engine/bsp/cut_polygon.h"

namespace csgrun {

struct CutFaces {
  struct Face {
    uint32_t polygon, first_loop, end_loop;
  };
  CutLoops loops;
  std::vector<Face> faces;
  std::vector<uint32_t> left;      ///< polygons that could not be cut this way
  std::vector<uint32_t> by_value;  ///< where names did not do; of the others, or of those left
  /// The points [first_crossing, end_crossing) are those in which sheets of two operands cross
  /// within a polygon of a third one, once for each polygon that was cut by name.
  uint32_t first_crossing = 0, end_crossing = 0;
  /// Given up (KernelOptions::stop_when_crowded): nothing of the above is complete.
  bool is_crowded = false;
};

/// Cuts polygons along the segments at which they have contacts: by name (cut_polygon.h) where all
/// of these are plain and no points coincide, else by value (face_arrangement.h). What nothing
/// cuts, and has a corner that is not touched, stays whole and is not mentioned. Points of the
/// loops are in the geometry; equal ones have one number in loops that are loose. `with_planes` are
/// `polygons` and all that have more than a corner of their own in common with these; their
/// supports are made. No contact of theirs may have been asked for. `is_open`: see PlainlyCovered.
/// `stats` is added to. Parallel; incomplete when cancelled.
CutFaces cut_faces(Job& job, std::span<const uint32_t> polygons,
                   std::span<const uint32_t> with_planes, const ContactTable& contacts,
                   ContactEnds& ends, std::span<const uint8_t> is_open, CellGeometry& geometry,
                   PointIndex& index, const KernelOptions& options, EvaluateStats& stats);

}  // namespace csgrun
