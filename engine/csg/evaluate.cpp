// From trees to solids.
#include <algorithm>
#include <cassert>
#include <limits>
#include <optional>
#include <unordered_map>
#include <utility>

#include "engine/base/number_map.h"
#include "engine/base/timer.h"
#include "engine/csg/body_union.h"
#include "engine/csg/convexity.h"
#include "engine/csg/evaluator.h"
#include "engine/mesh/present.h"

namespace csgrun {
namespace {

/// Renumbers appearances in the order in which faces use them: which others the run has seen is not
/// the solid's affair.
void keep_used_appearances(Solid& solid) {
  constexpr uint32_t kUnused = UINT32_MAX;
  std::vector<uint32_t> number(solid.appearances.size(), kUnused);
  std::vector<Appearance> used;
  for (Solid::Face& face : solid.faces) {
    uint32_t& id = number[face.appearance];
    if (id == kUnused) {
      id = static_cast<uint32_t>(used.size());
      used.push_back(solid.appearances[face.appearance]);
    }
    face.appearance = id;
  }
  solid.appearances = std::move(used);
}

/// Numbers the sources in the order in which faces come from them, and names the leaves that they
/// are: a model may have many more, counted with repetition.
void name_sources(const Scene& scene, uint32_t root, Solid& solid) {
  NumberMap number;
  std::vector<uint32_t> used;
  for (Solid::Face& face : solid.faces) {
    const auto [id, is_new] = number.find_or_add(face.source, static_cast<uint32_t>(used.size()));
    if (is_new) used.push_back(face.source);
    face.source = id;
  }
  std::vector<uint32_t> sorted = used;
  std::sort(sorted.begin(), sorted.end());
  const std::vector<uint32_t> leaves = scene.leaves(root, sorted);
  assert(leaves.size() == sorted.size());
  solid.sources.resize(used.size());
  for (size_t i = 0; i < leaves.size(); ++i) {
    const Node& node = *scene.nodes[leaves[i]].leaf;
    const uint32_t id = number.find_or_add(sorted[i], 0).first;
    solid.sources[id] = {node.mesh()->kind, node.where().text()};
  }
}

uint64_t bytes_of(const Solid& s) {
  return sizeof(Solid) + s.positions.size() * 41 + s.triangles.size() * 16 +
         s.faces.size() * (sizeof(Solid::Face) + sizeof(glm::dvec3)) + s.loop_vertices.size() * 4 +
         s.sources.size() * 96 + s.exact_points.size() * 256;
}

}  // namespace

/// What is remembered of trees and leaves is bounded too; forgetting costs time only.
bool Evaluator::Impl::forget_if_full() {
  constexpr size_t kMostNodes = 4u << 20;
  if (form.nodes().size() <= kMostNodes && store.bytes() <= options.cache_bytes) return false;
  form.clear();
  store.clear();
  starts.clear();
  tails.clear();
  return true;
}

/// What constructions made must be on the scene's grid: when that turns out to be coarser than the
/// grids on which they were made, they are made again. So the step grows until it is coarse enough.
Result<Scene> Evaluator::Impl::scene_of(const std::vector<NodePtr>& parts, bool may_be_partial) {
  if (const std::string fault = options.grid.problem(); !fault.empty()) {
    return Error{ErrorCode::kInvalidArgument, "the grid step " + fault, {}};
  }
  if (forget_if_full()) constructions.clear();
  GridStep least;
  while (true) {
    std::vector<NodePtr> expanded;
    double finest_mm = std::numeric_limits<double>::infinity();
    for (const NodePtr& part : parts) {
      const auto made = constructions.expand(part, least);
      if (!made) return made.error();
      expanded.push_back(made->node);
      finest_mm = std::min(finest_mm, made->finest_mm);
    }
    auto scene = scene_of_expanded(expanded, least, may_be_partial);
    if (!scene) return scene.error();
    if (scene->step.millimetres() <= finest_mm) {
      for (const NodePtr& part : parts) constructions.tell(part, least);
      return scene;
    }
    least = scene->step;
  }
}

Result<Scene> Evaluator::Impl::scene_of_expanded(const std::vector<NodePtr>& parts,
                                                 const GridStep& least, bool may_be_partial) {
  const Stopwatch watch(stats.leaf_seconds);
  forget_if_full();
  std::vector<uint32_t> roots;
  for (const NodePtr& part : parts) {
    auto root = form.add(part);
    if (!root) return root.error();
    roots.push_back(*root);
  }
  const Resolver resolve = [this](const Key& key, const Operand& surface,
                                  std::span<const std::array<uint32_t, 2>> crossings,
                                  InsideRule rule) -> Result<BoundaryPtr> {
    if (const auto known = disk.read(key)) {
      ++stats.nodes_from_disk;
      return known->boundary;
    }
    const Timer timer;
    KernelOptions how = kernel_options(options, threads);
    how.name_untouched = true;
    auto boundary = resolve_leaf(surface, crossings, rule, how, stats);
    if (boundary) disk.write(key, {*boundary, nullptr, {}}, timer.seconds());
    return boundary;
  };
  const auto is_cancelled = [this] { return cancelled(); };
  SceneContext context{form, store, appearances, warnings, room, is_cancelled, resolve};
  return build_scene(context, roots, options.grid, least, may_be_partial ? &starts : nullptr);
}

/// What the arrays of a root depend on: what it is, where it is in the world, and the step.
Key Evaluator::Impl::solid_key(const Scene& scene, const Subtree& subtree,
                               Measuring measuring) const {
  const Identity& id = subtree.id;
  const SignedPermutation back = id.permutation.inverse();
  KeyBuilder builder("solid");
  builder.numbers(id.key).numbers(back.apply(id.origin));
  for (const auto& row : back.apply_to_frame(scene.frames[id.frame]).matrix) builder.numbers(row);
  if (id.paint != kUnpainted) builder.numbers(appearances.key(id.paint));
  builder.number(options.join_contacts).number(static_cast<uint8_t>(measuring));
  builder.number(scene.step.numerator).number(scene.step.denominator).number(scene.step.exponent);
  return builder.key();
}

Result<SolidPtr> Evaluator::Impl::present_root(const Scene& scene, uint32_t root,
                                               const BoundaryMesh& boundary, Measuring measuring) {
  PresentContext context;
  context.step = scene.step;
  context.join_contacts = options.join_contacts;
  context.appearances = appearances.values();
  context.exact_points = options.exact_points;
  context.measuring = measuring;
  context.cancel = options.cancel;
  auto presented = present(boundary, context);
  if (!presented) return presented.error();
  auto solid = std::const_pointer_cast<Solid>(*presented);  // nobody else has it yet
  keep_used_appearances(*solid);
  name_sources(scene, root, *solid);
  return SolidPtr(std::move(solid));
}

Result<std::vector<SolidPtr>> Evaluator::Impl::evaluate(const std::vector<NodePtr>& parts,
                                                        Measuring measuring) {
  auto scene = scene_of(parts);
  if (!scene) return scene.error();
  return evaluate(*scene, measuring);
}

/// Solids for a construction: their trees have none left.
Result<EvaluatedParts> Evaluator::Impl::evaluate_parts(const std::vector<NodePtr>& parts,
                                                       bool ask_convex, const GridStep& least) {
  auto scene = scene_of_expanded(parts, least);
  if (!scene) return scene.error();
  auto solids_of_parts = evaluate(*scene, Measuring::kNothing);
  if (!solids_of_parts) return solids_of_parts.error();
  EvaluatedParts result{scene->step, *std::move(solids_of_parts), {}};
  result.is_convex.assign(parts.size(), 0);
  for (size_t i = 0; ask_convex && i < parts.size(); ++i) {
    if (result.solids[i]->empty()) continue;
    auto convex = is_convex(*scene, scene->roots[i]);
    if (!convex) return convex.error();
    result.is_convex[i] = *convex ? 1 : 0;
  }
  return result;
}

Result<bool> Evaluator::Impl::is_convex(const Scene& scene, uint32_t root) {
  const SceneNode& node = scene.nodes[root];
  if (node.kind == SceneNode::Kind::kLeaf && node.geometry) return node.geometry->convex;
  const Stopwatch watch(stats.boolean_seconds);
  auto world = world_of(scene, root);
  if (!world) return world.error();
  return bounds_convex(**world);
}

/// One that was made before, with what is wanted or more.
const SolidPtr* Evaluator::Impl::find_solid(const Scene& scene, const Subtree& subtree,
                                            Measuring measuring) {
  for (const Measuring more :
       {Measuring::kAll, Measuring::kButTheCentre, Measuring::kTopology, Measuring::kNothing}) {
    if (more < measuring) break;
    if (const SolidPtr* known = solids.find(solid_key(scene, subtree, more))) return known;
  }
  return nullptr;
}

Result<std::vector<SolidPtr>> Evaluator::Impl::evaluate(const Scene& scene_on_grid,
                                                        Measuring measuring) {
  const Scene* scene = &scene_on_grid;
  stats.grid_mm = scene->step.millimetres();
  const Stopwatch watch(stats.boolean_seconds);

  const std::vector<uint32_t>& parts = scene->roots;
  std::vector<SolidPtr> result(parts.size());
  std::vector<Key> keys(parts.size());
  std::unordered_map<Key, SolidPtr, KeyHash> made;  // of this call: they outlive the cache's bound
  std::vector<uint32_t> wanted;
  for (size_t i = 0; i < parts.size(); ++i) {
    const SceneNode& node = scene->nodes[scene->roots[i]];
    if (node.kind == SceneNode::Kind::kEmpty) {
      result[i] = std::make_shared<Solid>();
      continue;
    }
    keys[i] = solid_key(*scene, node.subtree, measuring);
    const auto [entry, is_new] = made.try_emplace(keys[i]);
    if (const SolidPtr* known = is_new ? find_solid(*scene, node.subtree, measuring) : nullptr) {
      entry->second = *known;
      ++stats.nodes_from_memory;
    } else if (is_new) {
      wanted.push_back(scene->roots[i]);
    } else {
      ++stats.nodes_from_memory;
    }
  }
  SceneJobs jobs(*scene, boundaries, tails, options, threads, stats);
  if (Status status = jobs.run(wanted); !status) return status.error();
  for (size_t i = 0; i < parts.size(); ++i) {
    if (result[i]) continue;
    SolidPtr& solid = made[keys[i]];
    if (!solid) {
      auto made_now = solid_of(*scene, jobs, scene->roots[i], measuring);
      if (!made_now) return made_now.error();
      solid = *made_now;
    }
    result[i] = solid;
  }
  return result;
}

/// The solid of a root whose jobs have run.
Result<SolidPtr> Evaluator::Impl::solid_of(const Scene& scene, SceneJobs& jobs, uint32_t root,
                                           Measuring measuring) {
  auto boundary = jobs.world_boundary(root);
  if (!boundary) return boundary.error();
  SolidPtr solid = std::make_shared<Solid>();
  if (!is_empty(**boundary)) {
    auto presented = present_root(scene, root, **boundary, measuring);
    if (!presented) return presented.error();
    solid = *presented;
  }
  solids.put(solid_key(scene, scene.nodes[root].subtree, measuring), solid, bytes_of(*solid));
  return solid;
}

Evaluator::Evaluator(EvaluateOptions options) : impl_(std::make_unique<Impl>(std::move(options))) {}
Evaluator::~Evaluator() = default;

Result<std::vector<SolidPtr>> Evaluator::evaluate(const std::vector<NodePtr>& parts,
                                                  Measuring measuring) {
  return evaluate_with(impl_->threads, [&] { return impl_->evaluate(parts, measuring); });
}

Result<SolidPtr> Evaluator::evaluate(const NodePtr& root, Measuring measuring) {
  auto solids = evaluate(std::vector<NodePtr>{root}, measuring);
  if (!solids) return solids.error();
  return solids->front();
}

const EvaluateStats& Evaluator::stats() const { return impl_->stats; }
std::vector<std::string> Evaluator::warnings(const PlaceText& place) const {
  return impl_->warnings.lines(
      [&](const SourceRef& where) { return place ? place(where) : where.text(); });
}

}  // namespace csgrun
