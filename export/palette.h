// The materials of a file: each distinct appearance once, with a name of its own.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <csgrun/engine/solid.h>

namespace csgrun {

/// A number for people and for files: six decimals, so that the last bits of a power or of a float
/// do not show, which differ between machines.
double rounded_to_millionths(double value);

/// A colour component in [0,1] as 0 .. 255, clamped.
uint8_t colour_byte(float component);

class Palette {
 public:
  /// Adds the appearances that faces of `solid` have, in the order of its faces. Returns the
  /// material of each of the solid's appearances; those of no face are left at 0.
  std::vector<uint32_t> add(const Solid& solid);

  [[nodiscard]] const std::vector<Appearance>& appearances() const { return appearances_; }
  /// Distinct words: the appearance's own name, "default", or its colour as "#rrggbb".
  [[nodiscard]] const std::vector<std::string>& names() const { return names_; }

 private:
  uint32_t material_of(const Appearance& appearance);

  std::vector<Appearance> appearances_;
  std::vector<std::string> names_;
};

}  // namespace csgrun
