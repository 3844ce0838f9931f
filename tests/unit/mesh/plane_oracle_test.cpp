// Points of a plane, in order and turning, against exact numbers; with and without their numbers to
// tell the order.
#include "engine/mesh/plane_oracle.h"

#include <algorithm>
#include <array>
#include <random>
#include <vector>

#include <gmpxx.h>
#include <gtest/gtest.h>

namespace csgrun::plane_oracle_test {
namespace {

using Exact = std::array<mpq_class, 3>;

mpz_class whole(Int128 v) {
  const bool is_negative = v < 0;
  const UInt128 m = is_negative ? -static_cast<UInt128>(v) : static_cast<UInt128>(v);
  mpz_class r = static_cast<unsigned long>(m >> 64);
  r = (r << 64) + static_cast<unsigned long>(m & ~uint64_t{0});
  return is_negative ? mpz_class(-r) : r;
}

/// Where three planes meet, by Cramer's rule; false if they do not meet in one point.
bool meet(const std::array<Plane, 3>& p, Exact& at) {
  std::array<std::array<mpz_class, 4>, 3> m;
  for (size_t i = 0; i < 3; ++i)
    m[i] = {whole(p[i].a), whole(p[i].b), whole(p[i].c), -whole(p[i].d)};
  const auto determinant = [&](size_t a, size_t b, size_t c) {
    return mpz_class(m[0][a] * (m[1][b] * m[2][c] - m[1][c] * m[2][b]) -
                     m[0][b] * (m[1][a] * m[2][c] - m[1][c] * m[2][a]) +
                     m[0][c] * (m[1][a] * m[2][b] - m[1][b] * m[2][a]));
  };
  const mpz_class w = determinant(0, 1, 2);
  if (w == 0) return false;
  const mpz_class n[3] = {determinant(3, 1, 2), determinant(0, 3, 2), determinant(0, 1, 3)};
  for (size_t k = 0; k < 3; ++k) {
    at[k] = mpq_class(n[k], w);
    at[k].canonicalize();
  }
  return true;
}

/// Points of one plane in lexicographic order, many with coordinates in common.
struct Points {
  PlaneTable planes;
  PlaneId support;
  std::vector<Exact> exact;
  CellGeometry geometry{planes, nullptr};
};

void make(const Plane& support, std::mt19937& random, Points& points) {
  points.support = points.planes.intern(support);
  struct Named {
    Exact at;
    std::array<uint32_t, 3> planes;
  };
  std::vector<Named> all;
  const auto few = [&](int n) { return static_cast<int64_t>(random() % (2 * n + 1)) - n; };
  while (all.size() < 40) {
    const std::array<Plane, 3> p{
        support, Plane{few(1), few(2), few(1), few(4) * (random() % 2 ? 1 : 1000003)},
        Plane{few(2), few(1), few(1), few(4)}};
    Named n;
    if (!meet(p, n.at)) continue;
    for (size_t k = 0; k < 3; ++k) n.planes[k] = points.planes.intern(p[k]).index();
    if (std::none_of(all.begin(), all.end(), [&](const Named& o) { return o.at == n.at; })) {
      all.push_back(n);
    }
  }
  std::sort(all.begin(), all.end(), [](const Named& a, const Named& b) { return a.at < b.at; });
  for (const Named& n : all) {
    points.geometry.add_point(n.planes);
    points.exact.push_back(n.at);
  }
}

TEST(PlaneOracle, OrderAndTurnsAreExact) {
  std::mt19937 random(3);
  size_t in_line = 0, level = 0;
  for (const Plane& support :
       {Plane{0, 0, 1, -5}, Plane{0, 0, -1, 0}, Plane{1, 2, 3, 4}, Plane{1, -2, -7, 4},
        Plane{3, 1, 1, 0}, Plane{0, -5, 2, 1}, Plane{1, 0, 0, 7}, Plane{2, 2, 2, 1}}) {
    Points points;
    make(support, random, points);
    PointView view(points.geometry);
    const auto count = static_cast<uint32_t>(points.exact.size());
    const mpz_class normal[3] = {whole(support.a), whole(support.b), whole(support.c)};
    int axis = 0;
    for (int k = 1; k < 3; ++k) {
      if (abs(normal[k]) > abs(normal[axis])) axis = k;
    }
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    for (const size_t in_order : {size_t{0}, size_t{count / 2}, size_t{count}}) {
      // That of the plane that faces outwards.
      PlaneOracle oracle(view, points.planes, points.support, in_order);
      for (uint32_t a = 0; a < count; ++a) {
        for (uint32_t b = 0; b < count; ++b) {
          const Exact &p = points.exact[a], &q = points.exact[b];
          const int by_u = cmp(p[u], q[u]), by_v = cmp(p[v], q[v]);
          const int expected = by_u != 0 ? by_u : by_v;
          ASSERT_EQ(oracle.compare(a, b), (expected > 0) - (expected < 0));
          level += a != b && by_u == 0;
          for (uint32_t c = 0; c < count; c += 3) {
            const Exact& r = points.exact[c];
            const mpq_class turn = (q[u] - p[u]) * (r[v] - p[v]) - (q[v] - p[v]) * (r[u] - p[u]);
            ASSERT_EQ(oracle.orient(a, b, c), sgn(turn) * (normal[axis] > 0 ? 1 : -1));
            in_line += a != b && b != c && a != c && sgn(turn) == 0;
          }
        }
      }
    }
  }
  EXPECT_GT(in_line, 500u);
  EXPECT_GT(level, 300u);
}

}  // namespace
}  // namespace csgrun::plane_oracle_test
