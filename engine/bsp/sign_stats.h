// How signs were decided, for the statistics of a run.
#pragma once

#include <csgrun/engine/evaluate.h>

#include "engine/exact/predicates.h"

namespace csgrun {

inline void add_signs(EvaluateStats& stats, const SignCounters& counters) {
  stats.sign_filter += counters.filter;
  stats.sign_symbolic += counters.symbolic;
  for (size_t t = 0; t < counters.exact.size(); ++t) stats.sign_exact[t] += counters.exact[t];
}

}  // namespace csgrun
