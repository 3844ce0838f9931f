#include "primitives/solids/finish_solid.h"

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include <csgrun/engine/repair.h>
#include <csgrun/engine/validate.h>

#include "primitives/base/text.h"
#include "primitives/solids/bent_quads.h"

namespace csgrun {
namespace {

std::string headline(const MeshReport& report) {
  if (report.bad_indices > 0) return "indices out of range";
  if (report.non_finite_points > 0) return "coordinates that are not finite";
  if (report.degenerate_faces > 0) return "faces without area";
  if (report.open_edges > 0) return "not closed";
  return "not consistently oriented";
}

/// Welding can make neighbours in a loop equal; a corner that repeats its predecessor is no corner.
void drop_repeated_corners(PolygonMesh& mesh) {
  std::vector<uint32_t> corners;
  corners.reserve(mesh.corners.size());
  for (size_t loop = 0; loop < mesh.loop_count(); ++loop) {
    const size_t begin = mesh.loop_starts[loop], end = mesh.loop_starts[loop + 1];
    const size_t first = corners.size();
    for (size_t i = begin; i < end; ++i) {
      if (corners.size() == first || corners.back() != mesh.corners[i]) {
        corners.push_back(mesh.corners[i]);
      }
    }
    while (corners.size() > first + 1 && corners.back() == corners[first]) corners.pop_back();
    mesh.loop_starts[loop] = static_cast<uint32_t>(first);
  }
  mesh.loop_starts.back() = static_cast<uint32_t>(corners.size());
  mesh.corners = std::move(corners);
}

/// Whether the loops are consecutive ranges of the corners, and the corners are points.
bool all_indices_valid(const PolygonMesh& mesh) {
  return !mesh.loop_starts.empty() && mesh.loop_starts.front() == 0 &&
         mesh.loop_starts.back() == mesh.corners.size() &&
         std::is_sorted(mesh.loop_starts.begin(), mesh.loop_starts.end()) &&
         std::all_of(mesh.corners.begin(), mesh.corners.end(),
                     [&](uint32_t corner) { return corner < mesh.points.size(); });
}

/// The options as a script writes them.
std::string options_text(const RepairOptions& options) {
  if (options == RepairOptions{}) return "true";
  std::string text;
  const auto add = [&](const std::string& entry) { text += (text.empty() ? "" : ", ") + entry; };
  if (options.weld > 0) add("weld = " + number_text(options.weld));
  if (options.fill_holes) add("fill_holes = true");
  if (!options.orient) add("orient = false");
  if (!options.drop_degenerate) add("drop_degenerate = false");
  if (!options.drop_duplicates) add("drop_duplicates = false");
  return "{" + text + "}";
}

/// Drops what has no area, where nothing else is wrong with the mesh of a file: programs write such
/// faces by the thousand, and no point of the surface is missing without them. Nothing when that
/// does not make it sound.
std::optional<PolygonMesh> without_flat_faces(const PolygonMesh& mesh, const MeshReport& report,
                                              std::string& done) {
  MeshReport others = report;
  others.degenerate_faces = 0;
  if (!others.ok()) return std::nullopt;
  RepairOptions options;
  options.drop_duplicates = options.orient = false;
  RepairReport steps;
  Result<PolygonMesh> repaired = repair_mesh(mesh, options, &steps);
  if (!repaired || !check_mesh(*repaired).ok()) return std::nullopt;
  for (const RepairStep& step : steps.steps) done += (done.empty() ? "" : "; ") + step.text();
  return *std::move(repaired);
}

/// What to do about faces that somebody wrote by hand.
std::string advice(const PolygonMesh& mesh) {
  RepairReport report;
  const Result<RepairOptions> options = suggest_repair(mesh, {}, &report);
  if (!options) return "; " + options.error().message;
  std::string text;
  for (const RepairStep& step : report.steps) {
    const std::string line = step.advice();
    if (!line.empty()) text += (text.empty() ? "; to mend it, " : ", and ") + line;
  }
  return text;
}

}  // namespace

std::string repair_hint(const PolygonMesh& mesh, const std::string& name,
                        const RepairOptions& wanted, const std::string& refusal) {
  const Result<RepairOptions> options = suggest_repair(mesh, wanted);
  if (options) {
    return "; a script repairs it by import(\"" + name + "\", {repair = " + options_text(*options) +
           "})";
  }
  const std::string& reason = options.error().message;
  return reason == refusal ? "" : "; no repair makes it a solid: " + reason;
}

bool turn_outside(PolygonMesh& mesh) {
  // With the rule `positive` what is inverted is meant to be nothing.
  if (mesh.fill == FillRule::kPositive || !(signed_volume(mesh) < 0)) return false;
  reverse_faces(mesh);
  return true;
}

Result<PolygonMesh> finish_solid(PolygonMesh mesh, const std::string& name, std::string* note,
                                 bool is_file, PolygonMesh* uncut) {
  if (mesh.face_count() == 0) {
    return Error{ErrorCode::kInvalidMesh, name + ": has no faces", {}};
  }
  if (all_indices_valid(mesh)) {
    weld_points(mesh);
    drop_repeated_corners(mesh);
  }
  const MeshReport report = check_mesh(mesh);
  std::string done;
  std::optional<PolygonMesh> without;
  if (is_file && report.degenerate_faces > 0) without = without_flat_faces(mesh, report, done);
  if (without) {
    mesh = *std::move(without);
  } else if (!report.ok()) {
    std::string message = name + ": " + headline(report) + ": " + report.text();
    if (report.bad_indices == 0 && report.non_finite_points == 0) {
      if (report.open_edges > 0) {
        const std::string holes = describe_holes(mesh);
        if (!holes.empty()) message += " " + holes;
      }
      message += is_file ? repair_hint(mesh, name, {}, "") : advice(mesh);
    }
    return Error{ErrorCode::kInvalidMesh, std::move(message), {}};
  }
  if (uncut != nullptr && has_bent_quads(mesh)) *uncut = mesh;
  cut_bent_quads(mesh);
  if (turn_outside(mesh)) {
    done += std::string(done.empty() ? "" : "; ") + "inside out, its faces were turned over";
  }
  if (note != nullptr && !done.empty()) *note = name + ": " + done;
  return mesh;
}

}  // namespace csgrun
