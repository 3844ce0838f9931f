// A name for a line by value: equal for any two planes that meet in it.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "engine/exact/plane.h"

namespace csgrun {

/// 122 bits of the line's Plücker coordinates modulo 2^61 - 1, divided by their first non-zero one:
/// independent of which planes through the line were used, and of their scale. Equal lines have
/// equal keys; different lines have different keys but for a chance of about 2^-120, so users
/// confirm.
struct LineKey {
  uint64_t a = 0, b = 0;
  bool operator==(const LineKey&) const = default;
  auto operator<=>(const LineKey&) const = default;
};

/// Computes keys; remembers the residues of planes.
class LineNamer {
 public:
  /// Two planes (indices) that meet in a line: not parallel.
  struct PlanePair {
    uint32_t p, q;
  };
  explicit LineNamer(const PlaneTable& planes) : planes_(&planes) {}
  /// The keys of many lines: one modular inverse serves them all (Montgomery's trick).
  void keys(const std::vector<PlanePair>& lines, std::vector<LineKey>& keys);

 private:
  struct Residues {
    uint64_t v[4] = {0, 0, 0, 0};
    bool known = false;
  };
  const Residues& residues(uint32_t plane);

  /// Plücker coordinates modulo the prime.
  struct Coordinates {
    uint64_t v[6];
    int first;  ///< the first that is not zero
  };
  Coordinates coordinates(PlanePair line);

  const PlaneTable* planes_;
  /// In pages, made when asked for: of a table that many operations share each needs a few planes.
  static constexpr uint32_t kPage = 64;
  using Page = std::array<Residues, kPage>;
  std::vector<std::unique_ptr<Page>> pages_;
  std::vector<Coordinates> lines_;
  std::vector<uint64_t> products_;
};

}  // namespace csgrun
