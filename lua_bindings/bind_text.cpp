// text, text3d, text_metrics, font_metrics.
#include <algorithm>
#include <array>
#include <iterator>

#include <csgrun/primitives/shape2d.h>
#include <csgrun/primitives/text.h>

#include "lua_bindings/api.h"
#include "lua_bindings/call_site.h"
#include "lua_bindings/guard.h"
#include "lua_bindings/session.h"

namespace csgrun {
namespace {

using T = ArgumentType;

constexpr Option kTextOptions[] = {
    {"text", T::kString, "", "in UTF-8; a newline begins a line", true},
    {"size", T::kNumber, "10", "height of capitals, roughly; the em is size / 0.72", true,
     Range::kPositive},
    {"font", T::kString, "\"Liberation Sans\"",
     "a font file beside the model (.ttf, .otf), or a family: \"Liberation Sans:style=Bold\";\n"
     "          behind either its features: \"Liberation Sans:fontfeatures=-kern;-liga\"",
     true},
    {"em", T::kNumber, "", "the em itself, instead of size", false, Range::kPositive},
    {"halign", T::kString, "\"left\"",
     "\"left\", \"center\" or \"right\", by advance width; in ttb and btt by the ink", false},
    {"valign", T::kString, "\"baseline\"",
     "\"baseline\", \"bottom\", \"center\" or \"top\", by the ink; in ttb and btt by advance",
     false},
    {"spacing", T::kNumber, "1", "factor of the distances of characters", false},
    {"line_spacing", T::kNumber, "1", "factor of the distance of lines, which the font has", false,
     Range::kPositive},
    {"direction", T::kString, "that of the script", "\"ltr\", \"rtl\", \"ttb\" or \"btt\"", false},
    {"language", T::kString, "\"en\"", "language, for the font's rules", false},
    {"script", T::kString, "that of the characters",
     "script: \"latin\", \"arabic\" ..., or a code: \"Latn\"", false},
    {"as_openscad", T::kBoolean, "false",
     "rounded as in OpenSCAD: letters 6e-5 smaller, ink aligned to within 6e-4 of the size", false},
};
constexpr FunctionSpec kText{"text", "Text as a 2D shape: one line or several.", kTextOptions, true,
                             "text(\"csgrun\", {size = 8, halign = \"center\"})"};
constexpr auto kText3dOptions = [] {
  std::array<Option, std::size(kTextOptions) + 2> options{};
  std::copy(std::begin(kTextOptions), std::end(kTextOptions), options.begin());
  options.end()[-2] = {"depth", T::kNumber, "1", "how thick, along Z", false, Range::kPositive};
  options.back() = {"height", T::kNumber,       "1", "the same, as linear_extrude calls it",
                    false,    Range::kPositive, "h"};
  return options;
}();
constexpr FunctionSpec kText3d{"text3d", "Text as a solid: one line or several.", kText3dOptions,
                               true, "text3d(\"csgrun\", {size = 8, depth = 2})"};
constexpr FunctionSpec kTextMetrics{"text_metrics",
                                    "What text would measure: {position, size, ascent, descent, "
                                    "offset, advance}, in mm. Of several "
                                    "lines: of all, above and below the first baseline.",
                                    kTextOptions, true,
                                    "text_metrics(\"csgrun\", {size = 8}).size[1]"};
constexpr FunctionSpec kTextmetrics{"textmetrics", "OpenSCAD's name of text_metrics.", kTextOptions,
                                    true, "textmetrics(\"csgrun\").advance[1]"};

constexpr Option kFontMetricsOptions[] = {kTextOptions[1], kTextOptions[2], kTextOptions[3]};
constexpr FunctionSpec kFontMetrics{
    "font_metrics",
    "What a font measures: {nominal = {ascent, descent}, max = {ascent, descent}, interline, font "
    "= "
    "{family, style}}, in mm: what it keeps for a line, its tallest and deepest glyph, from a "
    "baseline to the next.",
    kFontMetricsOptions, false, "font_metrics(10).interline"};
constexpr FunctionSpec kFontmetrics{
    "fontmetrics", "OpenSCAD's name of font_metrics.", kFontMetricsOptions, false,
    "fontmetrics(10, \"Liberation Sans:style=Bold\").nominal.ascent"};

/// The size of text as OpenSCAD counts it.
double size_of(const Arguments& arguments, const FunctionSpec& spec) {
  if (arguments.has("em") && arguments.has("size"))
    fail_in(spec, "give either 'size' or 'em', not both");
  return arguments.has("em") ? arguments.number("em", 0) * 0.72 : arguments.number("size", 10);
}

TextOptions text_options(const Arguments& arguments, const FunctionSpec& spec) {
  if (!arguments.has("text")) fail_in(spec, "needs a text");
  TextOptions options;
  options.text = arguments.string("text", "");
  options.lines = true;
  options.line_spacing = arguments.number("line_spacing", 1);
  options.size = size_of(arguments, spec);
  options.halign = arguments.string("halign", "default");
  options.valign = arguments.string("valign", "default");
  options.spacing = arguments.number("spacing", 1);
  options.direction = arguments.string("direction", "");
  options.language = arguments.string("language", "en");
  options.script = arguments.string("script", "");
  options.as_openscad_rounds = arguments.boolean("as_openscad", false);
  options.facets = arguments.facets();
  FontFeatures font = split_font_features(arguments.string("font", ""));
  if (!font.note.empty()) fail_in(spec, font.note);
  options.features = std::move(font.features);
  return options;
}

Font font_of(lua_State* L, const Arguments& arguments, const FunctionSpec& spec) {
  Session& session = session_of(L);
  const std::string name = split_font_features(arguments.string("font", "")).font;
  if (is_font_path(name)) {
    try {
      const Files::Opened file = session.files().open(calling_file(L), name);
      return value_or_fail(spec, Font::parse(file.display, file.bytes));
    } catch (const ScriptError& error) {
      fail_in(spec, error.what());
    }
  }
  FontChoice choice = value_or_fail(spec, session.fonts().find(name));
  if (!choice.note.empty()) session.warn(L, std::string(spec.name) + ": " + choice.note);
  return choice.font;
}

int text(lua_State* L) {
  const Arguments arguments(L, kText, 1);
  const TextOptions options = text_options(arguments, kText);
  std::string note;
  Shape2D shape = value_or_fail(kText, make_text(options, font_of(L, arguments, kText), &note));
  if (!note.empty()) session_of(L).warn(L, note);
  push_shape(L, std::move(shape), {});
  return 1;
}

int text3d(lua_State* L) {
  const Arguments arguments(L, kText3d, 1);
  const TextOptions options = text_options(arguments, kText3d);
  std::string note;
  const Shape2D shape =
      value_or_fail(kText3d, make_text(options, font_of(L, arguments, kText3d), &note));
  if (!note.empty()) session_of(L).warn(L, note);
  LinearExtrudeOptions extrusion;
  if (arguments.has("depth") && arguments.has("height"))
    fail_in(kText3d, "'depth' and 'height' are the same; give one of them");
  extrusion.height = arguments.number("height", arguments.number("depth", 1));
  extrusion.height_given = true;
  if (shape.empty()) {
    push_solid(L, Node::empty(session_of(L).source_ref(L)));  // a text of blanks
  } else {
    push_leaf(L, value_or_fail(kText3d, linear_extrude(shape, extrusion)));
  }
  return 1;
}

template <const FunctionSpec& Spec>
int text_metrics(lua_State* L) {
  const Arguments arguments(L, Spec, 1);
  const TextOptions options = text_options(arguments, Spec);
  const TextMetrics metrics =
      value_or_fail(Spec, measure_text(options, font_of(L, arguments, Spec)));
  lua_createtable(L, 0, 6);
  const auto set_list = [L](const char* name, const glm::dvec2& v) {
    push_list(L, {v.x, v.y});
    lua_setfield(L, -2, name);
  };
  set_list("position", metrics.position);
  set_list("size", metrics.size);
  set_list("offset", metrics.offset);
  set_list("advance", metrics.advance);
  lua_pushnumber(L, metrics.ascent);
  lua_setfield(L, -2, "ascent");
  lua_pushnumber(L, metrics.descent);
  lua_setfield(L, -2, "descent");
  return 1;
}

template <const FunctionSpec& Spec>
int font_metrics(lua_State* L) {
  const Arguments arguments(L, Spec, 1);
  const Font font = font_of(L, arguments, Spec);
  const FontMetrics metrics = value_or_fail(Spec, measure_font(size_of(arguments, Spec), font));
  lua_createtable(L, 0, 4);
  const auto set_pair = [L](const char* name, double ascent, double descent) {
    lua_createtable(L, 0, 2);
    lua_pushnumber(L, ascent);
    lua_setfield(L, -2, "ascent");
    lua_pushnumber(L, descent);
    lua_setfield(L, -2, "descent");
    lua_setfield(L, -2, name);
  };
  set_pair("nominal", metrics.ascent, metrics.descent);
  set_pair("max", metrics.max_ascent, metrics.max_descent);
  lua_pushnumber(L, metrics.interline);
  lua_setfield(L, -2, "interline");
  lua_createtable(L, 0, 2);
  lua_pushstring(L, font.family().c_str());
  lua_setfield(L, -2, "family");
  lua_pushstring(L, font.style().c_str());
  lua_setfield(L, -2, "style");
  lua_setfield(L, -2, "font");
  return 1;
}

constexpr Binding kTextBindings[] = {
    {&kText, guarded<text>, nullptr, nullptr},
    {&kText3d, guarded<text3d>, nullptr, nullptr},
    {&kTextMetrics, guarded<text_metrics<kTextMetrics>>, nullptr, nullptr},
    {&kTextmetrics, guarded<text_metrics<kTextmetrics>>, nullptr, nullptr},
    {&kFontMetrics, guarded<font_metrics<kFontMetrics>>, nullptr, nullptr},
    {&kFontmetrics, guarded<font_metrics<kFontmetrics>>, nullptr, nullptr},
};

}  // namespace

std::span<const Binding> text_bindings() { return kTextBindings; }

}  // namespace csgrun
