// Whether planes meet in a grid point, by planes made to do so or to miss it.
#include "engine/exact/grid_meeting.h"

#include <gtest/gtest.h>

#include "tests/support/seeded.h"

namespace csgrun::grid_meeting_test {
namespace {

using IVec3 = std::array<int64_t, 3>;

/// A plane through a grid point, or beside it by `miss`.
Plane through(const IVec3& at, Int128 a, Int128 b, Int128 c, Int128 miss = 0) {
  return {a, b, c, -(a * at[0] + b * at[1] + c * at[2]) + miss};
}

bool meet(const Plane& p, const Plane& q, const Plane& r, const IVec3& at) {
  return meet_on_grid(
      p, q, r,
      {static_cast<double>(at[0]), static_cast<double>(at[1]), static_cast<double>(at[2])});
}

TEST(GridMeeting, IsWhereAllPlanesPass) {
  test::Random random(31);
  for (int i = 0; i < 200; ++i) {
    const int64_t reach = int64_t{1} << random.integer(1, 30);
    const auto number = [&] { return random.integer(-reach, reach); };
    const IVec3 at{number(), number(), number()};
    const int64_t size = int64_t{1} << random.integer(1, 55);
    std::array<Plane, 3> planes;
    for (Plane& p : planes) {
      const auto part = [&] { return static_cast<Int128>(random.integer(-size, size)); };
      p = through(at, part(), part(), part());
    }
    ASSERT_TRUE(meet(planes[0], planes[1], planes[2], at));
    for (Plane& p : planes) {
      for (const int miss : {1, -1}) {
        p.d += miss;
        ASSERT_FALSE(meet(planes[0], planes[1], planes[2], at));
        p.d -= miss;
      }
    }
    // A coordinate between steps is none of the grid.
    for (size_t k = 0; k < 3; ++k) {
      std::array<double, 3> rounded{static_cast<double>(at[0]), static_cast<double>(at[1]),
                                    static_cast<double>(at[2])};
      rounded[k] += 0.25;
      ASSERT_FALSE(meet_on_grid(planes[0], planes[1], planes[2], rounded));
    }
  }
}

TEST(GridMeeting, IsNotToldOfFarPointsAndWidePlanes) {
  constexpr int64_t kFar = int64_t{1} << 30;
  for (size_t k = 0; k < 3; ++k) {
    for (const int64_t sign : {1, -1}) {
      IVec3 at{7, 8, 9};
      const auto answer = [&] {
        return meet(through(at, 1, 0, 0), through(at, 1, 1, 0), through(at, 1, 2, 3), at);
      };
      at[k] = sign * kFar;
      EXPECT_TRUE(answer());
      at[k] = sign * (kFar + 1);
      EXPECT_FALSE(answer());
    }
  }
  // Ninety bits a component, no more.
  const IVec3 at{1, -1, 1};
  const Int128 most = (Int128{1} << 90) - 1;
  const Plane p = through(at, 1, 2, 0), q = through(at, 0, 1, 3);
  for (int k = 0; k < 3; ++k) {
    for (const Int128 sign : {Int128{1}, Int128{-1}}) {
      const auto wide = [&](Int128 value) {
        return through(at, k == 0 ? value : 1, k == 1 ? value : 1, k == 2 ? value : 1);
      };
      EXPECT_TRUE(meet(wide(sign * most), p, q, at));
      EXPECT_FALSE(meet(wide(sign * (most + 1)), p, q, at));
      EXPECT_FALSE(meet(p, wide(sign * (most + 1)), q, at));
      EXPECT_FALSE(meet(p, q, wide(sign * (most + 1)), at));
    }
  }
}

}  // namespace
}  // namespace csgrun::grid_meeting_test
