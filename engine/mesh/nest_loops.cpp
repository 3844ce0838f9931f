#include "engine/mesh/nest_loops.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <span>

#include "engine/mesh/face_location.h"

namespace csgrun {
namespace {

using EdgeLoop = std::vector<DirectedEdge>;

class Nester {
 public:
  Nester(PlaneId support, PointView& points, const PlaneTable& planes)
      : support_(support), points_(points), planes_(planes), locator_(support, points, planes) {}

  /// Seen from outside: an outer loop turns left at its lowest corner, a hole right. A loop that
  /// touches itself there passes it several times: a hole turns left between two of its lobes, but
  /// not each time.
  [[nodiscard]] bool is_outer(const EdgeLoop& loop) const {
    if (const int turn = clear_turn(loop)) return turn > 0;
    uint32_t low = loop[0].from;
    for (const DirectedEdge& e : loop) {
      if (before(e.from, low)) low = e.from;
    }
    for (size_t i = 0; i < loop.size(); ++i) {
      const DirectedEdge& in = loop[(i + loop.size() - 1) % loop.size()];
      if (loop[i].from == low && turn_between(points_, planes_, support_, in, loop[i]) < 0) {
        return false;
      }
    }
    return true;
  }

  /// Whether `hole` lies inside `outer`. Loops of one region do not cross.
  bool contains(const EdgeLoop& outer, const EdgeLoop& hole) {
    for (const DirectedEdge& e : hole) {
      const int where = locator_.locate(std::span(&outer, 1), e.from);
      if (where != 0) return where > 0;
    }
    return false;
  }

  [[nodiscard]] bool before(uint32_t p, uint32_t q) const { return locator_.before(p, q); }

  struct Box {
    double lo[2] = {HUGE_VAL, HUGE_VAL}, hi[2] = {-HUGE_VAL, -HUGE_VAL};
    [[nodiscard]] bool holds(const Box& o) const {
      return lo[0] <= o.lo[0] && lo[1] <= o.lo[1] && hi[0] >= o.hi[0] && hi[1] >= o.hi[1];
    }
  };
  [[nodiscard]] Box box(const EdgeLoop& loop) const {
    const auto axes = locator_.axes();
    Box b;
    for (const DirectedEdge& e : loop) {
      const auto& p = points_.rounded(e.from);
      for (int k = 0; k < 2; ++k) {
        b.lo[k] = std::min(b.lo[k], p[axes[k]]), b.hi[k] = std::max(b.hi[k], p[axes[k]]);
      }
    }
    return b;
  }

 private:
  /// Whether a loop clearly goes around on the left (+1) or on the right (-1), by its area.
  [[nodiscard]] int clear_turn(const EdgeLoop& loop) const {
    const auto [u, v] = locator_.axes();
    const auto& origin = points_.rounded(loop[0].from);
    double area = 0, size = 0, largest = 0, extent = 0;
    for (const DirectedEdge& e : loop) {
      const auto &p = points_.rounded(e.from), &q = points_.rounded(e.to);
      const double pu = p[u] - origin[u], pv = p[v] - origin[v];
      const double qu = q[u] - origin[u], qv = q[v] - origin[v];
      area += pu * qv - pv * qu;
      size += std::fabs(pu * qv) + std::fabs(pv * qu);
      largest = std::max({largest, std::fabs(p[u]), std::fabs(p[v])});
      extent = std::max({extent, std::fabs(pu), std::fabs(pv)});
    }
    // With n corners, coordinates up to M and differences up to D: products are off by less than
    // 4 u M D + 4 u |product| each (PlaneOracle), and 2 n additions by 2 n u times their sizes.
    const auto n = static_cast<double>(loop.size());
    const double bound = 0x1p-49 * n * (largest * extent + size);
    if (std::fabs(area) <= bound) return 0;
    const Plane normal = planes_.oriented(support_);
    const int w = 3 - u - v;
    const Int128 along = w == 0 ? normal.a : w == 1 ? normal.b : normal.c;
    return (area > 0) == (along > 0) ? 1 : -1;
  }

  PlaneId support_;
  PointView& points_;
  const PlaneTable& planes_;
  FaceLocator locator_;
};

}  // namespace

std::vector<std::vector<EdgeLoop>> nest_loops(PlaneId support, const RegionLoops& loops,
                                              PointView& points, const PlaneTable& planes) {
  std::vector<std::vector<EdgeLoop>> faces;
  std::vector<EdgeLoop> holes;
  Nester nester(support, points, planes);
  for (size_t l = 0; l < loops.loop_count(); ++l) {
    EdgeLoop loop(loops.edges.begin() + loops.starts[l], loops.edges.begin() + loops.starts[l + 1]);
    if (loops.loop_count() == 1 || nester.is_outer(loop)) {
      faces.push_back({std::move(loop)});
    } else {
      holes.push_back(std::move(loop));
    }
  }
  if (holes.empty()) return faces;
  struct Outer {
    uint32_t lowest;  ///< corner
    Nester::Box box;
    size_t face;
  };
  std::vector<Outer> outers;
  for (size_t f = 0; f < faces.size(); ++f) {
    const EdgeLoop& loop = faces[f][0];
    const auto lowest = std::min_element(
        loop.begin(), loop.end(),
        [&](const auto& a, const auto& b) { return nester.before(a.from, b.from); });
    outers.push_back({lowest->from, nester.box(loop), f});
  }
  // Of several outer loops around a hole the innermost has the highest lowest corner: it comes
  // first.
  std::stable_sort(outers.begin(), outers.end(), [&](const Outer& a, const Outer& b) {
    return nester.before(b.lowest, a.lowest);
  });
  std::vector<size_t> around;  // faces whose outer loops may go around a hole
  for (EdgeLoop& hole : holes) {
    const Nester::Box box = nester.box(hole);
    around.clear();
    for (const Outer& outer : outers) {
      if (outer.box.holds(box)) around.push_back(outer.face);
    }
    // Each hole is in some face: if only one has it in its box, there is nothing to ask.
    const auto innermost = around.size() == 1
                               ? around.begin()
                               : std::find_if(around.begin(), around.end(), [&](size_t f) {
                                   return nester.contains(faces[f][0], hole);
                                 });
    assert(innermost != around.end());
    faces[*innermost].push_back(std::move(hole));
  }
  return faces;
}

}  // namespace csgrun
