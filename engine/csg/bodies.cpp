#include "engine/csg/bodies.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <utility>

#include "engine/csg/leaf_faces.h"

namespace csgrun {
namespace {

using Pairs = std::vector<std::array<uint32_t, 2>>;

/// Equal for the same faces, whatever their order, and for these alone.
std::vector<uint32_t> signature(const LeafGeometry& leaf, const Shell& faces) {
  std::vector<std::vector<uint32_t>> loops;
  loops.reserve(faces.size());
  for (const uint32_t f : faces) {
    auto& loop = loops.emplace_back(leaf.corners.begin() + leaf.face_starts[f],
                                    leaf.corners.begin() + leaf.face_starts[f + 1]);
    std::rotate(loop.begin(), std::min_element(loop.begin(), loop.end()), loop.end());
  }
  std::sort(loops.begin(), loops.end());
  std::vector<uint32_t> all;
  for (const auto& loop : loops) {
    all.push_back(static_cast<uint32_t>(loop.size()));
    all.insert(all.end(), loop.begin(), loop.end());
  }
  return all;
}

bool holds(const GridBox& outer, const GridBox& inner) {
  bool all = true;
  for (size_t k = 0; k < 3; ++k) {
    all = all && outer.lo[k] <= inner.lo[k] && inner.hi[k] <= outer.hi[k];
  }
  return all;
}

class BodyFinder {
 public:
  BodyFinder(const LeafGeometry& leaf, std::span<const std::array<uint32_t, 2>> crossings)
      : leaf_(leaf),
        crossings_(crossings),
        shell_of_(leaf.face_count()),
        body_of_(leaf.face_count()),
        is_repeated_(leaf.face_count()) {}

  std::optional<std::vector<Body>> run() {
    std::vector<Shell> shells = closed_shells(leaf_);
    if (shells.size() < 2) return std::nullopt;
    std::vector<uint32_t> cavities;
    std::vector<Body> of_cavities;
    for (uint32_t s = 0; s < shells.size(); ++s) {
      for (const uint32_t f : shells[s]) shell_of_[f] = s;
      Body body = prepared(std::move(shells[s]));
      const bool is_good = body.prepared.status == PreparedLeaf::Status::kGood;
      if (!is_good && body.prepared.status != PreparedLeaf::Status::kTangled) return std::nullopt;
      if (is_good || !body.prepared.crossings.empty()) {
        bodies_.push_back(std::move(body));
        shells_of_body_.push_back({s});
      } else {
        cavities.push_back(s);
        of_cavities.push_back(std::move(body));
      }
    }
    find_what_crosses(cavities, shells.size());
    tries_left_ = 4 * shells.size();
    for (size_t c = 0; c < cavities.size(); ++c) {
      if (!put_into_body(cavities[c], of_cavities[c])) return std::nullopt;
    }
    drop_equal();
    if (!are_in_order()) return std::nullopt;
    return std::move(bodies_);
  }

 private:
  [[nodiscard]] Body prepared(Shell faces) const {
    PreparedLeaf leaf = prepare_faces(leaf_of_faces(leaf_, faces));
    return {std::move(faces), std::move(leaf)};
  }

  void find_what_crosses(const std::vector<uint32_t>& cavities, size_t shells) {
    if (cavities.empty()) return;
    std::vector<uint8_t> is_cavity(shells, 0);
    for (const uint32_t c : cavities) is_cavity[c] = 1;
    for (const auto& [f, g] : crossings_) {
      const uint32_t a = shell_of_[f], b = shell_of_[g];
      if (is_cavity[a]) crosses_cavity_.push_back({a, b});
      if (is_cavity[b]) crosses_cavity_.push_back({b, a});
    }
    std::sort(crosses_cavity_.begin(), crosses_cavity_.end());
    crosses_cavity_.erase(std::unique(crosses_cavity_.begin(), crosses_cavity_.end()),
                          crosses_cavity_.end());
  }

  /// With the first body, of those nearest before and behind it in the leaf, with which it bounds a
  /// solid: then no point is wrapped by both but 0 or 1 times, whatever else may hold it.
  bool put_into_body(uint32_t shell, const Body& cavity) {
    const auto next =
        std::partition_point(shells_of_body_.begin(), shells_of_body_.end(),
                             [&](const std::vector<uint32_t>& of) { return of[0] < shell; });
    const auto middle = static_cast<size_t>(next - shells_of_body_.begin());
    for (size_t away = 0; away < bodies_.size(); ++away) {
      if (away < middle && try_body(middle - 1 - away, shell, cavity)) return true;
      if (middle + away < bodies_.size() && try_body(middle + away, shell, cavity)) return true;
    }
    return false;
  }
  bool try_body(size_t number, uint32_t shell, const Body& cavity) {
    Body& body = bodies_[number];
    std::vector<uint32_t>& shells = shells_of_body_[number];
    if (body.prepared.status != PreparedLeaf::Status::kGood ||
        !holds(body.prepared.box, cavity.prepared.box) || tries_left_ == 0) {
      return false;
    }
    if (std::any_of(shells.begin(), shells.end(), [&](uint32_t other) {
          return std::binary_search(crosses_cavity_.begin(), crosses_cavity_.end(),
                                    std::array{shell, other});
        })) {
      return false;
    }
    --tries_left_;
    Shell both;
    std::merge(body.faces.begin(), body.faces.end(), cavity.faces.begin(), cavity.faces.end(),
               std::back_inserter(both));
    Body hollow = prepared(std::move(both));
    if (hollow.prepared.status != PreparedLeaf::Status::kGood) return false;
    body = std::move(hollow);
    shells.push_back(shell);
    return true;
  }

  /// Leaves the first of equal bodies. Not before they have their cavities: one of two equal shells
  /// may have one.
  void drop_equal() {
    std::map<std::vector<uint32_t>, uint32_t> number_of;
    std::vector<Body> different;
    for (Body& body : bodies_) {
      const auto next = static_cast<uint32_t>(different.size());
      const auto [known, is_new] = number_of.emplace(signature(leaf_, body.faces), next);
      for (const uint32_t f : body.faces) {
        body_of_[f] = known->second;
        is_repeated_[f] = is_new ? 0 : 1;
      }
      if (is_new) different.push_back(std::move(body));
    }
    bodies_ = std::move(different);
  }

  /// Whether of faces that lie upon one another the first in the leaf is in the first body.
  [[nodiscard]] bool are_in_order() const {
    return std::none_of(crossings_.begin(), crossings_.end(), [&](const auto& pair) {
      const auto [f, g] = std::minmax(pair[0], pair[1]);
      // A face that is repeated is after the one that it repeats; then that one tells the rest.
      const bool are_swapped =
          body_of_[f] == body_of_[g]
              ? is_repeated_[f] > is_repeated_[g]
              : body_of_[f] > body_of_[g] && is_repeated_[f] == 0 && is_repeated_[g] == 0;
      return are_swapped && !are_labelled_alike(f, g) && are_coplanar(f, g);
    });
  }
  [[nodiscard]] bool are_labelled_alike(uint32_t f, uint32_t g) const {
    return leaf_.facet[f] == leaf_.facet[g] && leaf_.surface[f] == leaf_.surface[g] &&
           leaf_.appearance[f] == leaf_.appearance[g];
  }
  [[nodiscard]] bool are_coplanar(uint32_t f, uint32_t g) const {
    const uint32_t begin = leaf_.face_starts[f];
    CornerPlane plane;
    corner_plane(leaf_.vertices, &leaf_.corners[begin], leaf_.face_starts[f + 1] - begin, plane);
    const auto corners =
        std::span(leaf_.corners)
            .subspan(leaf_.face_starts[g], leaf_.face_starts[g + 1] - leaf_.face_starts[g]);
    return std::all_of(corners.begin(), corners.end(),
                       [&](uint32_t v) { return plane.side(leaf_.vertices[v]) == 0; });
  }

  const LeafGeometry& leaf_;
  const std::span<const std::array<uint32_t, 2>> crossings_;
  std::vector<uint32_t> shell_of_;  ///< per face
  Pairs crosses_cavity_;            ///< of shells, the first a cavity
  std::vector<Body> bodies_;
  std::vector<std::vector<uint32_t>> shells_of_body_;  ///< the outer one first; until equals go
  std::vector<uint32_t> body_of_;                      ///< per face; the first of equal ones
  std::vector<uint8_t> is_repeated_;  ///< whether a face is of another one of these
  size_t tries_left_ = 0;             ///< so many bodies are looked at for cavities
};

}  // namespace

std::optional<std::vector<Body>> find_bodies(const LeafGeometry& leaf,
                                             std::span<const std::array<uint32_t, 2>> crossings) {
  return BodyFinder(leaf, crossings).run();
}

}  // namespace csgrun
