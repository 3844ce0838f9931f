// What single triangles cross: a tree of boxes as they were, and a list of those that changed.
#include <algorithm>
#include <numeric>

#include <csgrun/engine/exact_triangles.h>

#include "engine/mesh/box_tree.h"
#include "engine/mesh/crossing_test.h"
#include "engine/mesh/triangle_boxes.h"

namespace csgrun {

class LocalCrossings::Search {
 public:
  explicit Search(const TriangleView& mesh)
      : mesh_(mesh),
        test_(mesh),
        boxes_(mesh, sample_of(mesh, numbers(mesh))),
        place_(mesh.triangles.size(), kInTree) {
    plant();
  }

  void changed(uint32_t triangle) {
    test_.renew(mesh_, triangle);
    const bool is_as_planted = mesh_.triangles[triangle] == planted_[triangle];
    if (place_[triangle] != kInTree) {
      const uint32_t place = place_[triangle];
      if (!is_as_planted) {
        changed_[place].box = boxes_.of(mesh_, triangle);
        return;
      }
      changed_[place] = changed_.back();
      place_[changed_[place].triangle] = place;
      changed_.pop_back();
      place_[triangle] = kInTree;
    } else if (!is_as_planted) {
      place_[triangle] = static_cast<uint32_t>(changed_.size());
      changed_.push_back({triangle, boxes_.of(mesh_, triangle)});
      if (changed_.size() > kMostChanged) plant();
    }
  }

  [[nodiscard]] std::vector<uint32_t> of(uint32_t triangle) const {
    std::vector<uint32_t> crossed;
    if (!test_.has_area(triangle)) return crossed;
    const auto look_at = [&](uint32_t other) {
      if (other == triangle || !test_.has_area(other)) return;
      const auto [first, second] = std::minmax(triangle, other);
      if (test_.crossing(first, second)) crossed.push_back(other);
    };
    const Box box = boxes_.of(mesh_, triangle);
    tree_->visit_all(box, [&](uint32_t other) {
      if (place_[other] == kInTree) look_at(other);
    });
    for (const Changed& other : changed_) {
      if (other.box.overlaps(box)) look_at(other.triangle);
    }
    std::sort(crossed.begin(), crossed.end());
    return crossed;
  }

 private:
  static constexpr uint32_t kInTree = UINT32_MAX;
  static constexpr size_t kMostChanged = 512;
  struct Changed {
    uint32_t triangle = 0;
    Box box{};
  };

  static std::vector<uint32_t> numbers(const TriangleView& mesh) {
    std::vector<uint32_t> all(mesh.triangles.size());
    std::iota(all.begin(), all.end(), 0u);
    return all;
  }

  /// A new tree of all triangles as they are.
  void plant() {
    planted_.assign(mesh_.triangles.begin(), mesh_.triangles.end());
    in_tree_.clear();
    in_tree_.reserve(planted_.size());
    for (uint32_t t = 0; t < planted_.size(); ++t) in_tree_.push_back(boxes_.of(mesh_, t));
    tree_.emplace(in_tree_);
    for (const Changed& changed : changed_) place_[changed.triangle] = kInTree;
    changed_.clear();
  }

  const TriangleView mesh_;
  CrossingTest test_;
  TriangleBoxes boxes_;
  std::vector<std::array<uint32_t, 3>> planted_;  ///< the triangles when the tree was made
  std::vector<Box> in_tree_;                      ///< theirs
  std::optional<BoxTree> tree_;
  std::vector<Changed> changed_;
  std::vector<uint32_t> place_;  ///< per triangle: into changed_, or in the tree
};

LocalCrossings::LocalCrossings(const TriangleView& mesh)
    : search_(std::make_unique<Search>(mesh)) {}
LocalCrossings::~LocalCrossings() = default;

void LocalCrossings::changed(uint32_t triangle) { search_->changed(triangle); }

std::vector<uint32_t> LocalCrossings::of(uint32_t triangle) const { return search_->of(triangle); }

}  // namespace csgrun
