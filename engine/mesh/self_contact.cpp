#include "engine/mesh/self_contact.h"

#include <algorithm>
#include <array>

namespace csgrun {
namespace {

/// A convex face of so few corners cannot touch itself, and no other face of so few can either.
constexpr size_t kTooFew = 5;

class Breaker {
 public:
  explicit Breaker(CellGeometry& geometry) : geometry_(geometry) {}

  void run(MergedFace& face) {
    corners_.clear();
    for (const auto& loop : face.loops) {
      for (const DirectedEdge& e : loop) corners_.push_back(e.from);
    }
    if (corners_.size() < kTooFew) return;
    // Along the axis on which the face is longest.
    axis_ = longest_axis();
    std::sort(corners_.begin(), corners_.end(), [&](uint32_t p, uint32_t q) {
      return at(p, axis_) < at(q, axis_) || (at(p, axis_) == at(q, axis_) && p < q);
    });
    corners_.erase(std::unique(corners_.begin(), corners_.end()), corners_.end());
    for (auto& loop : face.loops) break_loop(loop);
  }

 private:
  [[nodiscard]] double at(uint32_t p, int axis) const { return geometry_.point(p).rounded[axis]; }

  [[nodiscard]] int longest_axis() const {
    std::array<double, 3> lo = geometry_.point(corners_[0]).rounded, hi = lo;
    for (const uint32_t c : corners_) {
      for (int k = 0; k < 3; ++k)
        lo[k] = std::min(lo[k], at(c, k)), hi[k] = std::max(hi[k], at(c, k));
    }
    int axis = 0;
    for (int k = 1; k < 3; ++k) {
      if (hi[k] - lo[k] > hi[axis] - lo[axis]) axis = k;
    }
    return axis;
  }

  void break_loop(FaceLoop& loop) {
    broken_.clear();
    for (const DirectedEdge& e : loop) {
      inside_.clear();
      const double lo = std::min(at(e.from, axis_), at(e.to, axis_));
      const double hi = std::max(at(e.from, axis_), at(e.to, axis_));
      auto c = std::lower_bound(corners_.begin(), corners_.end(), lo,
                                [&](uint32_t p, double v) { return at(p, axis_) < v; });
      for (; c != corners_.end() && at(*c, axis_) <= hi; ++c) {
        if (lies_inside(geometry_, e, *c)) inside_.push_back(*c);
      }
      append_broken(geometry_, e, inside_, broken_);
    }
    if (broken_.size() != loop.size()) loop = broken_;
  }

  CellGeometry& geometry_;
  int axis_ = 0;
  std::vector<uint32_t> corners_, inside_;
  std::vector<DirectedEdge> broken_;
};

}  // namespace

bool lies_inside(CellGeometry& geometry, const DirectedEdge& e, uint32_t p) {
  const auto at = [&](uint32_t x, int axis) { return geometry.point(x).rounded[axis]; };
  if (p == e.from || p == e.to) return false;
  for (int k = 0; k < 3; ++k) {
    if (at(p, k) < std::min(at(e.from, k), at(e.to, k))) return false;
    if (at(p, k) > std::max(at(e.from, k), at(e.to, k))) return false;
  }
  if (geometry.side(e.plane, p) != 0) return false;
  // On the line: rounding is monotone, so only a tie with an end needs the exact order.
  for (int k = 0; k < 3; ++k) {
    const int from = geometry.compare_along(p, e.from, k), to = geometry.compare_along(p, e.to, k);
    if (from * to > 0) return false;
    if (from * to < 0) return true;
  }
  return false;
}

void append_broken(CellGeometry& geometry, DirectedEdge edge, std::vector<uint32_t>& inside,
                   std::vector<DirectedEdge>& broken) {
  int axis = 0, along = 0;
  while (inside.size() > 1 && along == 0) {
    along = geometry.compare_along(edge.to, edge.from, axis++);
  }
  std::sort(inside.begin(), inside.end(), [&](uint32_t p, uint32_t q) {
    return geometry.compare_along(p, q, axis - 1) * along < 0;
  });
  for (const uint32_t p : inside) {
    broken.push_back({edge.from, p, edge.plane});
    edge.from = p;
  }
  broken.push_back(edge);
}

void break_at_own_corners(std::vector<MergedFace>& faces, std::span<const uint32_t> which,
                          CellGeometry& geometry) {
  Breaker breaker(geometry);
  for (const uint32_t f : which) breaker.run(faces[f]);
}

}  // namespace csgrun
