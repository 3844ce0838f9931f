#include "engine/bsp/surface_cells.h"

#include <algorithm>
#include <atomic>

#include "engine/bsp/cell_arrangement.h"
#include "engine/bsp/parallel_runs.h"
#include "engine/bsp/sign_stats.h"

namespace csgrun {
namespace {

/// Solves cells one after another; one per thread.
class SurfaceCellSolver {
 public:
  SurfaceCellSolver(const Job& job, const SurfacePatches& patches,
                    const SurfaceCellsRequest& request)
      : job_(job), patches_(patches), request_(request), geometry_(job.planes(), &job) {}

  bool solve(const SurfaceOctree& tree, const SurfaceCell& cell, const CellWalls& walls,
             SurfaceCells& out) {
    geometry_.clear();
    numbers_.clear();
    polygons_.clear();
    for (uint32_t k = 0; k < cell.count; ++k) {
      Fragment f = geometry_.load(tree.polygons[cell.first_polygon + k]);
      if (clip_to_cell(geometry_, job_, cell.box, walls, f)) polygons_.push_back(f);
    }
    if (!arrangement_.build(geometry_, job_, cell.box, walls, polygons_, cell.corner_winding)) {
      return false;
    }
    const auto base = static_cast<uint32_t>(out.windings.size());
    const auto& windings = arrangement_.windings();
    out.windings.insert(out.windings.end(), windings.begin(), windings.end());
    for (const CellArrangement::Part& part : arrangement_.parts()) add(part, base, walls, out);
    if (request_.below_vertex != kNone) {
      const uint32_t volume =
          volume_below(geometry_.vertex_point(request_.below_vertex), walls, base);
      if (volume != kNone) out.vertex_volumes.push_back({request_.below_vertex, volume});
    }
    if (request_.below_points) {
      out.below_point.resize(out.set.points.size(), kNone);
      for (uint32_t p = 0; p < numbers_.size(); ++p) {
        if (numbers_[p] != kNone) out.below_point[numbers_[p]] = volume_below(p, walls, base);
      }
    }
    return true;
  }

  SignCounters take_counters() { return std::exchange(geometry_.counters, {}); }

 private:
  void add(const CellArrangement::Part& part, uint32_t base, const CellWalls& walls,
           SurfaceCells& out) {
    const Fragment& f = part.fragment;
    const uint32_t front = base + part.front, back = base + part.back;
    const uint32_t patch = patches_.patch_of[f.polygon];
    if (patch != kNone) {
      const bool up = part.has_up;
      out.patches.push_back({patch, up ? front : back, up ? back : front});
      return;
    }
    out.set.add(geometry_, f, false, numbers_);
    out.sides.push_back({front, back, part.has_up, part.has_down});
    if (!request_.wall_edges) return;
    const FragmentSet::Piece& piece = out.set.pieces.back();
    for (uint32_t i = 0; i < f.count; ++i) {
      const uint32_t plane = geometry_.edges(f)[i];
      const auto wall = std::find(walls.begin(), walls.end(), plane);
      if (wall == walls.end()) continue;
      out.wall_edges.push_back({f.support.index(), plane, (wall - walls.begin()) % 2 == 1,
                                out.set.corner_point[piece.first + i],
                                out.set.corner_point[piece.first + (i + 1) % f.count], front,
                                back});
    }
  }

  /// The volume just below a point, or kNone for a point that the cell does not hold inside.
  uint32_t volume_below(uint32_t point, const CellWalls& walls, uint32_t base) {
    for (size_t w = 0; w < walls.size(); ++w) {
      if (geometry_.side(walls[w], point) != (w % 2 == 0 ? 1 : -1)) return kNone;
    }
    return base + arrangement_.volume_below(geometry_, point);
  }

  const Job& job_;
  const SurfacePatches& patches_;
  const SurfaceCellsRequest& request_;
  CellGeometry geometry_;
  CellArrangement arrangement_;
  std::vector<Fragment> polygons_;
  std::vector<uint32_t> numbers_;
};

}  // namespace

Result<std::vector<SurfaceCells>> solve_surface_cells(Job& job, const SurfaceOctree& tree,
                                                      const SurfacePatches& patches,
                                                      const SurfaceCellsRequest& request,
                                                      const KernelOptions& options,
                                                      EvaluateStats& stats) {
  for (const uint32_t p : tree.polygons) job.ensure_planes(p);
  std::vector<CellWalls> walls;
  for (const SurfaceCell& cell : tree.cells) walls.push_back(walls_of(job, cell.box));

  std::vector<SurfaceCells> runs(run_count(tree.cells.size()));
  std::vector<SignCounters> counters(runs.size());
  std::atomic<bool> is_closed{true};
  const auto make = [&] { return SurfaceCellSolver(job, patches, request); };
  for_each_run(runs.size(), options, make, [&](SurfaceCellSolver& solver, size_t run) {
    for (size_t c = run * kCellsPerRun; c < std::min(tree.cells.size(), (run + 1) * kCellsPerRun);
         ++c) {
      if (!solver.solve(tree, tree.cells[c], walls[c], runs[run])) is_closed = false;
    }
    counters[run] = solver.take_counters();
  });
  if (options.cancel && options.cancel->load(std::memory_order_relaxed)) {
    return Error{ErrorCode::kCancelled, "the evaluation was cancelled", {}};
  }
  if (!is_closed) {
    return Error{
        ErrorCode::kInternal, "the winding numbers of a surface contradict each other", {}};
  }
  SignCounters total;
  for (const SignCounters& c : counters) total.add(c);
  add_signs(stats, total);
  stats.cells += tree.visited;
  stats.surface_cells += tree.cells.size();
  stats.solved_cells += tree.cells.size();
  return runs;
}

}  // namespace csgrun
