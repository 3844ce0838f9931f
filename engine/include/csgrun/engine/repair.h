// Repair of meshes that are open or broken: a named step, which says what it did and where.
#pragma once

#include <compare>
#include <cstdint>
#include <string>
#include <vector>

#include <csgrun/engine/error.h>
#include <csgrun/engine/polygon_mesh.h>

namespace csgrun {

struct RepairOptions {
  /// Points of open edges are made one with points of open edges within this distance, mm, and open
  /// edges are split at such points on them. 0: equal coordinates only (these are always welded).
  double weld = 0;
  /// Faces whose points lie on one line. Faces of fewer than three distinct points are none, and go
  /// in any case.
  bool drop_degenerate = true;
  bool drop_duplicates = true;  ///< faces that repeat another one, or lie on its back
  bool orient = true;           ///< turns faces to agree with their neighbours, surfaces outwards
  bool fill_holes = false;      ///< closes what is open by new faces

  auto operator<=>(const RepairOptions&) const = default;
};

enum class RepairAction : uint8_t {
  kWeldEqual,
  kWeldNear,
  kDropDegenerate,
  kDropDuplicates,
  kSplitEdges,
  kTurnFaces,
  kTurnSurfaces,
  kFillHoles,
};

/// One thing that was done: how often, and the first places.
struct RepairStep {
  RepairAction action = RepairAction::kWeldEqual;
  uint64_t count = 0;
  uint64_t faces = 0;               ///< kFillHoles: how many were added
  double tolerance = 0;             ///< kWeldNear, kSplitEdges: mm
  std::vector<std::string> places;  ///< at most kMostPlaces
  static constexpr size_t kMostPlaces = 3;

  /// One line: "3 faces were turned to agree with their neighbours (first: at (0, 0, 1))".
  [[nodiscard]] std::string text() const;
  /// What somebody who writes faces by hand would do instead: "reverse 3 faces (first: at (0, 0,
  /// 1))". Empty where it comes by itself.
  [[nodiscard]] std::string advice() const;
};

struct RepairReport {
  std::vector<RepairStep> steps;  ///< in the order in which they were done; empty: nothing was
};

/// Makes a mesh what a leaf must be: closed, every directed edge balanced by its reverse. Its
/// surface may still cross itself, which PolygonMesh::fill settles. In this order, each step only
/// if there is need: points of equal coordinates are welded and unused ones dropped; duplicate
/// faces are dropped; points of open edges are welded within the tolerance, and open edges split at
/// points on them; faces without area are dropped; faces are turned to agree with their neighbours;
/// holes are filled; surfaces that are inside out are turned over. Faces that one of these leaves
/// without three distinct points, or makes duplicates, go at once.
///
/// With the fill rule kPositive surfaces that are inside out stay as they are.
///
/// A hole is a loop of open edges, closed by the triangles of least area between its points (a loop
/// of more than a few hundred edges by one polygon). A surface that others enclose keeps its
/// orientation relative to them: voids stay voids.
///
/// Deterministic; labels of faces are kept, new faces have those of the first face beside their
/// hole. Errors (kInvalidMesh): indices out of range, points that are not finite, nothing left,
/// surfaces that have no consistent orientation, open edges when holes are not to be filled,
/// nothing enclosed (a sheet and its back). The message gives counts and first places. O(n log n),
/// per hole of k edges O(k^3) with k bounded, and for each surface that is inside out the number of
/// faces of those whose boxes hold its box.
[[nodiscard]] Result<PolygonMesh> repair_mesh(PolygonMesh mesh, const RepairOptions& options,
                                              RepairReport* report);

/// The open boundary of a mesh whose points are welded: "in 2 holes, the largest of 28 edges at
/// (1, 2, 3)", or empty when it is closed or has no consistent orientation. REQUIRES: no bad
/// indices, as check_mesh counts them.
[[nodiscard]] std::string describe_holes(const PolygonMesh& mesh);

/// The least repair that makes a mesh a closed one: what is wanted, what is switched off there, a
/// small tolerance of welding (a power of ten, at most a ten-thousandth of the mesh's size), or
/// filling of its holes; else the error of the last. `report`, if given, gets what that does.
/// Repairs copies, so it costs some times what repair_mesh does.
[[nodiscard]] Result<RepairOptions> suggest_repair(const PolygonMesh& mesh,
                                                   const RepairOptions& wanted = {},
                                                   RepairReport* report = nullptr);

}  // namespace csgrun
