#include "export/small_steps.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>

#include <csgrun/engine/exact_triangles.h>

#include "export/edge_turn.h"
#include "export/half_edges.h"
#include "export/none.h"

namespace csgrun {
namespace {

/// A vertex with more triangles stays: each step there would take as long as all others.
constexpr size_t kMostAround = 200;
/// So many steps for each triangle of which something is wrong at first: a bound that nothing that
/// ends well comes near.
constexpr uint64_t kMostSteps = 64;

/// What is wrong of some triangles; less is better.
struct Wrong {
  uint64_t count = 0;  ///< crossings, triangles without area and flipped ones
  double area = 0;     ///< mm^2: twice that of flipped ones
};

struct Step {
  uint32_t half_edge = 0;
  bool merges = false;  ///< its first vertex goes to its second; else the edge is turned
  double by = 0;        ///< mm: what it moves the surface by
};

double distance_from_segment(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b) {
  const glm::dvec3 ab = b - a;
  const double squared = glm::dot(ab, ab);
  const double at = squared > 0 ? std::clamp(glm::dot(p - a, ab) / squared, 0.0, 1.0) : 0.0;
  return glm::distance(p, a + at * ab);
}

class Stepper {
 public:
  Stepper(RoundedMesh& mesh, std::span<const uint32_t> wrong,
          std::span<const glm::dvec3> directions)
      : mesh_(mesh),
        directions_(directions),
        place_(number_places(mesh.positions)),
        points_(positions_of_places(mesh.positions, place_)),
        placed_(mesh.triangles),
        crossings_({points_, placed_with_places()}),
        suspects_(wrong.begin(), wrong.end()),
        is_suspect_(mesh.triangles.size(), false),
        known_(mesh.triangles.size()),
        is_known_(mesh.triangles.size(), false),
        steps_left_(kMostSteps * wrong.size()) {
    for (const uint32_t t : wrong) is_suspect_[t] = true;
  }

  /// False if it was cancelled.
  bool run(double width, const std::atomic<bool>* cancel) {
    for (bool any = true; any;) {
      any = false;
      for (size_t i = 0; i < suspects_.size(); ++i) {  // which grow meanwhile
        if (cancel && cancel->load(std::memory_order_relaxed)) return false;
        while (steps_left_ > 0 && step_near(suspects_[i], width)) any = true;
      }
    }
    return true;
  }

  Result<SmallSteps> finish() {
    if (result_.turned + result_.merged == 0) return result_;
    for (const double by : moved_) result_.farthest = std::max(result_.farthest, by);
    if (Status status = compact(); !status) return status.error();
    return result_;
  }

 private:
  const std::vector<Triangle>& placed_with_places() {
    for (Triangle& t : placed_) t = {place_[t[0]], place_[t[1]], place_[t[2]]};
    return placed_;
  }

  [[nodiscard]] uint32_t from(uint32_t h) const { return mesh_.triangles[h / 3][h % 3]; }
  [[nodiscard]] uint32_t to(uint32_t h) const { return from(next_in_triangle(h)); }
  [[nodiscard]] const glm::dvec3& at(uint32_t v) const { return mesh_.positions[v]; }
  [[nodiscard]] bool is_gone(uint32_t t) const { return mesh_.triangles[t][0] == kNone; }

  /// Calls visit(h) for the half-edges that leave the first vertex of h; ends when it says so.
  template <class Visit>
  void visit_around(uint32_t h, Visit visit) const {
    uint32_t k = h;
    do {
      if (!visit(k)) return;
      k = mesh_.twins[previous_in_triangle(k)];
    } while (k != h);
  }

  /// The triangles around the first vertex of h; nothing if there are too many.
  [[nodiscard]] std::vector<uint32_t> star(uint32_t h) const {
    std::vector<uint32_t> around;
    visit_around(h, [&](uint32_t k) {
      around.push_back(k / 3);
      return around.size() <= kMostAround;
    });
    if (around.size() > kMostAround) around.clear();
    return around;
  }

  /// What a triangle crosses before a step; remembered until a step changes it.
  const std::vector<uint32_t>& known_crossings_of(uint32_t t) {
    if (!is_known_[t]) {
      known_[t] = crossings_.of(t);
      is_known_[t] = true;
    }
    return known_[t];
  }
  void forget_crossings_with(uint32_t t) {
    for (const uint32_t other : known_crossings_of(t)) is_known_[other] = false;
    is_known_[t] = false;
  }

  Wrong wrong_before(std::vector<uint32_t> triangles) {
    return wrong_of(std::move(triangles), [this](uint32_t t) -> const std::vector<uint32_t>& {
      return known_crossings_of(t);
    });
  }
  [[nodiscard]] Wrong wrong_after(std::vector<uint32_t> triangles) const {
    return wrong_of(std::move(triangles), [this](uint32_t t) { return crossings_.of(t); });
  }

  template <class CrossingsOf>
  [[nodiscard]] Wrong wrong_of(std::vector<uint32_t> triangles, CrossingsOf crossings_of) const {
    const TriangleView view{points_, placed_};
    std::sort(triangles.begin(), triangles.end());
    Wrong wrong;
    for (const uint32_t t : triangles) {
      if (is_gone(t)) continue;
      if (is_degenerate(view, t)) {
        ++wrong.count;
        continue;
      }
      if (facing(view, t, directions_[mesh_.triangle_face[t]]) < 0) {
        ++wrong.count;
        const auto& [a, b, c] = mesh_.triangles[t];
        wrong.area += glm::length(glm::cross(at(b) - at(a), at(c) - at(a)));
      }
      for (const uint32_t other : crossings_of(t)) {
        const bool is_counted =
            other < t && std::binary_search(triangles.begin(), triangles.end(), other);
        if (!is_counted) ++wrong.count;
      }
    }
    return wrong;
  }

  // Changes, which can be taken back.

  struct Change {
    uint32_t* slot;
    uint32_t before;
  };
  void set(uint32_t& slot, uint32_t value) {
    changes_.push_back({&slot, slot});
    slot = value;
  }
  void set_triangle(uint32_t t, const Triangle& corners) {
    for (size_t i = 0; i < 3; ++i) {
      set(mesh_.triangles[t][i], corners[i]);
      set(placed_[t][i], corners[i] == kNone ? 0 : place_[corners[i]]);
    }
    crossings_.changed(t);
    changed_.push_back(t);
  }
  void glue(uint32_t g, uint32_t h) {
    set(mesh_.twins[g], h);
    set(mesh_.twins[h], g);
  }
  void keep() {
    changes_.clear();
    changed_.clear();
  }
  void take_back() {
    for (size_t i = changes_.size(); i-- > 0;) *changes_[i].slot = changes_[i].before;
    for (const uint32_t t : changed_) crossings_.changed(t);
    keep();
  }

  bool turn(uint32_t h) {
    const std::optional<EdgeTurn> to = edge_turn(mesh_, h);
    if (!to) return false;
    set_triangle(to->t, to->first);
    set_triangle(to->u, to->second);
    set(mesh_.triangle_face[to->t], mesh_.triangle_face[to->u]);
    to->glue_all([&](uint32_t g, uint32_t k) { glue(g, k); });
    return true;
  }

  /// The first vertex of h becomes the second: possible if no third vertex is joined to both but
  /// those of the two triangles at the edge.
  bool merge(uint32_t h, std::span<const uint32_t> around) {
    const uint32_t g = mesh_.twins[h], t = h / 3, u = g / 3;
    const uint32_t gone = from(h), stays = to(h);
    const uint32_t c = from(previous_in_triangle(h)), d = from(previous_in_triangle(g));
    if (c == d) return false;
    std::vector<uint32_t> neighbours;
    visit_around(h, [&](uint32_t k) {
      neighbours.push_back(to(k));
      return true;
    });
    size_t common = 0;
    visit_around(g, [&](uint32_t k) {
      if (std::find(neighbours.begin(), neighbours.end(), to(k)) != neighbours.end()) ++common;
      return common < 3;
    });
    const std::array<uint32_t, 4> outer{
        mesh_.twins[next_in_triangle(h)], mesh_.twins[previous_in_triangle(h)],
        mesh_.twins[next_in_triangle(g)], mesh_.twins[previous_in_triangle(g)]};
    if (common != 2) return false;
    for (const uint32_t o : outer) {
      if (o / 3 == t || o / 3 == u) return false;
    }
    for (const uint32_t s : around) {
      Triangle corners = mesh_.triangles[s];
      std::replace(corners.begin(), corners.end(), gone, stays);
      set_triangle(s, s == t || s == u ? Triangle{kNone, kNone, kNone} : corners);
    }
    glue(outer[0], outer[1]);
    glue(outer[2], outer[3]);
    return true;
  }

  [[nodiscard]] std::vector<Step> steps_near(uint32_t triangle, double width) const {
    std::vector<uint32_t> near{triangle};
    for (uint32_t h = 3 * triangle; h < 3 * triangle + 3; ++h) {
      const uint32_t beyond = mesh_.twins[h] / 3;
      if (std::find(near.begin(), near.end(), beyond) == near.end()) near.push_back(beyond);
    }
    std::vector<Step> steps;
    for (const uint32_t t : near) {
      for (uint32_t h = 3 * t; h < 3 * t + 3; ++h) {
        const glm::dvec3 &a = at(from(h)), &b = at(to(h)), &c = at(from(previous_in_triangle(h)));
        // With the corner moved to the edge, the surface would be the same before and after.
        const double height = distance_from_segment(c, a, b), length = glm::distance(a, b);
        if (height < width) steps.push_back({h, false, height});
        if (!(length < width)) continue;
        steps.push_back({h, true, length});
        steps.push_back({mesh_.twins[h], true, length});
      }
    }
    return steps;
  }

  [[nodiscard]] std::vector<uint32_t> triangles_of(const Step& step) const {
    if (step.merges) return star(step.half_edge);
    return {step.half_edge / 3, mesh_.twins[step.half_edge] / 3};
  }

  bool take(const Step& step, std::span<const uint32_t> triangles) {
    return step.merges ? merge(step.half_edge, triangles) : turn(step.half_edge);
  }

  /// Takes the step that leaves the least wrong, if any leaves less.
  bool step_near(uint32_t triangle, double width) {
    if (is_gone(triangle) || wrong_before({triangle}).count == 0) return false;
    std::optional<Step> best;
    // Steps have to do with different triangles, so what goes away with each is compared.
    const auto difference = [](const Wrong& before, const Wrong& after) {
      return std::pair(static_cast<int64_t>(before.count - after.count), before.area - after.area);
    };
    std::pair<int64_t, double> best_gone{0, 0};
    for (const Step& step : steps_near(triangle, width)) {
      const std::vector<uint32_t> triangles = triangles_of(step);
      if (triangles.empty()) continue;
      const Wrong before = wrong_before(triangles);
      if (before.count == 0 || !take(step, triangles)) continue;
      const std::pair<int64_t, double> gone = difference(before, wrong_after(triangles));
      take_back();
      if (gone < best_gone || gone <= std::pair<int64_t, double>{0, 0}) continue;
      if (best && gone == best_gone && step.by >= best->by) continue;
      best = step;
      best_gone = gone;
    }
    if (!best) return false;
    commit(*best);
    return true;
  }

  void commit(const Step& step) {
    --steps_left_;
    moved_.resize(mesh_.positions.size(), 0);
    const std::vector<uint32_t> triangles = triangles_of(step);
    double moved = 0;
    for (const uint32_t t : triangles) {
      for (const uint32_t v : mesh_.triangles[t]) moved = std::max(moved, moved_[v]);
    }
    // Any point of these triangles may have moved as far as their corners, and moves on.
    for (const uint32_t t : triangles) {
      for (const uint32_t v : mesh_.triangles[t]) moved_[v] = moved + step.by;
    }
    for (const uint32_t t : triangles) {
      if (is_suspect_[t]) continue;
      is_suspect_[t] = true;
      suspects_.push_back(t);
    }
    for (const uint32_t t : triangles) forget_crossings_with(t);
    take(step, triangles);
    for (const uint32_t t : triangles) forget_crossings_with(t);
    keep();
    ++(step.merges ? result_.merged : result_.turned);
  }

  /// Leaves out what is gone.
  Status compact() {
    std::vector<uint32_t> new_triangle(mesh_.triangles.size(), kNone);
    std::vector<uint32_t> new_vertex(mesh_.positions.size(), kNone);
    uint32_t triangles = 0, vertices = 0;
    for (uint32_t t = 0; t < new_triangle.size(); ++t) {
      if (is_gone(t)) continue;
      new_triangle[t] = triangles++;
      for (const uint32_t v : mesh_.triangles[t]) new_vertex[v] = 0;
    }
    for (uint32_t v = 0; v < new_vertex.size(); ++v) {
      if (new_vertex[v] == kNone) continue;
      mesh_.positions[vertices] = mesh_.positions[v];
      new_vertex[v] = vertices++;
    }
    for (uint32_t t = 0; t < new_triangle.size(); ++t) {
      const uint32_t n = new_triangle[t];
      if (n == kNone) continue;
      for (uint32_t i = 0; i < 3; ++i) {
        mesh_.triangles[n][i] = new_vertex[mesh_.triangles[t][i]];
        const uint32_t twin = mesh_.twins[3 * t + i];
        mesh_.twins[3 * n + i] = 3 * new_triangle[twin / 3] + twin % 3;
      }
      mesh_.triangle_face[n] = mesh_.triangle_face[t];
    }
    mesh_.dropped += mesh_.triangles.size() - triangles;
    mesh_.triangles.resize(triangles);
    mesh_.triangle_face.resize(triangles);
    mesh_.twins.resize(size_t{3} * triangles);
    mesh_.positions.resize(vertices);
    for (auto& outline : mesh_.outlines) outline.clear();
    const auto twins = manifold_twins(mesh_.triangles, mesh_.positions.size());
    if (!twins) return twins.error();
    if (*twins != mesh_.twins) {
      return Error{ErrorCode::kInternal, "edges are not glued as small steps left them", {}};
    }
    return std::monostate{};
  }

  RoundedMesh& mesh_;
  std::span<const glm::dvec3> directions_;
  const std::vector<uint32_t> place_;
  const std::vector<glm::dvec3> points_;
  std::vector<Triangle> placed_;  ///< the triangles with numbers of places
  LocalCrossings crossings_;
  std::vector<uint32_t> suspects_;  ///< triangles of which something may be wrong
  std::vector<bool> is_suspect_;
  std::vector<std::vector<uint32_t>> known_;  ///< per triangle: what it crosses
  std::vector<bool> is_known_;                ///< per triangle
  uint64_t steps_left_;
  std::vector<double> moved_;  ///< per vertex: no point of the triangles there moved by more
  std::vector<Change> changes_;
  std::vector<uint32_t> changed_;  ///< triangles
  SmallSteps result_;
};

}  // namespace

Result<SmallSteps> take_small_steps(RoundedMesh& mesh, std::span<const uint32_t> wrong,
                                    double first, double last,
                                    std::span<const glm::dvec3> directions,
                                    const std::atomic<bool>* cancel) {
  Stepper stepper(mesh, wrong, directions);
  for (double width = first; width <= last; width *= 2) {
    if (!stepper.run(width, cancel)) return Error{ErrorCode::kCancelled, "cancelled", {}};
  }
  return stepper.finish();
}

}  // namespace csgrun
