// Which repair would help: found by trying.
#include <algorithm>
#include <array>
#include <cmath>

#include <csgrun/engine/repair.h>

namespace csgrun {
namespace {

constexpr std::array<bool RepairOptions::*, 3> kSwitches{
    &RepairOptions::orient, &RepairOptions::drop_duplicates, &RepairOptions::drop_degenerate};

double size_of(const PolygonMesh& mesh) {
  double size = 0;
  for (const glm::dvec3& p : mesh.points) {
    for (int i = 0; i < 3; ++i) size = std::max(size, std::fabs(p[i] - mesh.points[0][i]));
  }
  return size;
}

/// What is tried, the mildest first.
std::vector<RepairOptions> candidates(const PolygonMesh& mesh, const RepairOptions& wanted) {
  std::vector<RepairOptions> all{wanted};
  RepairOptions every = wanted;
  for (const auto option : kSwitches) {
    if (wanted.*option) continue;
    all.push_back(wanted);
    all.back().*option = every.*option = true;
  }
  if (all.size() > 2) all.push_back(every);
  const double size = size_of(mesh);
  for (const double weld : {1e-9, 1e-8, 1e-7, 1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 1e-1, 1.0, 10.0}) {
    if (!(weld >= 1e-7 * size && weld <= 1e-4 * size && weld > wanted.weld)) continue;
    all.push_back(every);
    all.back().weld = weld;
  }
  if (wanted.fill_holes) return all;
  all.push_back(wanted);
  all.back().fill_holes = true;
  if (every == wanted) return all;
  all.push_back(every);
  all.back().fill_holes = true;
  return all;
}

}  // namespace

Result<RepairOptions> suggest_repair(const PolygonMesh& mesh, const RepairOptions& wanted,
                                     RepairReport* report) {
  Error last;
  for (const RepairOptions& options : candidates(mesh, wanted)) {
    RepairReport own;
    const Result<PolygonMesh> repaired = repair_mesh(mesh, options, &own);
    if (repaired) {
      if (report != nullptr) *report = std::move(own);
      return options;
    }
    last = repaired.error();
  }
  return last;
}

}  // namespace csgrun
