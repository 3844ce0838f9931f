#include "primitives/files/dxf_loops.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <optional>

#include <csgrun/primitives/trig.h>

namespace csgrun {
namespace {

constexpr double kSteps = 1024;
constexpr double kFarthest = 1e12;  // beyond, doubles have no such steps

/// The ends of open chains that are not part of a line yet. Those in one place stay in order.
class FreeEnds {
 public:
  explicit FreeEnds(std::vector<Chain>& chains) : chains_(chains), used_(chains.size(), true) {}

  void add(size_t chain) {
    used_[chain] = false;
    for (const glm::dvec2& end : {chains_[chain].points.front(), chains_[chain].points.back()})
      ends_[DxfGrid::key(end)].push_back(chain);
  }
  [[nodiscard]] bool is_used(size_t chain) const { return used_[chain]; }

  /// The first chain that ends in p, turned so that it begins there; it is used then.
  std::optional<Shape2D::Loop> take(const glm::dvec2& p) {
    const std::vector<size_t>& here = at(p);
    if (here.empty()) return std::nullopt;
    const size_t chain = here.front();
    Shape2D::Loop points = take(chain);
    if (DxfGrid::key(points.front()) != DxfGrid::key(p)) std::reverse(points.begin(), points.end());
    return points;
  }
  Shape2D::Loop take(size_t chain) {
    used_[chain] = true;
    alone_.erase(chain);
    Shape2D::Loop points = std::move(chains_[chain].points);
    for (const glm::dvec2& end : {points.front(), points.back()}) {
      std::vector<size_t>& here = ends_[DxfGrid::key(end)];
      here.erase(std::find(here.begin(), here.end(), chain));
      if (here.size() == 1) alone_.insert(here.front());
    }
    return points;
  }

  /// Notes chains of which an end is the only one in its place.
  void look_for_lone_ends() {
    for (const auto& [key, here] : ends_) {
      if (here.size() == 1) alone_.insert(here.front());
    }
  }
  /// The first of them, turned so that it begins there; it is used then.
  std::optional<Shape2D::Loop> take_with_lone_end() {
    if (alone_.empty()) return std::nullopt;
    const size_t chain = *alone_.begin();
    const bool begins_there = at(chains_[chain].points.front()).size() == 1;
    Shape2D::Loop points = take(chain);
    if (!begins_there) std::reverse(points.begin(), points.end());
    return points;
  }

 private:
  const std::vector<size_t>& at(const glm::dvec2& p) const {
    static const std::vector<size_t> kNone;
    const auto here = ends_.find(DxfGrid::key(p));
    return here != ends_.end() ? here->second : kNone;
  }
  std::vector<Chain>& chains_;
  std::vector<bool> used_;
  std::map<DxfGrid::Key, std::vector<size_t>> ends_;
  std::set<size_t> alone_;
};

class ChainJoiner {
 public:
  explicit ChainJoiner(OpenLines& open) : open_(open) {}

  std::vector<Shape2D::Loop> join(std::vector<Chain>& chains, bool as_openscad) {
    FreeEnds ends(chains);
    for (size_t i = 0; i < chains.size(); ++i) {
      if (chains[i].closed || is_closed(chains[i].points)) {
        loops_.push_back(std::move(chains[i].points));
      } else {
        ends.add(i);
      }
    }
    if (as_openscad) {
      join_as_openscad(chains, ends);
    } else {
      join_from_first(chains, ends);
    }
    return std::move(loops_);
  }

 private:
  static bool is_closed(const Shape2D::Loop& line) {
    return DxfGrid::key(line.front()) == DxfGrid::key(line.back());
  }

  static void append(const Shape2D::Loop& more, Shape2D::Loop& line) {
    line.insert(line.end(), more.begin() + 1, more.end());
  }

  /// Open ones are joined end to end, from the first on.
  void join_from_first(const std::vector<Chain>& chains, FreeEnds& ends) {
    for (size_t i = 0; i < chains.size(); ++i) {
      if (ends.is_used(i)) continue;
      Shape2D::Loop line = ends.take(i);
      // Both ways, so that it does not matter where in an open line the first chain lies.
      for (int side = 0; side < 2; ++side) {
        while (!is_closed(line)) {
          const auto more = ends.take(line.back());
          if (!more) break;
          append(*more, line);
        }
        std::reverse(line.begin(), line.end());
      }
      add_line(std::move(line));
    }
  }

  /// Where more than two chains meet, OpenSCAD's order decides: first lines from ends that no other
  /// chain has, then the rest from the first on; each goes on for as long as there is a chain, also
  /// beyond its own start. It takes the latter for closed, and drops the first point of those that
  /// are not, of the way round in which it puts them unless there are lines of the former kind.
  void join_as_openscad(const std::vector<Chain>& chains, FreeEnds& ends) {
    const auto walk = [&](Shape2D::Loop line) {
      while (const auto more = ends.take(line.back())) append(*more, line);
      return line;
    };
    ends.look_for_lone_ends();
    bool has_open_lines = false;
    while (auto line = ends.take_with_lone_end()) {
      has_open_lines = true;
      add_line(walk(*std::move(line)));
    }
    for (size_t i = 0; i < chains.size(); ++i) {
      if (ends.is_used(i)) continue;
      Shape2D::Loop line = walk(ends.take(i));
      const bool closed = is_closed(line);
      if (!closed && !has_open_lines && is_turned_by_openscad(line))
        std::reverse(line.begin(), line.end());
      add_line(std::move(line));
      if (!closed) loops_.back().erase(loops_.back().begin());
    }
  }

  /// By the directions to the neighbours of the first of its leftmost points.
  static bool is_turned_by_openscad(const Shape2D::Loop& line) {
    const auto left_of = [](const glm::dvec2& a, const glm::dvec2& b) { return a.x < b.x; };
    const auto b =
        static_cast<size_t>(std::min_element(line.begin(), line.end(), left_of) - line.begin());
    const glm::dvec2 before = line[b == 0 ? line.size() - 2 : b - 1] - line[b];
    const glm::dvec2 after = line[b + 1 == line.size() ? 1 : b + 1] - line[b];
    return atan2_deg(before.x, before.y) < atan2_deg(after.x, after.y);
  }

  void add_line(Shape2D::Loop line) {
    if (is_closed(line)) {
      line.pop_back();
    } else if (open_.count++ == 0) {
      open_.first = line.front();
    }
    loops_.push_back(std::move(line));
  }

  OpenLines& open_;
  std::vector<Shape2D::Loop> loops_;
};

}  // namespace

DxfGrid::Key DxfGrid::key(const glm::dvec2& p) {
  constexpr double kMost = 9e15;
  return {std::llround(std::clamp(p.x * kSteps, -kMost, kMost)),
          std::llround(std::clamp(p.y * kSteps, -kMost, kMost))};
}

glm::dvec2 DxfGrid::aligned(const glm::dvec2& p) {
  if (!(std::max(std::fabs(p.x), std::fabs(p.y)) < kFarthest)) return p;
  Key place = key(p);
  if (taken_.count(place) == 0) {
    Key best = place;
    int64_t least = 3;  // one step in each direction is two
    for (int64_t x = place.first - 1; x <= place.first + 1; ++x) {
      for (int64_t y = place.second - 1; y <= place.second + 1; ++y) {
        const int64_t steps = std::abs(x - place.first) + std::abs(y - place.second);
        if (steps >= least || taken_.count({x, y}) == 0) continue;
        least = steps;
        best = {x, y};
      }
    }
    place = best;
    taken_.insert(place);
  }
  return {static_cast<double>(place.first) / kSteps, static_cast<double>(place.second) / kSteps};
}

std::vector<Shape2D::Loop> join_to_loops(std::vector<Chain>& chains, bool as_openscad,
                                         OpenLines& open) {
  return ChainJoiner(open).join(chains, as_openscad);
}

}  // namespace csgrun
