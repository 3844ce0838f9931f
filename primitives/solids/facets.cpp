// OpenSCAD's rule for the number of fragments of a circle.
#include <algorithm>
#include <cmath>

#include <csgrun/primitives/solids.h>

namespace csgrun {

int Facets::fragments(double r, double angle_deg) const {
  // Below this radius OpenSCAD gives up on a circle; its callers then use three fragments.
  constexpr double kGridFine = 0x1p-20;
  constexpr double kPi = 3.14159265358979323846;
  constexpr double kMost = 1e9;  // what no memory can hold is refused by the makers, not here
  if (!(r >= kGridFine) || !std::isfinite(fn)) return 3;
  const double turn = std::fabs(angle_deg) / 360;
  const double smallest_fa = std::max(fa, 0.01), smallest_fs = std::max(fs, 0.01);
  const double whole =
      fn > 0 ? std::ceil(std::max(fn, 3.0))
             : std::ceil(std::max(std::min(360 / smallest_fa, 2 * kPi * r / smallest_fs), 5.0));
  return static_cast<int>(std::clamp(std::ceil(whole * turn), 1.0, kMost));
}

}  // namespace csgrun
