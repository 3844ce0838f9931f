#include "engine/bsp/self_resolution.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

#include "engine/bsp/assemble.h"
#include "engine/bsp/common_boxes.h"
#include "engine/bsp/cut_surface.h"
#include "engine/bsp/evaluate_job.h"
#include "engine/bsp/non_manifold.h"
#include "engine/bsp/surface_cells.h"
#include "engine/bsp/surface_octree.h"
#include "engine/bsp/surface_patches.h"
#include "engine/bsp/surface_volumes.h"
#include "engine/bsp/touch_list.h"
#include "engine/bsp/untouched.h"

namespace csgrun {
namespace {

using BoundaryPtr = std::shared_ptr<const BoundaryMesh>;

class Resolution {
 public:
  Resolution(const std::vector<Operand>& surface,
             std::span<const std::array<uint32_t, 2>> crossings, InsideRule rule,
             const KernelOptions& options, EvaluateStats& stats)
      : operands_(surface),
        surface_(surface[0]),
        crossings_(crossings),
        job_(surface),
        crosses_(job_.polygons().size(), 0),
        rule_(rule),
        options_(options),
        stats_(stats) {
    find_touching(surface);
    if (is_hull() && !job_.is_leaf(0)) {
      // It may touch itself anywhere, and what touches parts volumes: every cell is solved.
      std::fill(crosses_.begin(), crosses_.end(), 1);
      patches_.patch_of.assign(crosses_.size(), kNone);
      return;
    }
    for (const auto& [f, g] : crossings) crosses_[f] = crosses_[g] = 1;
  }

  [[nodiscard]] bool is_hull() const {
    return rule_ == InsideRule::kOuterHull || rule_ == InsideRule::kOrientedHull;
  }
  /// Whether the result of a hull may still be nested: one part in the filled void of another.
  [[nodiscard]] bool may_be_nested() const { return is_hull() && patches_.class_count != 1; }

  Result<BoundaryPtr> run() {
    const Status status = keep_all();
    if (!status) return status.error();
    std::vector<UntouchedPart> parts;
    if (options_.name_untouched && !is_hull()) {
      parts = take_untouched(job_, operands_, {}, whole_, true);
    }
    return assemble(job_, std::move(sets_), std::move(whole_), std::move(touching_),
                    std::move(parts));
  }

 private:
  Status keep_all() {
    if (is_hull() && !job_.is_leaf(0)) return fill_voids();
    if (may_cut_whole()) {
      const LeafGeometry& leaf = *surface_.leaf;
      const auto& opposite = leaf.opposite.empty() ? opposite_ : leaf.opposite;
      auto cut = cut_surface(job_, leaf, opposite, crossings_, crosses_, options_, stats_);
      if (!cut) return cut.error();
      if (*cut) {
        keep_cut(std::move(**cut));
        return std::monostate{};
      }
    }
    patches_ = find_patches(job_, crossings_, crosses_);
    return is_hull() ? solve_classes() : solve(all_polygons(), patches_.witness, kNone);
  }

  [[nodiscard]] bool may_cut_whole() const {
    return options_.whole_faces && !is_hull() && job_.is_leaf(0) && surface_.frame.is_identity;
  }

  void keep_cut(CutSurface&& cut) {
    for (CutSurface::Pieces& part : cut.pieces) {
      FragmentSet& set = sets_.emplace_back(std::move(part.set));
      size_t kept = 0;
      for (size_t i = 0; i < set.pieces.size(); ++i) {
        const auto [before, behind] = part.windings[i];
        const bool front = is_inside(before, rule_), back = is_inside(behind, rule_);
        if (front == back) continue;
        set.pieces[kept] = set.pieces[i];
        if (front) set.flip(set.pieces[kept]);
        ++kept;
      }
      set.pieces.resize(kept);
    }
    for (uint32_t p = 0; p < crosses_.size(); ++p) {
      if (crosses_[p]) continue;
      const int32_t winding = cut.winding_of_polygon[p];
      const bool front = is_inside(winding, rule_), back = is_inside(winding + 1, rule_);
      if (front != back) whole_.push_back({p, front});
    }
  }

  /// What is kept are parts of the polygons. They touch where these do, but for common corners and
  /// edges; and where these are no manifold: the faces of one fan at a corner may become a face
  /// that has no corner there.
  void find_touching(const std::vector<Operand>& surface) {
    if (!job_.is_leaf(0)) {
      touching_ = touching_before(surface);
      return;
    }
    const LeafGeometry& leaf = *surface[0].leaf;
    touching_.anywhere = leaf.opposite.empty() && is_hull();
    if (touching_.anywhere) return;
    // Of many crossings one box each: lists of places are kept short (touch_list.h).
    constexpr size_t kFewCrossings = 64;
    constexpr uint32_t kSlices = 16;
    const uint32_t slices = crossings_.size() <= kFewCrossings ? kSlices : 1;
    for (const auto& [f, g] : crossings_) {
      add_common_boxes(job_, f, g, slices, touching_.boxes);
    }
    NonManifold non_manifold = find_non_manifold(leaf);
    non_manifold.each([&](uint32_t v, uint32_t w) { add_touching(v, w); });
    opposite_ = std::move(non_manifold.opposite);
    keep_few(touching_.boxes);
  }

  /// Between two vertices of the leaf.
  void add_touching(uint32_t v, uint32_t w) {
    const auto &a = job_.rounded(job_.vertex_start(0) + v),
               &b = job_.rounded(job_.vertex_start(0) + w);
    GridBox& box = touching_.boxes.emplace_back();
    for (size_t k = 0; k < 3; ++k) {
      box.lo[k] = static_cast<int64_t>(std::floor(std::min(a[k], b[k])));
      box.hi[k] = static_cast<int64_t>(std::ceil(std::max(a[k], b[k])));
    }
  }

  [[nodiscard]] std::vector<uint32_t> all_polygons() const {
    std::vector<uint32_t> all(job_.polygons().size());
    std::iota(all.begin(), all.end(), 0u);
    return all;
  }

  Status fill_voids() {
    const std::vector<uint32_t> all = all_polygons();
    SurfaceCellsRequest request;
    request.wall_edges = request.below_points = true;
    for (;;) {
      auto runs = solve_cells(all, {}, request);
      if (!runs) return runs.error();
      if (!crosses_in_wall(job_, *runs)) {
        if (const auto labels = label_by_filling(job_, *runs)) {
          for (size_t r = 0; r < runs->size(); ++r) keep_boundary((*runs)[r], labels->volumes[r]);
          return std::monostate{};
        }
      }
      job_.move_walls();
    }
  }

  /// Each class by itself: its surface hangs together.
  Status solve_classes() {
    std::vector<std::vector<uint32_t>> polygons(patches_.class_count);
    for (uint32_t p = 0; p < patches_.class_of.size(); ++p) {
      polygons[patches_.class_of[p]].push_back(p);
    }
    for (size_t c = 0; c < polygons.size(); ++c) {
      const uint32_t lowest = lowest_vertex(polygons[c]);
      job_.keep_walls_off({&lowest, 1});
      // Where patches touch, the volumes beside them may be one. A patch that is not all of its
      // class has a vertex there, or one that a polygon has that crosses another: it is seen.
      std::vector<uint32_t> witnesses{lowest};
      const auto& junctions = patches_.junctions[c];
      witnesses.insert(witnesses.end(), junctions.begin(), junctions.end());
      if (Status status = solve(polygons[c], witnesses, lowest); !status) return status;
    }
    return std::monostate{};
  }

  [[nodiscard]] uint32_t lowest_vertex(const std::vector<uint32_t>& polygons) const {
    uint32_t lowest = kNone;
    for (const uint32_t p : polygons) {
      for (const uint32_t v : job_.corners(job_.polygons()[p])) {
        if (lowest == kNone || job_.is_below(v, lowest)) lowest = v;
      }
    }
    return lowest;
  }
  /// Finds what is inside for some of the polygons and keeps the boundary.
  Status solve(const std::vector<uint32_t>& polygons, const std::vector<uint32_t>& witnesses,
               uint32_t lowest) {
    SurfaceCellsRequest request;
    request.wall_edges = is_hull();
    request.below_vertex = lowest;
    auto runs = solve_cells(polygons, witnesses, request);
    while (runs && is_hull() && crosses_in_wall(job_, *runs)) {
      job_.move_walls();
      job_.keep_walls_off({&lowest, 1});
      runs = solve_cells(polygons, witnesses, request);
    }
    if (!runs) return runs.error();
    const auto labels = is_hull() ? label_by_reach(job_, *runs, patches_.patch_count, lowest, rule_)
                                  : label_by_winding(*runs, patches_.patch_count, rule_);
    if (!labels) return contradiction();
    for (size_t r = 0; r < runs->size(); ++r) keep_boundary((*runs)[r], labels->volumes[r]);
    for (const uint32_t p : polygons) {
      const uint32_t patch = patches_.patch_of[p];
      if (patch == kNone) continue;
      const InsideLabels::Patch& label = labels->patches[patch];
      if (!label.known) return contradiction();
      if (label.front != label.back) whole_.push_back({p, label.front});
    }
    return std::monostate{};
  }

  Result<std::vector<SurfaceCells>> solve_cells(const std::vector<uint32_t>& polygons,
                                                const std::vector<uint32_t>& witnesses,
                                                const SurfaceCellsRequest& request) {
    const SurfaceOctree tree = build_surface_octree(job_, polygons, crosses_, witnesses, options_);
    return solve_surface_cells(job_, tree, patches_, request, options_, stats_);
  }

  static Error contradiction() {
    return {ErrorCode::kInternal, "the parts of a surface contradict each other", {}};
  }

  void keep_boundary(SurfaceCells& run, const std::vector<uint8_t>& inside) {
    FragmentSet& set = run.set;
    size_t kept = 0;
    for (size_t i = 0; i < set.pieces.size(); ++i) {
      const bool front = inside[run.sides[i].front] != 0, back = inside[run.sides[i].back] != 0;
      if (front == back) continue;
      set.pieces[kept] = set.pieces[i];
      if (front) set.flip(set.pieces[kept]);
      ++kept;
    }
    set.pieces.resize(kept);
    sets_.push_back(std::move(set));
  }

  const std::vector<Operand>& operands_;  ///< the surface alone
  const Operand& surface_;
  std::span<const std::array<uint32_t, 2>> crossings_;
  Job job_;
  std::vector<uint8_t> crosses_;
  const InsideRule rule_;
  const KernelOptions& options_;
  EvaluateStats& stats_;
  SurfacePatches patches_;
  std::vector<uint32_t> opposite_;  ///< NonManifold::opposite
  Touching touching_;
  std::vector<FragmentSet> sets_;
  std::vector<WholePolygon> whole_;
};

}  // namespace

Result<BoundaryPtr> resolve_surface(const Operand& surface,
                                    std::span<const std::array<uint32_t, 2>> crossings,
                                    InsideRule rule, const KernelOptions& options,
                                    EvaluateStats& stats) {
  std::vector<Operand> operands{surface};
  if (surface.boundary) operands[0].boundary = expanded(surface.boundary);
  Resolution resolution(operands, crossings, rule, options, stats);
  auto result = resolution.run();
  if (!result || !resolution.may_be_nested()) return result;
  // The hulls of several classes are apart or one inside another: what is inside goes.
  Operand hulls;
  hulls.boundary = *result;
  return resolve_surface(hulls, {}, InsideRule::kNonZero, options, stats);
}

}  // namespace csgrun
