// Words for messages: numbers in their shortest form, errors in one line.
#pragma once

#include <string>

#include <csgrun/engine/error.h>

namespace csgrun {

/// The shortest decimal that reads back as the same double; independent of the locale.
std::string number_text(double value);

Error invalid_argument(std::string message);

/// "cylinder: h must be positive, got -1".
Error not_positive(const std::string& function, const std::string& argument, double value);
/// "circle: r must be finite, got nan".
Error not_finite(const std::string& function, const std::string& argument, double value);

}  // namespace csgrun
