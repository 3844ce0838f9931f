#include "primitives/base/text.h"

#include <array>
#include <charconv>
#include <cmath>
#include <utility>

namespace csgrun {

std::string number_text(double value) {
  if (std::isnan(value)) return "nan";
  std::array<char, 32> buffer{};
  const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value).ptr;
  return {buffer.data(), end};
}

Error invalid_argument(std::string message) {
  return Error{ErrorCode::kInvalidArgument, std::move(message), {}};
}

Error not_positive(const std::string& function, const std::string& argument, double value) {
  return invalid_argument(function + ": " + argument + " must be positive, got " +
                          number_text(value));
}

Error not_finite(const std::string& function, const std::string& argument, double value) {
  return invalid_argument(function + ": " + argument + " must be finite, got " +
                          number_text(value));
}

}  // namespace csgrun
