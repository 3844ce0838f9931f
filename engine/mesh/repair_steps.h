// The steps of repair_mesh. Each works on faces as loops over welded points and notes what it does.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

#include <csgrun/engine/error.h>
#include <csgrun/engine/repair.h>

#include "engine/mesh/loop_faces.h"

namespace csgrun {

/// A mesh while it is repaired. Loops have no repeated neighbours (clean_faces sees to that).
struct RepairMesh {
  std::vector<glm::dvec3> points;
  std::vector<LoopFace> faces;
};

/// What a step does, counted.
class StepNote {
 public:
  explicit StepNote(RepairAction action) { step_.action = action; }
  void add(const std::string& place) {
    if (step_.places.size() < RepairStep::kMostPlaces) step_.places.push_back(place);
    ++step_.count;
  }
  void add() { ++step_.count; }  ///< somewhere: it has no place
  /// "at (1, 2, 3)".
  void add_at(const glm::dvec3& point);
  RepairStep& step() { return step_; }
  /// Into the report, if anything was counted.
  void file(RepairReport& report) {
    if (step_.count > 0) report.steps.push_back(std::move(step_));
  }

 private:
  RepairStep step_;
};

/// For each face, whether it is one of several over the same points of which nobody can tell yet
/// how many will stay. An edge is open if an odd number of other faces uses it, or only such ones.
using Undecided = std::vector<bool>;

/// Makes points of open edges one with the nearest earlier such point within `tolerance` that was
/// not itself moved. So no point moves further than the tolerance.
void weld_open_points(RepairMesh& mesh, const Undecided& undecided, double tolerance,
                      StepNote& note);

/// Splits edges that are open, or that are not balanced, at the points of such edges that lie on
/// them: within `tolerance`, or as near as doubles can be.
void split_open_edges(RepairMesh& mesh, const Undecided& undecided, double tolerance,
                      StepNote& note);

/// Drops repeated corners and spikes, and faces of which nothing is left.
void clean_faces(RepairMesh& mesh, StepNote& note);

/// Drops faces whose points lie on a line; the neighbour across the longest edge is split, so that
/// nothing opens.
void drop_flat_faces(RepairMesh& mesh, StepNote& note);

/// When faces over the same points are looked at.
enum class RepeatedFaces {
  kBeforeSplitting,  ///< neighbours may still be found by welding and splitting
  kBeforeFilling,
  kAfterFilling,
};

/// Of faces over the same points one stays where its neighbours need one: where on most of its
/// edges an odd number of others ends. Elsewhere, and where all edges are balanced, pairs back to
/// back are taken away, which changes no winding number. Before holes are filled, a surface of
/// which nothing would be left stays once. Before edges are split, faces that would go wait where
/// no other uses some of their edges, unless their other edges do without them: returned are those
/// of the faces left.
Undecided drop_repeated_faces(RepairMesh& mesh, RepeatedFaces when, StepNote& note);

/// Turns faces so that every edge which an even number of faces uses is balanced, and as few faces
/// as may be where there is a choice. Errors: kInvalidMesh, when there is no such orientation.
Status orient_faces(RepairMesh& mesh, StepNote& note);

/// Whether no point has a winding number other than 0: faces of each plane, up to rounding, cancel.
/// False also where they do so but share no edges. O(n log n).
bool encloses_nothing(const RepairMesh& mesh);

/// Turns over closed surfaces that are inside out, each with what it encloses. Each is compared
/// with the surfaces whose boxes hold its box, by a few rays: O(n log n) where that are few, and
/// faces above one another are.
void orient_outwards(RepairMesh& mesh, StepNote& note);

/// A loop of edges that are missing, in the direction of the face that would close it.
using HoleLoop = std::vector<uint32_t>;

/// The holes: simple loops, shortest ones first where loops meet in a vertex; in the order of their
/// lowest edges. Closed by them every directed edge is balanced.
std::vector<HoleLoop> find_holes(const RepairMesh& mesh);

/// Closes the holes.
void fill_holes(RepairMesh& mesh, const std::vector<HoleLoop>& holes, StepNote& note);

/// "28 edges at (1, 2, 3)": the point is the middle of the hole's box.
std::string hole_text(const RepairMesh& mesh, const HoleLoop& hole);

/// The triangles of least area (a little weight is on short edges) that close a loop, in its
/// direction. O(n^3).
std::vector<std::vector<uint32_t>> triangulate_hole(const std::vector<glm::dvec3>& points,
                                                    const HoleLoop& hole);

}  // namespace csgrun
