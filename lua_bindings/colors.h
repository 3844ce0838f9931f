// Colours by name: the 148 of CSS, "transparent", and hexadecimal forms.
#pragma once

#include <array>
#include <optional>
#include <string>

namespace csgrun {

/// Red, green, blue, alpha from 0 to 1 (sRGB) of a CSS name in any case, #rgb, #rgba, #rrggbb or
/// #rrggbbaa.
std::optional<std::array<float, 4>> parse_color(const std::string& text);

/// " (did you mean 'x'?)" for a name that is not one.
std::string color_hint(const std::string& text);

}  // namespace csgrun
