#include "primitives/solids/edge_reach.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "primitives/base/box3_tree.h"
#include "primitives/base/text.h"

namespace csgrun {
namespace {

/// The usual reach is about this part of the setback.
constexpr double kReach = 1e-3;
/// And it is this many mm times a power of two, 200 nm = 25 * 2^3 nm: so it is on every grid that
/// the model's decimals are on, also where the scene is large and steps are 2^3 nm and more, up to
/// 10^-4 mm. (On coarser ones it is rounded, which moves no edge of the cut.)
constexpr double kReachUnit = 2e-4;
/// Grid steps by which corners of bodies may be off, with those of the solid, and more.
constexpr double kLeastSteps = 8;
/// The setback is so many times the reach at least: what is made of it is small beside the cut.
constexpr double kLeastSetback = 32;
/// Bodies at corners reach so much farther than those along edges.
constexpr double kFarthest = 4;

struct HalfSpace {
  glm::dvec3 outwards{0};  ///< of length 1
  double at = 0;
  [[nodiscard]] double height(const glm::dvec3& p) const { return glm::dot(outwards, p) - at; }
};

HalfSpace half_space(const glm::dvec3& outwards, const glm::dvec3& point) {
  const glm::dvec3 n = glm::normalize(outwards);
  return {n, glm::dot(n, point)};
}

double usual_reach(double setback) {
  double reach = kReachUnit;
  while (reach < kReach * setback) reach *= 2;
  return reach;
}

/// A convex body around an edge with its surroundings.
struct Probe {
  std::vector<HalfSpace> body;     ///< all that is behind each of these
  std::vector<HalfSpace> surface;  ///< of the solid, around the edge: what is in front is not its
  Box3 box;
  double margin = 0;  ///< that far out it touches only
};

class Surroundings {
 public:
  Surroundings(const Solid& solid, const EdgeFrames& frames, const EdgeEnds& ends)
      : solid_(solid), frames_(frames), ends_(ends), tree_(near_triangles()) {
    for (const EdgeGraph::Edge& e : frames.graph().edges()) {
      for (const uint32_t v : e.vertex) {
        for (const uint32_t side : e.side) sides_at_.emplace_back(v, side);
      }
    }
    std::sort(sides_at_.begin(), sides_at_.end());
  }

  /// Whether what bodies along an edge take has material in front of the solid's planes there.
  [[nodiscard]] bool are_filled(const EdgeFrame& f) const {
    const auto probe = probe_of(f);
    if (!probe) return false;
    bool is_filled = false;
    tree_.find(probe->box, [&](uint32_t i) {
      is_filled = !is_beside(f, triangles_[i]) && meets(*probe, triangles_[i]);
      return !is_filled;
    });
    return is_filled;
  }

 private:
  std::vector<Box3> near_triangles() {
    Box3 all;
    for (const EdgeFrame& f : frames_.frames()) {
      if (const auto probe = probe_of(f)) all.add(probe->box);
    }
    std::vector<Box3> boxes;
    for (uint32_t t = 0; t < solid_.triangles.size(); ++t) {
      Box3 box;
      for (const uint32_t v : solid_.triangles[t]) box.add(solid_.positions[v]);
      if (!box.meets(all)) continue;
      triangles_.push_back(t);
      boxes.push_back(box);
    }
    return boxes;
  }

  /// The prism along an edge, larger than any body there. Null where there can be none: making that
  /// fails.
  [[nodiscard]] std::optional<Probe> probe_of(const EdgeFrame& edge) const {
    EdgeFrame f = edge;
    f.is_flush = false;
    f.reach *= kFarthest;
    const EdgeEnds::Lines lines = EdgeEnds::lines(f);
    std::array<std::array<glm::dvec3, 3>, 2> corners;
    Probe probe;
    probe.margin = edge.reach / 4;
    for (int end = 0; end < 2; ++end) {
      const auto found = ends_.end_of(f, end);
      if (!found) return std::nullopt;
      for (size_t k = 0; k < 3; ++k) {
        corners[end][k] = f.start + lines[k] + found->at[k] * f.along;
        probe.box.add(corners[end][k]);
      }
    }
    const auto add = [&](const glm::dvec3& normal, const glm::dvec3& on, const glm::dvec3& inside) {
      if (glm::length(normal) == 0) return;
      const HalfSpace h = half_space(normal, on);
      probe.body.push_back(h.height(inside) <= 0 ? h : half_space(-normal, on));
    };
    for (size_t k = 0; k < 3; ++k) {
      const glm::dvec3 &a = lines[k], &b = lines[(k + 1) % 3], &c = lines[(k + 2) % 3];
      add(glm::cross(f.along, b - a), f.start + a, f.start + c);
    }
    for (int end = 0; end < 2; ++end) {
      const auto &here = corners[end], &there = corners[1 - end];
      add(glm::cross(here[1] - here[0], here[2] - here[0]), here[0],
          (there[0] + there[1] + there[2]) / 3.0);
    }
    const SolidEdge& line = frames_.graph().edges()[f.edge].line;
    for (const glm::dvec3& n : line.normals) probe.surface.push_back(half_space(n, f.start));
    for (int end = 0; end < 2; ++end) {
      for (int side = 0; side < 2; ++side) {
        const EdgeEnd kind = frames_.kind(f, end, side);
        if (kind != EdgeEnd::kCap && kind != EdgeEnd::kMitre) continue;
        probe.surface.push_back(
            half_space(frames_.plane_normal(f, end, side), end == 0 ? line.from : line.to));
      }
    }
    return probe;
  }

  /// Whether a triangle is of a side that the edge's ends have: these are the solid's own there.
  [[nodiscard]] bool is_beside(const EdgeFrame& f, uint32_t triangle) const {
    const uint32_t side = frames_.graph().side_of(triangle);
    for (const uint32_t v : frames_.graph().edges()[f.edge].vertex) {
      if (std::binary_search(sides_at_.begin(), sides_at_.end(), std::pair(v, side))) return true;
    }
    return false;
  }

  [[nodiscard]] bool meets(const Probe& probe, uint32_t triangle) const {
    polygon_.clear();
    for (const uint32_t v : solid_.triangles[triangle]) polygon_.push_back(solid_.positions[v]);
    for (const HalfSpace& h : probe.body) clip(h, -1, probe.margin);
    const std::vector<glm::dvec3> inside = polygon_;
    for (const HalfSpace& h : probe.surface) {
      polygon_ = inside;
      clip(h, 1, probe.margin);
      if (!polygon_.empty()) return true;
    }
    return false;
  }

  /// Keeps what is farther than the margin behind (-1) or in front of (1) a plane.
  void clip(const HalfSpace& h, double sign, double margin) const {
    const auto height = [&](const glm::dvec3& p) { return sign * h.height(p) - margin; };
    rest_.clear();
    for (size_t i = 0; i < polygon_.size(); ++i) {
      const glm::dvec3 &p = polygon_[i], &q = polygon_[i + 1 < polygon_.size() ? i + 1 : 0];
      const double at_p = height(p), at_q = height(q);
      if (at_p >= 0) rest_.push_back(p);
      if ((at_p < 0) != (at_q < 0)) rest_.push_back(p + at_p / (at_p - at_q) * (q - p));
    }
    polygon_.swap(rest_);
  }

  const Solid& solid_;
  const EdgeFrames& frames_;
  const EdgeEnds& ends_;
  std::vector<uint32_t> triangles_;
  const Box3Tree tree_;
  std::vector<std::pair<uint32_t, uint32_t>> sides_at_;  ///< vertex and side
  mutable std::vector<glm::dvec3> polygon_, rest_;
};

}  // namespace

std::optional<Error> choose_reaches(const Solid& solid, EdgeFrames& frames, const EdgeEnds& ends,
                                    double grid_step_mm) {
  const double least = kLeastSteps * grid_step_mm;
  for (size_t i = 0; i < frames.frames().size(); ++i) {
    frames.set_reach(i, std::max(usual_reach(frames.frames()[i].setback), least), false);
  }
  const Surroundings surroundings(solid, frames, ends);
  for (size_t i = 0; i < frames.frames().size(); ++i) {
    const EdgeFrame& f = frames.frames()[i];
    const SolidEdge& line = frames.graph().edges()[f.edge].line;
    const bool is_small = f.setback < kLeastSetback * least;
    if (!is_small && !surroundings.are_filled(f)) continue;
    if (ends.can_be_flush(f)) {
      frames.set_reach(i, f.reach, true);
      continue;
    }
    if (is_small) {
      return invalid_argument(fmt::format(
          "that is too little for {}: it must be {:.4g} mm beside it at least, at {} grid steps of "
          "{:.4g} mm",
          edge_text(line), kLeastSetback * least, kLeastSetback * kLeastSteps, grid_step_mm));
    }
    double reach = f.reach;
    do {
      reach /= kFarthest;
      frames.set_reach(i, reach, false);
    } while (reach >= least && surroundings.are_filled(f));
    if (reach >= least) continue;
    return invalid_argument(
        fmt::format("the solid touches {} elsewhere, or nearly so: such an edge can be cut only "
                    "where all sides around it lie along the axes, so before it is turned",
                    edge_text(line)));
  }
  return std::nullopt;
}

}  // namespace csgrun
