#include "engine/bsp/flat_pair.h"

#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>

#include "engine/exact/fixed_int.h"

namespace csgrun {
namespace {

/// A triangle by its vertices, and its way round as it is seen: +1 is counter-clockwise.
struct Seen {
  std::array<uint32_t, 3> vertices;
  int way = 0;
};

/// The plane of a triangle, seen along an axis that does not lie in it.
class Flat {
 public:
  Flat(const Job& job, uint32_t triangle) : job_(job) {
    for (; x_ < 3; ++x_) {
      y_ = x_ < 2 ? x_ + 1 : 0;
      if (see(triangle).way != 0) break;
    }
    assert(x_ < 3);  // it has an area
  }

  /// A triangle of the plane.
  [[nodiscard]] Seen see(uint32_t triangle) const {
    const auto corners = job_.corners(job_.polygons()[triangle]);
    return {{corners[0], corners[1], corners[2]}, turn(corners[0], corners[1], corners[2])};
  }
  /// +1 when c is seen on the left of the way from a to b. Differences of coordinates have 41 bits
  /// at most (widths::kFarGrid): doubles hold them. Their products, of 82, are rounded by a part of
  /// 2^-53 each, and so is the difference of these, unless they are small.
  [[nodiscard]] int turn(uint32_t a, uint32_t b, uint32_t c) const {
    const auto &at = job_.rounded(a), &to = job_.rounded(b), &of = job_.rounded(c);
    const double ux = to[x_] - at[x_], uy = to[y_] - at[y_], vx = of[x_] - at[x_],
                 vy = of[y_] - at[y_];
    const double left = ux * vy, right = uy * vx, det = left - right;
    const double size = std::fabs(left) + std::fabs(right);
    if (size < 0x1p53 || std::fabs(det) > 0x1p-51 * size) return (det > 0) - (det < 0);
    const auto whole = [](double v) { return static_cast<Int128>(static_cast<int64_t>(v)); };
    const Int128 exact = whole(ux) * whole(vy) - whole(uy) * whole(vx);
    return exact > 0 ? 1 : exact < 0 ? -1 : 0;
  }
  [[nodiscard]] bool are_equal(uint32_t v, uint32_t w) const {
    return job_.rounded(v) == job_.rounded(w);
  }

 private:
  const Job& job_;
  size_t x_ = 0, y_ = 1;
};

/// What the lines of a triangle's edges tell of another one: nothing, if it is on the outer side of
/// none. `corner`: the corners in common, of `own` first.
FlatMeeting across_edges(const Flat& flat, const Seen& own, const Seen& other,
                         std::array<uint32_t, 2>& corner) {
  FlatMeeting best = FlatMeeting::kOther;
  for (size_t e = 0; e < 3; ++e) {
    const uint32_t a = own.vertices[e], b = own.vertices[(e + 1) % 3];
    size_t on_line = 0;
    uint32_t touching = kNone;
    bool is_outer = true;
    for (size_t i = 0; i < 3 && is_outer; ++i) {
      const int side = flat.turn(a, b, other.vertices[i]) * own.way;
      is_outer = side <= 0;
      if (side == 0) ++on_line, touching = other.vertices[i];
    }
    if (!is_outer) continue;
    if (on_line == 0) return FlatMeeting::kApart;
    if (on_line > 1) continue;
    for (const uint32_t v : {a, b}) {
      if (!flat.are_equal(v, touching)) continue;
      best = FlatMeeting::kCorner;
      corner = {v, touching};
    }
  }
  return best;
}

}  // namespace

FlatPair flat_pair(const Job& job, uint32_t p, uint32_t q) {
  const Flat flat(job, p);
  const Seen of_p = flat.see(p), of_q = flat.see(q);
  std::array<uint32_t, 2> corner{kNone, kNone};
  FlatMeeting meeting = across_edges(flat, of_p, of_q, corner);
  if (meeting != FlatMeeting::kOther) return {meeting, corner[0], corner[1]};
  meeting = across_edges(flat, of_q, of_p, corner);
  return {meeting, corner[1], corner[0]};
}

}  // namespace csgrun
