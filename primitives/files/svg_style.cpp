#include "primitives/files/svg_style.h"

#include <algorithm>
#include <iterator>
#include <optional>

#include "primitives/files/formats.h"
#include "primitives/files/svg_path.h"

namespace csgrun {
namespace {

/// The value of a property that is handed down; empty where that of the parent stays.
std::string handed_down(const SvgElementStyle& own, const char* name, const char* initial) {
  std::string value = own.property(name);
  if (value == "initial") return initial;
  if (value == "inherit" || value == "unset" || value == "revert" || value == "revert-layer")
    return {};
  return value;
}

/// More than that are a mistake, or meant ill: every element takes the list over.
constexpr size_t kMostDashes = 1000;

/// Nothing where a part is no length, or negative, and for too many.
std::optional<std::vector<double>> dashes_of(const std::string& list, const SvgUnits& units) {
  std::vector<double> dashes;
  double sum = 0;
  const std::vector<std::string> words = css_words(list);
  if (words.size() > kMostDashes) return std::nullopt;
  for (const std::string& word : words) {
    const auto length = units.length(word, units.diagonal());
    if (!length || *length < 0) return std::nullopt;
    dashes.push_back(*length);
    sum += *length;
  }
  if (sum == 0) return std::vector<double>();  // a list of zeros is no list
  const size_t n = dashes.size();
  if (n % 2 == 1) {
    for (size_t i = 0; i < n; ++i) dashes.push_back(dashes[i]);
  }
  return dashes;
}

}  // namespace

bool is_svg_property(std::string_view property) {
  constexpr std::string_view kHeeded[] = {"display",
                                          "visibility",
                                          "fill",
                                          "fill-rule",
                                          "stroke",
                                          "stroke-linecap",
                                          "stroke-width",
                                          "stroke-linejoin",
                                          "clip-path",
                                          "stroke-miterlimit",
                                          "mask",
                                          "stroke-dasharray",
                                          "transform",
                                          "transform-origin",
                                          "translate",
                                          "rotate",
                                          "scale",
                                          "transform-box",
                                          "marker",
                                          "marker-start",
                                          "marker-mid",
                                          "marker-end",
                                          "x",
                                          "y",
                                          "width",
                                          "height",
                                          "rx",
                                          "ry",
                                          "cx",
                                          "cy",
                                          "r",
                                          "d",
                                          "stroke-dashoffset",
                                          "vector-effect",
                                          "font",
                                          "font-size"};
  return std::find(std::begin(kHeeded), std::end(kHeeded), property) != std::end(kHeeded);
}

void SvgStyle::read(const pugi::xml_node& node, const SvgElementStyle& own, SvgNotes& notes) {
  const auto take = [&](const char* name, std::string& value, const char* initial) {
    const std::string given = handed_down(own, name, initial);
    if (!given.empty()) value = given;
  };
  const auto refuse = [&](const char* name, const std::string& value, const std::string& expected) {
    notes.leave_out(node, std::string("a ") + name + " of <" + svg_name(node) + ">",
                    "got " + csgrun::quoted(value) + ", " + expected);
  };
  // Where only the font is named, too, its size is not looked for.
  if (own.declared("font") != nullptr) units.em.reset();
  if (const std::string size = handed_down(own, "font-size", "medium"); !size.empty())
    units.set_font_size(size);
  take("fill", fill, "black");
  take("stroke", stroke, "none");
  take("fill-rule", fill_rule, "nonzero");
  take("stroke-linecap", cap, "butt");
  take("stroke-linejoin", join, "miter");
  if (const std::string text = handed_down(own, "stroke-width", "1"); !text.empty()) {
    const auto width = units.length(text, units.diagonal());
    if (width && *width >= 0) {
      stroke_width = *width;
    } else {
      refuse("stroke-width", text,
             width ? "which must not be negative" : std::string(kSvgLengthExpected));
    }
  }
  if (const std::string text = handed_down(own, "stroke-miterlimit", "4"); !text.empty()) {
    const auto limit = parse_svg_length(text);
    if (limit && limit->unit.empty() && limit->number >= 1) {
      mitre_limit = limit->number;
    } else {
      refuse("stroke-miterlimit", text, "expected a number of at least 1");
    }
  }
  if (const std::string text = handed_down(own, "stroke-dasharray", "none"); !text.empty()) {
    const auto list = text == "none" ? std::vector<double>() : dashes_of(text, units);
    if (list) {
      dashes = *list;
    } else {
      refuse("stroke-dasharray", text,
             "expected up to " + std::to_string(kMostDashes) + " lengths that are not negative");
    }
  }
  if (const std::string text = handed_down(own, "stroke-dashoffset", "0"); !text.empty()) {
    if (const auto offset = units.length(text, units.diagonal())) {
      dash_offset = *offset;
    } else {
      refuse("stroke-dashoffset", text, kSvgLengthExpected);
    }
  }
  std::string text;
  take("visibility", text, "visible");
  if (!text.empty()) visible = text == "visible";
  // `marker` stands for all three, but only where CSS is written.
  const std::string* const all = own.declared("marker");
  constexpr const char* kMarkers[] = {"marker-start", "marker-mid", "marker-end"};
  for (size_t i = 0; i < markers.size(); ++i) {
    text = handed_down(own, kMarkers[i], "none");
    if (all != nullptr && own.declared(kMarkers[i]) == nullptr) text = css_lower(*all);
    if (!text.empty()) markers[i] = text != "none";
  }
}

}  // namespace csgrun
