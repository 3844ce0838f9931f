// The insides of an Evaluator: what it remembers, and its steps from trees to solids.
#pragma once

#include <new>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <thread>
#include <utility>
#include <vector>

#include <csgrun/engine/evaluate.h>

#include "engine/base/function_ref.h"
#include "engine/base/parallel.h"
#include "engine/base/timer.h"
#include "engine/csg/boundary_cache.h"
#include "engine/csg/constructions.h"
#include "engine/csg/disk_boundaries.h"
#include "engine/csg/locate.h"
#include "engine/csg/result_cache.h"
#include "engine/csg/scene.h"
#include "engine/csg/scene_jobs.h"
#include "engine/csg/scene_start.h"

namespace csgrun {

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

}  // namespace csgrun
