// Sums of decimals are a little off: 0.1 + 0.2 is more than 0.3.
#pragma once

namespace csgrun {

/// `most`, where the value is above it by no more than a few roundings; else the value.
inline double at_most(double value, double most) {
  return value > most && value <= most * (1 + 0x1p-50) ? most : value;
}

}  // namespace csgrun
