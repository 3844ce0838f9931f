#include "engine/bsp/evaluate_job.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "engine/bsp/cell_solver.h"
#include "engine/bsp/frame_map.h"
#include "engine/bsp/literal_cell.h"
#include "engine/bsp/non_manifold.h"
#include "engine/bsp/octree.h"
#include "engine/bsp/parallel_runs.h"
#include "engine/bsp/sign_stats.h"
#include "engine/bsp/touch_list.h"
#include "engine/bsp/unate.h"
#include "engine/bsp/whole_faces.h"

namespace csgrun {
namespace {

struct Work {
  std::vector<CellWalls> critical_walls, copied_walls;
  std::vector<uint32_t> walls_of_copied_cell;   ///< index into copied_walls, or kNone: not needed
  std::vector<Octree::CopiedPiece> cut_copies;  ///< of polygons that are not copied as a whole
  std::vector<WholePolygon> whole;
};

bool copied_whole(uint8_t fate) {
  return fate == static_cast<uint8_t>(Copy::kKeep) || fate == static_cast<uint8_t>(Copy::kFlip);
}

/// Makes every plane that the cells will need, so that they can be solved in parallel.
Work prepare(Job& job, const Octree& tree) {
  Work work;
  for (uint32_t p = 0; p < tree.fate.size(); ++p) {
    if (tree.is_wanted(p) && copied_whole(tree.fate[p])) {
      work.whole.push_back({p, tree.fate[p] == static_cast<uint8_t>(Copy::kFlip)});
    }
  }
  for (const uint32_t p : tree.cell_polygons) job.ensure_planes(p);
  for (const CriticalCell& c : tree.critical) {
    work.critical_walls.push_back(walls_of(job, c.box));
  }
  work.walls_of_copied_cell.assign(tree.copied_cells.size(), kNone);
  for (const Octree::CopiedPiece& piece : tree.copied) {
    if (copied_whole(tree.fate[piece.polygon])) continue;
    job.ensure_planes(piece.polygon);
    uint32_t& wall = work.walls_of_copied_cell[piece.cell];
    if (wall == kNone) {
      wall = static_cast<uint32_t>(work.copied_walls.size());
      work.copied_walls.push_back(walls_of(job, tree.copied_cells[piece.cell]));
    }
    work.cut_copies.push_back(piece);
  }
  return work;
}

/// Progress of the first or the second half of a job.
KernelOptions first_half(KernelOptions options) {
  if (options.progress) {
    options.progress = [report = std::move(options.progress)](uint64_t done, uint64_t total) {
      report(done, 2 * total);
    };
  }
  return options;
}
KernelOptions second_half(KernelOptions options) {
  if (options.progress) {
    options.progress = [report = std::move(options.progress)](uint64_t done, uint64_t total) {
      report(total + done, 2 * total);
    };
  }
  return options;
}

/// Where a leaf without crossings may touch itself.
std::vector<GridBox> touches_of(const LeafGeometry& leaf) {
  std::vector<GridBox> boxes;
  find_non_manifold(leaf).each([&](uint32_t v, uint32_t w) {
    GridBox& box = boxes.emplace_back();
    for (size_t k = 0; k < 3; ++k) {
      std::tie(box.lo[k], box.hi[k]) = std::minmax(leaf.vertices[v][k], leaf.vertices[w][k]);
    }
  });
  return boxes;
}

/// A box around what a box in a frame is in the world.
GridBox mapped(const FrameMap& map, const GridBox& box) {
  if (map.is_identity()) return box;
  std::vector<IVec3> around;
  for (unsigned corner = 0; corner < 8; ++corner) {
    IVec3 at;
    for (size_t k = 0; k < 3; ++k) at[k] = (corner >> k & 1) != 0 ? box.hi[k] : box.lo[k];
    // A step more than rounding asks for.
    for (const double step : {-1.0, 1.0}) {
      const std::array<double, 3> p = rounded(map.point(at));
      IVec3& whole = around.emplace_back();
      for (size_t k = 0; k < 3; ++k) whole[k] = static_cast<int64_t>(std::round(p[k] + step));
    }
  }
  return box_of_points(around);
}

/// Adds boxes, and keeps few.
void add_touching(Touching& touching, const std::vector<GridBox>& more) {
  touching.boxes.insert(touching.boxes.end(), more.begin(), more.end());
  keep_few(touching.boxes);
}

}  // namespace

Touching touching_before(const std::vector<Operand>& operands) {
  Touching result{false, {}};
  for (const Operand& o : operands) {
    if (o.pieces) continue;
    const bool may_touch = o.leaf ? o.leaf->may_touch : o.boundary->may_touch;
    // Where faces of a leaf meet in corners that both have, too: near what touches them, those of
    // one plane become one face, which may lose a corner that others keep.
    if (!may_touch && (!o.leaf || o.leaf->has_single_fans)) continue;
    const std::vector<GridBox> boxes = o.leaf ? touches_of(*o.leaf) : o.boundary->touches;
    result.anywhere |= may_touch && boxes.empty();
    const FrameMap map(o.frame);
    for (const GridBox& box : boxes) {
      result.boxes.push_back(mapped(map, box.moved(o.translation)));
    }
  }
  keep_few(result.boxes);
  return result;
}

Result<EvaluatedJob> evaluate_job(Job& job, const std::vector<Operand>& operands,
                                  const Expression& expression, const GridBox& region,
                                  const KernelOptions& options, EvaluateStats& stats) {
  const auto cancelled = [&] {
    return options.cancel && options.cancel->load(std::memory_order_relaxed);
  };
  const bool is_fast = options.whole_faces && !options.literal_cells;
  WholeFaces faces;
  if (is_fast) {
    auto evaluated = evaluate_whole_faces(job, expression, first_half(options), stats);
    if (!evaluated) return evaluated.error();
    faces = std::move(*evaluated);
  }
  if (faces.is_crowded) {
    EvaluatedJob none;
    none.is_crowded = true;
    return none;
  }
  if (!job.has_all_faces() && faces.any_general) {
    EvaluatedJob none;
    none.needs_all_faces = true;
    return none;
  }
  Octree tree;
  if (!is_fast || faces.any_general) {
    tree = build_octree(job, expression, region, options, is_fast ? &faces.general : nullptr);
  }
  if (cancelled()) return Error{ErrorCode::kCancelled, "the evaluation was cancelled", {}};
  Work work = prepare(job, tree);

  const size_t critical_runs = run_count(tree.critical.size());
  const size_t copy_runs = run_count(work.cut_copies.size());
  std::vector<FragmentSet> sets(critical_runs + copy_runs);
  std::vector<SignCounters> counters(sets.size());
  std::vector<uint64_t> contacts(sets.size(), 0);
  std::vector<std::vector<GridBox>> touches(sets.size());
  const bool may_cross_anywhere = !is_unate(expression);  // where three operands do
  const auto solve_run = [&](CellSolver& solver, size_t run) {
    const SignCounters before = solver.counters();
    const uint64_t contacts_before = solver.cells_with_contact();
    if (run < critical_runs) {
      const size_t end = std::min(tree.critical.size(), (run + 1) * kCellsPerRun);
      for (size_t c = run * kCellsPerRun; c < end; ++c) {
        const auto& walls = work.critical_walls[c];
        if (options.literal_cells) {
          solve_literal_cell(solver.geometry(), tree, tree.critical[c], walls, sets[run]);
        } else {
          solver.solve(tree, tree.critical[c], walls, sets[run]);
          if (solver.may_touch() || (may_cross_anywhere && tree.critical[c].presence_count > 2)) {
            touches[run].push_back(tree.critical[c].box.rounded_outwards());
          }
        }
      }
    } else {
      const size_t first = (run - critical_runs) * kCellsPerRun;
      const size_t end = std::min(work.cut_copies.size(), first + kCellsPerRun);
      for (size_t i = first; i < end; ++i) {
        const auto& piece = work.cut_copies[i];
        solver.copy(piece.polygon, tree.copied_cells[piece.cell],
                    work.copied_walls[work.walls_of_copied_cell[piece.cell]], piece.flip,
                    sets[run]);
      }
    }
    contacts[run] = solver.cells_with_contact() - contacts_before;
    counters[run] = solver.counters();
    counters[run].subtract(before);
  };
  for_each_run(
      sets.size(), is_fast ? second_half(options) : options, [&] { return CellSolver(job); },
      solve_run);
  if (cancelled()) return Error{ErrorCode::kCancelled, "the evaluation was cancelled", {}};

  SignCounters total;
  for (const SignCounters& c : counters) total.add(c);
  stats.cells += tree.cells;
  stats.surface_cells += tree.surface_cells;
  stats.solved_cells += tree.critical.size();
  for (const uint64_t c : contacts) stats.critical_cells += c;
  add_signs(stats, total);
  EvaluatedJob result;
  result.touching = touching_before(operands);
  result.touching.anywhere |= options.literal_cells;
  // Every contact of two operands is in a cell where both have surface.
  for (const auto& boxes : touches) add_touching(result.touching, boxes);
  add_touching(result.touching, faces.touching);
  sets.push_back(std::move(faces.cut));
  result.sets = std::move(sets);
  result.whole = std::move(faces.whole);
  result.far = std::move(faces.far);
  result.whole.insert(result.whole.end(), work.whole.begin(), work.whole.end());
  return result;
}

}  // namespace csgrun
