#include "engine/bsp/flat_pair.h"

#include <array>
#include <cstddef>

#include "engine/bsp/flat_view.h"

namespace csgrun {
namespace {

/// A triangle by its vertices, and its way round as it is seen: +1 is counter-clockwise.
struct Seen {
  std::array<uint32_t, 3> vertices;
  int way = 0;
};

Seen see(const Job& job, const FlatView& flat, uint32_t triangle) {
  const auto corners = job.corners(job.polygons()[triangle]);
  return {{corners[0], corners[1], corners[2]}, flat.way_round(triangle)};
}

/// What the lines of a triangle's edges tell of another one: nothing, if it is on the outer side of
/// none. `corner`: the corners in common, of `own` first.
FlatMeeting across_edges(const Job& job, const FlatView& flat, const Seen& own, const Seen& other,
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
      if (job.rounded(v) != job.rounded(touching)) continue;
      best = FlatMeeting::kCorner;
      corner = {v, touching};
    }
  }
  return best;
}

}  // namespace

FlatPair flat_pair(const Job& job, uint32_t p, uint32_t q) {
  const FlatView flat(job, p);
  const Seen of_p = see(job, flat, p), of_q = see(job, flat, q);
  std::array<uint32_t, 2> corner{kNone, kNone};
  FlatMeeting meeting = across_edges(job, flat, of_p, of_q, corner);
  if (meeting != FlatMeeting::kOther) return {meeting, corner[0], corner[1]};
  meeting = across_edges(job, flat, of_q, of_p, corner);
  return {meeting, corner[1], corner[0]};
}

}  // namespace csgrun
