// Random numbers for models of a test.
#pragma once

#include <random>

namespace csgrun::testing {

struct Draw {
  std::mt19937 random;
  double upto(double most) { return static_cast<double>(random() % 1000) / 1000 * most; }
  int below(int count) { return static_cast<int>(random() % static_cast<unsigned>(count)); }
};

}  // namespace csgrun::testing
