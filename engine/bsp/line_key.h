// A name for a line by value: equal for any two planes that meet in it.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/exact/plane.h"

namespace csgrun {

/// 122 bits of the line's Plücker coordinates modulo 2^61 - 1, divided by their first non-zero one:
/// independent of which planes through the line were used, and of their scale. Equal lines have equal
/// keys; different lines have different keys but for a chance of about 2^-120, so users confirm.
struct LineKey {
  uint64_t a = 0, b = 0;
  bool operator==(const LineKey&) const = default;
  auto operator<=>(const LineKey&) const = default;
};

/// Computes keys; remembers the residues of planes.
class LineNamer {
 public:
  explicit LineNamer(const PlaneTable& planes) : planes_(&planes) {}
  /// REQUIRES: the planes (indices) are not parallel.
  LineKey key(uint32_t p, uint32_t q);

 private:
  struct Residues {
    uint64_t v[4];
    bool known = false;
  };
  const Residues& residues(uint32_t plane);

  const PlaneTable* planes_;
  std::vector<Residues> residues_;
};

}  // namespace csgrun
