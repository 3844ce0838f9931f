#include "engine/csg/minkowski.h"

#include <algorithm>
#include <cstdlib>
#include <memory>
#include <utility>

#include "engine/csg/convex_hull.h"
#include "engine/csg/grid.h"
#include "engine/csg/outward_sums.h"

namespace csgrun {
namespace {

/// So many points are kept at most before their hull is taken.
constexpr size_t kMostWaiting = size_t{1} << 20;
constexpr double kMostSums = 0x1p26;

IVec3 sum(const IVec3& a, const IVec3& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }

/// The extreme points of all sums; none when they lie in one plane.
std::vector<IVec3> hull_of_sums(const std::vector<IVec3>& a, const std::vector<IVec3>& b) {
  std::vector<IVec3> waiting;
  for (const IVec3& p : a) {
    for (const IVec3& q : b) waiting.push_back(sum(p, q));
    if (waiting.size() < kMostWaiting) continue;
    // What is flat so far stays as it is: it may become a body.
    std::vector<IVec3> extreme = convex_hull(waiting).vertices;
    if (!extreme.empty()) waiting = std::move(extreme);
  }
  return convex_hull(waiting).vertices;
}

std::vector<IVec3> corners(const GridSolid& solid, const GridSolid::Patch& patch) {
  std::vector<IVec3> result;
  for (const uint32_t v : patch.corners) result.push_back(solid.points[v]);
  return result;
}

class Sums {
 public:
  explicit Sums(const GridStep& step) : step_(step) {}

  void add(const Summand& a, const Summand& b) {
    if (a.is_convex && b.is_convex) {
      add_hull(a.solid.points, b.solid.points);
    } else if (b.is_convex) {
      add_convex(a, b);
    } else if (a.is_convex) {
      add_convex(b, a);
    } else {
      for (const uint32_t anchor : b.solid.anchors) add_moved(a, b.solid.points[anchor]);
      for (const uint32_t anchor : a.solid.anchors) add_moved(b, a.solid.points[anchor]);
      for (const auto& f : a.solid.patches) {
        const std::vector<IVec3> face = corners(a.solid, f);
        for (const auto& g : b.solid.patches) add_hull(face, corners(b.solid, g));
      }
    }
  }
  std::vector<Summand> take() { return std::move(result_); }

 private:
  void add_hull(const std::vector<IVec3>& a, const std::vector<IVec3>& b) {
    add_body(hull_of_sums(a, b));
  }

  void add_body(std::vector<IVec3> points) {
    if (points.empty()) return;
    Summand summand;
    summand.solid.points = std::move(points);
    summand.is_convex = true;
    result_.push_back(std::move(summand));
  }

  void add_convex(const Summand& a, const Summand& convex) {
    OutwardSums outward;
    if (outward_sums(a.solid, convex.solid.points, outward)) {
      add_moved(a, outward.centre);
      for (const std::vector<IVec3>& body : outward.bodies) {
        add_body(convex_hull(body).vertices);
      }
      return;
    }
    add_moved(a, convex.solid.points[0]);
    for (const auto& f : a.solid.patches) add_hull(corners(a.solid, f), convex.solid.points);
  }

  void add_moved(const Summand& a, const IVec3& by) {
    Summand moved = a;
    for (IVec3& p : moved.solid.points) p = sum(p, by);
    const glm::dvec3 mm = to_millimetres({by}, step_)[0];
    Affine map;
    for (int i = 0; i < 3; ++i) map.m[i][3] = mm[i];
    moved.node = Node::transformed(map, a.node, a.node->where());
    result_.push_back(std::move(moved));
  }

  const GridStep& step_;
  std::vector<Summand> result_;
};

/// How many points are summed for a pair, roughly.
double count_sums(const Summand& a, const Summand& b) {
  const auto points = [](const Summand& s) {
    size_t count = s.solid.points.size();
    if (s.is_convex) return static_cast<double>(count);
    count = 0;
    for (const auto& patch : s.solid.patches) count += patch.corners.size();
    return static_cast<double>(count);
  };
  return points(a) * points(b);
}

/// The largest coordinate.
int64_t reach(const std::vector<Summand>& summands) {
  int64_t result = 0;
  for (const Summand& summand : summands) {
    for (const IVec3& p : summand.solid.points) {
      for (const int64_t x : p) result = std::max(result, std::abs(x));
    }
  }
  return result;
}

}  // namespace

Result<std::vector<Summand>> minkowski_sum(const std::vector<Summand>& a,
                                           const std::vector<Summand>& b, const GridStep& step) {
  double count = 0;
  for (const Summand& x : a) {
    for (const Summand& y : b) count += count_sums(x, y);
  }
  if (count > kMostSums) {
    return Error{ErrorCode::kLimit,
                 "minkowski: the operands have too many faces, more than 2^26 pairs of corners "
                 "would be summed; sum rounder shapes with fewer facets",
                 {}};
  }
  // The hulls of sums are taken in widths that allow for no more (wide_cross.h).
  if (reach(a) + reach(b) > kFarLimit) {
    return Error{ErrorCode::kOutOfRange, "reaches too far from the origin for the grid", {}};
  }
  Sums sums(step);
  for (const Summand& x : a) {
    for (const Summand& y : b) sums.add(x, y);
  }
  return sums.take();
}

}  // namespace csgrun
