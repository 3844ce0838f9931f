#include "export/collapse.h"

#include <algorithm>
#include <cassert>
#include <numeric>
#include <tuple>

#include "export/none.h"

namespace csgrun {
namespace {

class Collapser {
 public:
  Collapser(std::span<const Triangle> triangles, std::span<const uint32_t> twins,
            std::span<const uint32_t> place)
      : triangles_(triangles), twins_(twins), place_(place) {}

  CollapsedSurface run() {
    across_.assign(twins_.size(), kNone);
    gone_.assign(triangles_.size(), false);
    drop_degenerate();
    cancel_reverses();
    glue_survivors();
    label_fans();
    cut_double_edges();
    return number_vertices();
  }

 private:
  [[nodiscard]] uint32_t place_at(uint32_t h) const { return place_[triangles_[h / 3][h % 3]]; }
  [[nodiscard]] uint32_t fan_ahead(uint32_t h) const { return fan_[next_in_triangle(h)]; }
  [[nodiscard]] uint32_t turn(uint32_t h) const { return glued_[previous_in_triangle(h)]; }

  /// `across_` of a half-edge in a triangle that is gone: the half-edge of a triangle that is gone
  /// which now lies on it, reversed. Of a side of no length: none.
  void drop_degenerate() {
    for (uint32_t t = 0; t < triangles_.size(); ++t) {
      const uint32_t h = 3 * t;
      const uint32_t a = place_at(h), b = place_at(h + 1), c = place_at(h + 2);
      if (a != b && b != c && c != a) continue;
      gone_[t] = true;
      ++result_.dropped;
      if (a == b && b == c) continue;
      const uint32_t short_side = a == b ? h : b == c ? h + 1 : h + 2;
      const uint32_t p = next_in_triangle(short_side), q = previous_in_triangle(short_side);
      across_[p] = q;
      across_[q] = p;
    }
  }

  struct Placed {  // a triangle with its corners turned so that the smallest place comes first
    uint32_t shell;
    std::array<uint32_t, 3> sorted;
    bool reversed;        // the corners run against the sorted order
    uint32_t first_edge;  // the half-edge that starts at the smallest place
    [[nodiscard]] auto key() const { return std::tie(shell, sorted); }
    bool operator<(const Placed& other) const {
      return key() != other.key() ? key() < other.key() : first_edge < other.first_edge;
    }
  };

  void cancel_reverses() {
    const std::vector<uint32_t> shell = shells_of(twins_);
    std::vector<Placed> placed;
    for (uint32_t t = 0; t < triangles_.size(); ++t) {
      if (gone_[t]) continue;
      uint32_t first = 3 * t;
      if (place_at(3 * t + 1) < place_at(first)) first = 3 * t + 1;
      if (place_at(3 * t + 2) < place_at(first)) first = 3 * t + 2;
      const uint32_t a = place_at(first), b = place_at(next_in_triangle(first)),
                     c = place_at(previous_in_triangle(first));
      placed.push_back({shell[t], {a, std::min(b, c), std::max(b, c)}, b > c, first});
    }
    std::sort(placed.begin(), placed.end());
    std::vector<uint32_t> sides[2];
    for (size_t begin = 0; begin < placed.size();) {
      size_t end = begin;
      sides[0].clear();
      sides[1].clear();
      for (; end < placed.size() && placed[end].key() == placed[begin].key(); ++end) {
        sides[placed[end].reversed].push_back(placed[end].first_edge);
      }
      for (size_t i = 0; i < std::min(sides[0].size(), sides[1].size()); ++i) {
        cancel(sides[0][i], sides[1][i]);
      }
      begin = end;
    }
  }

  /// `f` starts at the smallest place of one triangle, `r` of its reverse: f = ab bc ca, r = ac cb
  /// ba.
  void cancel(uint32_t f, uint32_t r) {
    gone_[f / 3] = gone_[r / 3] = true;
    result_.cancelled += 2;
    const uint32_t pairs[3][2] = {{f, previous_in_triangle(r)},
                                  {next_in_triangle(f), next_in_triangle(r)},
                                  {previous_in_triangle(f), r}};
    for (const auto& [p, q] : pairs) {
      across_[p] = q;
      across_[q] = p;
    }
  }

  void glue_survivors() {
    glued_.assign(twins_.size(), kNone);
    for (uint32_t h = 0; h < twins_.size(); ++h) {
      if (gone_[h / 3]) continue;
      uint32_t other = twins_[h];
      while (gone_[other / 3]) other = twins_[across_[other]];
      glued_[h] = other;
    }
  }

  void relabel(uint32_t first, uint32_t label) {
    uint32_t h = first;
    do {
      fan_[h] = label;
      h = turn(h);
    } while (h != first);
  }

  void label_fans() {
    fan_.assign(twins_.size(), kNone);
    for (uint32_t h = 0; h < twins_.size(); ++h) {
      if (!gone_[h / 3] && fan_[h] == kNone) relabel(h, fans_++);
    }
  }

  void cut_double_edges() {
    std::vector<uint32_t> edges;
    for (uint32_t h = 0; h < twins_.size(); ++h) {
      if (!gone_[h / 3]) edges.push_back(h);
    }
    const auto key = [this](uint32_t h) { return std::pair(fan_[h], fan_ahead(h)); };
    std::vector<std::pair<std::pair<uint32_t, uint32_t>, uint32_t>> keyed;
    keyed.reserve(edges.size());
    for (const uint32_t h : edges) keyed.emplace_back(key(h), h);
    std::sort(keyed.begin(), keyed.end());
    for (size_t begin = 0; begin < keyed.size();) {
      size_t end = begin + 1;
      while (end < keyed.size() && keyed[end].first == keyed[begin].first) ++end;
      for (size_t i = begin + 1; i < end; ++i) {
        for (size_t j = begin; j < i; ++j) {
          const uint32_t g = keyed[j].second, h = keyed[i].second;
          if (key(g) == key(h)) cut(g, h);
        }
      }
      begin = end;
    }
  }

  /// Glues two parallel edges g and h crosswise, which splits the fans at both of their ends.
  void cut(uint32_t g, uint32_t h) {
    const uint32_t g_twin = glued_[g], h_twin = glued_[h];
    glued_[g] = h_twin;
    glued_[h_twin] = g;
    glued_[h] = g_twin;
    glued_[g_twin] = h;
    relabel(h, fans_++);
    assert(fan_[g] != fan_[h]);
    relabel(h_twin, fans_++);
    assert(fan_[g_twin] != fan_[h_twin]);
  }

  CollapsedSurface number_vertices() {
    std::vector<uint32_t> old_vertex(fans_, kNone);  // the smallest of each fan
    std::vector<uint32_t> new_triangle(triangles_.size(), kNone);
    for (uint32_t t = 0; t < triangles_.size(); ++t) {
      if (gone_[t]) continue;
      new_triangle[t] = static_cast<uint32_t>(result_.triangles.size());
      result_.triangles.push_back(t);
      for (uint32_t i = 0; i < 3; ++i) {
        uint32_t& vertex = old_vertex[fan_[3 * t + i]];
        vertex = std::min(vertex, triangles_[t][i]);
      }
    }
    std::vector<uint32_t> order(fans_);
    std::iota(order.begin(), order.end(), 0);
    std::sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) {
      return old_vertex[a] != old_vertex[b] ? old_vertex[a] < old_vertex[b] : a < b;
    });
    std::vector<uint32_t> new_vertex(fans_);
    for (const uint32_t fan : order) {
      new_vertex[fan] = static_cast<uint32_t>(result_.origin.size());
      result_.origin.push_back(old_vertex[fan]);
    }
    for (const uint32_t t : result_.triangles) {
      result_.vertices.push_back(
          {new_vertex[fan_[3 * t]], new_vertex[fan_[3 * t + 1]], new_vertex[fan_[3 * t + 2]]});
      for (uint32_t h = 3 * t; h < 3 * t + 3; ++h) {
        result_.twins.push_back(3 * new_triangle[glued_[h] / 3] + glued_[h] % 3);
      }
    }
    return std::move(result_);
  }

  std::span<const Triangle> triangles_;
  std::span<const uint32_t> twins_;
  std::span<const uint32_t> place_;
  std::vector<uint32_t> across_;  // see drop_degenerate
  std::vector<bool> gone_;
  std::vector<uint32_t> glued_;  // twins among the survivors
  std::vector<uint32_t> fan_;    // per surviving half-edge: the fan of its first vertex
  uint32_t fans_ = 0;
  CollapsedSurface result_;
};

}  // namespace

CollapsedSurface collapse(std::span<const Triangle> triangles, std::span<const uint32_t> twins,
                          std::span<const uint32_t> place) {
  return Collapser(triangles, twins, place).run();
}

}  // namespace csgrun
