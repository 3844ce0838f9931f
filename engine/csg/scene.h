// The normal form on one grid: every leaf quantised in its frame, every subtree with a key that
// says what it is and a placement that says where.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <unordered_map>
#include <vector>

#include "engine/csg/frames.h"
#include "engine/csg/key.h"
#include "engine/csg/leaf_store.h"
#include "engine/csg/normal_form.h"
#include "engine/csg/scene_step.h"
#include "engine/csg/warnings.h"

namespace csgrun {

/// What a subtree is (`key`) and where it stands: x in the axes of its reference, its first leaf,
/// is permutation x + origin in the frame. Subtrees of one frame have keys free of their placement,
/// so that copies moved by whole steps, or turned or mirrored as a whole, have one key. A subtree
/// that mixes frames has the world as its reference.
struct Identity {
  Key key{};
  uint32_t frame = 0;  ///< into Scene::frames
  SignedPermutation permutation;
  IVec3 origin{0, 0, 0};
  /// The appearance of all faces; it is not part of the key. kUnpainted: faces differ, and the key
  /// tells how.
  uint32_t paint = kUnpainted;

  /// The same point set with the same appearance.
  bool operator==(const Identity&) const = default;
};

struct IdentityHash {
  size_t operator()(const Identity& id) const {
    size_t h = KeyHash()(id.key);
    for (const int64_t x : id.origin) h = (h ^ static_cast<size_t>(x)) * 0x9E3779B97F4A7C15ULL;
    return h;
  }
};

/// A subtree as far as others see it. Boxes enclose the point set, in steps.
struct Subtree {
  Identity id;
  GridBox box;          ///< in the axes of its frame
  GridBox world;        ///< in the world
  uint64_t slots = 0;   ///< leaves, counted with repetition
  bool is_far = false;  ///< a leaf has coordinates beyond 2^27 steps
  /// All leaves are in its frame: moved by whole steps in there it is the same, elsewhere.
  bool is_of_one_frame = true;
  /// All leaves are boxes along the axes of the world (bsp/evaluate_boxes).
  bool is_of_boxes = false;

  /// The same, so many steps away in its frame, as far as jobs see it.
  [[nodiscard]] Subtree moved(const IVec3& by) const {
    Subtree result = *this;
    result.box = box.moved(by);
    for (size_t k = 0; k < 3; ++k) result.id.origin[k] += by[k];
    return result;
  }
};

/// Operands of one operator by what they are, with their places.
using OperandSet = std::unordered_map<Identity, uint32_t, IdentityHash>;

struct SceneNode {
  /// kKnown: an operator whose value is at hand; its operands are not in the scene.
  enum class Kind : uint8_t { kEmpty, kLeaf, kOperator, kHull, kKnown };
  Kind kind = Kind::kEmpty;
  Subtree subtree;

  /// Leaf: in the axes of its frame, less the origin; or, where its surface had to be resolved,
  /// what it encloses, in its local axes, less the origin.
  std::shared_ptr<const LeafGeometry> geometry;
  BoundaryPtr boundary;
  NodePtr leaf;

  BooleanOp op = BooleanOp::kUnion;  ///< as in NormalNode; a hull has `first` only
  uint32_t first = 0;
  std::vector<uint32_t> rest;
  std::vector<Subtree> prefixes;  ///< the value after each of `rest`
};

/// The operands of an operator with those of its prefix, and the value after each of them; of a
/// hull its only operand.
struct OperandList {
  std::vector<uint32_t> operands;
  std::vector<const Subtree*> values;
};

struct Scene {
  GridStep step;
  std::vector<Frame> frames;     ///< the first is the world
  std::vector<SceneNode> nodes;  ///< children before parents
  std::vector<uint32_t> roots;
  bool is_partial = false;  ///< the root's first operand is a known one
  /// If that is of the root's operator: its operands are those in the first so many places.
  std::shared_ptr<const OperandSet> met_before;
  size_t met_count = 0;

  [[nodiscard]] OperandList operands(uint32_t index) const;
  /// The leaves below a node are counted with repetition, in tree order: source i is leaf i. Those
  /// of some numbers, which ascend. O(nodes above them). REQUIRES: the scene is not partial.
  [[nodiscard]] std::vector<uint32_t> leaves(uint32_t index,
                                             std::span<const uint32_t> numbers) const;
};

/// Whether all coordinates are below 2^27 steps.
bool fits_grid(const GridBox& box);

/// Where scenes note what is known of each node of the normal form: room that they all take.
struct SceneRoom {
  std::vector<LeafRounding> rounding;
  std::vector<uint32_t> frame_of;
  std::vector<StepLeaf> step_leaves;
  std::vector<std::array<RowTable::Handle, 3>> row_handles;
  std::vector<uint32_t> scene_index;
  ReachRoom reach;
};

class SceneStarts;

struct SceneContext {
  NormalForm& form;
  LeafStore& store;
  AppearanceTable& appearances;
  Warnings& warnings;
  SceneRoom& room;
  std::function<bool()> cancelled;
  Resolver resolve;
};

/// Chooses the step (unless `step` is given), not below `least` if there is one, and puts the
/// subtrees of the normal form on the grid. Leaves that cross themselves are resolved, with a
/// warning. Errors: kInvalidMesh (with the leaf's line), kOutOfRange when the scene does not fit
/// the grid, kLimit, kCancelled, those of `resolve`. With `starts` (scene_start.h) the scene of one
/// root goes on from that of its first operand where it can, and is partial then: O(what is new).
Result<Scene> build_scene(SceneContext& context, std::span<const uint32_t> roots,
                          const GridStep& step, const GridStep& least = {},
                          SceneStarts* starts = nullptr);

}  // namespace csgrun
