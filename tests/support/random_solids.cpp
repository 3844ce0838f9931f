#include "tests/support/random_solids.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>

#include "engine/mesh/leaf_check.h"
#include "tests/support/prepared_leaf.h"

namespace csgrun::test {

Leaf make_leaf(const std::vector<Loop>& faces, bool keep_facets, uint32_t surface,
               uint32_t appearance) {
  auto leaf = std::make_shared<LeafGeometry>();
  std::map<IVec3, uint32_t> index;
  for (const Loop& face : faces) {
    for (const IVec3& p : face) {
      const auto [at, is_new] = index.emplace(p, static_cast<uint32_t>(leaf->vertices.size()));
      if (is_new) leaf->vertices.push_back(p);
      leaf->corners.push_back(at->second);
    }
    leaf->face_starts.push_back(static_cast<uint32_t>(leaf->corners.size()));
  }
  if (keep_facets) leaf->facet = FaceNumbers::ascending(1);
  leaf->surface = FaceNumbers::all(surface);
  leaf->appearance = FaceNumbers::all(appearance);
  return leaf;
}

std::vector<Loop> loops_of(const LeafGeometry& leaf) {
  std::vector<Loop> loops(leaf.face_count());
  for (size_t f = 0; f < leaf.face_count(); ++f) {
    for (uint32_t c = leaf.face_starts[f]; c < leaf.face_starts[f + 1]; ++c) {
      loops[f].push_back(leaf.vertices[leaf.corners[c]]);
    }
  }
  return loops;
}

std::vector<Loop> box_loops(const IVec3& lo, const IVec3& hi) {
  const auto at = [&](int x, int y, int z) {
    return IVec3{x ? hi[0] : lo[0], y ? hi[1] : lo[1], z ? hi[2] : lo[2]};
  };
  return {{at(0, 0, 0), at(0, 1, 0), at(1, 1, 0), at(1, 0, 0)},
          {at(0, 0, 1), at(1, 0, 1), at(1, 1, 1), at(0, 1, 1)},
          {at(0, 0, 0), at(1, 0, 0), at(1, 0, 1), at(0, 0, 1)},
          {at(0, 1, 0), at(0, 1, 1), at(1, 1, 1), at(1, 1, 0)},
          {at(0, 0, 0), at(0, 0, 1), at(0, 1, 1), at(0, 1, 0)},
          {at(1, 0, 0), at(1, 1, 0), at(1, 1, 1), at(1, 0, 1)}};
}

std::vector<Loop> box_with_middle(const IVec3& lo, const IVec3& hi) {
  std::vector<Loop> loops = box_loops(lo, hi);
  const IVec3 top{lo[0], lo[1], hi[2]}, middle{lo[0], lo[1], (lo[2] + hi[2]) / 2};
  for (Loop& loop : loops) {
    for (size_t i = 0; i < loop.size(); ++i) {
      if (std::minmax(loop[i], loop[(i + 1) % loop.size()]) != std::minmax(lo, top)) continue;
      loop.insert(loop.begin() + static_cast<std::ptrdiff_t>(i) + 1, middle);
      break;
    }
  }
  return loops;
}

std::vector<Loop> with_middles(std::vector<Loop> loops) {
  for (Loop& loop : loops) {
    Loop longer;
    for (size_t c = 0; c < loop.size(); ++c) {
      const IVec3 &a = loop[c], &b = loop[(c + 1) % loop.size()];
      longer.push_back(a);
      longer.push_back({(a[0] + b[0]) / 2, (a[1] + b[1]) / 2, (a[2] + b[2]) / 2});
    }
    loop = std::move(longer);
  }
  return loops;
}

Leaf box_leaf(const IVec3& lo, const IVec3& hi) { return make_leaf(box_loops(lo, hi)); }

std::vector<Loop> mapped(std::vector<Loop> loops, const GridMap& map) {
  // The determinant of a large map needs more than 64 bits.
  const auto& m = map.rows;
  __int128 determinant = 0;
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    determinant +=
        (static_cast<__int128>(m[1][j]) * m[2][k] - static_cast<__int128>(m[1][k]) * m[2][j]) *
        m[0][i];
  }
  const bool mirror = determinant < 0;
  for (Loop& loop : loops) {
    for (IVec3& p : loop) {
      const IVec3 q = p;
      for (int k = 0; k < 3; ++k) p[k] = dot_of(map.rows[k], q) + map.move[k];
    }
    if (mirror) std::reverse(loop.begin(), loop.end());
  }
  return loops;
}

bool on_segment2(const Point2& a, const Point2& b, const Point2& p) {
  return turn2(a, b, p) == 0 && std::min(a[0], b[0]) <= p[0] && p[0] <= std::max(a[0], b[0]) &&
         std::min(a[1], b[1]) <= p[1] && p[1] <= std::max(a[1], b[1]);
}

bool segments_meet2(const Point2& a, const Point2& b, const Point2& c, const Point2& d) {
  const auto sign = [](int64_t v) { return (v > 0) - (v < 0); };
  if (sign(turn2(a, b, c)) * sign(turn2(a, b, d)) < 0 &&
      sign(turn2(c, d, a)) * sign(turn2(c, d, b)) < 0) {
    return true;
  }
  return on_segment2(a, b, c) || on_segment2(a, b, d) || on_segment2(c, d, a) ||
         on_segment2(c, d, b);
}

bool is_simple(const std::vector<Point2>& p) {
  const size_t n = p.size();
  for (size_t i = 0; i < n; ++i) {
    const Point2 &a = p[i], &b = p[(i + 1) % n];
    if (on_segment2(a, b, p[(i + 2) % n])) return false;
    if (on_segment2(b, p[(i + 2) % n], a)) return false;
    for (size_t j = i + 2; j < n; ++j) {
      if (i == 0 && j == n - 1) continue;
      if (segments_meet2(a, b, p[j], p[(j + 1) % n])) return false;
    }
  }
  return true;
}

std::vector<Point2> random_polygon(Random& random, int64_t size) {
  for (;;) {
    const auto n = static_cast<size_t>(random.integer(3, 8));
    std::set<Point2> chosen;
    while (chosen.size() < n) chosen.insert({random.integer(0, size), random.integer(0, size)});
    std::vector<Point2> p(chosen.begin(), chosen.end());
    for (int attempt = 0; attempt < 60; ++attempt) {
      for (size_t i = n - 1; i > 0; --i)
        std::swap(p[i], p[static_cast<size_t>(random.integer(0, static_cast<int64_t>(i)))]);
      if (!is_simple(p)) continue;
      int64_t area = 0;
      for (size_t i = 0; i < n; ++i) area += turn2({0, 0}, p[i], p[(i + 1) % n]);
      if (area == 0) continue;
      if (area < 0) std::reverse(p.begin(), p.end());
      return p;
    }
  }
}

std::vector<std::array<Point2, 3>> triangles_of(std::vector<Point2> p) {
  std::vector<std::array<Point2, 3>> triangles;
  while (p.size() >= 3) {
    const size_t n = p.size();
    for (size_t i = 0; i < n; ++i) {
      const Point2 &a = p[(i + n - 1) % n], &b = p[i], &c = p[(i + 1) % n];
      if (turn2(a, b, c) <= 0) continue;
      const bool free = std::none_of(p.begin(), p.end(), [&](const Point2& q) {
        return q != a && q != b && q != c && turn2(a, b, q) >= 0 && turn2(b, c, q) >= 0 &&
               turn2(c, a, q) >= 0;
      });
      if (!free) continue;
      triangles.push_back({a, b, c});
      p.erase(p.begin() + static_cast<std::ptrdiff_t>(i));
      break;
    }
    if (p.size() == n) break;  // not simple: cannot be
    if (p.size() == 2) break;
  }
  return triangles;
}

std::vector<Loop> prism_loops(const std::vector<Point2>& base, int64_t z0, int64_t z1) {
  std::vector<Loop> loops;
  for (const auto& t : triangles_of(base)) {
    loops.push_back({{t[0][0], t[0][1], z1}, {t[1][0], t[1][1], z1}, {t[2][0], t[2][1], z1}});
    loops.push_back({{t[2][0], t[2][1], z0}, {t[1][0], t[1][1], z0}, {t[0][0], t[0][1], z0}});
  }
  for (size_t i = 0; i < base.size(); ++i) {
    const Point2 &a = base[i], &b = base[(i + 1) % base.size()];
    loops.push_back({{a[0], a[1], z0}, {b[0], b[1], z0}, {b[0], b[1], z1}, {a[0], a[1], z1}});
  }
  return loops;
}

std::vector<Loop> cone_loops(const std::vector<Point2>& base, int64_t z, const IVec3& apex,
                             const std::optional<IVec3>& below) {
  std::vector<Loop> loops;
  for (size_t i = 0; i < base.size(); ++i) {
    const Point2 &a = base[i], &b = base[(i + 1) % base.size()];
    loops.push_back({{a[0], a[1], z}, {b[0], b[1], z}, apex});
    if (below) loops.push_back({{b[0], b[1], z}, {a[0], a[1], z}, *below});
  }
  if (!below) {
    for (const auto& t : triangles_of(base)) {
      loops.push_back({{t[2][0], t[2][1], z}, {t[1][0], t[1][1], z}, {t[0][0], t[0][1], z}});
    }
  }
  return loops;
}

std::vector<Loop> hull_loops(const std::vector<IVec3>& points) {
  std::set<std::pair<IVec3, int64_t>> planes;
  std::vector<Loop> loops;
  for (const IVec3& a : points) {
    for (const IVec3& b : points) {
      for (const IVec3& c : points) {
        IVec3 n = cross_of(sub(b, a), sub(c, a));
        const int64_t divisor = std::gcd(std::gcd(n[0], n[1]), n[2]);
        if (divisor == 0) continue;
        for (auto& x : n) x /= divisor;
        const int64_t d = dot_of(n, a);
        if (std::any_of(points.begin(), points.end(),
                        [&](const IVec3& p) { return dot_of(n, p) > d; })) {
          continue;
        }
        if (!planes.emplace(n, d).second) continue;
        // The corners: from the lowest, always the next with everything on its left.
        std::vector<IVec3> on;
        for (const IVec3& p : points) {
          if (dot_of(n, p) == d) on.push_back(p);
        }
        Loop loop;
        IVec3 at = *std::min_element(on.begin(), on.end());
        do {
          loop.push_back(at);
          IVec3 next = at;
          for (const IVec3& p : on) {
            if (p == at) continue;
            const int64_t t = next == at ? -1 : dot_of(n, cross_of(sub(next, at), sub(p, at)));
            const bool farther =
                t == 0 && dot_of(sub(p, at), sub(p, at)) > dot_of(sub(next, at), sub(next, at));
            if (t < 0 || farther) next = p;
          }
          at = next;
        } while (at != loop.front());
        loops.push_back(loop);
      }
    }
  }
  return planes.size() < 4 ? std::vector<Loop>() : loops;
}

int64_t six_volumes(const std::vector<Loop>& loops) {
  int64_t six = 0;
  for (const Loop& l : loops) {
    for (size_t i = 1; i + 1 < l.size(); ++i) six += dot_of(l[0], cross_of(l[i], l[i + 1]));
  }
  return six;
}

void turn_over(std::vector<Loop>& loops) {
  for (Loop& l : loops) std::reverse(l.begin(), l.end());
}

std::vector<Loop> complex_loops(Random& random, int64_t size) {
  constexpr int64_t kCells = 3;
  std::array<std::array<int64_t, kCells + 1>, 3> lines{};
  for (auto& l : lines) {
    std::set<int64_t> chosen;
    while (chosen.size() < kCells + 1) chosen.insert(random.integer(0, size));
    std::copy(chosen.begin(), chosen.end(), l.begin());
  }
  const int64_t percent = random.integer(10, 70);
  const bool whole_cells = random.integer(0, 2) == 0;
  // Triangles by their sorted corners; those met twice are inner.
  std::map<std::array<IVec3, 3>, Loop> open;
  const auto toggle = [&](const Loop& t) {
    std::array<IVec3, 3> key{t[0], t[1], t[2]};
    std::sort(key.begin(), key.end());
    if (!open.erase(key)) open.emplace(key, t);
  };
  constexpr int kOrders[6][3] = {{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}};
  for (int64_t cell = 0; cell < kCells * kCells * kCells; ++cell) {
    const IVec3 lo{cell % kCells, cell / kCells % kCells, cell / (kCells * kCells)};
    const bool all = random.integer(0, 99) < percent;
    for (const auto& order : kOrders) {
      if (whole_cells ? !all : random.integer(0, 99) >= percent) continue;
      // Kuhn's subdivision: from the lowest corner to the highest along the axes in some order.
      std::array<IVec3, 4> p;
      IVec3 at = lo;
      for (int k = 0; k < 4; ++k) {
        p[k] = {lines[0][at[0]], lines[1][at[1]], lines[2][at[2]]};
        if (k < 3) ++at[order[k]];
      }
      if (dot_of(sub(p[1], p[0]), cross_of(sub(p[2], p[0]), sub(p[3], p[0]))) < 0)
        std::swap(p[2], p[3]);
      toggle({p[0], p[2], p[1]});
      toggle({p[0], p[1], p[3]});
      toggle({p[1], p[2], p[3]});
      toggle({p[2], p[0], p[3]});
    }
  }
  std::vector<Loop> loops;
  for (const auto& [key, t] : open) loops.push_back(t);
  return loops;
}

std::vector<Loop> random_loops(Random& random, int64_t size) {
  const auto point = [&] {
    return IVec3{random.integer(0, size), random.integer(0, size), random.integer(0, size)};
  };
  std::vector<Loop> loops;
  while (loops.empty()) {
    switch (random.integer(0, 7)) {
      case 0: {
        const IVec3 a = point(), b = point();
        if (a[0] != b[0] && a[1] != b[1] && a[2] != b[2]) {
          IVec3 lo, hi;
          for (int k = 0; k < 3; ++k) lo[k] = std::min(a[k], b[k]), hi[k] = std::max(a[k], b[k]);
          loops = box_loops(lo, hi);
        }
        break;
      }
      case 1:
        loops = hull_loops({point(), point(), point(), point()});
        break;
      case 2:
      case 3: {
        const int64_t z0 = random.integer(0, size - 1);
        loops = prism_loops(random_polygon(random, size), z0, random.integer(z0 + 1, size));
        break;
      }
      case 4: {
        std::vector<IVec3> points;
        for (int64_t n = random.integer(5, 9); n > 0; --n) points.push_back(point());
        loops = hull_loops(points);
        break;
      }
      case 5: {
        const int64_t z = random.integer(0, size - 1);
        IVec3 apex = point();
        apex[2] = random.integer(z + 1, size);
        loops = cone_loops(random_polygon(random, size), z, apex, std::nullopt);
        break;
      }
      case 6: {
        const int64_t z = random.integer(1, size - 1);
        IVec3 apex = point(), below = point();
        apex[2] = random.integer(z + 1, size);
        below[2] = random.integer(0, z - 1);
        loops = cone_loops(random_polygon(random, size), z, apex, below);
        break;
      }
      default:
        loops = complex_loops(random, size);
        break;
    }
  }
  // One of the 48 symmetries of the cube.
  GridMap map;
  std::array<int, 3> axes{0, 1, 2};
  for (int i = 2; i > 0; --i) std::swap(axes[i], axes[random.integer(0, i)]);
  for (int k = 0; k < 3; ++k) {
    const bool reflect = random.bits() & 1;
    map.rows[k] = {0, 0, 0};
    map.rows[k][axes[k]] = reflect ? -1 : 1;
    map.move[k] = reflect ? size : 0;
  }
  return mapped(std::move(loops), map);
}

std::vector<Loop> tent_loops(Random& random, int64_t size) {
  const int64_t x = random.integer(1, size), y = random.integer(1, size);
  const std::vector<IVec3> corners =
      random.integer(0, 1) == 0 ? std::vector<IVec3>{{0, 0, 0}, {x, 0, 0}, {0, y, 0}}
                                : std::vector<IVec3>{{0, 0, 0}, {x, 0, 0}, {x, y, 0}, {0, y, 0}};
  Loop base;
  for (size_t i = 0; i < corners.size(); ++i) {
    const IVec3 &from = corners[i], to = corners[(i + 1) % corners.size()];
    base.push_back(from);
    const int64_t steps = std::gcd(to[0] - from[0], to[1] - from[1]);
    for (int64_t k = 1; k < steps; ++k) {
      if (random.integer(0, 1) == 0) continue;
      base.push_back(
          {from[0] + k * (to[0] - from[0]) / steps, from[1] + k * (to[1] - from[1]) / steps, 0});
    }
  }
  const auto count = static_cast<int64_t>(base.size());
  std::rotate(base.begin(), base.begin() + random.integer(0, count - 1), base.end());
  const auto tip = [&] {
    return IVec3{random.integer(0, size), random.integer(0, size), random.integer(1, size)};
  };
  const IVec3 first = tip(), second = tip();
  const int64_t with_first = random.integer(1, count - 1);
  std::vector<Loop> loops{{base.rbegin(), base.rend()}};
  for (int64_t i = 0; i < count; ++i) {
    loops.push_back({base[i], base[(i + 1) % count], i < with_first ? first : second});
  }
  if (first != second) {
    loops.push_back({base[with_first], second, first});
    loops.push_back({base[0], first, second});
  }
  for (const Loop& l : loops) {
    const IVec3 normal = cross_of(sub(l[1], l[0]), sub(l[2], l[0]));
    if (l.size() == 3 && normal == IVec3{0, 0, 0}) return {};
  }
  return find_self_intersections(*make_leaf(loops)).empty() ? loops : std::vector<Loop>();
}

Leaf random_leaf(Random& random) {
  std::vector<Loop> loops;
  if (random.integer(0, 7) == 0) loops = tent_loops(random, 5);
  if (loops.empty()) loops = random_loops(random);
  const bool keep_facets = random.integer(0, 3) == 0;
  const auto surface = static_cast<uint32_t>(random.integer(0, 4) == 0);
  const Leaf leaf =
      make_leaf(loops, keep_facets, surface, static_cast<uint32_t>(random.integer(0, 1)));
  return random.integer(0, 1) == 0 ? leaf : as_prepared(leaf);
}

GridMap random_map(Random& random, int bits) {
  GridMap map;
  const int64_t bound = (int64_t{1} << bits) - 1;
  do {
    for (auto& row : map.rows) {
      for (auto& v : row) v = random.integer(-bound, bound);
    }
    // In doubles: the products overflow for large maps, and nearly singular is as bad.
    const auto& m = map.rows;
    const double det =
        static_cast<double>(m[0][0]) *
            (static_cast<double>(m[1][1]) * m[2][2] - static_cast<double>(m[1][2]) * m[2][1]) -
        static_cast<double>(m[0][1]) *
            (static_cast<double>(m[1][0]) * m[2][2] - static_cast<double>(m[1][2]) * m[2][0]) +
        static_cast<double>(m[0][2]) *
            (static_cast<double>(m[1][0]) * m[2][1] - static_cast<double>(m[1][1]) * m[2][0]);
    const double size = static_cast<double>(bound);
    if (std::fabs(det) > 0.01 * size * size * size) {
      if (det < 0) std::swap(map.rows[0], map.rows[1]);
      return map;
    }
  } while (true);
}

}  // namespace csgrun::test
