// Models of our own for the experiments, each at any number of faces: spheres of regular triangles
// that are drawn out, bent and put side by side.
#pragma once

#include <cstddef>
#include <string>

#include "tests/bench/workloads.h"

namespace csgrun::bench {

/// `statue`: upright, bumpy at every scale, for unions with a turned copy.
/// `sieve`: a round plate with nine dimples on either side: moved inwards, nine holes at once.
/// `twins`: two bumpy bodies beside each other, which merge when they grow.
/// `ring`: a tube that is bent to an open ring, whose ends meet when it grows.
/// `contortionist`: a body bent at neck, waist and knees so far that it crosses itself in every
/// fold. At most `faces` triangles, and nearly as many; coordinates are float32 values. Unknown
/// names: empty.
RawMesh model(const std::string& name, size_t faces);

}  // namespace csgrun::bench
