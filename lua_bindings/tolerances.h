// What is the same direction, or the same plane, where a script chooses faces or edges.
#pragma once

namespace csgrun {

constexpr double kDirectionDegrees = 0.01;
constexpr double kNearPlane = 1e-6;  // mm

}  // namespace csgrun
