// The order of the steps of a repair, and what is said about them.
#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <utility>

#include <csgrun/engine/repair.h>
#include <csgrun/engine/validate.h>

#include "engine/base/none.h"
#include "engine/mesh/edge_uses.h"
#include "engine/mesh/mesh_text.h"
#include "engine/mesh/repair_steps.h"

namespace csgrun {
namespace {

Error refuse(std::string message) { return {ErrorCode::kInvalidMesh, std::move(message), {}}; }

std::string counted(uint64_t count, const std::string& one, const std::string& many) {
  return std::to_string(count) + " " + (count == 1 ? one : many);
}

/// " (first: at (0, 0, 1), at (0, 0, 2))"; empty when no places are known.
std::string places_text(const RepairStep& step) {
  if (step.places.empty()) return {};
  std::string text = step.count > step.places.size() ? " (first: " : " (";
  for (size_t i = 0; i < step.places.size(); ++i) text += (i > 0 ? ", " : "") + step.places[i];
  return text + ")";
}

/// Welds points of equal coordinates, and notes those that were more than one.
void weld_equal(PolygonMesh& mesh, StepNote& note) {
  const std::vector<uint32_t> before = mesh.corners;
  std::vector<bool> seen(mesh.points.size(), false);
  weld_points(mesh);
  std::vector<uint32_t> first(mesh.points.size(), kNone);
  for (size_t i = 0; i < before.size(); ++i) {
    if (seen[before[i]]) continue;
    seen[before[i]] = true;
    uint32_t& own = first[mesh.corners[i]];
    if (own == kNone) {
      own = before[i];
    } else {
      note.add_at(mesh.points[mesh.corners[i]]);
    }
  }
}

RepairMesh to_loops(const PolygonMesh& mesh) {
  RepairMesh result;
  result.points = mesh.points;
  result.faces.resize(mesh.face_count());
  for (uint32_t f = 0; f < mesh.face_count(); ++f) {
    LoopFace& face = result.faces[f];
    if (f < mesh.surface.size()) face.surface = mesh.surface[f];
    if (f < mesh.appearance_of.size()) face.appearance = mesh.appearance_of[f];
    for (uint32_t l = mesh.face_starts[f]; l < mesh.face_starts[f + 1]; ++l) {
      face.loops.emplace_back(mesh.corners.begin() + mesh.loop_starts[l],
                              mesh.corners.begin() + mesh.loop_starts[l + 1]);
    }
  }
  return result;
}

/// The faces into `mesh`, whose labels and flags stay.
void from_loops(const RepairMesh& faces, PolygonMesh& mesh) {
  const bool has_appearance = !mesh.appearance_of.empty();
  mesh.points = faces.points;
  mesh.corners.clear();
  mesh.loop_starts.assign(1, 0);
  mesh.face_starts.assign(1, 0);
  mesh.surface.clear();
  mesh.appearance_of.clear();
  mesh.convex = false;
  for (const LoopFace& face : faces.faces) {
    for (const auto& loop : face.loops) {
      mesh.corners.insert(mesh.corners.end(), loop.begin(), loop.end());
      mesh.loop_starts.push_back(static_cast<uint32_t>(mesh.corners.size()));
    }
    mesh.face_starts.push_back(static_cast<uint32_t>(mesh.loop_count()));
    mesh.surface.push_back(face.surface);
    if (has_appearance) mesh.appearance_of.push_back(face.appearance);
  }
  weld_points(mesh);  // drops points that no face uses any more
}

/// Indices out of range, and numbers that are none.
std::optional<Error> find_bad_number(const PolygonMesh& mesh) {
  MeshReport report = check_mesh(mesh);
  if (report.bad_indices == 0 && report.non_finite_points == 0) return std::nullopt;
  report.degenerate_faces = report.open_edges = report.misoriented_edges = 0;
  return refuse("cannot be repaired: " + report.text());
}

/// Points beyond the range in which the steps can compute: products of three must be finite.
std::optional<Error> find_far_point(const PolygonMesh& mesh) {
  constexpr double kMost = 1e100;
  for (const glm::dvec3& p : mesh.points) {
    if (std::fabs(p.x) <= kMost && std::fabs(p.y) <= kMost && std::fabs(p.z) <= kMost) continue;
    return refuse("cannot be repaired: coordinates beyond 1e100 mm at " + place_text(p));
  }
  return std::nullopt;
}

std::string open_text(const RepairMesh& mesh, const std::vector<HoleLoop>& holes) {
  const auto largest =
      std::max_element(holes.begin(), holes.end(),
                       [](const HoleLoop& a, const HoleLoop& b) { return a.size() < b.size(); });
  return "in " + counted(holes.size(), "hole of ", "holes, the largest of ") +
         hole_text(mesh, *largest);
}

/// An edge that faces run through unequally though their number is even.
std::optional<Error> find_disagreement(const RepairMesh& mesh) {
  std::optional<Error> error;
  EdgeUses(mesh.faces, mesh.points.size()).for_each_edge([&](std::span<const EdgeUse> uses) {
    if (error || uses.size() % 2 == 1 || excess(uses) == 0) return;
    error = refuse("faces disagree at the edge " + place_text(mesh.points[uses[0].low]) + " - " +
                   place_text(mesh.points[uses[0].high]));
  });
  return error;
}

Undecided drop_bad_faces(RepairMesh& mesh, const RepairOptions& options, RepeatedFaces when,
                         StepNote& degenerate, StepNote& repeated) {
  clean_faces(mesh, degenerate);
  if (options.drop_duplicates) return drop_repeated_faces(mesh, when, repeated);
  return Undecided(mesh.faces.size(), false);
}

/// Everything between welding by value and the result.
Status run_steps(RepairMesh& mesh, const RepairOptions& options, bool outwards,
                 RepairReport& report) {
  StepNote degenerate(RepairAction::kDropDegenerate), repeated(RepairAction::kDropDuplicates),
      near(RepairAction::kWeldNear), split(RepairAction::kSplitEdges),
      turned(RepairAction::kTurnFaces), filled(RepairAction::kFillHoles),
      inverted(RepairAction::kTurnSurfaces);
  const auto drop_bad = [&](RepeatedFaces when) {
    return drop_bad_faces(mesh, options, when, degenerate, repeated);
  };
  Undecided undecided = drop_bad(RepeatedFaces::kBeforeSplitting);
  if (options.weld > 0) {
    weld_open_points(mesh, undecided, options.weld, near);
    undecided = drop_bad(RepeatedFaces::kBeforeSplitting);
  }
  split_open_edges(mesh, undecided, options.weld, split);
  drop_bad(RepeatedFaces::kBeforeFilling);
  if (options.drop_degenerate) {
    drop_flat_faces(mesh, degenerate);
    drop_bad(RepeatedFaces::kBeforeFilling);
  }
  near.file(report);
  split.file(report);
  degenerate.file(report);
  if (options.orient) {
    if (Status status = orient_faces(mesh, turned); !status) return status.error();
  } else if (const auto error = find_disagreement(mesh)) {
    return *error;
  }
  turned.file(report);

  const std::vector<HoleLoop> holes = find_holes(mesh);
  if (!holes.empty() && !options.fill_holes) {
    size_t edges = 0;
    for (const HoleLoop& hole : holes) edges += hole.size();
    return refuse("not closed: " + counted(edges, "open edge ", "open edges ") +
                  open_text(mesh, holes));
  }
  fill_holes(mesh, holes, filled);
  filled.file(report);
  if (options.drop_duplicates && !holes.empty()) {
    drop_repeated_faces(mesh, RepeatedFaces::kAfterFilling, repeated);
  }
  repeated.file(report);
  if (mesh.faces.empty()) return refuse("nothing is left: no face bounds a solid");
  if (encloses_nothing(mesh))
    return refuse("nothing is enclosed: every face lies on others' backs");
  if (outwards) orient_outwards(mesh, inverted);
  inverted.file(report);
  if (!find_holes(mesh).empty()) {
    return Error{ErrorCode::kInternal, "the repair left open edges", {}};
  }
  return std::monostate{};
}

}  // namespace

std::string RepairStep::text() const {
  std::string line;
  switch (action) {
    case RepairAction::kWeldEqual:
      line = counted(count, "point was", "points were") + " welded to another of equal coordinates";
      break;
    case RepairAction::kWeldNear:
      line = counted(count, "point was", "points were") + " welded to another within " +
             shortest_number(tolerance) + " mm";
      break;
    case RepairAction::kDropDegenerate:
      line = counted(count, "face", "faces") + " without area " + (count == 1 ? "was" : "were") +
             " dropped";
      break;
    case RepairAction::kDropDuplicates:
      line = counted(count, "face", "faces") + " on the same points as others " +
             (count == 1 ? "was" : "were") + " dropped";
      break;
    case RepairAction::kSplitEdges:
      line = counted(count, "open edge was", "open edges were") + " split at points on " +
             (count == 1 ? "it" : "them");
      break;
    case RepairAction::kTurnFaces:
      line = counted(count, "face was", "faces were") + " turned to agree with " +
             (count == 1 ? "its" : "their") + " neighbours";
      break;
    case RepairAction::kTurnSurfaces:
      line = counted(count, "surface", "surfaces") + " that " + (count == 1 ? "was" : "were") +
             " inside out " + (count == 1 ? "was" : "were") + " turned over";
      break;
    case RepairAction::kFillHoles:
      line = counted(count, "hole was", "holes were") + " filled with " +
             counted(faces, "face", "faces");
      break;
  }
  return line + places_text(*this);
}

std::string RepairStep::advice() const {
  std::string line;
  switch (action) {
    case RepairAction::kWeldEqual:
    case RepairAction::kTurnSurfaces:
      return {};  // nobody need do it by hand
    case RepairAction::kWeldNear:
      line = "make " + counted(count, "point", "points") + " equal to the one within " +
             shortest_number(tolerance) + " mm";
      break;
    case RepairAction::kDropDegenerate:
      line = "leave out " + counted(count, "face", "faces") + " without area";
      break;
    case RepairAction::kDropDuplicates:
      line = "leave out " + counted(count, "face", "faces") + " on the same points as others";
      break;
    case RepairAction::kSplitEdges:
      line = "put the points that lie on " + counted(count, "open edge", "open edges") +
             " into the faces there, as corners";
      break;
    case RepairAction::kTurnFaces:
      line = "reverse " + counted(count, "face", "faces");
      break;
    case RepairAction::kFillHoles:
      line = "add the faces that close " + counted(count, "hole", "holes");
      break;
  }
  return line + places_text(*this);
}

Result<PolygonMesh> repair_mesh(PolygonMesh mesh, const RepairOptions& options,
                                RepairReport* report) {
  RepairReport own;
  if (report == nullptr) report = &own;
  if (!(options.weld >= 0) || !std::isfinite(options.weld)) {
    return Error{ErrorCode::kInvalidArgument, "the tolerance of welding must be 0 or more", {}};
  }
  if (const auto error = find_bad_number(mesh)) return *error;
  StepNote equal(RepairAction::kWeldEqual);
  weld_equal(mesh, equal);  // and points without faces are gone
  if (const auto error = find_far_point(mesh)) return *error;
  equal.file(*report);
  RepairMesh faces = to_loops(mesh);
  // With the rule `positive` what is inverted is meant to be nothing.
  const bool outwards = options.orient && mesh.fill != FillRule::kPositive;
  if (const Status status = run_steps(faces, options, outwards, *report); !status) {
    return status.error();
  }
  from_loops(faces, mesh);
  return mesh;
}

std::string describe_holes(const PolygonMesh& mesh) {
  RepairMesh faces = to_loops(mesh);
  StepNote unused(RepairAction::kTurnFaces);
  clean_faces(faces, unused);
  if (!orient_faces(faces, unused)) return {};
  const std::vector<HoleLoop> holes = find_holes(faces);
  return holes.empty() ? std::string() : open_text(faces, holes);
}

}  // namespace csgrun
