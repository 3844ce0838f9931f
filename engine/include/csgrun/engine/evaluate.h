// Evaluation of CSG trees: bottom-up over the normal form, exact, cached, deterministic.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <glm/vec2.hpp>

#include <csgrun/engine/csg_tree.h>
#include <csgrun/engine/error.h>
#include <csgrun/engine/solid.h>

namespace csgrun {

/// Coordinates of what can reach a result are less than 2^kGridBits steps, as vertices of leaves
/// are.
constexpr int kGridBits = 27;

/// A grid step in millimetres as an exact number: numerator * 2^exponent / denominator.
struct GridStep {
  int64_t numerator = 0;  ///< 0: chosen from the scene's extent
  int64_t denominator = 1;
  int exponent = 0;

  bool operator==(const GridStep&) const = default;
  [[nodiscard]] bool automatic() const { return numerator == 0; }
  [[nodiscard]] double millimetres() const;
  /// Parses "0.001", "1e-3mm", "2^-20mm". It is in lowest terms: see problem().
  static Result<GridStep> parse(const std::string& text);
  /// What is wrong with one that was made by hand, or nothing. Numerator and denominator are odd
  /// (but for 0/1, which is automatic), positive, at most 2^53 and have no common divisor; it is
  /// from 2^-200 to 2^200 mm. Evaluations on others are refused (kInvalidArgument).
  [[nodiscard]] std::string problem() const;
};

/// The cache of intermediate meshes on disk, which other runs have, too. A folder that cannot be
/// used is as if there were none.
struct DiskCacheOptions {
  std::string folder;             ///< made if it is not there; empty: no cache on disk
  double least_seconds = 0.25;    ///< what was evaluated in less is not kept
  uint64_t bytes = 1ull << 30;    ///< bound of what is kept; the least recently used goes first
  bool warn_if_unusable = false;  ///< say so of a folder that cannot be written to
};

struct EvaluateOptions {
  unsigned threads = 0;  ///< 0: as many as the process may use
  GridStep grid;
  uint64_t cache_bytes = 512ull << 20;  ///< bound of the in-memory cache of intermediate meshes
  DiskCacheOptions disk_cache;
  /// The kernel's tuning; no value changes any result (tests vary them).
  uint32_t cell_limit = 17;  ///< m of Campen & Kobbelt 2010, section 4.1
  std::array<uint32_t, 3> octree_shift{0, 0, 0};
  bool literal_cells = false;  ///< labelled BSPs merged and extracted, as the paper has it
  bool whole_faces = true;     ///< cut faces whole, by names; false: cell by cell
  /// Solids that touch in an edge: false keeps them apart, true joins them through the edge. Either
  /// way the result is a manifold by index (Campen & Kobbelt 2010, chapter 7).
  bool join_contacts = false;
  bool exact_points = false;  ///< whether to fill Solid::exact_points
  bool flatten = true;        ///< false: every Boolean node is materialised on its own
  /// Polled now and then from any thread; non-zero stops the evaluation with kCancelled.
  const std::atomic<bool>* cancel = nullptr;
  /// Called from the evaluating thread with (done, total) units of work.
  std::function<void(uint64_t, uint64_t)> progress;
};

struct EvaluateStats {
  double leaf_seconds = 0, boolean_seconds = 0;
  double grid_mm = 0;
  uint64_t nodes_evaluated = 0, nodes_from_memory = 0, nodes_from_disk = 0;
  uint64_t cells = 0;           ///< of the octrees, inner ones too
  uint64_t surface_cells = 0;   ///< that hold surface, in cells of at most m polygons
  uint64_t solved_cells = 0;    ///< in which several operands have surface
  uint64_t critical_cells = 0;  ///< in which surfaces of different operands meet
  uint64_t sign_filter = 0, sign_symbolic = 0;
  std::array<uint64_t, 6> sign_exact{};  ///< by tier: 64 128 192 256 384 512 bits

  /// Adds what came later: sums, and the grid of the last evaluation.
  void add(const EvaluateStats& later) {
    leaf_seconds += later.leaf_seconds;
    boolean_seconds += later.boolean_seconds;
    if (later.grid_mm != 0) grid_mm = later.grid_mm;
    nodes_evaluated += later.nodes_evaluated;
    nodes_from_memory += later.nodes_from_memory;
    nodes_from_disk += later.nodes_from_disk;
    cells += later.cells;
    surface_cells += later.surface_cells;
    solved_cells += later.solved_cells;
    critical_cells += later.critical_cells;
    sign_filter += later.sign_filter;
    sign_symbolic += later.sign_symbolic;
    for (size_t t = 0; t < sign_exact.size(); ++t) sign_exact[t] += later.sign_exact[t];
  }
};

/// What Measures says of a solid, as far as it needs no triangles.
struct Extent {
  bool empty = true;
  double volume = 0;                 ///< mm^3
  std::array<glm::dvec3, 2> bbox{};  ///< mm; of an empty solid all zero
};

/// A piece of an outline in mm; seen from above the solid is on its left.
struct SectionSegment {
  glm::dvec2 from, to;
  double noise;  ///< mm: how far off the grid may have put it, the farther the flatter the solid is
};

/// Evaluates trees. One object serves one run: its cache spans all calls. Not thread-safe. Where
/// memory runs out a call ends by std::bad_alloc; what is cached may be half made then: nothing but
/// stats(), warnings() and the destructor may be called after that.
class Evaluator {
 public:
  explicit Evaluator(EvaluateOptions options);
  ~Evaluator();

  /// The solids of several parts, on one common grid. Parts of equal geometry share one Solid.
  [[nodiscard]] Result<std::vector<SolidPtr>> evaluate(const std::vector<NodePtr>& parts,
                                                       Measuring measuring = Measuring::kAll);
  /// The solid of one tree, on the grid that its own extent asks for.
  [[nodiscard]] Result<SolidPtr> evaluate(const NodePtr& root,
                                          Measuring measuring = Measuring::kAll);
  /// Volume and bounding box of one tree's solid. A result that goes on from one that was asked for
  /// before is not presented: the time then depends on what the difference touches.
  [[nodiscard]] Result<Extent> extent(const NodePtr& root);
  /// Measures::area of one tree's solid, to the last bit, as extent() gives the volume.
  [[nodiscard]] Result<double> area(const NodePtr& root);
  /// Measures::centroid of one tree's solid, from its faces: nothing is triangulated. Nothing of an
  /// empty one.
  [[nodiscard]] Result<std::optional<glm::dvec3>> centroid(const NodePtr& root);
  /// What the plane at height `z` (mm) cuts of one tree's solid, just above it: faces in the plane
  /// count that have the solid above them. The plane is rounded to the grid as the vertices of
  /// leaves are. Segments in no certain order, of which closed outlines are made; one at most of
  /// each plane of the solid and each connected piece. Of further heights O(n), no evaluation.
  [[nodiscard]] Result<std::vector<SectionSegment>> section(const NodePtr& root, double z);
  /// Whether `point` (mm) is inside (1), on the boundary (0) or outside (-1), exactly; the point is
  /// rounded to the grid as the vertices of leaves are, so that equal decimals meet.
  [[nodiscard]] Result<int> contains(const NodePtr& root, const glm::dvec3& point);

  [[nodiscard]] const EvaluateStats& stats() const;
  /// Notes for the user, in a deterministic order, each at most once. `place` says where the tree
  /// was made, as users know it; nothing: as SourceRef::text does.
  using PlaceText = std::function<std::string(const SourceRef&)>;
  [[nodiscard]] std::vector<std::string> warnings(const PlaceText& place = {}) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace csgrun
