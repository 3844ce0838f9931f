#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <new>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <thread>
#include <unordered_map>
#include <utility>

#include <csgrun/engine/evaluate.h>

#include "engine/base/function_ref.h"
#include "engine/base/number_map.h"
#include "engine/base/parallel.h"
#include "engine/base/timer.h"
#include "engine/bsp/untouched.h"
#include "engine/csg/body_union.h"
#include "engine/csg/boundary_cache.h"
#include "engine/csg/constructions.h"
#include "engine/csg/convexity.h"
#include "engine/csg/disk_boundaries.h"
#include "engine/csg/locate.h"
#include "engine/csg/result_cache.h"
#include "engine/csg/scene.h"
#include "engine/csg/scene_jobs.h"
#include "engine/csg/scene_start.h"
#include "engine/mesh/boundary_volume.h"
#include "engine/mesh/level_section.h"
#include "engine/mesh/pieces_area.h"
#include "engine/mesh/pieces_measures.h"
#include "engine/mesh/present.h"

namespace csgrun {
namespace {

/// Adds the seconds of its lifetime to a counter.
class Stopwatch {
 public:
  explicit Stopwatch(double& seconds) : seconds_(seconds) {}
  ~Stopwatch() { seconds_ += timer_.seconds(); }
  Stopwatch(const Stopwatch&) = delete;
  Stopwatch& operator=(const Stopwatch&) = delete;

 private:
  double& seconds_;
  Timer timer_;
};

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

struct Evaluator::Impl {
  explicit Impl(EvaluateOptions given)
      : options(std::move(given)),
        form(appearances),
        store(appearances),
        disk(options.disk_cache, appearances),
        boundaries(options.cache_bytes, disk),
        // Solids are a fraction of what led to them.
        starts([this](const Key& key) { return boundaries.contains(key); }),
        solids(options.cache_bytes / 4),
        worlds(options.cache_bytes / 4),
        centroids(options.cache_bytes / 4),
        constructions(
            [this](const std::vector<NodePtr>& parts, bool ask_convex, const GridStep& least) {
              return evaluate_parts(parts, ask_convex, least);
            },
            warnings) {
    threads = options.threads > 0 ? options.threads : std::thread::hardware_concurrency();
    if (threads == 0) threads = 1;
    if (!options.disk_cache.warn_if_unusable) return;
    if (const std::string fault = disk.find_fault(); !fault.empty()) {
      warnings.add({}, "the cache folder '" + options.disk_cache.folder +
                           "' cannot be written to: " + fault);
    }
  }

  [[nodiscard]] bool cancelled() const {
    return options.cancel && options.cancel->load(std::memory_order_relaxed);
  }
  bool forget_if_full();
  /// `may_be_partial`: it goes on from one before where it can.
  Result<Scene> scene_of(const std::vector<NodePtr>& parts, bool may_be_partial = false);
  Result<Scene> scene_of_expanded(const std::vector<NodePtr>& parts, const GridStep& least,
                                  bool may_be_partial = false);
  Result<EvaluatedParts> evaluate_parts(const std::vector<NodePtr>& parts, bool ask_convex,
                                        const GridStep& least);
  Result<bool> is_convex(const Scene& scene, uint32_t root);
  Result<BoundaryPtr> world_of(const Scene& scene, uint32_t root);
  Result<std::vector<SolidPtr>> evaluate(const Scene& scene, Measuring measuring);
  Result<std::vector<SolidPtr>> evaluate(const std::vector<NodePtr>& parts, Measuring measuring);
  const SolidPtr* find_solid(const Scene& scene, const Subtree& subtree, Measuring measuring);
  Result<std::vector<SectionSegment>> section(const NodePtr& root, double z);
  Result<int> contains(const NodePtr& root, const glm::dvec3& point);
  [[nodiscard]] Key solid_key(const Scene& scene, const Subtree& subtree,
                              Measuring measuring) const;
  Result<SolidPtr> present_root(const Scene& scene, uint32_t root, const BoundaryMesh& boundary,
                                Measuring measuring);
  Result<SolidPtr> solid_of(const Scene& scene, SceneJobs& jobs, uint32_t root,
                            Measuring measuring);
  template <class T>
  using OfPieces =
      FunctionRef<Result<std::optional<T>>(const ResultPieces&, const GridStep&, const IVec3&)>;
  template <class T>
  using OfSolid = FunctionRef<T(const Solid&)>;
  template <class T>
  Result<T> look(const NodePtr& part, const OfPieces<T>& of_pieces, const OfSolid<T>& of_solid);
  template <class T>
  Result<std::optional<T>> find_measure(const NodePtr& part, bool may_be_partial,
                                        const OfPieces<T>& of_pieces, const OfSolid<T>& of_solid);
  Result<Extent> extent(const NodePtr& root);
  Result<double> area(const NodePtr& root);
  Result<std::optional<glm::dvec3>> centroid(const NodePtr& root);

  EvaluateOptions options;
  unsigned threads;
  AppearanceTable appearances;
  NormalForm form;
  LeafStore store;
  SceneRoom room;
  DiskBoundaries disk;
  BoundaryCache boundaries;
  SceneStarts starts;
  KnownTails tails;
  ResultCache<SolidPtr> solids;
  ResultCache<BoundaryPtr> worlds;      // of roots that points were compared with
  std::optional<PointLocator> locator;  // of the last one of these
  ResultCache<std::optional<glm::dvec3>> centroids;
  Warnings warnings;
  EvaluateStats stats;
  Constructions constructions;
};

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

namespace {

/// As with_threads. Where a thread cannot begin it is memory that is missing; oneTBB throws a
/// runtime_error then, which names the call.
template <class Work>
auto evaluate_with(unsigned threads, Work&& work) {
  try {
    return with_threads(threads, std::forward<Work>(work));
  } catch (const std::runtime_error& error) {
    if (std::string_view(error.what()).substr(0, 8) != "pthread_") throw;
    throw std::bad_alloc();
  }
}

}  // namespace

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

const EvaluateStats& Evaluator::stats() const { return impl_->stats; }
std::vector<std::string> Evaluator::warnings(const PlaceText& place) const {
  return impl_->warnings.lines(
      [&](const SourceRef& where) { return place ? place(where) : where.text(); });
}

}  // namespace csgrun
