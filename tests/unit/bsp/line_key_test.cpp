// Keys of lines: equal for equal lines whatever planes they are given by, different for different
// ones.
#include "engine/bsp/line_key.h"

#include <map>
#include <set>

#include <gtest/gtest.h>

#include "tests/support/gmp_bridge.h"
#include "tests/support/seeded.h"

namespace csgrun::line_key_test {
namespace {

/// Pluecker coordinates by GMP, divided by the first that is not zero.
std::array<mpq_class, 6> line_of(const Plane& a, const Plane& b) {
  const mpz_class u[4] = {test::to_gmp(a.a), test::to_gmp(a.b), test::to_gmp(a.c),
                          test::to_gmp(a.d)};
  const mpz_class v[4] = {test::to_gmp(b.a), test::to_gmp(b.b), test::to_gmp(b.c),
                          test::to_gmp(b.d)};
  std::array<mpq_class, 6> line;
  int at = 0;
  mpq_class first = 0;
  for (int j = 1; j < 4; ++j) {
    for (int i = 0; i < j; ++i) {
      line[at] = u[i] * v[j] - u[j] * v[i];
      if (first == 0) first = line[at];
      ++at;
    }
  }
  if (first != 0) {
    for (auto& c : line) c /= first;
  }
  return line;
}

bool parallel(const std::array<mpq_class, 6>& line) {
  return line[0] == 0 && line[1] == 0 && line[2] == 0;
}

TEST(LineKey, IsEqualForEqualLinesOnly) {
  test::Random random(11);
  for (const int bits : {1, 2, 20, 50, 90}) {
    PlaneTable planes;
    const auto number = [&]() -> Int128 {
      const UInt128 v = (static_cast<UInt128>(random.bits()) << 64 | random.bits()) >> (128 - bits);
      return random.bits() & 1 ? -static_cast<Int128>(v) : static_cast<Int128>(v);
    };
    const auto plane = [&] {
      Plane p;
      while (p.a == 0 && p.b == 0 && p.c == 0) p = {number(), number(), number(), number()};
      return p;
    };
    std::vector<LineNamer::PlanePair> pairs;
    const auto add = [&](const Plane& p, const Plane& q) {
      if (!parallel(line_of(p, q)))
        pairs.push_back({planes.intern(p).index(), planes.intern(q).index()});
    };
    for (int i = 0; i < 60; ++i) {
      const Plane p = plane(), q = plane();
      if (parallel(line_of(p, q))) continue;
      add(p, q);
      add(q, p);
      add(p.reversed(), q);
      // Other planes through the line.
      for (int k = 0; k < 3; ++k) {
        const int64_t f = random.integer(1, 5), g = random.integer(-5, 5);
        add({p.a * f + q.a * g, p.b * f + q.b * g, p.c * f + q.c * g, p.d * f + q.d * g}, q);
      }
      // A parallel line in p, and one through the same point, perhaps.
      Plane shifted = q;
      shifted.d += 1;
      add(p, shifted);
      add(p, plane());
    }
    LineNamer namer(planes);
    std::vector<LineKey> together;
    namer.keys(pairs, together);
    ASSERT_EQ(together.size(), pairs.size());
    std::map<std::array<mpq_class, 6>, LineKey> key_of;
    std::set<LineKey> all;
    std::set<uint64_t> halves[2];
    for (size_t i = 0; i < pairs.size(); ++i) {
      const auto line = line_of(planes.plane(pairs[i].p), planes.plane(pairs[i].q));
      const auto [at, is_new] = key_of.emplace(line, together[i]);
      ASSERT_EQ(at->second, together[i]);
      all.insert(together[i]);
      halves[0].insert(together[i].a);
      halves[1].insert(together[i].b);
      // Alone as among others.
      std::vector<LineKey> alone;
      LineNamer(planes).keys({pairs[i]}, alone);
      ASSERT_EQ(alone.at(0), together[i]);
    }
    // Both halves tell lines apart.
    EXPECT_EQ(all.size(), key_of.size());
    EXPECT_EQ(halves[0].size(), key_of.size());
    EXPECT_EQ(halves[1].size(), key_of.size());
    EXPECT_LT(key_of.size(), pairs.size() / 2);
  }
}

}  // namespace
}  // namespace csgrun::line_key_test
