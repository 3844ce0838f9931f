// color, setcolor, material: what faces look like.
//
// A colour and a material are independent of one another: each leaves what the other has set.
#include <functional>

#include <fmt/format.h>

#include "lua_bindings/api.h"
#include "lua_bindings/colors.h"
#include "lua_bindings/guard.h"
#include "lua_bindings/nearest.h"
#include "lua_bindings/repaint.h"
#include "lua_bindings/session.h"

namespace csgrun {
namespace {

using T = ArgumentType;

constexpr Option kColorOptions[] = {
    {"c", T::kColor, "",
     "name, '#rrggbb', '#rrggbbaa', or red, green, blue (and alpha) from 0 to 1", true},
    {"alpha", T::kNumber, "1", "opacity, 0 to 1", true, Range::kNotNegative},
    {"metallic", T::kNumber, "0", "0 to 1", false, Range::kNotNegative},
    {"roughness", T::kNumber, "0.6", "0 to 1", false, Range::kNotNegative},
    {"name", T::kString, "", "name of the material", false},
};
constexpr const char* kColoredDoc = "a solid or a shape; part:color(...) leaves it out";
constexpr FunctionSpec kColor{
    "color",
    "Paints every face; of several colours the outermost counts. The material stays.",
    kColorOptions,
    false,
    "part:color('steelblue', 0.5)",
    "part",
    kColoredDoc};
constexpr FunctionSpec kSetcolor{"setcolor",
                                 "Paints every face: another name of color.",
                                 kColorOptions,
                                 false,
                                 "part:setcolor(\"red\")",
                                 "part",
                                 kColoredDoc};

/// A fraction from 0 to 1.
float fraction(const FunctionSpec& spec, const char* name, double x) {
  if (!(x >= 0 && x <= 1))
    fail_in(spec, fmt::format("'{}' must be from 0 to 1, got {:.14g}", name, x));
  return static_cast<float>(x);
}

void read_color(lua_State* L, const FunctionSpec& spec, int index, Appearance& appearance) {
  if (lua_type(L, index) == LUA_TSTRING) {
    const std::string name = lua_tostring(L, index);
    const auto color = parse_color(name);
    if (!color) fail_in(spec, "there is no colour '" + name + "'" + color_hint(name));
    appearance.red = (*color)[0];
    appearance.green = (*color)[1];
    appearance.blue = (*color)[2];
    appearance.alpha = (*color)[3];
    return;
  }
  const lua_Integer length = lua_istable(L, index) ? list_length(L, index) : -1;
  if (length != 3 && length != 4) {
    fail_in(spec,
            "option 'c' must be " + describe_type(T::kColor) + ", got " + describe_value(L, index));
  }
  float* const channels[] = {&appearance.red, &appearance.green, &appearance.blue,
                             &appearance.alpha};
  for (lua_Integer i = 0; i < length; ++i) {
    if (lua_rawgeti(L, index, i + 1) != LUA_TNUMBER) {
      fail_in(spec, "option 'c' must be " + describe_type(T::kColor) + "; one entry is " +
                        describe_value(L, -1));
    }
    *channels[i] = fraction(spec, "c", lua_tonumber(L, -1));
    lua_pop(L, 1);
  }
}

/// Pushes the solid or shape at index 1 with its appearances changed, and its marks.
/// `wholly`: the same for whatever it was before.
void push_changed(lua_State* L, const std::function<Appearance(const Appearance&)>& change,
                  bool wholly) {
  if (const SolidValue* solid = to_solid(L, 1)) {
    push_solid(L, wholly ? Node::painted(change({}), solid->node, session_of(L).source_ref(L))
                         : repaint(solid->node, change));
  } else {
    const ShapeValue& shape = *to_shape(L, 1);
    push_shape(L, shape.shape, change(shape.appearance.value_or(Appearance{})));
  }
  keep_marks(L, 1);
}

/// color{r = 1, g = 0, b = 0}: says how that is written.
void refuse_named_channels(lua_State* L, const FunctionSpec& spec) {
  const int last = lua_gettop(L);
  if (!lua_istable(L, last)) return;
  std::string list;
  for (const char* channel : {"r", "g", "b"}) {
    lua_pushstring(L, channel);
    if (lua_rawget(L, last) != LUA_TNUMBER) return lua_settop(L, last);
    list += (list.empty() ? "" : ", ") + describe_value(L, -1);
  }
  fail_in(spec, fmt::format("red, green and blue are a list: {}{{{}}}", spec.name, list));
}

template <const FunctionSpec& Spec>
int color(lua_State* L) {
  part_argument(L, Spec);
  refuse_named_channels(L, Spec);
  // color(part, r, g, b): three numbers stand for the list.
  if (lua_gettop(L) >= 4 && lua_type(L, 2) == LUA_TNUMBER && lua_type(L, 3) == LUA_TNUMBER &&
      lua_type(L, 4) == LUA_TNUMBER) {
    push_list(L, {lua_tonumber(L, 2), lua_tonumber(L, 3), lua_tonumber(L, 4)});
    lua_replace(L, 2);
    lua_remove(L, 4);
    lua_remove(L, 3);
  }
  const Arguments arguments(L, Spec, 2);
  if (!arguments.has("c")) fail_in(Spec, "needs a colour");
  Appearance painted;
  painted.is_default = false;
  read_color(L, Spec, arguments.stack_index("c"), painted);
  painted.alpha =
      fraction(Spec, "alpha", arguments.number("alpha", static_cast<double>(painted.alpha)));
  const bool has_metallic = arguments.has("metallic"), has_roughness = arguments.has("roughness"),
             has_name = arguments.has("name");
  if (has_metallic) painted.metallic = fraction(Spec, "metallic", arguments.number("metallic", 0));
  if (has_roughness)
    painted.roughness = fraction(Spec, "roughness", arguments.number("roughness", 0));
  painted.name = arguments.string("name", "");
  Session& session = session_of(L);
  // Where no material was ever set, there is none to be kept: one node is enough.
  const bool wholly = !session.has_materials || (has_metallic && has_roughness && has_name);
  session.has_materials |= has_metallic || has_roughness || has_name;
  push_changed(
      L,
      [&](const Appearance& before) {
        Appearance after = painted;
        if (!has_metallic) after.metallic = before.metallic;
        if (!has_roughness) after.roughness = before.roughness;
        if (!has_name) after.name = before.name;
        return after;
      },
      wholly);
  return 1;
}

/// Names of materials that scripts use, as metallic and roughness of glTF.
struct Preset {
  const char* name;
  float metallic, roughness;
  const char* color;  ///< of faces without a colour; empty: they stay without
};
constexpr Preset kPresets[] = {
    {"matte", 0, 1, ""},
    {"plastic", 0, 0.27F, ""},
    {"metal", 1, 0.25F, ""},
    {"glass", 0, 0, ""},
    {"emissive", 0, 1, ""},
    {"steel", 1, 0.35F, "#9ea0a6"},
    {"chrome", 1, 0.05F, "#d9d9d9"},
    {"gold", 1, 0.25F, "#ffd66b"},
    {"copper", 1, 0.3F, "#f2a389"},
    {"brass", 1, 0.3F, "#e8c76b"},
    {"rubber", 0, 0.7F, "#262626"},
    {"wood", 0, 0.5F, "#a67c52"},
    {"ivory", 0, 0.2F, "#f2ecda"},
};

constexpr Option kMaterialOptions[] = {
    {"kind", T::kString, "\"plastic\"",
     "\"matte\", \"plastic\", \"metal\", \"glass\", \"emissive\", \"steel\", \"chrome\", "
     "\"gold\",\n          \"copper\", \"brass\", \"rubber\", \"wood\" or \"ivory\"",
     true},
    {"metallic", T::kNumber, "the kind's", "0 to 1", false, Range::kNotNegative},
    {"roughness", T::kNumber, "the kind's", "0 to 1", false, Range::kNotNegative},
    {"name", T::kString, "the kind", "name of the material", false},
    {"specular", T::kNumber, "", "reflectance; no format holds it, so it is said in a warning",
     false, Range::kNotNegative},
    {"ior", T::kNumber, "", "index of refraction; as specular", false, Range::kPositive},
    {"strength", T::kNumber, "", "of light; as specular", false, Range::kNotNegative},
};
constexpr FunctionSpec kMaterial{
    "material",
    "What every face is made of; colours stay. The kinds with a colour of their own (steel, gold, "
    "rubber ...) give it to faces that have none.",
    kMaterialOptions,
    false,
    "part:material(\"metal\", {roughness = 0.4})",
    "part",
    "a solid or a shape; part:material(...) leaves it out"};

const Preset& find_preset(const std::string& kind) {
  std::vector<std::string> names;
  for (const Preset& preset : kPresets) {
    if (kind == preset.name) return preset;
    names.emplace_back(preset.name);
  }
  fail_in(kMaterial, fmt::format("there is no material '{}'{}; there are {}", kind,
                                 did_you_mean(kind, names), fmt::join(names, ", ")));
}

int material(lua_State* L) {
  part_argument(L, kMaterial);
  const Arguments arguments(L, kMaterial, 2);
  if (lua_gettop(L) < 2) fail_in(kMaterial, "needs the name of a material, or options");
  const std::string kind = arguments.string("kind", "plastic");
  const Preset& preset = find_preset(kind);
  Session& session = session_of(L);
  session.has_materials = true;
  for (const char* unwritten : {"specular", "ior", "strength"}) {
    if (arguments.has(unwritten))
      session.warn(L, fmt::format("material: '{}' is in no file that csgrun writes", unwritten));
  }
  const float metallic = fraction(
      kMaterial, "metallic", arguments.number("metallic", static_cast<double>(preset.metallic)));
  const float roughness = fraction(
      kMaterial, "roughness", arguments.number("roughness", static_cast<double>(preset.roughness)));
  const std::string name = arguments.string("name", kind);
  const auto own = parse_color(preset.color);
  push_changed(
      L,
      [&](const Appearance& before) {
        Appearance after = before;
        after.metallic = metallic;
        after.roughness = roughness;
        after.name = name;
        if (before.is_default && own) {
          after.red = (*own)[0];
          after.green = (*own)[1];
          after.blue = (*own)[2];
          after.is_default = false;
        }
        return after;
      },
      false);
  return 1;
}

constexpr Binding kColorsBindings[] = {
    {&kColor, guarded<color<kColor>>, guarded<color<kColor>>, guarded<color<kColor>>},
    {&kSetcolor, guarded<color<kSetcolor>>, guarded<color<kSetcolor>>, guarded<color<kSetcolor>>},
    {&kMaterial, guarded<material>, guarded<material>, guarded<material>},
};

}  // namespace

std::span<const Binding> color_bindings() { return kColorsBindings; }

}  // namespace csgrun
