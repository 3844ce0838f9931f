#include "engine/bsp/cell_walls.h"

namespace csgrun {

CellWalls walls_of(Job& job, const CellBox& box) {
  CellWalls w{};
  for (int k = 0; k < 3; ++k) {
    w[2 * k] = job.wall(k, box.lo[k]);
    w[2 * k + 1] = job.wall(k, box.hi[k]);
  }
  return w;
}

bool clip_to_cell(CellGeometry& geometry, const Job& job, const CellBox& box,
                  const CellWalls& walls, Fragment& f) {
  const PolygonBox& b = job.boxes()[f.polygon];
  for (int k = 0; k < 3; ++k) {
    for (int upper = 0; upper < 2; ++upper) {
      if (upper ? b.hi[k] <= box.hi[k] : b.lo[k] > box.lo[k]) continue;
      Fragment front, back;
      switch (geometry.split(f, walls[2 * k + upper], front, back)) {
        case Side::kFront:
          if (upper) return false;
          break;
        case Side::kBack:
          if (!upper) return false;
          break;
        case Side::kSplit:
          f = upper ? back : front;
          break;
        case Side::kOn:
          return false;  // unreachable: no leaf vertex lies in a wall
      }
    }
  }
  return true;
}

}  // namespace csgrun
