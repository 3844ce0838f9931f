// Where a triangle mesh over doubles crosses itself: a tree of boxes finds the pairs that may,
// slabs part long triangles, and signs of determinants decide.
#include <algorithm>
#include <array>
#include <atomic>
#include <optional>

#include <csgrun/engine/exact_triangles.h>

#include "engine/base/parallel.h"
#include "engine/mesh/box_frame.h"
#include "engine/mesh/box_tree.h"
#include "engine/mesh/crossing_test.h"
#include "engine/mesh/long_triangles.h"
#include "engine/mesh/triangle_boxes.h"
#include "engine/mesh/triangle_shape.h"

namespace csgrun {
namespace {

using Crossings = std::vector<TriangleCrossing>;

bool in_order(const TriangleCrossing& a, const TriangleCrossing& b) {
  return a.triangles < b.triangles;
}

/// The triangles with area, in a tree.
class Search {
 public:
  explicit Search(const TriangleView& mesh) : mesh_(mesh), test_(mesh) {
    for (uint32_t t = 0; t < mesh.triangles.size(); ++t) {
      if (test_.has_area(t)) triangles_.push_back(t);
    }
    const std::vector<std::array<Vec3d, 3>> sample = sample_of(mesh, triangles_);
    const TriangleBoxes boxes(mesh, sample);
    boxes_.reserve(triangles_.size());
    for (const uint32_t t : triangles_) boxes_.push_back(boxes.of(mesh, t));
    tree_.emplace(boxes_);
    if (!has_long_triangles(sample)) return;
    std::vector<uint32_t> order = tree_->order();
    for (uint32_t& t : order) t = triangles_[t];
    slabs_.emplace(mesh, order);
  }

  /// All crossings; nothing if there are more than `most`.
  [[nodiscard]] std::optional<Crossings> all(uint64_t most) const {
    constexpr size_t kTasks = 256;
    return collect(tree_->pair_tasks(kTasks), most, [&](const PackedBoxes::Task& task, auto add) {
      tree_->visit_pairs(
          task,
          [&](uint32_t place, uint32_t group, uint32_t hits) {
            return slabs_ ? hits & ~slabs_->apart(place, group, hits) : hits;
          },
          add);
    });
  }

  /// Those of `some` triangles, which ascend, with others and among themselves.
  [[nodiscard]] std::optional<Crossings> of(std::span<const uint32_t> some, uint64_t most) const {
    std::vector<uint8_t> is_asked(mesh_.triangles.size(), 0);
    for (const uint32_t t : some) is_asked[t] = 1;
    std::vector<uint32_t> asked;  // with area, by their numbers here
    for (uint32_t i = 0; i < triangles_.size(); ++i) {
      if (is_asked[triangles_[i]] != 0) asked.push_back(i);
    }
    return collect(asked, most, [&](uint32_t i, auto add) {
      tree_->visit_all(boxes_[i], [&](uint32_t j) {
        if (j > i || is_asked[triangles_[j]] == 0) add(i, j);
      });
    });
  }

  /// The first `most` of all. Takes one triangle after another, and ends where there are enough.
  [[nodiscard]] Crossings first(uint64_t most) const {
    constexpr size_t kEach = 256;
    std::vector<Crossings> parts(part_count(boxes_.size(), kEach));
    std::atomic<size_t> enough = parts.size();  // a part with as many: those after it do not matter
    for_each_part(boxes_.size(), kEach, [&](size_t part, size_t begin, size_t end) {
      Crossings& found = parts[part];
      for (auto i = static_cast<uint32_t>(begin); i < end && part <= enough; ++i) {
        const size_t before = found.size();
        tree_->visit_later(i, [&](uint32_t j) { look_at(i, j, found); });
        std::sort(found.begin() + static_cast<std::ptrdiff_t>(before), found.end(), in_order);
        if (found.size() < most) continue;
        for (size_t at = enough; part < at && !enough.compare_exchange_weak(at, part);) {
        }
        break;
      }
    });
    Crossings all;
    for (const Crossings& part : parts) {
      const size_t wanted = std::min<size_t>(part.size(), most - all.size());
      all.insert(all.end(), part.begin(), part.begin() + static_cast<std::ptrdiff_t>(wanted));
    }
    return all;
  }

 private:
  void look_at(uint32_t i, uint32_t j, Crossings& found) const {
    const auto [first, second] = std::minmax(triangles_[i], triangles_[j]);
    if (const auto place = test_.crossing(first, second))
      found.push_back({{first, second}, *place});
  }

  /// Those of the pairs that visit(thing, add) adds for each of the things, by add(i, j); each pair
  /// is added once.
  template <class Thing, class Visit>
  std::optional<Crossings> collect(const std::vector<Thing>& things, uint64_t most,
                                   Visit visit) const {
    std::vector<Crossings> parts(things.size());
    std::atomic<uint64_t> count = 0;
    for_each_part(things.size(), 1, [&](size_t part, size_t, size_t) {
      Crossings& found = parts[part];
      visit(things[part], [&](uint32_t i, uint32_t j) {
        if (count > most) return;
        const size_t before = found.size();
        look_at(i, j, found);
        count += found.size() - before;
      });
    });
    if (count > most) return std::nullopt;
    Crossings all;
    for (const Crossings& part : parts) all.insert(all.end(), part.begin(), part.end());
    std::sort(all.begin(), all.end(), in_order);
    return all;
  }

  const TriangleView mesh_;
  const CrossingTest test_;
  std::vector<uint32_t> triangles_;  ///< with area, ascending
  std::vector<Box> boxes_;
  std::optional<BoxTree> tree_;
  std::optional<LongTriangles> slabs_;  ///< if they are long
};

/// What look(search) finds, or the first `most` of all where there are more: what comes first is
/// not what is found first.
template <class Look>
Crossings found_by(const TriangleView& mesh, uint64_t most, unsigned threads, Look look) {
  const auto find = [&] {
    expect_faces(mesh.triangles.size());
    const Search search(mesh);
    auto found = look(search);
    return found ? *std::move(found) : search.first(most);
  };
  return threads == 0 ? find() : with_threads(threads, find);
}

}  // namespace

std::vector<TriangleCrossing> find_crossings(const TriangleView& mesh, uint64_t most,
                                             unsigned threads) {
  return found_by(mesh, most, threads, [&](const Search& search) { return search.all(most); });
}

std::vector<TriangleCrossing> find_crossings(const TriangleView& mesh, uint64_t most,
                                             std::span<const uint32_t> some, unsigned threads) {
  return found_by(mesh, most, threads, [&](const Search& search) { return search.of(some, most); });
}

}  // namespace csgrun
