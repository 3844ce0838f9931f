// What is wrong with the facets that somebody asks for.
#pragma once

#include <cmath>
#include <optional>
#include <utility>

#include <csgrun/engine/error.h>
#include <csgrun/primitives/solids.h>

#include "primitives/base/text.h"

namespace csgrun {

/// The error of numbers that are not finite; nothing if all are.
inline std::optional<Error> check_facets(const char* function, const Facets& facets) {
  for (const auto& [name, value] :
       {std::pair{"fn", facets.fn}, std::pair{"fa", facets.fa}, std::pair{"fs", facets.fs}}) {
    if (!std::isfinite(value)) return not_finite(function, name, value);
  }
  return std::nullopt;
}

}  // namespace csgrun
