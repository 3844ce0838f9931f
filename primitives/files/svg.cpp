// SVG: the document is walked once, with the transform, the fill and the stroke of each element.
//
// Every element gives a shape of its own by its own fill rule, and the result is their union: the
// order of painting has no meaning for area. Sizes follow OpenSCAD: with a viewBox its width is the
// page's; else a user unit is 1 mm.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <optional>
#include <utility>

#include <pugixml.hpp>

#include <csgrun/primitives/flat_file.h>
#include <csgrun/primitives/shape_operations.h>

#include "primitives/base/text.h"
#include "primitives/files/drawn_shape.h"
#include "primitives/files/flat_formats.h"
#include "primitives/files/formats.h"
#include "primitives/files/svg_document.h"
#include "primitives/files/svg_path.h"
#include "primitives/files/svg_style_sheet.h"

namespace csgrun {
namespace {

constexpr double kMmPerInch = 25.4;
constexpr double kPxPerInch = 96;

/// The properties that say what is area.
bool is_heeded(std::string_view property) {
  constexpr std::string_view kHeeded[] = {
      "display",   "visibility",        "fill",         "fill-rule",
      "stroke",    "stroke-linecap",    "stroke-width", "stroke-linejoin",
      "clip-path", "stroke-miterlimit", "mask"};
  return std::find(std::begin(kHeeded), std::end(kHeeded), property) != std::end(kHeeded);
}

/// What an element hands down to those in it.
struct Style {
  std::string fill = "black", stroke = "none", fill_rule = "nonzero";
  std::string cap = "butt", join = "miter";
  double stroke_width = 1, mitre_limit = 4;
  bool visible = true;
  glm::dvec2 viewport{0, 0};  ///< what percentages are of, in user units; 0: not known
};

class SvgReader {
 public:
  SvgReader(const std::string& name, const FlatFileOptions& options)
      : name_(name), options_(options) {}

  Result<FlatFile> read(std::string_view bytes) {
    pugi::xml_document document;
    const Result<pugi::xml_node> parsed = parse_svg_document(name_, bytes, document);
    if (!parsed) return parsed.error();
    const pugi::xml_node root = *parsed;
    if (auto status = index(root); !status) return status.error();
    SvgMap map;
    Style style;
    if (auto status = page(root, map, style.viewport); !status) return status.error();
    read_style(root, style);
    const bool all = !options_.id && !options_.layer;
    for (const pugi::xml_node& child : root.children()) {
      if (child.type() != pugi::node_element) continue;
      if (auto status = element(child, map, style, all, 0); !status) return status.error();
      if (options_.parts && !shapes_.empty()) {
        std::vector<Shape2D>& part = part_named(name_of(child));
        part.insert(part.end(), shapes_.begin(), shapes_.end());
        shapes_.clear();
      }
    }
    if (!all && !found_) {
      return invalid_argument(name_ + ": there is no " +
                              (options_.id ? "element of id " + csgrun::quoted(*options_.id)
                                           : "layer " + csgrun::quoted(*options_.layer)));
    }
    FlatFile file;
    for (auto& [part, shapes] : parts_) {
      Result<Shape2D> shape = Shape2D::boolean(BooleanOp::kUnion, shapes);
      if (!shape) return shape.error();
      if (!shape->empty()) file.parts.push_back({part, *std::move(shape)});
    }
    Result<Shape2D> rest = Shape2D::boolean(BooleanOp::kUnion, shapes_);
    if (!rest) return rest.error();
    file.shape = *std::move(rest);
    for (const auto& [what, count] : left_out_) {
      file.notes.push_back(name_ + ": " + what + " left out (" + std::to_string(count) + ")");
    }
    return file;
  }

 private:
  std::vector<Shape2D>& part_named(const std::string& part) {
    for (auto& [known, shapes] : parts_) {
      if (known == part) return shapes;
    }
    return parts_.emplace_back(part, std::vector<Shape2D>()).second;
  }

  static std::string name_of(const pugi::xml_node& node) {
    for (const pugi::xml_node& child : node.children()) {
      if (svg_name(child) != "title") continue;
      const std::string title = trimmed(child.text().get());
      if (!title.empty()) return title;
    }
    const std::string label = node.attribute("inkscape:label").value();
    return label.empty() ? node.attribute("id").value() : label;
  }

  void leave_out(const std::string& what) { ++left_out_[what]; }

  /// Elements by id, for `use`; style sheets, which stand anywhere, are noted.
  Status index(const pugi::xml_node& root) {
    size_t count = 0;
    // In the order of the document, without recursion.
    for (pugi::xml_node node = root; node;) {
      if (node.type() == pugi::node_element) {
        if (++count > kMostSvgElements) return too_many_in_svg(name_, "elements", kMostSvgElements);
        if (const char* id = node.attribute("id").value(); *id != '\0') by_id_.emplace(id, node);
        if (svg_name(node) == "style") sheet_.add(text_of(node), is_heeded);
      }
      if (node.first_child()) {
        node = node.first_child();
        continue;
      }
      while (node && node != root && !node.next_sibling()) node = node.parent();
      node = !node || node == root ? pugi::xml_node() : node.next_sibling();
    }
    if (sheet_.unknown_rules() > 0) left_out_["rules of a <style>"] += sheet_.unknown_rules();
    return std::monostate();
  }

  /// Millimetres; percentages are of `whole`, in user units.
  std::optional<double> to_mm(const char* text, std::optional<double> whole) const {
    const auto length = parse_svg_length(text);
    if (!length) return std::nullopt;
    const double n = length->number;
    if (length->unit.empty()) return n * kMmPerInch / options_.dpi;
    if (length->unit == "mm") return n;
    if (length->unit == "cm") return n * 10;
    if (length->unit == "in") return n * kMmPerInch;
    if (length->unit == "pt") return n * kMmPerInch / 72;
    if (length->unit == "pc") return n * kMmPerInch / 6;
    if (length->unit == "px") return n * kMmPerInch / kPxPerInch;
    if (length->unit == "%" && whole) return n / 100 * *whole * kMmPerInch / options_.dpi;
    return std::nullopt;
  }

  /// A viewBox; empty when there is none.
  Result<std::vector<double>> view_box(const pugi::xml_node& node) const {
    const pugi::xml_attribute view = node.attribute("viewBox");
    if (!view) return std::vector<double>();
    auto box = parse_svg_numbers(view.value());
    if (box && box->size() == 4 && (*box)[2] > 0 && (*box)[3] > 0) return *std::move(box);
    return malformed(
        name_, "",
        "viewBox must be four numbers with a positive size, got " + csgrun::quoted(view.value()));
  }

  /// From a viewBox to a viewport at the origin, as preserveAspectRatio has it.
  static SvgMap fitted(const pugi::xml_node& node, const std::vector<double>& box,
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

  /// From user units to mm, with Y upwards.
  Status page(const pugi::xml_node& root, SvgMap& map, glm::dvec2& viewport) {
    const Result<std::vector<double>> view = view_box(root);
    if (!view) return view.error();
    const std::vector<double>& box = *view;
    const auto size = [&](const char* side, size_t i) -> Result<std::optional<double>> {
      const pugi::xml_attribute attribute = root.attribute(side);
      if (!attribute) return std::optional<double>();
      std::optional<double> whole;
      if (!box.empty()) whole = box[i];
      const std::optional<double> mm = to_mm(attribute.value(), whole);
      const bool percent = std::strchr(attribute.value(), '%') != nullptr;
      if (!mm && percent) return mm;
      if (!mm || !(*mm > 0) || !std::isfinite(*mm)) {
        return malformed(name_, "",
                         std::string(side) + " must be a positive length, got " +
                             csgrun::quoted(attribute.value()));
      }
      return mm;
    };
    const auto width = size("width", 2), height = size("height", 3);
    if (!width) return width.error();
    if (!height) return height.error();
    const double unit = kMmPerInch / options_.dpi;
    if (box.empty()) {
      const auto in_user_units = [&](const char* side) {
        const auto length = parse_svg_length(root.attribute(side).value());
        if (!length) return 0.0;
        const bool is_px = length->unit.empty() || length->unit == "px";
        return is_px ? length->number : to_mm(root.attribute(side).value(), {}).value_or(0);
      };
      viewport = {in_user_units("width"), in_user_units("height")};
      units_per_inch_ = kMmPerInch;
      map = {1, 0, 0, -1, 0, height->value_or(0)};
      return std::monostate();
    }
    viewport = {box[2], box[3]};
    if (width->has_value() || height->has_value()) units_per_inch_ = kPxPerInch;
    double sx = width->has_value() ? **width / box[2] : unit;
    double sy = height->has_value() ? **height / box[3] : unit;
    if (!width->has_value() && height->has_value()) sx = sy;
    if (width->has_value() && !height->has_value()) sy = sx;
    const glm::dvec2 paper(width->has_value() ? **width : sx * box[2],
                           height->has_value() ? **height : sy * box[3]);
    map = SvgMap{1, 0, 0, -1, 0, paper.y}.after(fitted(root, box, paper));
    return std::monostate();
  }

  /// What stands in a viewport of its own: an <svg>, or a <symbol> that is used. `user` is the
  /// <use> that may give it another size, or null.
  Status viewport(const pugi::xml_node& node, const pugi::xml_node& user, SvgMap map, Style style,
                  bool shown, int depth) {
    const Result<std::vector<double>> box = view_box(node);
    if (!box) return box.error();
    // As large as what it stands in, or, where that has no size, as its viewBox.
    const auto side = [&](const char* name, double whole, size_t i) {
      const bool by_user = user && user.attribute(name);
      if (!(whole > 0) && !box->empty()) whole = (*box)[i];
      return number(by_user ? user : node, name, style, whole);
    };
    const glm::dvec2 size(side("width", style.viewport.x, 2), side("height", style.viewport.y, 3));
    if (svg_name(node) == "svg")
      map = map.after({1, 0, 0, 1, number(node, "x", style), number(node, "y", style)});
    style.viewport = size;
    if (!box->empty()) {
      if (!(size.x > 0) || !(size.y > 0)) return std::monostate();
      map = map.after(fitted(node, *box, size));
      style.viewport = {(*box)[2], (*box)[3]};
    }
    return children(node, map, style, shown, depth + 1);
  }

  Status children(const pugi::xml_node& parent, const SvgMap& map, const Style& style, bool shown,
                  int depth) {
    for (const pugi::xml_node& child : parent.children()) {
      if (child.type() != pugi::node_element) continue;
      if (auto status = element(child, map, style, shown, depth); !status) return status;
    }
    return std::monostate();
  }

  /// Whether an element is the one asked for by id or layer.
  bool is_wanted(const pugi::xml_node& node) const {
    if (options_.id) return *options_.id == node.attribute("id").value();
    return options_.layer &&
           std::strcmp(node.attribute("inkscape:groupmode").value(), "layer") == 0 &&
           *options_.layer == node.attribute("inkscape:label").value();
  }

  Status element(const pugi::xml_node& node, const SvgMap& outer, const Style& inherited,
                 bool shown, int depth) {
    if (depth > kDeepestSvg) return too_deep_svg(name_);
    if (++elements_ > kMostSvgElements) return too_many_in_svg(name_, "elements", kMostSvgElements);
    if (sheet_.is_exhausted())
      return Error{ErrorCode::kLimit, name_ + ": too many rules of a <style> for its elements", {}};
    const std::string kind = svg_name(node);
    if (kind == "defs" || kind == "symbol" || kind == "clipPath" || kind == "mask" ||
        kind == "marker" || kind == "pattern" || kind == "style" || kind == "metadata" ||
        kind == "namedview" || kind == "title" || kind == "desc" || kind == "script") {
      // Where only one element is wanted, it may stand among the definitions.
      const bool look = !shown && (kind == "defs" || kind == "symbol");
      return look ? children(node, outer, inherited, false, depth + 1) : std::monostate();
    }
    SvgMap map = outer;
    if (const pugi::xml_attribute transform = node.attribute("transform")) {
      const auto inner = parse_svg_transform(transform.value());
      if (!inner) {
        return malformed(name_, "<" + kind + ">",
                         "no transform: " + csgrun::quoted(transform.value()));
      }
      map = outer.after(*inner);
    }
    Style style = inherited;
    read_style(node, style);
    const bool hidden = std::strcmp(node.attribute("display").value(), "none") == 0 ||
                        property(node, "display") == "none";
    if (hidden && !is_wanted(node)) return std::monostate();
    if (is_wanted(node)) shown = true;
    if (shown) found_ = true;
    for (const char* cut : {"clip-path", "mask"}) {
      const std::string by = property(node, cut);
      if (shown && !by.empty() && by != "none") leave_out(cut);
    }
    if (kind == "g" || kind == "a" || kind == "switch") {
      return children(node, map, style, shown, depth + 1);
    }
    if (kind == "svg") return viewport(node, {}, map, style, shown, depth);
    if (kind == "use") return use(node, map, style, shown, depth);
    if (!shown || !style.visible) return std::monostate();
    return draw(node, kind, map, style);
  }

  static std::string text_of(const pugi::xml_node& node) {
    std::string text;
    for (const pugi::xml_node& part : node.children()) text += part.value();
    return text;
  }

  Status use(const pugi::xml_node& node, const SvgMap& outer, const Style& style, bool shown,
             int depth) {
    if (!shown) return std::monostate();
    pugi::xml_attribute link = node.attribute("href");
    if (!link) link = node.attribute("xlink:href");
    const char* text = link.value();
    if (*text != '#') {
      return malformed(name_, "<use>",
                       "only elements of the same file can be used, got " + csgrun::quoted(text));
    }
    const auto target = by_id_.find(text + 1);
    if (target == by_id_.end()) {
      leave_out("a <use> of " + csgrun::quoted(text) + ", which is not there,");
      return std::monostate();
    }
    const SvgMap map =
        outer.after({1, 0, 0, 1, number(node, "x", style), number(node, "y", style)});
    const std::string kind = svg_name(target->second);
    if (kind == "symbol" || kind == "svg") {
      if (depth > kDeepestSvg) return too_deep_svg(name_);
      Style own = style;
      read_style(target->second, own);
      return viewport(target->second, node, map, own, shown, depth);
    }
    return element(target->second, map, style, shown, depth + 1);
  }

  /// A property of the attribute `style`, of the style sheets, or an attribute of that name.
  std::string property(const pugi::xml_node& node, const std::string& name) const {
    const std::string styled = svg_style(node, name);
    if (!styled.empty()) return styled;
    const std::string by_rule = sheet_.property(node, name);
    if (!by_rule.empty()) return by_rule;
    return trimmed(node.attribute(name.c_str()).value());
  }

  void read_style(const pugi::xml_node& node, Style& style) const {
    const auto take = [&](const char* name, std::string& value) {
      const std::string given = property(node, name);
      if (!given.empty() && given != "inherit") value = given;
    };
    take("fill", style.fill);
    take("stroke", style.stroke);
    take("fill-rule", style.fill_rule);
    take("stroke-linecap", style.cap);
    take("stroke-linejoin", style.join);
    std::string text;
    take("stroke-width", text);
    if (const auto width = parse_svg_length(text))
      style.stroke_width = user_units(*width, diagonal(style.viewport));
    text.clear();
    take("stroke-miterlimit", text);
    if (const auto limit = parse_svg_length(text)) style.mitre_limit = limit->number;
    text.clear();
    take("visibility", text);
    if (!text.empty()) style.visible = text == "visible";
  }

  /// User units; `whole` is what percentages are of.
  [[nodiscard]] double user_units(const SvgLength& length, double whole) const {
    const auto& unit = length.unit;
    const double per_inch = unit == "mm"   ? 1 / kMmPerInch
                            : unit == "cm" ? 10 / kMmPerInch
                            : unit == "in" ? 1
                            : unit == "pt" ? 1 / 72.0
                            : unit == "pc" ? 1 / 6.0
                                           : 0;
    if (per_inch > 0) return length.number * per_inch * units_per_inch_;
    return unit == "%" && whole > 0 ? length.number / 100 * whole : length.number;
  }

  static double diagonal(const glm::dvec2& viewport) {
    return std::sqrt((viewport.x * viewport.x + viewport.y * viewport.y) / 2);
  }

  /// A length in user units.
  double number(const pugi::xml_node& node, std::string_view name, const Style& style,
                double otherwise = 0) const {
    const auto length = parse_svg_length(node.attribute(name.data()).value());
    if (!length) return otherwise;
    const bool across = name == "width" || name.find('x') != name.npos;
    const bool along = name == "height" || name.find('y') != name.npos;
    return user_units(*length, across  ? style.viewport.x
                               : along ? style.viewport.y
                                       : diagonal(style.viewport));
  }

  Status draw(const pugi::xml_node& node, const std::string& kind, const SvgMap& map,
              const Style& style) {
    const SvgSteps steps{options_.facets, map.scale()};
    std::vector<Chain> chains;
    bool good = true;
    if (kind == "path") {
      chains = parse_svg_path(node.attribute("d").value(), steps, good);
    } else if (kind == "rect") {
      rectangle(node, style, steps, chains);
    } else if (kind == "circle" || kind == "ellipse") {
      const bool circle = kind == "circle";
      const double rx = number(node, circle ? "r" : "rx", style),
                   ry = circle ? rx : number(node, "ry", style);
      const glm::dvec2 center(number(node, "cx", style), number(node, "cy", style));
      if (rx > 0 && ry > 0) {
        Chain& chain = chains.emplace_back();
        chain.closed = true;
        append_ellipse(center, {rx, 0}, {0, ry}, 0, 360, steps.of_ellipse(std::max(rx, ry)),
                       chain.points);
      }
    } else if (kind == "line") {
      chains.push_back({{{number(node, "x1", style), number(node, "y1", style)},
                         {number(node, "x2", style), number(node, "y2", style)}},
                        false});
    } else if (kind == "polyline" || kind == "polygon") {
      const auto numbers = parse_svg_numbers(node.attribute("points").value());
      good = numbers.has_value();
      Chain chain;
      chain.closed = kind == "polygon";
      for (size_t i = 0; numbers && i + 1 < numbers->size(); i += 2)
        chain.points.emplace_back((*numbers)[i], (*numbers)[i + 1]);
      chains.push_back(std::move(chain));
    } else {
      if (kind == "text" || kind == "image" || kind == "foreignObject") leave_out("<" + kind + ">");
      return std::monostate();
    }
    if (!good) leave_out("the rest of a damaged <" + kind + ">");
    return add(chains, map, style);
  }

  void rectangle(const pugi::xml_node& node, const Style& style, const SvgSteps& curve_steps,
                 std::vector<Chain>& chains) const {
    const double x = number(node, "x", style), y = number(node, "y", style);
    const double w = number(node, "width", style), h = number(node, "height", style);
    if (!(w > 0) || !(h > 0)) return;
    double rx = number(node, "rx", style, -1), ry = number(node, "ry", style, -1);
    if (rx < 0) rx = ry;
    if (ry < 0) ry = rx;
    rx = std::clamp(rx, 0.0, w / 2);
    ry = std::clamp(ry, 0.0, h / 2);
    Chain& chain = chains.emplace_back();
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

  Status add(const std::vector<Chain>& chains, const SvgMap& map, const Style& style) {
    // Icons have a square of this kind behind them, which says how large they are. What is asked
    // for by its id is meant, as what is hidden is then.
    if (style.fill == "none" && style.stroke == "none" && !options_.id) {
      if (!chains.empty()) leave_out("an element without fill and stroke");
      return std::monostate();
    }
    std::vector<Shape2D::Loop> loops;
    for (const Chain& chain : chains) {
      Shape2D::Loop loop;
      for (const glm::dvec2& p : chain.points) loop.push_back(map.apply(p));
      points_ += loop.size();
      if (points_ > kMostDrawingPoints) return too_many_in_svg(name_, "points", kMostDrawingPoints);
      // An open line without a fill is area by its stroke only.
      const bool ends_meet = loop.size() > 2 && loop.front() == loop.back();
      if (!chain.closed && !ends_meet && (style.fill == "none" || loop.size() < 3)) {
        if (style.stroke == "none") continue;
        if (auto status = stroke(loop, map, style); !status) return status;
      } else if (loop.size() >= 3) {
        loops.push_back(std::move(loop));
      }
    }
    if (loops.empty()) return std::monostate();
    Result<Shape2D> shape =
        drawn_shape(loops, style.fill_rule == "evenodd" ? FillRule::kEvenOdd : FillRule::kNonZero);
    if (!shape) return Error{shape.error().code, name_ + ": " + shape.error().message, {}};
    shapes_.push_back(*std::move(shape));
    return std::monostate();
  }

  Status stroke(const Shape2D::Loop& line, const SvgMap& map, const Style& style) {
    StrokeOptions options;
    options.width = style.stroke_width * map.scale();
    options.cap = style.cap == "round"    ? StrokeCap::kRound
                  : style.cap == "square" ? StrokeCap::kSquare
                                          : StrokeCap::kButt;
    options.join = style.join == "round"   ? OffsetJoin::kRound
                   : style.join == "bevel" ? OffsetJoin::kBevel
                                           : OffsetJoin::kMitre;
    options.mitre_limit = style.mitre_limit;
    options.facets = options_.facets;
    Result<Shape2D> shape = stroke_shape(line, options);
    if (!shape) return Error{shape.error().code, name_ + ": " + shape.error().message, {}};
    points_ += line.size();
    shapes_.push_back(*std::move(shape));
    return std::monostate();
  }

  const std::string& name_;
  const FlatFileOptions& options_;
  std::map<std::string, pugi::xml_node, std::less<>> by_id_;
  std::vector<Shape2D> shapes_;  ///< that belong to no part yet
  std::vector<std::pair<std::string, std::vector<Shape2D>>> parts_;
  std::map<std::string, size_t> left_out_;
  SvgStyleSheet sheet_;
  /// The user units of an inch: a px is one of them, and where only a viewBox says how large the
  /// page is, there are `dpi`.
  double units_per_inch_ = options_.dpi;
  size_t elements_ = 0, points_ = 0;
  bool found_ = false;
};

}  // namespace

Result<FlatFile> parse_svg(const std::string& name, std::string_view bytes,
                           const FlatFileOptions& options) {
  return SvgReader(name, options).read(bytes);
}

}  // namespace csgrun
