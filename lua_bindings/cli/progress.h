// Progress on standard error, when that is a terminal.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>

namespace csgrun {

/// A function for EvaluateOptions::progress, or none when nobody watches.
std::function<void(uint64_t, uint64_t)> make_progress(bool quiet);

/// The same for WriteOptions::repairing.
std::function<void(unsigned, size_t)> make_repair_progress(bool quiet);

/// Takes the line of progress away.
void clear_progress();

}  // namespace csgrun
