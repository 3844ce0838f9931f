// Volume, centroid and area of meshes whose vertices are exact rational points.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>

#include <glm/vec3.hpp>

#include <csgrun/engine/error.h>
#include <csgrun/engine/evaluate.h>

#include "engine/base/double_double.h"
#include "engine/exact/point.h"
#include "engine/mesh/natural.h"

namespace csgrun {

/// An exact sum and how far the true value may be from it: value and error * 2^exponent.
struct Sum {
  Signed value;
  Natural error;
};

struct MassProperties {
  double volume = 0;      ///< mm^3, the exact rational rounded once; negative when inside out
  double area = 0;        ///< mm^2, within one unit in the last place
  glm::dvec3 centroid{};  ///< mm, each coordinate rounded once; zero when the volume is zero
};

/// What is measured of a mesh; the rest is zero.
enum class Wanted : uint8_t { kVolume, kVolumeAndArea, kAll };

/// Measures a closed, oriented triangle mesh over the points 0 .. point_count - 1, of which `point`
/// tells the exact value in grid steps (|coordinate| < 2^40; called once a round for each point
/// that a triangle uses, rounds are one except in rare cases). `step` is not automatic.
///
/// Coordinates are cut to fixed point and summed without any further rounding; the error of the
/// cuts is bounded. When that leaves more than one double, the next round takes twice the digits;
/// when a result seems to stand exactly between two doubles, or on zero, residues modulo two 61-bit
/// primes tell. O(n): about 0.5 us a triangle and 0.3 us a point; a half or
/// less without the centroid, about a third for the volume alone. Errors: kInternal when a point is
/// out of range or no number of digits suffices.
Result<MassProperties> measure_mesh(size_t point_count, const std::function<Point(uint32_t)>& point,
                                    std::span<const std::array<uint32_t, 3>> triangles,
                                    const GridStep& step, Wanted wanted = Wanted::kAll);

/// The volume in mm^3, rounded once, from the sum of all triangles' determinants * 2^-3F, F being
/// `fraction_bits`. Nothing when the sum's error leaves more than one double.
std::optional<double> round_volume(const Sum& six_volumes, int fraction_bits, const GridStep& step);

/// The area in mm^2 from twice the area in steps^2.
double round_area(const DoubleDouble& twice_area, const GridStep& step);

}  // namespace csgrun
