#include "engine/bsp/flat_cover.h"

#include <algorithm>

#include "engine/base/parallel.h"
#include "engine/bsp/flat_view.h"
#include "engine/bsp/label_order.h"

namespace csgrun {
bool covers(const Job& job, uint32_t q, uint32_t p) {
  const JobPolygon &outer = job.polygons()[q], &inner = job.polygons()[p];
  if (!job.has_grid_vertices(outer.operand) || !job.has_grid_vertices(inner.operand)) return false;
  if (!job.boxes()[q].holds(job.boxes()[p])) return false;
  const auto around = job.corners(outer), corners = job.corners(inner);
  const FlatView flat(job, q);
  const int way = flat.way_round(q);
  for (const uint32_t corner : corners) {
    for (size_t e = 0; e < around.size(); ++e) {
      const uint32_t next = around[e + 1 < around.size() ? e + 1 : 0];
      if (flat.turn(around[e], next, corner) == -way) return false;
    }
  }
  return true;
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
