// How the program ends.
#pragma once

#include <string>

namespace csgrun {

enum ExitCode : int {
  kExitGood = 0,
  kExitScript = 1,    ///< anything that the script raises; a file that it may not or cannot read
  kExitUsage = 2,     ///< options, unknown -D
  kExitGeometry = 3,  ///< geometry, an empty result, a failed check, memory used up in evaluation
  kExitFiles = 4,     ///< MODEL cannot be read, OUT cannot be written
  kExitTime = 124,    ///< out of time
};

/// Why a run ended early: what is printed and with which code the program ends.
struct Failure {
  ExitCode code = kExitGood;
  std::string message;
  [[nodiscard]] bool failed() const { return code != kExitGood; }
};

}  // namespace csgrun
