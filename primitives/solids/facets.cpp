// OpenSCAD's rule for the number of fragments of a circle.
#include <algorithm>
#include <cmath>

#include <csgrun/primitives/solids.h>
#include <csgrun/primitives/trig.h>

namespace csgrun {

namespace {

constexpr double kGridFine = 0x1p-20;  // of OpenSCAD's

}  // namespace

bool Facets::by_error() const { return !(fn > 0) && fe >= kGridFine && std::isfinite(fe); }

int Facets::fragments(double r, double angle_deg) const {
  // Below this radius OpenSCAD gives up on a circle; its callers then use three fragments.
  constexpr double kPi = 3.14159265358979323846;
  constexpr double kMost = 1e9;  // what no memory can hold is refused by the makers, not here
  if (!(r >= kGridFine) || !std::isfinite(fn) || (!(fn > 0) && !std::isfinite(fe))) return 3;
  const double turn = std::fabs(angle_deg) / 360;
  const double smallest_fa = std::max(fa, 0.01), smallest_fs = std::max(fs, 0.01);
  double whole = 0;
  if (fn > 0) {
    whole = std::ceil(std::max(fn, 3.0));
  } else if (by_error()) {
    // The middle of a side is r cos(180 / n) from the centre. No more than the least fa and fs
    // would give, and no fewer than five.
    constexpr double kOfFive = 0.1909830056;
    const double most = std::max(std::min(36000.0, 2 * kPi * r / 0.01), 5.0);
    whole = fe / r >= kOfFive ? 5 : std::min(most, 180 / acos_deg(1 - fe / r));
  } else {
    whole = std::ceil(std::max(std::min(360 / smallest_fa, 2 * kPi * r / smallest_fs), 5.0));
  }
  return static_cast<int>(std::clamp(std::ceil(whole * turn), 1.0, kMost));
}

}  // namespace csgrun
