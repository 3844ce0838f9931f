// SVG as OpenSCAD's import() draws it, for trees that OpenSCAD wrote.
//
// It is another drawing than that of SVG's specification (svg.cpp): nothing is inherited but
// transforms and visibility; what is not closed is the area of its stroke, whatever its fill; rules
// of filling are even-odd; elements that it does not know are as if they were not there, but for
// what is in them; only what stands in <defs> can be used.
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include <glm/common.hpp>
#include <pugixml.hpp>

#include <csgrun/primitives/flat_file.h>
#include <csgrun/primitives/shape_operations.h>

#include "primitives/base/text.h"
#include "primitives/files/drawn_shape.h"
#include "primitives/files/flat_formats.h"
#include "primitives/files/formats.h"
#include "primitives/files/svg_document.h"
#include "primitives/files/svg_path.h"

namespace csgrun {
namespace {

/// What an element hands down to those in it.
struct Around {
  SvgMap map;
  bool shown = false;
};

/// A number and nothing else; 0 for anything that is more.
double lone_number(const std::string& text) {
  const auto length = parse_svg_length(text);
  return length && length->unit.empty() ? length->number : 0;
}

double attribute(const pugi::xml_node& node, const char* name) {
  return lone_number(node.attribute(name).value());
}

/// Of six digits, as the path is written that a rounded rectangle becomes.
double of_six_digits(double value) {
  char text[32];
  const auto end = std::to_chars(text, text + sizeof text, value, std::chars_format::general, 6);
  double rounded = value;
  std::from_chars(text, end.ptr, rounded);
  return rounded;
}

class SvgTreeReader {
 public:
  SvgTreeReader(const std::string& name, const FlatFileOptions& options)
      : name_(name), options_(options) {}

  Result<FlatFile> read(std::string_view bytes) {
    pugi::xml_document document;
    const Result<pugi::xml_node> root = parse_svg_document(name_, bytes, document);
    if (!root) return root.error();
    if (auto status = look_through(*root); !status) return status.error();
    const bool all = !options_.id && !options_.layer;
    if (auto status = children(*root, {SvgMap(), all}, false, 0); !status) return status.error();
    return placed();
  }

 private:
  static bool is_known(const std::string& kind) {
    constexpr const char* kKnown[] = {"circle",   "ellipse", "g",    "line",  "path", "polygon",
                                      "polyline", "rect",    "text", "tspan", "use"};
    return std::find(std::begin(kKnown), std::end(kKnown), kind) != std::end(kKnown);
  }

  /// Notes the pages, what is asked for, and what can be used. In the order of the document,
  /// without recursion.
  Status look_through(const pugi::xml_node& root) {
    size_t count = 0, defs = 0, layers = 0;  // how many of those that are open
    for (pugi::xml_node node = root; node;) {
      if (node.type() == pugi::node_element) {
        if (++count > kMostSvgElements) return too_many_in_svg(name_, "elements", kMostSvgElements);
        order_.emplace(node.internal_object(), count);
        const std::string kind = svg_name(node);
        if (kind == "svg") pages_.push_back(node);
        layers += of_wanted_layer(node) ? 1 : 0;
        if (is_known(kind)) look_at(node, defs > 0, layers > 0);
        defs += kind == "defs" ? 1 : 0;
        if (node.first_child()) {
          node = node.first_child();
          continue;
        }
        leave(node, defs, layers);
      }
      while (node && node != root && !node.next_sibling()) {
        node = node.parent();
        leave(node, defs, layers);
      }
      node = !node || node == root ? pugi::xml_node() : node.next_sibling();
    }
    return std::monostate();
  }

  void leave(const pugi::xml_node& node, size_t& defs, size_t& layers) const {
    defs -= svg_name(node) == "defs" ? 1 : 0;
    layers -= of_wanted_layer(node) ? 1 : 0;
  }

  [[nodiscard]] bool of_wanted_layer(const pugi::xml_node& node) const {
    if (!options_.layer || !is_known(svg_name(node))) return false;
    const pugi::xml_attribute label = node.attribute("inkscape:label");
    return label && std::strcmp(node.attribute("inkscape:groupmode").value(), "layer") == 0 &&
           *options_.layer == label.value();
  }

  void look_at(const pugi::xml_node& node, bool in_defs, bool in_layer) {
    const pugi::xml_attribute id = node.attribute("id");
    if (in_defs && *id.value() != '\0') definitions_.emplace(id.value(), node);
    const bool wanted = options_.id
                            ? id && *options_.id == id.value() && (!options_.layer || in_layer)
                            : of_wanted_layer(node);
    if (wanted) wanted_.insert(node.internal_object());
  }

  Status children(const pugi::xml_node& parent, const Around& around, bool in_defs, int depth) {
    if (depth > kDeepestSvg) return too_deep_svg(name_);
    for (const pugi::xml_node& child : parent.children()) {
      if (child.type() != pugi::node_element) continue;
      if (auto status = element(child, around, in_defs, depth); !status) return status;
    }
    return std::monostate();
  }

  Status element(const pugi::xml_node& node, const Around& around, bool in_defs, int depth) {
    if (++elements_ > kMostSvgElements) return too_many_in_svg(name_, "elements", kMostSvgElements);
    const std::string kind = svg_name(node);
    if (kind == "defs") return children(node, around, true, depth + 1);
    if (kind == "image" || kind == "foreignObject") leave_out("<" + kind + ">");
    if (!is_known(kind)) return children(node, around, in_defs, depth + 1);
    Around own = around;
    std::string moves = node.attribute("transform").value();
    if (kind == "use") {
      moves += " translate(" + number_text(attribute(node, "x")) + " " +
               number_text(attribute(node, "y")) + ")";
    }
    if (const auto map = parse_svg_transform(moves)) {
      own.map = around.map.after(*map);
    } else {
      leave_out("a transform that is none");
    }
    const std::string display = svg_style(node, "display");
    const bool hidden =
        (display.empty() ? node.attribute("display").value() : display) == std::string("none");
    own.shown = wanted_.count(node.internal_object()) != 0 || (around.shown && !hidden);
    if (own.shown && !in_defs) {
      if (kind == "text") leave_out("<text>");
      if (auto status = draw(node, kind, own.map); !status) return status;
    }
    if (kind == "use" && !in_defs) {  // shown or not: what it names may be what is wanted
      if (auto status = use(node, own, depth); !status) return status;
    }
    const bool holds = kind == "g" || kind == "text" || kind == "tspan";
    return children(node, holds ? own : around, in_defs, depth + 1);
  }

  /// A use shows only what stands in <defs> before it.
  Status use(const pugi::xml_node& node, const Around& around, int depth) {
    pugi::xml_attribute link = node.attribute("href");
    if (*link.value() == '\0') link = node.attribute("xlink:href");
    const char* text = link.value();
    const auto target = *text == '#' ? definitions_.find(text + 1) : definitions_.end();
    if (target == definitions_.end() ||
        order_.at(target->second.internal_object()) > order_.at(node.internal_object())) {
      leave_out("a <use> of " + csgrun::quoted(text) + ", which no <defs> before it has,");
      return std::monostate();
    }
    return element(target->second, around, false, depth + 1);
  }

  Status draw(const pugi::xml_node& node, const std::string& kind, const SvgMap& map) {
    const SvgSteps steps{options_.facets, 1, true};
    std::vector<Chain> chains;
    bool good = true;
    if (kind == "path") {
      chains = parse_svg_path(node.attribute("d").value(), steps, good);
      close_where_it_is_filled(chains);
    } else if (kind == "rect") {
      chains.push_back(rectangle(node, steps));
    } else if (kind == "circle" || kind == "ellipse") {
      const double rx = attribute(node, kind == "circle" ? "r" : "rx");
      const double ry = kind == "circle" ? rx : attribute(node, "ry");
      Chain& chain = chains.emplace_back(Chain{{}, true});
      // From the Y axis on, towards X.
      append_ellipse({attribute(node, "cx"), attribute(node, "cy")}, {0, ry}, {rx, 0}, 0, 360,
                     steps.of_ellipse(std::max(rx, ry)), chain.points);
    } else if (kind == "line") {
      chains.push_back({{{attribute(node, "x1"), attribute(node, "y1")},
                         {attribute(node, "x2"), attribute(node, "y2")}},
                        false});
    } else if (kind == "polyline" || kind == "polygon") {
      const auto numbers = parse_svg_numbers(node.attribute("points").value());
      good = numbers.has_value();
      Chain& chain = chains.emplace_back(Chain{{}, kind == "polygon"});
      for (size_t i = 0; numbers && i + 1 < numbers->size(); i += 2)
        chain.points.emplace_back((*numbers)[i], (*numbers)[i + 1]);
    }
    if (!good) leave_out("the rest of a damaged <" + kind + ">");
    return add(node, chains, map);
  }

  /// Ends that almost meet are closed; so is what stands last in a path that was closed before.
  static void close_where_it_is_filled(std::vector<Chain>& chains) {
    constexpr double kAlmost = 0.1;
    bool closed_before = false;
    for (Chain& chain : chains) {
      closed_before |= chain.closed;
      if (chain.points.empty()) continue;
      const glm::dvec2 gap = chain.points.back() - chain.points.front();
      chain.closed |= gap.x * gap.x + gap.y * gap.y <= kAlmost * kAlmost;
    }
    if (closed_before) chains.back().closed = true;
  }

  static Chain rectangle(const pugi::xml_node& node, const SvgSteps& steps) {
    const double x = attribute(node, "x"), y = attribute(node, "y");
    const double w = attribute(node, "width"), h = attribute(node, "height");
    double rx = attribute(node, "rx"), ry = attribute(node, "ry");
    constexpr double kNothing = 1e-8;
    const bool has_rx = std::fabs(rx) >= kNothing, has_ry = std::fabs(ry) >= kNothing;
    if (!has_rx && !has_ry) return {{{x, y}, {x + w, y}, {x + w, y + h}, {x, y + h}}, true};
    rx = std::min(has_rx ? rx : ry, w / 2);
    ry = std::min(has_ry ? ry : rx, h / 2);
    Chain chain{{}, true};
    const double left = of_six_digits(x + rx), right = of_six_digits(x + w - rx);
    const double top = of_six_digits(y + ry), bottom = of_six_digits(y + h - ry);
    rx = of_six_digits(rx);
    ry = of_six_digits(ry);
    const int count = steps.of_arc(std::max(rx, ry), 90);
    for (int corner = 0; corner < 4; ++corner) {
      const glm::dvec2 center(corner == 0 || corner == 1 ? right : left,
                              corner == 1 || corner == 2 ? bottom : top);
      append_ellipse(center, {rx, 0}, {0, ry}, 90.0 * corner - 90, 90, count, chain.points);
    }
    return chain;
  }

  Status add(const pugi::xml_node& node, const std::vector<Chain>& chains, const SvgMap& map) {
    std::vector<Shape2D::Loop> loops;
    for (const Chain& chain : chains) {
      points_ += chain.points.size();
      if (points_ > kMostDrawingPoints) return too_many_in_svg(name_, "points", kMostDrawingPoints);
      if (chain.closed) {
        loops.push_back(chain.points);
        continue;
      }
      const Result<Shape2D> pen = stroke(node, chain.points);
      if (!pen) return Error{pen.error().code, name_ + ": " + pen.error().message, {}};
      for (const Shape2D::Loop& loop : pen->loops()) points_ += loop.size();
      loops.insert(loops.end(), pen->loops().begin(), pen->loops().end());
    }
    for (Shape2D::Loop& loop : loops) {
      for (glm::dvec2& point : loop) point = map.apply(point);
    }
    if (!loops.empty()) elements_of_drawing_.push_back(std::move(loops));
    return std::monostate();
  }

  /// The element's own pen, in user units: one that is thinner than 0.01 is 1 wide.
  static Result<Shape2D> stroke(const pugi::xml_node& node, const Shape2D::Loop& line) {
    const auto property = [&](const char* name) {
      const std::string given = node.attribute(name).value();
      return given.empty() ? svg_style(node, name) : given;
    };
    constexpr double kThinnest = 0.01;
    constexpr double kRound = 720;  // OpenSCAD has so many that the form is round
    StrokeOptions options;
    const double width = lone_number(property("stroke-width"));
    options.width = width < kThinnest ? 1 : width;
    const std::string cap = property("stroke-linecap"), join = property("stroke-linejoin");
    options.cap = cap == "round"    ? StrokeCap::kRound
                  : cap == "square" ? StrokeCap::kSquare
                                    : StrokeCap::kButt;
    options.join = join == "round"   ? OffsetJoin::kRound
                   : join == "bevel" ? OffsetJoin::kChamfer
                                     : OffsetJoin::kMitre;
    options.mitre_limit = 2;
    options.cut_square = true;
    options.facets.fn = kRound;
    return stroke_shape(line, options);
  }

  /// From user units to millimetres, with Y upwards.
  struct Page {
    glm::dvec2 scale{1, 1}, align{0, 0}, corner{0, 0};
    double height = 0;
  };

  /// Nothing where the text is no length in the units of SVG.
  [[nodiscard]] static std::optional<SvgLength> side_of(const pugi::xml_node& page,
                                                        const char* side) {
    const auto length = parse_svg_length(page.attribute(side).value());
    constexpr const char* kUnits[] = {"", "%", "em", "ex", "px", "in", "cm", "mm", "pt", "pc"};
    const bool known =
        length && std::find(std::begin(kUnits), std::end(kUnits), length->unit) != std::end(kUnits);
    return known ? length : std::nullopt;
  }

  [[nodiscard]] double millimetres(const std::optional<SvgLength>& side, double whole) const {
    constexpr double kInch = 25.4;
    if (!side) return kInch * whole / options_.dpi;
    const std::string_view unit = side->unit;
    const double n = side->number;
    if (unit.empty()) return kInch * n / options_.dpi;
    if (unit == "px") return kInch * n / 96;
    if (unit == "pt") return kInch * n / 72;
    if (unit == "pc") return kInch * n / 6;
    if (unit == "in") return kInch * n;
    if (unit == "cm") return 10 * n;
    if (unit == "mm") return n;
    return unit == "%" ? kInch * n / 100 * whole / options_.dpi : whole;  // em, ex
  }

  /// The last page of a file says how large it is, but for what only its viewBox could say.
  Page page() const {
    Page page;
    for (const pugi::xml_node& node : pages_) {
      const auto box = parse_svg_numbers(node.attribute("viewBox").value());
      const bool valid = box && box->size() == 4 && (*box)[2] > 0 && (*box)[3] > 0;
      const auto width = side_of(node, "width"), height = side_of(node, "height");
      const glm::dvec2 size(millimetres(width, valid ? (*box)[2] : 0),
                            millimetres(height, valid ? (*box)[3] : 0));
      page.height = size.y;
      if (!valid) continue;
      const auto part = [](const std::optional<SvgLength>& side) {
        return side && side->unit == "%" ? side->number / 100 : 1.0;
      };
      page.corner = {part(width) * (*box)[0], part(height) * (*box)[1]};
      page.scale = {size.x / (*box)[2], size.y / (*box)[3]};
      const std::string keep = node.attribute("preserveAspectRatio").as_string("xMidYMid");
      if (keep.find("none") != std::string::npos) continue;
      const bool slice = keep.find("slice") != std::string::npos;
      page.scale = glm::dvec2(slice ? std::max(page.scale.x, page.scale.y)
                                    : std::min(page.scale.x, page.scale.y));
      const auto aligned = [&](const char* low, const char* high, double rest) {
        return keep.find(low) != std::string::npos    ? 0.0
               : keep.find(high) != std::string::npos ? rest
                                                      : rest / 2;
      };
      page.align = {aligned("xMin", "xMax", size.x - page.scale.x * (*box)[2]),
                    aligned("YMin", "YMax", size.y - page.scale.y * (*box)[3])};
    }
    return page;
  }

  /// The middle of what is centred comes to lie where the corner of the viewBox is, turned over:
  /// that is what OpenSCAD does, and in the origin if that corner is.
  Result<FlatFile> placed() {
    const Page page = this->page();
    glm::dvec2 shift(page.align.x, page.height - page.align.y);
    if (options_.center && !elements_of_drawing_.empty()) {
      const auto [low, high] = extent();
      shift = glm::dvec2(-1, 1) * page.scale * (low + high) / 2.0;
    }
    std::vector<Shape2D> shapes;
    for (std::vector<Shape2D::Loop>& loops : elements_of_drawing_) {
      for (Shape2D::Loop& loop : loops) {
        for (glm::dvec2& p : loop) {
          p = {page.scale.x * (p.x - page.corner.x) + shift.x,
               page.scale.y * (-page.corner.y - p.y) + shift.y};
        }
      }
      Result<Shape2D> shape = drawn_shape(loops, FillRule::kEvenOdd);
      if (!shape) return Error{shape.error().code, name_ + ": " + shape.error().message, {}};
      shapes.push_back(*std::move(shape));
    }
    FlatFile file;
    Result<Shape2D> all = Shape2D::boolean(BooleanOp::kUnion, shapes);
    if (!all) return Error{all.error().code, name_ + ": " + all.error().message, {}};
    file.shape = *std::move(all);
    if (wanted_.empty() && (options_.id || options_.layer)) {
      std::string none = name_ + ": there is no ";
      none += options_.id ? "element of id " + csgrun::quoted(*options_.id) : "";
      none += options_.id && options_.layer ? " in a " : "";
      none += options_.layer ? "layer " + csgrun::quoted(*options_.layer) : "";
      file.notes.push_back(none);
    }
    for (const auto& [what, count] : left_out_) {
      file.notes.push_back(name_ + ": " + what + " left out (" + std::to_string(count) + ")");
    }
    return file;
  }

  [[nodiscard]] std::array<glm::dvec2, 2> extent() const {
    glm::dvec2 low(std::numeric_limits<double>::infinity()), high = -low;
    for (const std::vector<Shape2D::Loop>& loops : elements_of_drawing_) {
      for (const Shape2D::Loop& loop : loops) {
        for (const glm::dvec2& p : loop) {
          low = glm::min(low, p);
          high = glm::max(high, p);
        }
      }
    }
    return {low, high};
  }

  void leave_out(const std::string& what) { ++left_out_[what]; }

  const std::string& name_;
  const FlatFileOptions& options_;
  std::vector<pugi::xml_node> pages_;
  std::map<std::string, pugi::xml_node, std::less<>> definitions_;  ///< by id
  std::map<const void*, size_t> order_;                             ///< looked up only
  std::set<const void*> wanted_;                                    ///< by id or layer
  std::vector<std::vector<Shape2D::Loop>> elements_of_drawing_;     ///< in user units
  std::map<std::string, size_t> left_out_;
  size_t elements_ = 0, points_ = 0;
};

}  // namespace

Result<FlatFile> parse_svg_as_openscad(const std::string& name, std::string_view bytes,
                                       const FlatFileOptions& options) {
  return SvgTreeReader(name, options).read(bytes);
}

}  // namespace csgrun
