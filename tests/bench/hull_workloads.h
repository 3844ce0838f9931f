// Workloads about surfaces that cross themselves (Campen & Kobbelt 2010, chapters 6 and 7).
#pragma once

#include <string>

#include "tests/bench/run.h"

namespace csgrun::bench {

/// The outer hull of a mesh as it is found: closed, but crossing itself. The counters say how many
/// pairs of triangles cross in the file and in the result as it is rounded to doubles.
void run_hull(const std::string& name, const Settings& settings, const std::string& path);

/// Front tracking: the closed surface moves along its vertex normals, by 1/500 of its diagonal in
/// each step, the first third of the steps inwards and the others outwards; after each step the
/// orientation-sensitive outer hull resolves what has come to cross. The counters have an entry for
/// each step: `ms` and `cpu_ms` from arrays to arrays, without moving the points, and `events`:
/// connected curves along which the surface was cut.
void run_front(const std::string& name, const Settings& settings, const std::string& path,
               int steps);

}  // namespace csgrun::bench
