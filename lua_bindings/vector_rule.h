// Which lists of numbers an argument type takes.
#pragma once

#include "lua_bindings/arguments.h"

namespace csgrun {

struct VectorRule {
  int least, most;  ///< `most` 0: the type is no vector
  bool number_too;  ///< a bare number is taken as well
};

VectorRule vector_rule(ArgumentType type);

}  // namespace csgrun
