#include "engine/mesh/improve_triangles.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <functional>
#include <utility>

#include "engine/base/sort_few.h"

namespace csgrun {
namespace {

constexpr uint32_t kNoTwin = ~0u;
/// By how much the cotangents of two opposite angles must add up to less than zero, relative to
/// their sizes. Points that are meant to be on one circle are not quite, and without a margin that
/// noise would cause a quadratic number of flips.
constexpr double kMargin = 1.0 / 64;
/// A ring between two circles of 1000 corners each takes 11, other faces hardly ever more than 2.
/// Such rings are the known bad case: there the number grows with that of corners.
constexpr size_t kFlipsPerTriangle = 16;
/// Of so many corners or triangles, all pairs are looked at sooner than sorted.
constexpr size_t kFewCorners = 12;

using Triangle = std::array<uint32_t, 3>;

/// Each from its lowest point on, and by their points.
void sort_canonically(std::vector<Triangle>& triangles) {
  for (Triangle& t : triangles) {
    const uint32_t second_is_less = t[1] < t[0] ? 1 : 0;
    const uint32_t lowest = t[2] < t[second_is_less] ? 2 : second_is_less;
    t = {t[lowest], t[lowest == 2 ? 0 : lowest + 1], t[lowest == 0 ? 2 : lowest - 1]};
  }
  sort_few(triangles.begin(), triangles.end(), [](const Triangle& a, const Triangle& b) {
    const uint64_t of_a = together(a[0], a[1]), of_b = together(b[0], b[1]);
    return of_a != of_b ? of_a < of_b : a[2] < b[2];
  });
}

bool are_distinct(std::span<const uint32_t> corners) {
  for (size_t i = 1; i < corners.size(); ++i) {
    for (size_t j = 0; j < i; ++j) {
      if (corners[i] == corners[j]) return false;
    }
  }
  return true;
}

/// Two sides of a triangle, from one corner.
struct Sides {
  double px, py, pz, qx, qy, qz;

  using Place = std::array<double, 3>;
  Sides(const Place& o, const Place& p, const Place& q)
      : px(p[0] - o[0]),
        py(p[1] - o[1]),
        pz(p[2] - o[2]),
        qx(q[0] - o[0]),
        qy(q[1] - o[1]),
        qz(q[2] - o[2]) {}
  [[nodiscard]] double dot() const { return px * qx + py * qy + pz * qz; }
  [[nodiscard]] double cross() const {
    const double x = py * qz - pz * qy, y = pz * qx - px * qz, z = px * qy - py * qx;
    return std::sqrt(x * x + y * y + z * z);
  }
};

/// Whether the angles opposite to a diagonal add up to clearly more than 180 degrees: then those
/// opposite to the other diagonal add up to less. Cotangents, multiplied by both sines.
bool clearly_obtuse(const Sides& at_c, const Sides& at_d) {
  const double dot_c = at_c.dot(), dot_d = at_d.dot();
  if (dot_c >= 0 && dot_d >= 0) return false;  // both are acute, or right
  const double cross_c = at_c.cross(), cross_d = at_d.cross();
  const double left = dot_c * cross_d, right = dot_d * cross_c;
  return left + right < -kMargin * (std::fabs(left) + std::fabs(right) + cross_c * cross_d);
}

/// Whether the diagonal a b of the quadrilateral a d b c is to be replaced by d c.
bool is_worse(uint32_t a, uint32_t b, uint32_t c, uint32_t d, const PlanarOracle& oracle,
              const RoundedPosition& position) {
  const std::array<double, 3>&at_a = position(a), &at_b = position(b);
  return clearly_obtuse(Sides(position(c), at_a, at_b), Sides(position(d), at_a, at_b)) &&
         oracle.orient(a, d, c) > 0 && oracle.orient(d, b, c) > 0;
}

/// Kept from one face to the next: most are small.
struct Memory {
  struct HalfEdge {
    uint64_t edge;
    uint32_t number;
    bool operator<(const HalfEdge& other) const {
      return edge != other.edge ? edge < other.edge : number < other.number;
    }
  };
  std::vector<uint64_t> slits;  ///< edges, sorted
  std::vector<uint32_t> twin;   ///< per half-edge; kNoTwin on the boundary
  std::vector<uint8_t> queued;  ///< per half-edge
  std::vector<uint32_t> queue;  ///< half-edges to look at, those before the current one are done
  std::vector<uint64_t> loop_edges;  ///< while slits are looked for
  std::vector<HalfEdge> edges;       ///< while twins are
};

/// Half-edge h = 4 t + k runs from corner k < 3 of triangle t to the next one.
class Flipper {
 public:
  Flipper(std::span<const std::vector<uint32_t>> loops, const PlanarOracle& oracle,
          const RoundedPosition& position, std::vector<Triangle>& triangles, Memory& memory)
      : oracle_(oracle), position_(position), triangles_(triangles), memory_(memory) {
    find_slits(loops);
    pair_diagonals();
  }

  /// Whether anything was flipped.
  bool run() {
    bool any = false;
    size_t left = kFlipsPerTriangle * triangles_.size();
    for (size_t next = 0; next < queue_.size() && left > 0; ++next) {
      const uint32_t h = queue_[next];
      queued_[h] = false;
      if (twin_[h] == kNoTwin || !flip_if_better(h)) continue;
      any = true;
      --left;
    }
    return any;
  }

 private:
  static uint32_t next(uint32_t h) { return h % 4 == 2 ? h - 2 : h + 1; }
  uint32_t& origin(uint32_t h) { return triangles_[h / 4][h % 4]; }

  /// Edges of the loops that occur in both directions: both sides have triangles, which are not
  /// neighbours there.
  void find_slits(std::span<const std::vector<uint32_t>> loops) {
    slits_.clear();
    if (loops.size() == 1 && loops[0].size() <= kFewCorners && are_distinct(loops[0])) return;
    std::vector<uint64_t>& edges = memory_.loop_edges;
    edges.clear();
    for (const auto& loop : loops) {
      for (size_t i = 0; i < loop.size(); ++i) {
        edges.push_back(ends_together(loop[i], loop[i + 1 < loop.size() ? i + 1 : 0]));
      }
    }
    std::sort(edges.begin(), edges.end());
    for (size_t i = 1; i < edges.size(); ++i) {
      if (edges[i] == edges[i - 1]) slits_.push_back(edges[i]);
    }
  }

  /// Finds the twins of half-edges and queues all diagonals in the order of their points.
  void pair_diagonals() {
    std::vector<Memory::HalfEdge>& edges = memory_.edges;
    edges.clear();
    queue_.clear();
    twin_.assign(4 * triangles_.size(), kNoTwin);
    queued_.assign(4 * triangles_.size(), false);
    if (triangles_.size() <= kFewCorners && slits_.empty()) return pair_few();
    for (uint32_t t = 0; t < triangles_.size(); ++t) {
      for (uint32_t h = 4 * t; h < 4 * t + 3; ++h) {
        edges.push_back({ends_together(origin(h), origin(next(h))), h});
      }
    }
    std::sort(edges.begin(), edges.end());
    for (size_t i = 1; i < edges.size(); ++i) {
      const auto [edge, h] = edges[i - 1];
      if (edges[i].edge != edge) continue;
      if (std::binary_search(slits_.begin(), slits_.end(), edge)) continue;
      link(h, edges[i].number);
      enqueue(h);
    }
  }

  /// The same for a few: each half-edge is held against those of later triangles.
  void pair_few() {
    const size_t count = triangles_.size();
    // The ends of half-edges, as they run.
    std::array<std::array<uint64_t, 3>, kFewCorners> ends;
    for (size_t t = 0; t < count; ++t) {
      const auto [a, b, c] = triangles_[t];
      ends[t] = {together(a, b), together(b, c), together(c, a)};
    }
    std::vector<Memory::HalfEdge>& diagonals = memory_.edges;
    for (uint32_t t = 0; t + 1 < count; ++t) {
      for (uint32_t k = 0; k < 3; ++k) {
        const uint32_t h = 4 * t + k;
        if (twin_[h] != kNoTwin) continue;  // of a triangle before
        const uint64_t reverse = std::rotl(ends[t][k], 32);
        for (uint32_t u = t + 1; u < count; ++u) {
          for (uint32_t l = 0; l < 3; ++l) {
            if (ends[u][l] != reverse) continue;
            link(h, 4 * u + l);
            diagonals.push_back({std::min(ends[t][k], reverse), h});
          }
        }
      }
    }
    sort_few(diagonals.begin(), diagonals.end(), std::less<>());
    for (const Memory::HalfEdge& diagonal : diagonals) enqueue(diagonal.number);
  }

  void link(uint32_t h, uint32_t twin) {
    twin_[h] = twin;
    if (twin != kNoTwin) twin_[twin] = h;
  }

  void enqueue(uint32_t h) {
    if (twin_[h] == kNoTwin || queued_[h] || queued_[twin_[h]]) return;
    queued_[h] = true;
    queue_.push_back(h);
  }

  /// Replaces diagonal a b of the quadrilateral a d b c by d c.
  bool flip_if_better(uint32_t h) {
    const uint32_t h1 = next(h), h2 = next(h1);
    const uint32_t g = twin_[h], g1 = next(g), g2 = next(g1);
    const uint32_t a = origin(h), b = origin(h1), c = origin(h2), d = origin(g2);
    if (!is_worse(a, b, c, d, oracle_, position_)) return false;
    origin(h1) = d;  // the first triangle is a d c now
    origin(g1) = c;  // and the second one b c d
    link(h, twin_[g1]);
    link(g, twin_[h1]);
    link(h1, g1);
    for (const uint32_t side : {h, h2, g, g2}) enqueue(side);
    return true;
  }

  const PlanarOracle& oracle_;
  const RoundedPosition& position_;
  std::vector<Triangle>& triangles_;
  Memory& memory_;
  std::vector<uint64_t>& slits_ = memory_.slits;
  std::vector<uint32_t>& twin_ = memory_.twin;
  std::vector<uint8_t>& queued_ = memory_.queued;
  std::vector<uint32_t>& queue_ = memory_.queue;
};

/// What Flipper does with two triangles of one loop, which are most: they have one edge in common.
void improve_two(const PlanarOracle& oracle, const RoundedPosition& position,
                 std::vector<Triangle>& triangles) {
  Triangle &s = triangles[0], &t = triangles[1];
  for (size_t i = 0; i < 3; ++i) {
    for (size_t k = 0; k < 3; ++k) {
      const uint32_t a = s[i], b = s[(i + 1) % 3], c = s[(i + 2) % 3], d = t[(k + 2) % 3];
      if (t[k] != b || t[(k + 1) % 3] != a) continue;
      if (!is_worse(a, b, c, d, oracle, position)) return;
      s = {a, d, c};
      t = {b, c, d};
      return sort_canonically(triangles);
    }
  }
}

}  // namespace

void improve_triangles(std::span<const std::vector<uint32_t>> loops, const PlanarOracle& oracle,
                       const RoundedPosition& position,
                       std::vector<std::array<uint32_t, 3>>& triangles) {
  sort_canonically(triangles);
  if (triangles.size() < 2) return;
  if (triangles.size() == 2 && loops.size() == 1 && are_distinct(loops[0])) {
    return improve_two(oracle, position, triangles);
  }
  thread_local Memory memory;
  if (Flipper(loops, oracle, position, triangles, memory).run()) sort_canonically(triangles);
}

}  // namespace csgrun
