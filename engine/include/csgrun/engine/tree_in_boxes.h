// What of a tree there is in boxes: trees for the parts of a solid that is at hand as a whole.
#pragma once

#include <memory>

#include <glm/vec3.hpp>

#include <csgrun/engine/csg_tree.h>

namespace csgrun {

class TreeInBoxes {
 public:
  explicit TreeInBoxes(NodePtr tree);
  ~TreeInBoxes();
  TreeInBoxes(const TreeInBoxes&) = delete;
  TreeInBoxes& operator=(const TreeInBoxes&) = delete;

  /// A tree whose solid has the same faces in the box, with the same labels, as that of the whole:
  /// without the leaves that are beside it, and the closed surfaces of leaves, by their points as
  /// they were given (on a grid they are elsewhere, by a few steps). Null if it is not a small
  /// part: what is evaluated anew is then more than what is saved. O(its size) or so; the first box
  /// costs O(n log n) for a whole of n leaves and faces.
  [[nodiscard]] NodePtr within(const glm::dvec3& low, const glm::dvec3& high);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace csgrun
