#include "engine/bsp/flat_cover.h"

#include <algorithm>

#include "engine/base/parallel.h"
#include "engine/bsp/label_order.h"
#include "engine/exact/fixed_int.h"

namespace csgrun {
namespace {

/// Corners as seen along an axis. Coordinates are below 2^41, so that products fit 128 bits.
class SeenAlong {
 public:
  SeenAlong(const Job& job, size_t axis) : job_(job), i_((axis + 1) % 3), j_((axis + 2) % 3) {}

  /// The sign of the turn from a to b to c.
  [[nodiscard]] int turn(uint32_t a, uint32_t b, uint32_t c) const {
    const Int128 turn = from(a, b, i_) * from(a, c, j_) - from(a, b, j_) * from(a, c, i_);
    return (turn > 0) - (turn < 0);
  }

 private:
  [[nodiscard]] Int128 from(uint32_t a, uint32_t b, size_t k) const {
    return static_cast<int64_t>(job_.rounded(b)[k]) - static_cast<int64_t>(job_.rounded(a)[k]);
  }

  const Job& job_;
  const size_t i_, j_;
};

/// Which way a convex polygon turns, seen along an axis; 0: it is seen from the side.
int way_round(std::span<const uint32_t> corners, const SeenAlong& seen) {
  for (size_t c = 2; c < corners.size(); ++c) {
    if (const int turn = seen.turn(corners[0], corners[c - 1], corners[c])) return turn;
  }
  return 0;
}

}  // namespace

bool covers(const Job& job, uint32_t q, uint32_t p) {
  const JobPolygon &outer = job.polygons()[q], &inner = job.polygons()[p];
  if (!job.has_grid_vertices(outer.operand) || !job.has_grid_vertices(inner.operand)) return false;
  if (!job.boxes()[q].holds(job.boxes()[p])) return false;
  const auto around = job.corners(outer), corners = job.corners(inner);
  for (size_t axis = 0; axis < 3; ++axis) {
    const SeenAlong seen(job, axis);
    const int way = way_round(around, seen);
    if (way == 0) continue;
    for (const uint32_t corner : corners) {
      for (size_t e = 0; e < around.size(); ++e) {
        const uint32_t next = around[e + 1 < around.size() ? e + 1 : 0];
        if (seen.turn(around[e], next, corner) == -way) return false;
      }
    }
    return true;
  }
  return false;
}

void mark_flat_covered(const Job& job, const Expression& expression, const ContactTable& contacts,
                       std::vector<uint8_t>& is_covered) {
  const auto& all = contacts.all();
  if (std::none_of(all.begin(), all.end(), [](const Contact& c) { return c.is_coplanar; })) return;
  const LabelOrder order(expression, job.operand_count());
  const auto lies_on = [&](uint32_t p, const Contact& c) {
    if (!c.is_coplanar) return false;
    const uint32_t q = c.p == p ? c.q : c.p;
    return order.yields(job.polygons()[p].operand, job.polygons()[q].operand) && covers(job, q, p);
  };
  for_each_range(is_covered.size(), [&](size_t begin, size_t end) {
    for (auto p = static_cast<uint32_t>(begin); p < end; ++p) {
      const auto own = contacts.of(p);
      is_covered[p] |= is_covered[p] == 0 && std::any_of(own.begin(), own.end(), [&](uint32_t i) {
                         return lies_on(p, contacts[i]);
                       });
    }
  });
}

}  // namespace csgrun
