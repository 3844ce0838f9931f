// How scenes are built: leaves are placed in frames, a step is chosen for all of them, and nodes
// are made from below.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "engine/csg/quantise.h"
#include "engine/csg/scene.h"
#include "engine/csg/scene_start.h"
#include "engine/csg/scene_step.h"

namespace csgrun {

class SceneBuilder {
 public:
  /// `start`: that of the first operand of the only root, or null.
  SceneBuilder(SceneContext& context, std::span<const uint32_t> roots, SceneStart* start)
      : context_(context),
        roots_(roots),
        start_(start),
        order_(context.form.reachable(roots, start ? start->reach.index : UINT32_MAX)),
        scene_index_(context.room.scene_index),
        rounding_(context.room.rounding),
        frame_of_(context.room.frame_of),
        step_leaves_(context.room.step_leaves) {}

  Result<Scene> build(const GridStep& step, const GridStep& least);
  /// From the start; nothing if what the root adds changes what is known of it, or is at fault.
  std::optional<Scene> go_on(const GridStep& step);
  /// What scenes need that go on from this one; nothing if they cannot.
  std::optional<SceneStart> start_of(const Scene& scene);

 private:
  Status place_leaves();
  Status choose(const GridStep& step, const GridStep& least);
  void count_repeated_far_leaves();
  [[nodiscard]] uint32_t farthest_leaf() const;
  /// These warn if they are to `tell`; true if there is something to warn of.
  [[nodiscard]] bool has_far_parts(const SceneReach& reach, bool tell) const;
  [[nodiscard]] bool has_thin_leaves(const SceneReach& reach, bool tell) const;
  Result<SceneNode> make_leaf(uint32_t index, const Quantiser& quantiser);
  [[nodiscard]] GridBox placed_box(uint32_t index, const QuantisedLeaf& leaf) const;
  Status resolve_leaf(uint32_t index, const QuantisedLeaf& leaf, SceneNode& result);
  Status make_nodes();
  SceneNode make_hull(const NormalNode& node) const;
  SceneNode make_operator(const NormalNode& node);
  Subtree fold(BooleanOp op, const Subtree& prefix, const Subtree& operand) const;
  void put_paints(KeyBuilder& builder, const Identity& a, const Identity& b,
                  Identity& result) const;
  void put_placed(KeyBuilder& builder, const Identity& id) const;
  uint32_t intern(const Frame& frame);
  const NormalNode& normal(uint32_t index) const { return context_.form.nodes()[index]; }

  SceneContext& context_;
  std::span<const uint32_t> roots_;
  SceneStart* const start_;
  std::vector<uint32_t> order_;  // of normal nodes, children first
  Scene scene_;
  FrameNumbers frame_ids_;
  RowTable rows_;
  SceneReach reach_;
  bool is_quiet_ = true;  ///< nothing was to be said of how fine the grid is
  // By normal index; those of nodes that are in order_ are set.
  std::vector<uint32_t>& scene_index_;
  std::vector<LeafRounding>& rounding_;
  std::vector<uint32_t>& frame_of_;
  std::vector<StepLeaf>& step_leaves_;
  /// Set when leaves are found to be needed as a whole: one that must be resolved reaches too far,
  /// or those that are far repeat.
  bool is_step_too_small_ = false;
  bool has_repeats_ = false;  ///< see count_repeated_far_leaves
};

}  // namespace csgrun
