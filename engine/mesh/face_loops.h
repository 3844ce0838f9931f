// The loops of a face. Of hundreds of thousands of faces nearly all have one loop of few corners.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "engine/base/few_vector.h"
#include "engine/bsp/regions.h"

namespace csgrun {

/// Edge i starts at corner i. Triangles and quadrangles take no memory beside the face.
using FaceLoop = FewVector<DirectedEdge, 4>;

/// The outer loop first, then the holes.
class FaceLoops {
 public:
  FaceLoops() = default;
  explicit FaceLoops(std::span<const DirectedEdge> outer) : outer_(outer) {}
  explicit FaceLoops(const std::vector<std::vector<DirectedEdge>>& loops) {
    if (loops.size() == 1) {
      outer_ = loops[0];
    } else if (!loops.empty()) {
      all_ = std::make_unique<std::vector<FaceLoop>>(loops.begin(), loops.end());
    }
  }

  [[nodiscard]] size_t size() const { return all_ ? all_->size() : outer_.empty() ? 0 : 1; }
  FaceLoop* begin() { return all_ ? all_->data() : &outer_; }
  FaceLoop* end() { return begin() + size(); }
  [[nodiscard]] const FaceLoop* begin() const { return all_ ? all_->data() : &outer_; }
  [[nodiscard]] const FaceLoop* end() const { return begin() + size(); }
  FaceLoop& operator[](size_t i) { return begin()[i]; }
  const FaceLoop& operator[](size_t i) const { return begin()[i]; }

 private:
  FaceLoop outer_;                              ///< if it is the only one
  std::unique_ptr<std::vector<FaceLoop>> all_;  ///< of several
};

}  // namespace csgrun
