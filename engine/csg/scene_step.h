// How far the part of a scene reaches that can reach its results.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/csg/frames.h"
#include "engine/csg/normal_form.h"

namespace csgrun {

/// An axis-aligned box in mm, closed; empty when lo > hi.
struct MmBox {
  std::array<double, 3> lo{}, hi{};
  bool operator==(const MmBox&) const = default;
};

/// A leaf: its box in the world, its box in its local axes, and the rows that lead there.
struct StepLeaf {
  MmBox world, own;
  MmBox local;  ///< what of `own` is needed, by scene_reach: less where a prismatic leaf is far
                ///< longer
  std::array<Row, 3> rows{};
  std::array<bool, 3> prismatic{};  ///< by local axis, see MeshFacts
  bool framed = false;              ///< its frame is not the world
  bool whole = false;               ///< it is needed as a whole, wherever results can be
  bool seen = false;                ///< a result can be where it is, by scene_reach
};

/// In mm: the largest coordinate, in the world or in a frame, of what can reach a result, and the
/// largest of any leaf that is seen. Leaves in frames of their own count as a whole to the former:
/// the planes of far leaves have no room for a frame (engine/exact/widths.h). But those that are
/// prismatic along an axis are cut off along it, beyond all that can see them.
struct SceneReach {
  double reach = 0, far = 0;
  std::vector<MmBox> of_roots;  ///< around the result of each root
  bool sees_known = true;       ///< all of what is known is seen from the root
};

/// What a scene of its own said of a node, so that its leaves need not be looked at again.
struct KnownReach {
  uint32_t index = 0;  ///< in the normal form
  MmBox box;
  double reach = 0, far = 0;
};

/// What is noted of each node of the normal form on the way: room that all calls take.
struct ReachRoom {
  std::vector<MmBox> box, reach;
  std::vector<uint8_t> whole;
};

/// Interval bounds over the normal form: the box of a union is the hull of the boxes, of a
/// difference the first, of an intersection the common box; a leaf counts where a result can be
/// above it. A leaf that is resolved by itself, and all below a hull, count as a whole. `order` has
/// children before parents; `leaves` is indexed like the normal form: their `local` and `seen` are
/// set. Of what stands over a `known` node alone nothing is in `order`: then the result holds if it
/// sees all of that. O(order).
SceneReach scene_reach(const NormalForm& form, std::span<const uint32_t> order,
                       std::span<const uint32_t> roots, std::span<StepLeaf> leaves, ReachRoom& room,
                       const KnownReach* known = nullptr);

}  // namespace csgrun
