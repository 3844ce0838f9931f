// The table of planes: one number for each plane, whatever scale and side it was given in.
#include <cmath>
#include <numeric>
#include <set>

#include <gtest/gtest.h>

#include "engine/exact/forced_tier.h"
#include "engine/exact/predicates.h"
#include "tests/support/gmp_bridge.h"
#include "tests/support/seeded.h"

namespace csgrun::plane_test {
namespace {

using test::to_gmp;

TEST(BitWidth, OfEveryPowerOfTwoAndItsNeighbours) {
  EXPECT_EQ(bit_width(0), 0);
  for (int k = 0; k < 126; ++k) {
    const Int128 power = Int128{1} << k;
    for (const Int128 sign : {Int128{1}, Int128{-1}}) {
      EXPECT_EQ(bit_width(sign * power), k + 1);
      EXPECT_EQ(bit_width(sign * (power - 1)), k);
      EXPECT_EQ(bit_width(sign * (power + (power - 1))), k + 1);
    }
  }
}

mpz_class gcd_of(const Plane& p) {
  return gcd(gcd(to_gmp(p.a), to_gmp(p.b)), gcd(to_gmp(p.c), to_gmp(p.d)));
}

Int128 random_bits(test::Random& random, int bits) {
  if (bits == 0) return 0;
  const UInt128 v = (static_cast<UInt128>(random.bits()) << 64 | random.bits()) >> (128 - bits);
  return random.bits() & 1 ? -static_cast<Int128>(v) : static_cast<Int128>(v);
}

TEST(PlaneTable, NamesEachPlaneOnce) {
  test::Random random(71);
  PlaneTable table;
  std::vector<Plane> known;
  for (int i = 0; i < 3000; ++i) {
    const int bits = static_cast<int>(random.integer(1, 100));
    Plane p;
    while (p.a == 0 && p.b == 0 && p.c == 0) {
      // Zeros are common.
      const auto component = [&] { return random.integer(0, 2) ? random_bits(random, bits) : 0; };
      p = {component(), component(), component(), component()};
    }
    const PlaneId id = table.intern(p);
    ASSERT_TRUE(id.valid());
    // Reduced, the first component of the normal positive, and the same plane on the same side.
    const Plane stored = table.plane(id.index()), oriented = table.oriented(id);
    ASSERT_EQ(gcd_of(stored), 1);
    ASSERT_GT(stored.a != 0 ? stored.a : stored.b != 0 ? stored.b : stored.c, 0);
    const mpz_class scale = gcd_of(p);
    ASSERT_EQ(to_gmp(oriented.a) * scale, to_gmp(p.a));
    ASSERT_EQ(to_gmp(oriented.b) * scale, to_gmp(p.b));
    ASSERT_EQ(to_gmp(oriented.c) * scale, to_gmp(p.c));
    ASSERT_EQ(to_gmp(oriented.d) * scale, to_gmp(p.d));
    ASSERT_EQ(table.oriented(id.flip()), oriented.reversed());
    // What is remembered of it.
    const auto width = [](const Int128 v) {
      return static_cast<int>(mpz_sizeinbase(to_gmp(v).get_mpz_t(), 2)) * (v != 0);
    };
    ASSERT_EQ(table.normal_bits(id.index()),
              std::max({width(stored.a), width(stored.b), width(stored.c)}));
    ASSERT_EQ(table.offset_bits(id.index()), width(stored.d));
    const auto& approximate = table.approximate(id.index());
    const Int128 exact[4] = {stored.a, stored.b, stored.c, stored.d};
    for (int k = 0; k < 4; ++k) ASSERT_EQ(approximate[k], static_cast<double>(exact[k]));
    // Any multiple of it, of either sign, has its number.
    const Int128 factor = random.integer(1, 1000);
    const Plane multiple{p.a * factor, p.b * factor, p.c * factor, p.d * factor};
    const size_t size = table.size();
    ASSERT_EQ(table.intern(multiple), id);
    ASSERT_EQ(table.intern(multiple.reversed()), id.flip());
    ASSERT_EQ(table.size(), size);
    if (id.index() == known.size()) known.push_back(stored);
    ASSERT_EQ(known[id.index()], stored);
  }
  // After the table grew, all are where they were.
  ASSERT_EQ(table.size(), known.size());
  EXPECT_GT(known.size(), 2000u);
  for (uint32_t i = 0; i < known.size(); ++i) {
    ASSERT_EQ(table.intern(known[i]), PlaneId(i, false));
    ASSERT_EQ(table.plane(i), known[i]);
  }
}

// Planes that were taken over are found like those that were interned, and new ones come after
// them.
TEST(PlaneTable, TakesOverPlanesOfAnother) {
  test::Random random(73);
  PlaneTable table;
  std::vector<Plane> given;
  while (given.size() < 500) {
    const auto component = [&] { return Int128{random.integer(-9, 9)} << random.integer(0, 70); };
    const Plane p{component(), component(), component(), component()};
    if (p.a == 0 && p.b == 0 && p.c == 0) continue;
    given.push_back(p);
    table.intern(p);
  }
  std::vector<Plane> planes;
  for (uint32_t i = 0; i < table.size(); ++i) planes.push_back(table.plane(i));
  PlaneTable other;
  other.adopt(planes);
  ASSERT_EQ(other.size(), planes.size());
  for (uint32_t i = 0; i < planes.size(); ++i) {
    ASSERT_EQ(other.plane(i), planes[i]);
    ASSERT_EQ(other.approximate(i), table.approximate(i));
    ASSERT_EQ(other.normal_bits(i), table.normal_bits(i));
    ASSERT_EQ(other.offset_bits(i), table.offset_bits(i));
  }
  const PlaneId fresh = other.intern({1, 2, 3, 1000001});
  EXPECT_EQ(fresh, PlaneId(static_cast<uint32_t>(planes.size()), false));
  for (const Plane& p : given) ASSERT_EQ(other.intern(p), table.intern(p));
  for (uint32_t i = 0; i < planes.size(); ++i) {
    ASSERT_EQ(other.intern_computed(reduce(planes[i])), PlaneId(i, false));
    ASSERT_EQ(other.intern_computed(reduce(planes[i].reversed())), PlaneId(i, true));
  }
  EXPECT_EQ(other.intern_computed(reduce({-1, -2, -3, -1000001})), fresh.flip());
}

// Room that is made beforehand, for none, few or all, changes no number.
TEST(PlaneTable, RoomMadeBeforehandChangesNothing) {
  test::Random random(74);
  std::vector<Plane> planes;
  while (planes.size() < 3000) {
    const auto component = [&] { return Int128{random.integer(-6, 6)}; };
    const Plane p{component(), component(), component(), component()};
    if (p.a != 0 || p.b != 0 || p.c != 0) planes.push_back(p);
  }
  PlaneTable plain, at_once, in_steps, adopted;
  adopted.adopt(std::vector<Plane>{{1, 0, 0, 7}, {0, 1, 0, 7}});
  at_once.make_room(planes.size());
  for (size_t i = 0; i < planes.size(); ++i) {
    if (i % 7 == 0) in_steps.make_room(i % 5 * 40);
    if (i == 0) adopted.make_room(20000);
    const PlaneId known = plain.intern(planes[i]);
    ASSERT_EQ(at_once.intern(planes[i]), known);
    ASSERT_EQ(in_steps.intern(planes[i]), known);
    ASSERT_EQ(adopted.oriented(adopted.intern(planes[i])), plain.oriented(known));
  }
  EXPECT_EQ(at_once.size(), plain.size());
  EXPECT_EQ(in_steps.size(), plain.size());
  EXPECT_EQ(adopted.intern({0, -1, 0, -7}), PlaneId(1, true));
}

// Planes that are taken over where room was made before are found as elsewhere.
TEST(PlaneTable, TakesOverPlanesWhereRoomWasMade) {
  std::vector<Plane> planes;
  for (int i = 0; i < 20; ++i) planes.push_back({1, 0, 0, i});
  for (const size_t room : {0u, 1u, 20u, 1000u}) {
    PlaneTable table;
    table.make_room(room);
    table.adopt(planes);
    for (uint32_t i = 0; i < planes.size(); ++i) {
      ASSERT_EQ(table.intern(planes[i]), PlaneId(i, false)) << "room for " << room;
    }
    EXPECT_EQ(table.size(), planes.size());
  }
}

// Of so many planes some have equal hashes of 32 bits.
TEST(PlaneTable, EqualHashesAreNotEqualPlanes) {
  PlaneTable table;
  for (uint32_t i = 0; i < 400000; ++i) {
    const PlaneId id = table.intern({1, i % 1000, i / 1000, 7});
    ASSERT_EQ(id.index(), i);
  }
  EXPECT_EQ(table.intern({1, 5, 0, 7}).index(), 5u);
}

// Where a tier is forced, no sum with the approximate offset may decide.
TEST(PlaneTable, HasNoApproximationWhereATierIsForced) {
  const int before = forced_tier;
  for (const int tier : {-1, 0, 3}) {
    forced_tier = tier;
    PlaneTable table;
    const double offset = table.approximate(table.intern({1, 2, 3, 4}).index())[3];
    EXPECT_EQ(std::isnan(offset), tier >= 0) << tier;
  }
  forced_tier = before;
}

TEST(PlaneId, IsANumberAndASide) {
  std::set<PlaneId> all;
  for (uint32_t i = 0; i < 50; ++i) {
    for (const bool flipped : {false, true}) {
      const PlaneId id(i, flipped);
      EXPECT_EQ(id.index(), i);
      EXPECT_EQ(id.flipped(), flipped);
      EXPECT_EQ(id.flip().index(), i);
      EXPECT_EQ(id.flip().flipped(), !flipped);
      EXPECT_EQ(id.flip().flip(), id);
      EXPECT_NE(id.flip(), id);
      EXPECT_EQ(PlaneId::from_value(id.value()), id);
      EXPECT_TRUE(id.valid());
      all.insert(id);
    }
  }
  EXPECT_EQ(all.size(), 100u);
  EXPECT_FALSE(PlaneId().valid());
}

// The lowest tier whose bits hold the bound of widths.h and a sign; and it does hold the value.
TEST(ExactTier, IsTheLowestThatHoldsTheBound) {
  test::Random random(72);
  std::array<int, 6> seen{};
  for (int i = 0; i < 20000; ++i) {
    Point p = grid_point(1, 1, 1);
    const auto wide = [&](int bits) { return Int<kPointLimbs>(1).shifted_left(bits - 1); };
    const int xyz = static_cast<int>(random.integer(1, widths::kMaxPointXyz));
    const int w = static_cast<int>(random.integer(1, std::min(xyz + 4, widths::kMaxPointW)));
    p.x = wide(static_cast<int>(random.integer(1, xyz)));
    p.y = wide(static_cast<int>(random.integer(1, xyz)));
    p.z = wide(static_cast<int>(random.integer(1, xyz)));
    p.w = wide(w);
    normalise(p);
    const Plane s{random_bits(random, static_cast<int>(random.integer(1, widths::kMaxNormal))),
                  random_bits(random, static_cast<int>(random.integer(1, widths::kMaxNormal))),
                  random_bits(random, static_cast<int>(random.integer(1, widths::kMaxNormal))),
                  random_bits(random, static_cast<int>(random.integer(0, widths::kMaxOffset)))};
    const int widest = std::max({p.x.bit_width(), p.y.bit_width(), p.z.bit_width()});
    const int normal = std::max({bit_width(s.a), bit_width(s.b), bit_width(s.c)});
    const int needed = std::max(widest + normal, w + bit_width(s.d)) + 2 + 1;
    const int tier = exact_tier(s, p);
    ASSERT_GE(kTierBits[tier], needed);
    if (tier > 0) {
      ASSERT_LT(kTierBits[tier - 1], needed);
    }
    ASSERT_EQ(exact_side(s, p), test::gmp_side(s, to_gmp(p)));
    ++seen[tier];
  }
  for (const int n : seen) EXPECT_GT(n, 10);
}

TEST(PlaneTable, TakesMovedPlanesOfATableAsTheyAre) {
  test::Random random(72);
  PlaneTable first, of_stored, of_any;
  size_t shared = 0;  // planes whose coefficients had a divisor in common
  for (int i = 0; i < 2000; ++i) {
    const auto component = [&] { return Int128{random.integer(-12, 12)} * 6; };
    Plane p{component(), component(), component(), component()};
    if (p.a == 0 && p.b == 0 && p.c == 0) continue;
    const Plane& stored = first.plane(first.intern(p).index());
    shared += gcd_of({stored.a, stored.b, stored.c, 0}) > 1;
    const Int128 x = random.integer(-9, 9), y = random.integer(-9, 9), z = random.integer(-9, 9);
    Plane moved = stored;
    moved.d -= stored.a * x + stored.b * y + stored.c * z;
    const PlaneId id = of_stored.intern_computed(as_stored(moved));
    ASSERT_EQ(id, of_any.intern(moved));
    ASSERT_EQ(of_stored.plane(id.index()), of_any.plane(id.index()));
    ASSERT_EQ(of_stored.intern(moved), id);
  }
  EXPECT_GT(shared, 100u);
}

}  // namespace
}  // namespace csgrun::plane_test
