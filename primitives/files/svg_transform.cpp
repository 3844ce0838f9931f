// CSS Transforms 1 and 2, as far as they stay in the plane. As browsers do it, the reference box
// of SVG elements is the viewport: percentages are of its size, and its origin is that of the user
// units, so that is what turns are about where nothing else is said.
#include "primitives/files/svg_transform.h"

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <csgrun/primitives/trig.h>

#include "primitives/files/formats.h"

namespace csgrun {
namespace {

bool says_nothing(const std::string& value) {
  return value.empty() || value == "none" || value == "initial" || value == "unset" ||
         value == "revert" || value == "revert-layer";
}

std::optional<double> degrees_of(const std::string& text) {
  const auto angle = parse_svg_length(text);
  if (!angle) return std::nullopt;
  if (angle->unit.empty() || angle->unit == "deg") return angle->number;
  if (angle->unit == "grad") return angle->number * 0.9;
  if (angle->unit == "turn") return angle->number * 360;
  constexpr double kDegreesOfRadian = 57.295779513082320877;
  if (angle->unit == "rad") return angle->number * kDegreesOfRadian;
  return std::nullopt;
}

std::optional<double> factor_of(const std::string& text) {
  const auto factor = parse_svg_length(text);
  if (!factor) return std::nullopt;
  if (factor->unit == "%") return factor->number / 100;
  return factor->unit.empty() ? std::optional(factor->number) : std::nullopt;
}

SvgMap moved(double x, double y) { return {1, 0, 0, 1, x, y}; }

/// One function of CSS; nothing where it is not known, or leads out of the plane.
std::optional<SvgMap> function_of(std::string_view name, const std::vector<std::string>& words,
                                  const SvgUnits& units) {
  const size_t n = words.size();
  // All of them in one unit; false where one is none.
  std::vector<double> v;
  const auto read = [&](size_t least, size_t most, const auto& value_of) {
    if (n < least || n > most) return false;
    for (const std::string& word : words) {
      const std::optional<double> value = value_of(word);
      if (!value) return false;
      v.push_back(*value);
    }
    return true;
  };
  const auto across = [&](const std::string& word) { return units.length(word, units.viewport.x); };
  const auto along = [&](const std::string& word) { return units.length(word, units.viewport.y); };
  if (name == "translate" || name == "translate3d") {
    const bool flat = name == "translate";
    if (n < (flat ? 1 : 3) || n > (flat ? 2 : 3)) return std::nullopt;
    const auto x = across(words[0]), y = n > 1 ? along(words[1]) : std::optional(0.0);
    if (!x || !y) return std::nullopt;
    return moved(*x, *y);
  }
  if (name == "translatex" && read(1, 1, across)) return moved(v[0], 0);
  if (name == "translatey" && read(1, 1, along)) return moved(0, v[0]);
  if (name == "translatez" && read(1, 1, across)) return SvgMap();  // seen from above
  if (name == "scale" && read(1, 2, factor_of)) return SvgMap{v[0], 0, 0, v[n - 1], 0, 0};
  if (name == "scale3d" && read(3, 3, factor_of)) return SvgMap{v[0], 0, 0, v[1], 0, 0};
  if (name == "scalex" && read(1, 1, factor_of)) return SvgMap{v[0], 0, 0, 1, 0, 0};
  if (name == "scaley" && read(1, 1, factor_of)) return SvgMap{1, 0, 0, v[0], 0, 0};
  if ((name == "rotate" || name == "rotatez") && read(1, 1, degrees_of)) {
    const double c = cos_deg(v[0]), s = sin_deg(v[0]);
    return SvgMap{c, s, -s, c, 0, 0};
  }
  if (name == "skew" && read(1, 2, degrees_of))
    return SvgMap{1, n > 1 ? tan_deg(v[1]) : 0, tan_deg(v[0]), 1, 0, 0};
  if (name == "skewx" && read(1, 1, degrees_of)) return SvgMap{1, 0, tan_deg(v[0]), 1, 0, 0};
  if (name == "skewy" && read(1, 1, degrees_of)) return SvgMap{1, tan_deg(v[0]), 0, 1, 0, 0};
  if (name == "matrix" && read(6, 6, factor_of)) return SvgMap{v[0], v[1], v[2], v[3], v[4], v[5]};
  return std::nullopt;
}

/// A list of functions, in small letters.
std::optional<SvgMap> css_transform(std::string_view text, const SvgUnits& units) {
  SvgMap map;
  for (size_t at = 0;;) {
    at = text.find_first_not_of(", \t\r\n\f", at);
    if (at == std::string_view::npos) return map;
    const size_t open = text.find('(', at), close = text.find(')', at);
    if (close == std::string_view::npos || open > close) return std::nullopt;
    const auto next = function_of(text.substr(at, open - at),
                                  css_words(text.substr(open + 1, close - open - 1)), units);
    if (!next) return std::nullopt;
    map = map.after(*next);
    at = close + 1;
  }
}

/// A `transform-origin`: the third length, above the plane, has no meaning.
std::optional<glm::dvec2> origin_of(const std::string& text, const SvgUnits& units) {
  std::vector<std::string> words = css_words(text);
  if (words.empty() || words.size() > 3) return std::nullopt;
  if (words.size() == 1) words.emplace_back("center");
  const auto names = [](const std::string& word, const char* a, const char* b) {
    return word == a || word == b;
  };
  if (names(words[0], "top", "bottom") || names(words[1], "left", "right"))
    std::swap(words[0], words[1]);
  const auto place = [&](const std::string& word, const char* low, const char* high, double whole) {
    return units.length(word == low        ? "0"
                        : word == "center" ? "50%"
                        : word == high     ? "100%"
                                           : std::string_view(word),
                        whole);
  };
  const auto x = place(words[0], "left", "right", units.viewport.x);
  const auto y = place(words[1], "top", "bottom", units.viewport.y);
  if (!x || !y) return std::nullopt;
  return glm::dvec2(*x, *y);
}

}  // namespace

Result<SvgMap> svg_transform_of(const std::string& name, const pugi::xml_node& node,
                                const SvgElementStyle& own, const SvgUnits& units,
                                SvgNotes& notes) {
  const std::string element = "<" + svg_name(node) + ">";
  SvgMap map;
  bool any = false;
  const auto add = [&](const char* property, const std::string& functions,
                       const std::string& value) {
    if (const auto next = css_transform(functions, units)) {
      map = map.after(*next);
      any = true;
    } else {
      notes.leave_out(node, std::string("a ") + property + " of " + element,
                      "got " + csgrun::quoted(value) +
                          ", expected functions of CSS in the plane, with lengths in known units");
    }
  };
  for (const char* property : {"translate", "rotate", "scale"}) {
    const std::string* const given = own.declared(property);
    if (given == nullptr) continue;
    const std::string value = css_lower(*given);
    if (!says_nothing(value)) add(property, property + ("(" + value) + ")", value);
  }
  if (const std::string* const styled = own.declared("transform")) {
    const std::string value = css_lower(*styled);
    if (!says_nothing(value)) add("transform", value, value);
  } else if (const pugi::xml_attribute given = node.attribute("transform");
             given && trimmed(given.value()) != "none") {
    const auto inner = parse_svg_transform(given.value());
    if (!inner) {
      return malformed(name, notes.place(node),
                       element + ": no transform: " + csgrun::quoted(given.value()));
    }
    map = map.after(*inner);
    any = true;
  }
  if (!any) return map;
  const std::string box = own.property("transform-box");
  if (!says_nothing(box) && box != "view-box") {
    notes.leave_out(node, "a transform-box of " + element,
                    "got " + csgrun::quoted(box) + ", taken as view-box");
  }
  const std::string origin = own.property("transform-origin");
  if (says_nothing(origin)) return map;
  const auto about = origin_of(origin, units);
  if (!about) {
    notes.leave_out(node, "a transform-origin of " + element,
                    "got " + csgrun::quoted(origin) +
                        ", expected two lengths, of percentages of a page with a size, or words");
    return map;
  }
  return moved(about->x, about->y).after(map).after(moved(-about->x, -about->y));
}

}  // namespace csgrun
