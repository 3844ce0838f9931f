// What is asked of a tree's solid without its triangles: measures, sections, points.
#include <cmath>
#include <optional>
#include <vector>

#include "engine/bsp/untouched.h"
#include "engine/csg/evaluator.h"
#include "engine/csg/grid.h"
#include "engine/mesh/boundary_volume.h"
#include "engine/mesh/level_section.h"
#include "engine/mesh/pieces_area.h"
#include "engine/mesh/pieces_measures.h"

namespace csgrun {

/// The boundary of a root in the world, all faces spelled out.
Result<BoundaryPtr> Evaluator::Impl::world_of(const Scene& scene, uint32_t root) {
  const Key key = solid_key(scene, scene.nodes[root].subtree, Measuring::kNothing);
  if (const BoundaryPtr* known = worlds.find(key)) return BoundaryPtr(*known);
  SceneJobs jobs(scene, boundaries, tails, options, threads, stats);
  if (Status status = jobs.run({root}); !status) return status.error();
  auto boundary = jobs.world_boundary(root);
  if (!boundary) return boundary.error();
  const BoundaryPtr world = expanded(*boundary);
  worlds.put(key, world, memory_bytes(*world));
  return world;
}

/// A measure of one tree's solid, from the pieces of a result that goes on from one that was asked
/// for before, else from the solid. `of_pieces` may give nothing: then the solid is asked, too.
template <class T>
Result<T> Evaluator::Impl::look(const NodePtr& part, const OfPieces<T>& of_pieces,
                                const OfSolid<T>& of_solid) {
  auto found = find_measure(part, true, of_pieces, of_solid);
  if (found && !*found) found = find_measure(part, false, of_pieces, of_solid);
  if (!found) return found.error();
  return **found;
}

/// Nothing if the scene was partial, and something wants its leaves.
template <class T>
Result<std::optional<T>> Evaluator::Impl::find_measure(const NodePtr& part, bool may_be_partial,
                                                       const OfPieces<T>& of_pieces,
                                                       const OfSolid<T>& of_solid) {
  auto scene = scene_of({part}, may_be_partial);
  if (!scene) return scene.error();
  stats.grid_mm = scene->step.millimetres();
  const Stopwatch watch(stats.boolean_seconds);
  const uint32_t root = scene->roots[0];
  const SceneNode& node = scene->nodes[root];
  if (node.kind == SceneNode::Kind::kEmpty) return std::optional(T{});
  if (const SolidPtr* known = find_solid(*scene, node.subtree, Measuring::kButTheCentre)) {
    ++stats.nodes_from_memory;
    return std::optional(of_solid(**known));
  }
  SceneJobs jobs(*scene, boundaries, tails, options, threads, stats);
  if (Status status = jobs.run({root}); !status) return status.error();
  if (!scene->is_partial) tails.note(*scene, root);
  if (const auto [pieces, moved] = jobs.pieces(root); pieces) {
    auto measure = of_pieces(*pieces, scene->step, moved);
    if (!measure || *measure) return measure;
  }
  if (scene->is_partial) return std::optional<T>();
  auto made = solid_of(*scene, jobs, root, Measuring::kButTheCentre);
  if (!made) return made.error();
  return std::optional(of_solid(**made));
}

Result<Extent> Evaluator::Impl::extent(const NodePtr& part) {
  const auto of_pieces = [](const ResultPieces& pieces, const GridStep& step,
                            const IVec3& moved) -> Result<std::optional<Extent>> {
    const auto box = pieces_box(pieces, step, moved);
    if (!box) return std::optional(Extent{});
    auto volume = pieces_volume(pieces, step);
    if (!volume) return volume.error();
    return std::optional(Extent{false, *volume, *box});
  };
  const auto of_solid = [](const Solid& solid) {
    if (solid.empty()) return Extent{};
    return Extent{false, solid.measures.volume, solid.measures.bbox};
  };
  return look<Extent>(part, of_pieces, of_solid);
}

Result<double> Evaluator::Impl::area(const NodePtr& part) {
  const auto of_pieces = [](const ResultPieces& pieces, const GridStep& step,
                            const IVec3&) -> Result<std::optional<double>> {
    return pieces_area(pieces, step);
  };
  return look<double>(part, of_pieces, [](const Solid& solid) { return solid.measures.area; });
}

Result<std::optional<glm::dvec3>> Evaluator::Impl::centroid(const NodePtr& part) {
  auto scene = scene_of({part});
  if (!scene) return scene.error();
  stats.grid_mm = scene->step.millimetres();
  const Stopwatch watch(stats.boolean_seconds);
  const uint32_t root = scene->roots[0];
  const SceneNode& node = scene->nodes[root];
  std::optional<glm::dvec3> none;
  if (node.kind == SceneNode::Kind::kEmpty) return none;
  if (const SolidPtr* known = find_solid(*scene, node.subtree, Measuring::kAll)) {
    ++stats.nodes_from_memory;
    return (*known)->empty() ? none : (*known)->measures.centroid;
  }
  // A script asks for one coordinate after another.
  const Key key = solid_key(*scene, node.subtree, Measuring::kNothing);
  if (const auto* known = centroids.find(key)) return *known;
  SceneJobs jobs(*scene, boundaries, tails, options, threads, stats);
  if (Status status = jobs.run({root}); !status) return status.error();
  auto boundary = jobs.world_boundary(root);
  if (!boundary) return boundary.error();
  std::optional<glm::dvec3> centre;
  if (!is_empty(**boundary)) {
    auto centroid = boundary_centroid(**boundary, scene->step);
    if (!centroid) return centroid.error();
    centre = *centroid;
  }
  constexpr uint64_t kBytes = 256;  // about, with what the cache has of it
  centroids.put(key, centre, kBytes);
  return centre;
}

Result<std::vector<SectionSegment>> Evaluator::Impl::section(const NodePtr& root, double z) {
  if (!std::isfinite(z)) return Error{ErrorCode::kInvalidArgument, "the height is not finite", {}};
  auto scene = scene_of({root});
  if (!scene) return scene.error();
  std::vector<SectionSegment> none;
  if (scene->nodes[scene->roots[0]].kind == SceneNode::Kind::kEmpty) return none;
  const auto level = Quantiser(scene->step)(z);
  if (!level) return none;  // far beyond anything on the grid
  const Stopwatch watch(stats.boolean_seconds);
  auto world = world_of(*scene, scene->roots[0]);
  if (!world) return world.error();
  return level_section(**world, *level, scene->step);
}

Result<int> Evaluator::Impl::contains(const NodePtr& root, const glm::dvec3& point) {
  for (int i = 0; i < 3; ++i) {
    if (!std::isfinite(point[i])) {
      return Error{ErrorCode::kInvalidArgument, "the point is not finite", {}};
    }
  }
  auto scene = scene_of({root});
  if (!scene) return scene.error();
  const SceneNode& node = scene->nodes[scene->roots[0]];
  if (node.kind == SceneNode::Kind::kEmpty) return -1;
  const Quantiser quantiser(scene->step);
  IVec3 p;
  for (int i = 0; i < 3; ++i) {
    const auto rounded = quantiser(point[i]);
    if (!rounded) return -1;  // far beyond anything on the grid
    p[i] = *rounded;
  }
  const Stopwatch watch(stats.boolean_seconds);
  auto world = world_of(*scene, scene->roots[0]);
  if (!world) return world.error();
  // Who asks twice will ask again.
  const bool is_again = locator && locator->boundary() == world->get();
  if (!is_again || !locator->has_bins()) locator.emplace(*world, is_again);
  return locator->locate(p);
}

Result<double> Evaluator::area(const NodePtr& root) {
  return evaluate_with(impl_->threads, [&] { return impl_->area(root); });
}

Result<std::optional<glm::dvec3>> Evaluator::centroid(const NodePtr& root) {
  return evaluate_with(impl_->threads, [&] { return impl_->centroid(root); });
}

Result<std::vector<SectionSegment>> Evaluator::section(const NodePtr& root, double z) {
  return evaluate_with(impl_->threads, [&] { return impl_->section(root, z); });
}

Result<int> Evaluator::contains(const NodePtr& root, const glm::dvec3& point) {
  return evaluate_with(impl_->threads, [&] { return impl_->contains(root, point); });
}

Result<Extent> Evaluator::extent(const NodePtr& root) {
  return evaluate_with(impl_->threads, [&] { return impl_->extent(root); });
}

}  // namespace csgrun
