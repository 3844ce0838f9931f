// The evaluation of a scene: which subtrees are kept as results of their own, and the kernel's jobs
// in the order in which they depend on one another.
#pragma once

#include <cstdint>
#include <memory>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include <csgrun/engine/evaluate.h>

#include "engine/bsp/kernel.h"
#include "engine/csg/boundary_cache.h"
#include "engine/csg/known_tails.h"
#include "engine/csg/scene.h"

namespace csgrun {

/// The kernel's part of the options.
KernelOptions kernel_options(const EvaluateOptions& options, unsigned threads);

/// One call's evaluation. A subtree that occurs more than once (by key) is evaluated once, in the
/// axes of its frame, and stands in other jobs as one operand; so do a hull and the solid that it
/// is the hull of, operators that have one solid in one place for an operand (in a job of both its
/// surfaces would coincide), and what the cache knows, also when it is only a prefix of an
/// operator's operands. All else becomes part of its parent's job.
class SceneJobs {
 public:
  SceneJobs(const Scene& scene, BoundaryCache& cache, const KnownTails& tails,
            const EvaluateOptions& options, unsigned threads, EvaluateStats& stats)
      : scene_(scene),
        cache_(cache),
        tails_(tails),
        options_(options),
        threads_(threads),
        stats_(stats) {}

  /// Evaluates what the roots (scene nodes, not empty) need. Errors: those of evaluate_boolean.
  Status run(const std::vector<uint32_t>& roots);
  struct MovedPieces {
    PiecesPtr pieces;
    IVec3 moved;  ///< by how many steps the root is elsewhere
  };
  /// The pieces of a root, if it has become one in pieces and is not turned from where it was
  /// evaluated; else null. REQUIRES: run() was called with it.
  MovedPieces pieces(uint32_t root);
  /// The boundary of a root in the world. REQUIRES: run() was called with it.
  Result<BoundaryPtr> world_boundary(uint32_t root);

 private:
  struct Kept {
    StoredBoundary stored;
    bool is_fresh = false;  // evaluated for a use that has not come yet
    double seconds = 0;     // in which it was evaluated, if it was
  };
  struct Parts {  // of one job
    std::vector<Operand> operands;
    std::vector<Key> keys;  // of what each of them is
    PiecesPtr in_pieces;    // an operand, which is empty then
    uint32_t pieces_at = 0;
    /// By how many steps all stands away from its place in the scene: where the first operand was
    /// evaluated.
    IVec3 moved{0, 0, 0};
    bool may_be_moved = false;
    bool is_too_far = false;  // an operand does not fit the grid there
    Expression expression;
    uint64_t operators = 0, sources = 0;
  };
  struct OpenOperator;  // an operator whose operands are being put into a job

  /// Whether a node must be evaluated: an operator or a hull.
  [[nodiscard]] bool is_operator(uint32_t node) const {
    return scene_.nodes[node].kind == SceneNode::Kind::kOperator || is_hull(node);
  }
  [[nodiscard]] bool is_hull(uint32_t node) const {
    return scene_.nodes[node].kind == SceneNode::Kind::kHull;
  }
  /// Whether it is an operator whose value has surface of its first operand, and lies within it.
  [[nodiscard]] bool cuts_its_first(uint32_t node) const {
    const SceneNode& n = scene_.nodes[node];
    return n.kind == SceneNode::Kind::kOperator &&
           (n.op == BooleanOp::kIntersection || n.op == BooleanOp::kDifference);
  }
  [[nodiscard]] static bool may_keep(const Subtree& subtree);
  [[nodiscard]] bool is_known(const Key& key);
  [[nodiscard]] bool may_use_known(const Subtree& subtree);
  void find_operators(const std::vector<uint32_t>& roots);
  std::vector<uint32_t> count_uses(const std::vector<uint32_t>& roots);
  void note_user(uint32_t operand, uint32_t user);
  void note_cut_from(uint32_t node, const Identity& value, uint32_t user);
  void note_overlap(uint32_t a, uint32_t b, bool in_operator);
  [[nodiscard]] size_t shared_prefix(const OperandList& list);
  [[nodiscard]] KnownTails::Tail known_tail(uint32_t node, const OperandList& list);
  Status evaluate(uint32_t node);
  Status evaluate_hull(uint32_t node);
  void keep(const Subtree& subtree, StoredBoundary stored, double seconds);
  Status take_as_whole_if_less_work(Parts& parts);
  Result<StoredBoundary> run_kept_job(Parts parts, const Subtree& subtree);
  KernelOptions job_options();
  Result<BoundaryPtr> run_job(Parts parts, const GridBox& region);
  Result<Parts> build(uint32_t node, size_t count, uint32_t job_frame, bool may_be_moved = false);
  Result<uint32_t> put_known(Parts& parts, const Subtree& value, uint32_t job_frame,
                             bool is_tail = false);
  Result<OpenOperator> open(uint32_t node, size_t count, bool is_target, uint32_t job_frame,
                            Parts& parts);
  uint32_t put(Parts& parts, Operand operand, const Subtree& subtree) const;
  uint32_t put_leaf(Parts& parts, const SceneNode& node, uint32_t job_frame) const;
  Result<uint32_t> put_placed(Parts& parts, const Subtree& subtree, uint32_t job_frame);
  BoundaryPtr spelled(const Key& of, const BoundaryPtr& boundary);
  void spell_out(Parts& parts);
  Result<Operand> place_as_kept(const Subtree& subtree, uint32_t job_frame);
  Result<Operand> place(const Subtree& subtree, uint32_t job_frame);
  [[nodiscard]] Operand place_leaf(const SceneNode& node, uint32_t job_frame,
                                   const IVec3& moved = {0, 0, 0}) const;
  /// Whether nothing is turned or painted over.
  static bool is_only_moved(const Subtree& subtree, const StoredBoundary& stored);
  /// Whether it is not even moved.
  static bool stands_as_stored(const Subtree& subtree, const StoredBoundary& stored);
  [[nodiscard]] bool may_be_in_pieces() const;
  const StoredBoundary& use(const Key& key);
  Kept& hold(const Key& key);
  PiecesPtr pieces_of_result(const Key& key);
  Result<BoundaryPtr> boundary_of(const Key& key);

  const Scene& scene_;
  BoundaryCache& cache_;
  const KnownTails& tails_;
  const EvaluateOptions& options_;
  unsigned threads_;
  EvaluateStats& stats_;
  /// Operators that stand in some operand list, by key: nodes of one key are interchangeable.
  std::unordered_map<Key, uint32_t, KeyHash> operators_;
  std::unordered_map<Key, uint32_t, KeyHash> uses_;
  struct User {
    uint32_t user;   // an operator
    Identity value;  // what of it has the solid's surface
  };
  std::unordered_map<Identity, User, IdentityHash> first_users_;  // of each solid
  std::unordered_set<uint32_t> overlapping_;        // operators that have surface of one solid
  std::unordered_map<Key, Kept, KeyHash> results_;  // of this run: they outlive the cache's bound
  uint64_t jobs_done_ = 0, jobs_total_ = 0;
};

}  // namespace csgrun
