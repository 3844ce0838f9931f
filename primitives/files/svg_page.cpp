#include "primitives/files/svg_page.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "primitives/files/formats.h"
#include "primitives/files/svg_css.h"

namespace csgrun {
namespace {

constexpr double kPxPerInch = 96;

/// Millimetres; percentages are of `whole`, in user units.
std::optional<double> to_mm(const std::string& text, double whole, double dpi,
                            const SvgUnits& css) {
  const auto length = parse_svg_length(text);
  if (!length) return std::nullopt;
  const auto units = css.length(text, whole);
  if (!units) return std::nullopt;
  const bool of_user_units = length->unit.empty() || length->unit == "%";
  return *units * kMmPerInch / (of_user_units ? dpi : kPxPerInch);
}

}  // namespace

Result<std::vector<double>> svg_view_box(const std::string& name, const pugi::xml_node& node,
                                         const SvgNotes& notes) {
  const pugi::xml_attribute view = node.attribute("viewBox");
  if (!view) return std::vector<double>();
  auto box = parse_svg_numbers(view.value());
  if (box && box->size() == 4 && (*box)[2] > 0 && (*box)[3] > 0) return *std::move(box);
  return malformed(name, notes.place(node),
                   "<" + svg_name(node) +
                       ">: viewBox must be four numbers with a positive size, got " +
                       csgrun::quoted(view.value()));
}

SvgMap svg_fitted(const pugi::xml_node& node, const std::vector<double>& box,
                  const glm::dvec2& size) {
  double sx = size.x / box[2], sy = size.y / box[3];
  glm::dvec2 align(0);
  const std::string keep = node.attribute("preserveAspectRatio").as_string("xMidYMid");
  if (keep.find("none") == std::string::npos) {
    sx = sy = keep.find("slice") != std::string::npos ? std::max(sx, sy) : std::min(sx, sy);
    const auto part = [&](const char* low, const char* high) {
      return keep.find(low) != std::string::npos    ? 0.0
             : keep.find(high) != std::string::npos ? 1.0
                                                    : 0.5;
    };
    align = {part("xMin", "xMax") * (size.x - sx * box[2]),
             part("YMin", "YMax") * (size.y - sy * box[3])};
  }
  return {sx, 0, 0, sy, align.x - sx * box[0], align.y - sy * box[1]};
}

Result<SvgPage> svg_page(const std::string& name, const pugi::xml_node& root,
                         const SvgElementStyle& own, double dpi, SvgNotes& notes) {
  const Result<std::vector<double>> view = svg_view_box(name, root, notes);
  if (!view) return view.error();
  const std::vector<double>& box = *view;
  SvgPage page;
  // Of the size of the page an inch has 96 px, also where the drawing has another.
  SvgUnits css;
  if (const std::string size = own.property("font-size"); !size.empty()) css.set_font_size(size);
  css.rem = css.em.value_or(css.rem);
  const auto size = [&](const char* side, size_t i) -> Result<std::optional<double>> {
    const std::string* const styled = own.declared(side);
    if (styled != nullptr && css_lower(*styled) != "auto" && !styled->ends_with('%')) {
      notes.leave_out(root, std::string("a ") + side + " that CSS gives to the page",
                      "got " + csgrun::quoted(*styled) + ", expected it as an attribute");
    }
    const std::string text = trimmed(root.attribute(side).value());
    if (!root.attribute(side) || css_lower(text) == "auto") return std::optional<double>();
    const std::optional<double> mm = to_mm(text, box.empty() ? 0 : box[i], dpi, css);
    if (!mm && parse_svg_length(text) && text.ends_with('%')) return mm;
    if (!mm || !(*mm > 0) || !std::isfinite(*mm)) {
      return malformed(name, notes.place(root),
                       std::string("<svg>: ") + side + " must be a positive length, got " +
                           csgrun::quoted(text) + ", " + kSvgLengthExpected);
    }
    return mm;
  };
  const auto width = size("width", 2), height = size("height", 3);
  if (!width) return width.error();
  if (!height) return height.error();
  const double unit = kMmPerInch / dpi;
  if (box.empty()) {
    page.units = css;
    page.units.per_inch = kMmPerInch;  // a user unit is 1 mm
    const auto in_user_units = [&](const char* side) {
      return page.units.length(root.attribute(side).value(), 0).value_or(0);
    };
    page.units.viewport = {in_user_units("width"), in_user_units("height")};
    page.map = {1, 0, 0, -1, 0, height->value_or(0)};
    return page;
  }
  page.units.em = css.em;
  page.units.rem = css.rem;
  page.units.viewport = {box[2], box[3]};
  // A px is a user unit, and where only a viewBox says how large the page is, an inch has `dpi`.
  page.units.per_inch = width->has_value() || height->has_value() ? kPxPerInch : dpi;
  double sx = width->has_value() ? **width / box[2] : unit;
  double sy = height->has_value() ? **height / box[3] : unit;
  if (!width->has_value() && height->has_value()) sx = sy;
  if (width->has_value() && !height->has_value()) sy = sx;
  const glm::dvec2 paper(width->has_value() ? **width : sx * box[2],
                         height->has_value() ? **height : sy * box[3]);
  page.map = SvgMap{1, 0, 0, -1, 0, paper.y}.after(svg_fitted(root, box, paper));
  return page;
}

}  // namespace csgrun
