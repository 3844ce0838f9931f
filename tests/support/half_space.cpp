#include "tests/support/half_space.h"

#include "engine/bsp/grid_planes.h"
#include "tests/support/kernel_case.h"

namespace csgrun::test {

Operand half_space(int64_t q, int64_t height, bool is_below) {
  // Steps along the plane, from its point in y = 0 one step below the height.
  const int64_t s = is_below ? 1 : -1;
  const IVec3 at{s * (1 - q), 0, height - 1};
  const auto corner = [&](int64_t i, int64_t j) {
    return IVec3{at[0] + s * q * i - q * j, at[1] + q * j, at[2] + i};
  };
  const IVec3 a = corner(-2, -2), b = corner(4, -2), c = corner(-2, 4),
              tip{0, 0, height + (is_below ? -1 : 1) * (int64_t{1} << 25)};
  std::vector<Loop> loops{{a, b, c}, {a, c, tip}, {c, b, tip}, {b, a, tip}};
  const Plane base = plane_through(a, b, c);
  if (base.a * tip[0] + base.b * tip[1] + base.c * tip[2] + base.d > 0) turn_over(loops);
  return operand_of(make_leaf(loops));
}

}  // namespace csgrun::test
