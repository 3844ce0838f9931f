// SVG: the document is walked once, with the transform, the fill and the stroke of each element.
//
// Every element gives a shape of its own by its own fill rule, and the result is their union: the
// order of painting has no meaning for area. Sizes follow OpenSCAD: with a viewBox its width is the
// page's; else a user unit is 1 mm.
#include <algorithm>
#include <cstring>
#include <initializer_list>
#include <map>
#include <utility>

#include <pugixml.hpp>

#include <csgrun/primitives/flat_file.h>
#include <csgrun/primitives/shape_operations.h>

#include "primitives/base/text.h"
#include "primitives/files/drawn_shape.h"
#include "primitives/files/flat_formats.h"
#include "primitives/files/formats.h"
#include "primitives/files/svg_css.h"
#include "primitives/files/svg_document.h"
#include "primitives/files/svg_notes.h"
#include "primitives/files/svg_outline.h"
#include "primitives/files/svg_page.h"
#include "primitives/files/svg_path.h"
#include "primitives/files/svg_stroke.h"
#include "primitives/files/svg_style.h"
#include "primitives/files/svg_style_sheet.h"
#include "primitives/files/svg_transform.h"

namespace csgrun {
namespace {

bool is_one_of(const std::string& kind, std::initializer_list<std::string_view> kinds) {
  return std::find(kinds.begin(), kinds.end(), kind) != kinds.end();
}

/// Whether an element is for readers of English who know no extensions.
bool is_for_us(const pugi::xml_node& node) {
  if (node.attribute("requiredExtensions")) return false;
  const pugi::xml_attribute languages = node.attribute("systemLanguage");
  if (!languages) return true;
  const std::vector<std::string> words = css_words(css_lower(languages.value()));
  return std::any_of(words.begin(), words.end(), [](const std::string& word) {
    return word == "en" || word.starts_with("en-");
  });
}

class SvgReader {
 public:
  SvgReader(const std::string& name, const FlatFileOptions& options)
      : name_(name), options_(options) {}

  Result<FlatFile> read(std::string_view bytes) {
    pugi::xml_document document;
    const Result<pugi::xml_node> parsed = parse_svg_document(name_, bytes, document, &lines_);
    if (!parsed) return parsed.error();
    const pugi::xml_node root = *parsed;
    if (auto status = index(root); !status) return status.error();
    const SvgElementStyle own(root, sheet_);
    const Result<SvgPage> page = svg_page(name_, root, own, options_.dpi, notes_);
    if (!page) return page.error();
    px_ = kMmPerInch / page->units.per_inch;
    SvgStyle style;
    style.units = page->units;
    style.read(root, own, notes_);
    // On the root it turns the page in the window.
    const std::string turned = own.property("transform");
    if (!turned.empty() && turned != "none") notes_.leave_out(root, "a transform of the page");
    const bool all = !options_.id && !options_.layer;
    for (const pugi::xml_node& child : root.children()) {
      if (child.type() != pugi::node_element) continue;
      if (auto status = element(child, page->map, style, all, 0); !status) return status.error();
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
    file.notes = notes_.texts(name_);
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
    const std::string label = inkscape_attribute(node, "label").value();
    return label.empty() ? node.attribute("id").value() : label;
  }

  /// Elements by id, for `use`; style sheets, which stand anywhere, are noted.
  Status index(const pugi::xml_node& root) {
    size_t count = 0;
    // In the order of the document, without recursion.
    for (pugi::xml_node node = root; node;) {
      if (node.type() == pugi::node_element) {
        if (++count > kMostSvgElements) return too_many_in_svg(name_, "elements", kMostSvgElements);
        if (const char* id = node.attribute("id").value(); *id != '\0') by_id_.emplace(id, node);
        if (svg_name(node) == "style") {
          const size_t before = sheet_.unknown_rules();
          sheet_.add(text_of(node), is_svg_property);
          for (size_t i = before; i < sheet_.unknown_rules(); ++i)
            notes_.leave_out(node, "rules of a <style>");
        }
      }
      if (node.first_child()) {
        node = node.first_child();
        continue;
      }
      while (node && node != root && !node.next_sibling()) node = node.parent();
      node = !node || node == root ? pugi::xml_node() : node.next_sibling();
    }
    return std::monostate();
  }

  /// What stands in a viewport of its own: an <svg>, or a <symbol> that is used. `user` is the
  /// <use> that may give it another size, or null.
  Status viewport(const pugi::xml_node& node, const pugi::xml_node& user, SvgMap map,
                  SvgStyle style, bool shown, int depth) {
    const Result<std::vector<double>> box = svg_view_box(name_, node, notes_);
    if (!box) return box.error();
    const SvgElementStyle own(node, sheet_), own_of_user(user, sheet_);
    SvgLengths lengths(node, own, style.units), by_user(user, own_of_user, style.units);
    // As large as what it stands in, or, where that has no size, as its viewBox.
    const auto side = [&](const char* name, double whole, size_t i) {
      if (!(whole > 0) && !box->empty()) whole = (*box)[i];
      const auto length = user ? by_user.find(name) : std::nullopt;
      if (length) return *length;
      return lengths.get(name, whole);
    };
    const glm::dvec2 whole = style.units.viewport;
    const glm::dvec2 size(side("width", whole.x, 2), side("height", whole.y, 3));
    if (svg_name(node) == "svg") map = map.after({1, 0, 0, 1, lengths.get("x"), lengths.get("y")});
    if (shown && (leave_out_damaged(user, by_user) || leave_out_damaged(node, lengths)))
      return std::monostate();
    style.units.viewport = size;
    if (!box->empty()) {
      if (!(size.x > 0) || !(size.y > 0)) return std::monostate();
      map = map.after(svg_fitted(node, *box, size));
      style.units.viewport = {(*box)[2], (*box)[3]};
    }
    return children(node, map, style, shown, depth + 1);
  }

  /// Whether one of its lengths is at fault; it is noted then.
  bool leave_out_damaged(const pugi::xml_node& node, const SvgLengths& lengths) {
    const auto& fault = lengths.fault();
    if (fault)
      notes_.leave_out(node, "a <" + svg_name(node) + "> with a bad " + fault->name, fault->why);
    return fault.has_value();
  }

  Status children(const pugi::xml_node& parent, const SvgMap& map, const SvgStyle& style,
                  bool shown, int depth) {
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
           std::strcmp(inkscape_attribute(node, "groupmode").value(), "layer") == 0 &&
           *options_.layer == inkscape_attribute(node, "label").value();
  }

  Status element(const pugi::xml_node& node, const SvgMap& outer, const SvgStyle& inherited,
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
    const SvgElementStyle own(node, sheet_);
    const Result<SvgMap> inner = svg_transform_of(name_, node, own, inherited.units, notes_);
    if (!inner) return inner.error();
    const SvgMap map = outer.after(*inner);
    if (own.property("display") == "none" && !is_wanted(node)) return std::monostate();
    SvgStyle style = inherited;
    style.read(node, own, notes_);
    if (is_wanted(node)) shown = true;
    if (shown) found_ = true;
    if (shown && !is_for_us(node)) {
      notes_.leave_out(node, "an element for others, by systemLanguage or requiredExtensions,");
      return std::monostate();
    }
    for (const char* cut : {"clip-path", "mask"}) {
      const std::string by = own.property(cut);
      if (shown && !by.empty() && by != "none" && by != "initial") notes_.leave_out(node, cut);
    }
    if (kind == "g" || kind == "a") return children(node, map, style, shown, depth + 1);
    if (kind == "switch") return choice(node, map, style, shown, depth + 1);
    if (kind == "svg") return viewport(node, {}, map, style, shown, depth);
    if (kind == "use") return use(node, own, map, style, shown, depth);
    if (!shown || !style.visible) return std::monostate();
    return draw(node, kind, own, map, style);
  }

  /// The first element of a <switch> that can be shown to us. One that is asked for by its id may
  /// be any of them.
  Status choice(const pugi::xml_node& parent, const SvgMap& map, const SvgStyle& style, bool shown,
                int depth) {
    if (!shown) return children(parent, map, style, shown, depth);
    pugi::xml_node chosen;
    for (const pugi::xml_node& child : parent.children()) {
      const std::string kind = svg_name(child);
      if (child.type() != pugi::node_element || !is_for_us(child) ||
          !is_one_of(kind, {"g", "a", "svg", "use", "path", "rect", "circle", "ellipse", "line",
                            "polyline", "polygon", "switch", "text", "image", "foreignObject"})) {
        continue;
      }
      // Files have other elements behind a foreignObject, for those who cannot show it.
      if (!chosen || svg_name(chosen) == "foreignObject") chosen = child;
    }
    return chosen ? element(chosen, map, style, shown, depth) : std::monostate();
  }

  static std::string text_of(const pugi::xml_node& node) {
    std::string text;
    for (const pugi::xml_node& part : node.children()) text += part.value();
    return text;
  }

  Status use(const pugi::xml_node& node, const SvgElementStyle& own, const SvgMap& outer,
             const SvgStyle& style, bool shown, int depth) {
    if (!shown) return std::monostate();
    pugi::xml_attribute link = node.attribute("href");
    if (!link) link = xlink_href(node);
    const char* text = link.value();
    if (*text != '#') {
      return malformed(
          name_, notes_.place(node),
          link ? "<use>: only elements of the same file can be used, got " + csgrun::quoted(text)
               : "<use> has no href, expected \"#\" and the id of an element");
    }
    const auto target = by_id_.find(text + 1);
    if (target == by_id_.end()) {
      notes_.leave_out(node, "a <use> of " + csgrun::quoted(text) + ", which is not there,");
      return std::monostate();
    }
    SvgLengths lengths(node, own, style.units);
    const SvgMap map = outer.after({1, 0, 0, 1, lengths.get("x"), lengths.get("y")});
    if (leave_out_damaged(node, lengths)) return std::monostate();
    const std::string kind = svg_name(target->second);
    if (kind == "symbol" || kind == "svg") {
      if (depth > kDeepestSvg) return too_deep_svg(name_);
      SvgStyle inner = style;
      inner.read(target->second, SvgElementStyle(target->second, sheet_), notes_);
      return viewport(target->second, node, map, inner, shown, depth);
    }
    return element(target->second, map, style, shown, depth + 1);
  }

  Status draw(const pugi::xml_node& node, const std::string& kind, const SvgElementStyle& own,
              const SvgMap& map, const SvgStyle& style) {
    SvgLengths lengths(node, own, style.units);
    const SvgOutline outline =
        svg_outline(node, kind, own, lengths, {options_.facets, map.scale()});
    if (!outline.known) {
      if (is_one_of(kind, {"text", "image", "foreignObject"}))
        notes_.leave_out(node, "<" + kind + ">");
      return std::monostate();
    }
    if (leave_out_damaged(node, lengths)) return std::monostate();
    if (!outline.damage.empty()) {
      notes_.leave_out(node, "the rest of a damaged <" + kind + ">",
                       "from " + csgrun::quoted(outline.damage) + " on");
    }
    constexpr const char* kMarkers[] = {"marker-start", "marker-mid", "marker-end"};
    for (size_t i = 0; i < style.markers.size(); ++i) {
      if (style.markers[i] && is_one_of(kind, {"path", "line", "polyline", "polygon"}))
        notes_.leave_out(node, kMarkers[i]);
    }
    return add(node, own, outline.chains, map, style);
  }

  Status add(const pugi::xml_node& node, const SvgElementStyle& own,
             const std::vector<Chain>& chains, const SvgMap& map, const SvgStyle& style) {
    // Icons have a square of this kind behind them, which says how large they are. What is asked
    // for by its id is meant, as what is hidden is then.
    if (!style.is_filled() && !style.is_stroked() && !options_.id) {
      if (!chains.empty()) notes_.leave_out(node, "an element without fill and stroke");
      return std::monostate();
    }
    if (map.is_flat()) return std::monostate();
    const SvgPen pen = pen_of(node, own, chains, style);
    std::vector<Shape2D::Loop> loops;
    for (const Chain& chain : chains) {
      const Shape2D::Loop& line = chain.points;
      points_ += line.size();
      if (points_ > kMostDrawingPoints) return too_many_in_svg(name_, "points", kMostDrawingPoints);
      // An open line without a fill is area by its stroke only.
      const bool ends_meet = line.size() > 2 && line.front() == line.back();
      if (!chain.closed && !ends_meet && (!style.is_filled() || line.size() < 3)) {
        if (!style.is_stroked()) continue;
        if (auto status = stroke_svg_line(line, map, pen, shapes_, points_); !status)
          return in_file(status.error());
      } else if (line.size() >= 3) {
        Shape2D::Loop& loop = loops.emplace_back();
        for (const glm::dvec2& p : line) loop.push_back(map.apply(p));
      }
    }
    if (loops.empty()) return std::monostate();
    Result<Shape2D> shape =
        drawn_shape(loops, style.fill_rule == "evenodd" ? FillRule::kEvenOdd : FillRule::kNonZero);
    if (!shape) return in_file(shape.error());
    shapes_.push_back(*std::move(shape));
    return std::monostate();
  }

  [[nodiscard]] Error in_file(const Error& error) const {
    return Error{error.code, name_ + ": " + error.message, {}};
  }

  SvgPen pen_of(const pugi::xml_node& node, const SvgElementStyle& own,
                const std::vector<Chain>& chains, const SvgStyle& style) {
    SvgPen pen;
    pen.stroke.width = style.stroke_width;
    pen.stroke.cap = style.cap == "round"    ? StrokeCap::kRound
                     : style.cap == "square" ? StrokeCap::kSquare
                                             : StrokeCap::kButt;
    pen.stroke.join = style.join == "round"   ? OffsetJoin::kRound
                      : style.join == "bevel" ? OffsetJoin::kBevel
                                              : OffsetJoin::kMitre;
    pen.stroke.mitre_limit = style.mitre_limit;
    pen.stroke.facets = options_.facets;
    const std::string effect = own.property("vector-effect");
    if (effect == "non-scaling-stroke") {
      pen.fixed_unit = px_;
    } else if (!effect.empty() && effect != "none" && effect != "initial") {
      notes_.leave_out(node, "a vector-effect",
                       "got " + csgrun::quoted(effect) + ", expected non-scaling-stroke or none");
    }
    pen.dashes = style.dashes;
    pen.dash_offset = style.dash_offset;
    if (pen.dashes.empty()) return pen;
    // Where the author says how long the path is, dashes are in his measure.
    const auto said = parse_svg_length(node.attribute("pathLength").value());
    if (!said || !said->unit.empty() || !(said->number > 0)) return pen;
    const double factor = svg_length_of(chains) / said->number;
    for (double& dash : pen.dashes) dash *= factor;
    pen.dash_offset *= factor;
    return pen;
  }

  const std::string& name_;
  const FlatFileOptions& options_;
  std::map<std::string, pugi::xml_node, std::less<>> by_id_;
  std::vector<Shape2D> shapes_;  ///< that belong to no part yet
  std::vector<std::pair<std::string, std::vector<Shape2D>>> parts_;
  SvgLines lines_;
  SvgNotes notes_{lines_};
  SvgStyleSheet sheet_;
  double px_ = 1;  ///< the mm of a px on the page
  size_t elements_ = 0, points_ = 0;
  bool found_ = false;
};

}  // namespace

Result<FlatFile> parse_svg(const std::string& name, std::string_view bytes,
                           const FlatFileOptions& options) {
  return SvgReader(name, options).read(bytes);
}

}  // namespace csgrun
