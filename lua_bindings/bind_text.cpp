// text, text3d, text_metrics.
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
    {"text", T::kString, "", "one line, in UTF-8", true},
    {"size", T::kNumber, "10", "height of capitals, roughly; the em is size / 0.72", true,
     Range::kPositive},
    {"font", T::kString, "\"Liberation Sans\"",
     "a font file beside the model (.ttf, .otf), or a family: \"Liberation Sans:style=Bold\"",
     true},
    {"em", T::kNumber, "", "the em itself, instead of size", false, Range::kPositive},
    {"halign", T::kString, "\"left\"", "\"left\", \"center\" or \"right\", by advance width",
     false},
    {"valign", T::kString, "\"baseline\"",
     "\"baseline\", \"bottom\", \"center\" or \"top\", by the ink", false},
    {"spacing", T::kNumber, "1", "factor of the distances of characters", false},
    {"direction", T::kString, "that of the script", "\"ltr\", \"rtl\", \"ttb\" or \"btt\"", false},
    {"language", T::kString, "\"en\"", "language, for the font's rules", false},
    {"script", T::kString, "that of the characters", "script: \"latin\", \"arabic\" ...", false},
};
constexpr FunctionSpec kText{"text", "A line of text as a 2D shape.", kTextOptions, true,
                             "text(\"csgrun\", {size = 8, halign = \"center\"})"};
constexpr auto kText3dOptions = [] {
  std::array<Option, std::size(kTextOptions) + 1> options{};
  std::copy(std::begin(kTextOptions), std::end(kTextOptions), options.begin());
  options.back() = {"depth", T::kNumber, "1", "how thick, along Z", false, Range::kPositive};
  return options;
}();
constexpr FunctionSpec kText3d{"text3d", "A line of text as a solid.", kText3dOptions, true,
                               "text3d(\"csgrun\", {size = 8, depth = 2})"};
constexpr FunctionSpec kTextMetrics{
    "text_metrics",
    "What text would measure: {position, size, ascent, descent, offset, advance}, in mm.",
    kTextOptions, true, "text_metrics(\"csgrun\", {size = 8}).size[1]"};
constexpr FunctionSpec kTextmetrics{"textmetrics", "OpenSCAD's name of text_metrics.", kTextOptions,
                                    true, "textmetrics(\"csgrun\").advance[1]"};

TextOptions text_options(const Arguments& arguments, const FunctionSpec& spec) {
  if (!arguments.has("text")) fail_in(spec, "needs a text");
  if (arguments.has("em") && arguments.has("size"))
    fail_in(spec, "give either 'size' or 'em', not both");
  TextOptions options;
  options.text = arguments.string("text", "");
  options.size =
      arguments.has("em") ? arguments.number("em", 0) * 0.72 : arguments.number("size", 10);
  options.halign = arguments.string("halign", "default");
  options.valign = arguments.string("valign", "default");
  options.spacing = arguments.number("spacing", 1);
  options.direction = arguments.string("direction", "");
  options.language = arguments.string("language", "en");
  options.script = arguments.string("script", "");
  options.facets = arguments.facets();
  return options;
}

Font font_of(lua_State* L, const Arguments& arguments, const FunctionSpec& spec) {
  Session& session = session_of(L);
  const std::string name = arguments.string("font", "");
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
  extrusion.height = arguments.number("depth", 1);
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

constexpr Binding kBindings[] = {
    {&kText, guarded<text>, nullptr, nullptr},
    {&kText3d, guarded<text3d>, nullptr, nullptr},
    {&kTextMetrics, guarded<text_metrics<kTextMetrics>>, nullptr, nullptr},
    {&kTextmetrics, guarded<text_metrics<kTextmetrics>>, nullptr, nullptr},
};

}  // namespace

std::span<const Binding> text_bindings() { return kBindings; }

}  // namespace csgrun
