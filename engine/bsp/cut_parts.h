// What one thread makes of some of the polygons that are cut (cut_faces.h), and all of it together.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "engine/bsp/contact_table.h"
#include "engine/bsp/cut_faces.h"

namespace csgrun {

/// Some of the polygons, what meets them, and what comes of it.
struct CutPart {
  /// Corners of its loops are points of the geometry by their numbers, vertices of the job (kVertex
  /// + number), or new points of the part (kNew + number).
  static constexpr uint32_t kVertex = 1u << 30, kNew = 1u << 31;

  struct Polygon {
    uint32_t number;
    uint32_t first_contact, end_contact, first_coplanar, end_coplanar;
    bool is_plain;  ///< all contacts are, and names may do
  };
  struct Point {
    std::array<double, 3> rounded;
    std::array<uint32_t, 3> planes;
    bool is_loose;  ///< of loops that are
  };
  struct Made {
    CutLoops loops;
    std::vector<Point> points;
    std::vector<CutFaces::Face> faces;
  };

  std::vector<Polygon> polygons;
  /// Of the polygons, but for those with convex operands that have a face in the polygon's plane:
  /// that one tells all.
  std::vector<uint32_t> contacts;
  std::vector<uint32_t> coplanar;  ///< polygons
  std::vector<Polygon> again;      ///< not cut by name after all
  Made made;
  std::vector<uint32_t> left, by_value;
  SignCounters counters;
};

/// Puts together what came of the parts, with points of the geometry: each has the corners of its
/// loops there, equal ones once in loops that are loose. Parallel.
CutFaces join_parts(const Job& job, const ContactTable& contacts, const std::vector<CutPart>& parts,
                    CellGeometry& geometry, PointIndex& index);

}  // namespace csgrun
