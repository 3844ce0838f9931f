#include "primitives/files/svg_outline.h"

#include <algorithm>
#include <initializer_list>
#include <string_view>
#include <utility>

#include <glm/geometric.hpp>

#include "primitives/files/formats.h"
#include "primitives/files/svg_css.h"
#include "primitives/files/svg_document.h"
#include "primitives/files/svg_path.h"

namespace csgrun {
namespace {

bool is_any_of(std::string_view name, std::initializer_list<std::string_view> names) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// The data of a path, where CSS says d: path("...").
std::string_view without_wrapper(std::string_view value) {
  const size_t begin = value.find_first_of("\"'"), end = value.find_last_of("\"'");
  if (!value.starts_with("path(") || begin >= end) return value == "none" ? "" : value;
  return value.substr(begin + 1, end - begin - 1);
}

void add_ellipse(SvgLengths& lengths, const SvgSteps& steps, bool circle, SvgOutline& outline) {
  std::optional<double> rx = lengths.find(circle ? "r" : "rx"),
                        ry = circle ? rx : lengths.find("ry");
  if (!rx) rx = ry;
  if (!ry) ry = rx;
  const glm::dvec2 center(lengths.get("cx"), lengths.get("cy"));
  if (!rx || !(*rx > 0) || !(*ry > 0)) return;
  Chain& chain = outline.chains.emplace_back();
  chain.closed = true;
  append_ellipse(center, {*rx, 0}, {0, *ry}, 0, 360, steps.of_ellipse(std::max(*rx, *ry)),
                 chain.points);
}

void add_rectangle(SvgLengths& lengths, const SvgSteps& curve_steps, SvgOutline& outline) {
  const double x = lengths.get("x"), y = lengths.get("y");
  const double w = lengths.get("width"), h = lengths.get("height");
  std::optional<double> round_x = lengths.find("rx"), round_y = lengths.find("ry");
  if (!(w > 0) || !(h > 0)) return;
  if (!round_x) round_x = round_y;
  if (!round_y) round_y = round_x;
  const double rx = std::clamp(round_x.value_or(0), 0.0, w / 2);
  const double ry = std::clamp(round_y.value_or(0), 0.0, h / 2);
  Chain& chain = outline.chains.emplace_back();
  chain.closed = true;
  if (rx == 0 || ry == 0) {
    chain.points = {{x, y}, {x + w, y}, {x + w, y + h}, {x, y + h}};
    return;
  }
  const int steps = (curve_steps.of_ellipse(std::max(rx, ry)) + 3) / 4;
  for (int corner = 0; corner < 4; ++corner) {
    const glm::dvec2 center(corner == 1 || corner == 2 ? x + rx : x + w - rx,
                            corner >= 2 ? y + ry : y + h - ry);
    append_ellipse(center, {rx, 0}, {0, ry}, 90.0 * corner, 90, steps, chain.points);
  }
}

}  // namespace

std::optional<double> SvgLengths::find(const char* name) {
  // x1 and the like are no properties.
  const std::string* const styled =
      is_any_of(name, {"x", "y", "width", "height", "rx", "ry", "cx", "cy", "r"})
          ? own_.declared(name)
          : nullptr;
  const pugi::xml_attribute attribute = node_.attribute(name);
  if (styled == nullptr && !attribute) return std::nullopt;
  const std::string text = styled != nullptr ? *styled : trimmed(attribute.value());
  if (is_any_of(css_lower(text), {"auto", "initial", "unset"})) return std::nullopt;
  const std::string_view side(name);
  const bool across = side == "width" || side.find('x') != side.npos;
  const bool along = side == "height" || side.find('y') != side.npos;
  const double whole = across ? units_.viewport.x : along ? units_.viewport.y : units_.diagonal();
  const std::optional<double> length = units_.length(text, whole);
  const bool is_size = is_any_of(side, {"width", "height", "rx", "ry", "r"});
  if (length && !(is_size && *length < 0)) return length;
  if (!fault_) {
    const bool no_page = text.ends_with('%') && !(whole > 0);
    fault_ = Fault{name, "got " + csgrun::quoted(text) +
                             (length    ? ", which must not be negative"
                              : no_page ? ", but the page has no size"
                                        : std::string(", ") + kSvgLengthExpected)};
  }
  return std::nullopt;
}

SvgOutline svg_outline(const pugi::xml_node& node, const std::string& kind,
                       const SvgElementStyle& own, SvgLengths& lengths, const SvgSteps& steps) {
  SvgOutline outline;
  if (kind == "path") {
    const std::string* const styled = own.declared("d");
    const std::string_view data = styled != nullptr ? without_wrapper(*styled)
                                                    : std::string_view(node.attribute("d").value());
    bool good = true;
    size_t mistake = 0;
    outline.chains = parse_svg_path(data, steps, good, &mistake);
    if (!good) outline.damage = data.substr(std::min(mistake, data.size()));
    if (!good && outline.damage.empty()) outline.damage = "(the end)";
  } else if (kind == "rect") {
    add_rectangle(lengths, steps, outline);
  } else if (kind == "circle" || kind == "ellipse") {
    add_ellipse(lengths, steps, kind == "circle", outline);
  } else if (kind == "line") {
    const glm::dvec2 from(lengths.get("x1"), lengths.get("y1"));
    const glm::dvec2 to(lengths.get("x2"), lengths.get("y2"));
    outline.chains.push_back({{from, to}, false});
  } else if (kind == "polyline" || kind == "polygon") {
    const std::string_view text = node.attribute("points").value();
    size_t mistake = 0;
    Chain& chain = outline.chains.emplace_back();
    chain.points = parse_svg_points(text, mistake);
    chain.closed = kind == "polygon";
    outline.damage = text.substr(mistake);
  } else {
    outline.known = false;
  }
  return outline;
}

double svg_length_of(const std::vector<Chain>& chains) {
  double length = 0;
  for (const Chain& chain : chains) {
    const std::vector<glm::dvec2>& p = chain.points;
    for (size_t i = 1; i < p.size(); ++i) length += glm::length(p[i] - p[i - 1]);
    if (chain.closed && !p.empty()) length += glm::length(p.front() - p.back());
  }
  return length;
}

}  // namespace csgrun
