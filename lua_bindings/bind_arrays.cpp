// Where parts stand to one another: anchors, alignment, copies in rows, grids and circles.
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include <fmt/format.h>

#include "lua_bindings/affine_maps.h"
#include "lua_bindings/api.h"
#include "lua_bindings/guard.h"
#include "lua_bindings/nearest.h"
#include "lua_bindings/session.h"

namespace csgrun {
namespace {

using T = ArgumentType;

constexpr int kMostCopies = 1'000'000;
constexpr const char* kPartDoc = "a solid or a shape; as a method, part:f(...), it is left out";

/// The bounding box of the solid or shape at `index`, which is `option` unless it is the first
/// argument; z is 0 for a shape.
std::array<glm::dvec3, 2> box_of(lua_State* L, int index, const FunctionSpec& spec,
                                 const char* option = "part") {
  if (const SolidValue* solid = to_solid(L, index)) {
    const Extent extent = session_of(L).extent(*solid);
    if (extent.empty) fail_in(spec, "there is nothing in it, so it has no place");
    return extent.bbox;
  }
  const ShapeValue* shape = to_shape(L, index);
  if (shape == nullptr)
    fail_in(spec, fmt::format("option '{}' must be a solid or a shape, got {}", option,
                              describe_value(L, index)));
  if (shape->shape.empty()) fail_in(spec, "there is nothing in it, so it has no place");
  const auto bounds = shape->shape.bounds();
  return {glm::dvec3(bounds[0].x, bounds[0].y, 0), glm::dvec3(bounds[1].x, bounds[1].y, 0)};
}

/// Pushes the part at index 1 under a map, with its marks.
void push_moved(lua_State* L, const FunctionSpec& spec, const Affine& map) {
  if (const SolidValue* solid = to_solid(L, 1)) {
    push_solid(L, Node::transformed(map, solid->node, session_of(L).source_ref(L)));
  } else {
    const ShapeValue& shape = *to_shape(L, 1);
    push_shape(L, value_or_fail(spec, shape.shape.transformed(map)), shape.appearance);
  }
  keep_marks(L, 1);
}

/// A place in a box: -1, 0 or 1 along each axis.
using Anchor = glm::dvec3;

glm::dvec3 point_of(const std::array<glm::dvec3, 2>& box, const Anchor& anchor) {
  glm::dvec3 p;
  // Sides are the box's own numbers: no rounding comes between parts that are to touch.
  for (int i = 0; i < 3; ++i) {
    p[i] = anchor[i] < 0   ? box[0][i]
           : anchor[i] > 0 ? box[1][i]
                           : box[0][i] + (box[1][i] - box[0][i]) / 2;
  }
  return p;
}

/// "top", "bottom-left", "center" and the like.
Anchor parse_anchor(const FunctionSpec& spec, const char* option, const std::string& text) {
  struct Side {
    const char* name;
    int axis;
    double value;
  };
  static constexpr Side kSides[] = {{"left", 0, -1}, {"right", 0, 1},   {"front", 1, -1},
                                    {"back", 1, 1},  {"bottom", 2, -1}, {"top", 2, 1},
                                    {"center", 0, 0}};
  Anchor anchor(0, 0, 0);
  for (size_t start = 0; start <= text.size();) {
    const size_t end = std::min(text.find_first_of("-+ ", start), text.size());
    const std::string word = text.substr(start, end - start);
    start = end + 1;
    const auto* side = std::find_if(std::begin(kSides), std::end(kSides),
                                    [&](const Side& s) { return word == s.name; });
    if (side == std::end(kSides)) {
      std::vector<std::string> names;
      for (const Side& each : kSides) names.emplace_back(each.name);
      fail_in(spec, fmt::format("option '{}': there is no side '{}'{}; sides are {}, as in "
                                "\"top-left\"",
                                option, word, did_you_mean(word, names), fmt::join(names, ", ")));
    }
    if (side->value == 0) continue;
    if (anchor[side->axis] != 0 && anchor[side->axis] != side->value)
      fail_in(spec, fmt::format("option '{}': '{}' has opposite sides", option, text));
    anchor[side->axis] = side->value;
  }
  return anchor;
}

constexpr Option kAnchorOptions[] = {
    {"at", T::kString, "\"center\"",
     "left, right, front, back, bottom, top, or several: \"top-left\"; else the middle", true},
};
constexpr FunctionSpec kAnchor{"anchor", "A point of the bounding box, {x, y, z}.", kAnchorOptions,
                               false,    "cube(10):anchor(\"top-right\")",          "part",
                               kPartDoc};

int anchor(lua_State* L) {
  part_argument(L, kAnchor);
  const Arguments arguments(L, kAnchor, 2);
  const Anchor at = parse_anchor(kAnchor, "at", arguments.string("at", "center"));
  const glm::dvec3 p = point_of(box_of(L, 1, kAnchor), at);
  if (to_shape(L, 1) != nullptr) {
    push_point(L, glm::dvec2(p));
  } else {
    push_point(L, p);
  }
  return 1;
}

constexpr Option kAttachOptions[] = {
    {"to", T::kValue, "", "the part that stays where it is", true},
    {"at", T::kString, "\"top\"", "where on that one; sides as anchor has them", true},
    {"own", T::kString, "the opposite", "which of its own places comes there", true},
    {"gap", T::kNumber, "0", "how far apart, along the sides that are named", false},
};
constexpr FunctionSpec kAttach{"attach",
                               "Moves it so that its bounding box touches that of another part.",
                               kAttachOptions,
                               false,
                               "cylinder(5, 2):attach(cube(10), \"top\")",
                               "part",
                               kPartDoc};

int attach(lua_State* L) {
  part_argument(L, kAttach);
  const Arguments arguments(L, kAttach, 2);
  const int to = arguments.stack_index("to");
  if (to == 0) fail_in(kAttach, "needs the part to attach it to");
  const Anchor at = parse_anchor(kAttach, "at", arguments.string("at", "top"));
  const Anchor own = arguments.has("own")
                         ? parse_anchor(kAttach, "own", arguments.string("own", ""))
                         : Anchor(-at.x, -at.y, -at.z);
  const double gap = arguments.number("gap", 0);
  const glm::dvec3 from = point_of(box_of(L, 1, kAttach), own);
  const glm::dvec3 target = point_of(box_of(L, to, kAttach, "to"), at) + gap * at;
  push_moved(L, kAttach, translation(target - from));
  return 1;
}

constexpr const char* kAlignDoc =
    "\"min\", \"center\" or \"max\": which side of its box comes there";
constexpr Option kAlignOptions[] = {
    {"x", T::kString, "as it is", kAlignDoc, true},
    {"y", T::kString, "as it is", kAlignDoc, true},
    {"z", T::kString, "as it is", kAlignDoc, true},
    {"to", T::kValue, "{0, 0, 0}", "a point, or a part: then the same side of its box", false},
};
constexpr FunctionSpec kAlign{"align",
                              "Moves it by its bounding box.",
                              kAlignOptions,
                              false,
                              "cube(10):align{x = \"center\", z = \"max\"}",
                              "part",
                              kPartDoc};

int align(lua_State* L) {
  part_argument(L, kAlign);
  const Arguments arguments(L, kAlign, 2);
  const auto box = box_of(L, 1, kAlign);
  std::array<glm::dvec3, 2> target{};
  if (const int to = arguments.stack_index("to"); to != 0) {
    if (lua_istable(L, to)) {
      const lua_Integer length = list_length(L, to);
      if (length != 2 && length != 3)
        fail_in(kAlign, "option 'to' must be a point or a part, got " + describe_value(L, to));
      for (int i = 0; i < length; ++i) {
        if (lua_rawgeti(L, to, i + 1) != LUA_TNUMBER || !std::isfinite(lua_tonumber(L, -1)))
          fail_in(kAlign, "option 'to' must be a point of finite numbers, or a part");
        target[0][i] = target[1][i] = lua_tonumber(L, -1);
        lua_pop(L, 1);
      }
    } else {
      if (to_solid(L, to) == nullptr && to_shape(L, to) == nullptr)
        fail_in(kAlign, "option 'to' must be a point or a part, got " + describe_value(L, to));
      target = box_of(L, to, kAlign);
    }
  }
  glm::dvec3 move(0, 0, 0);
  for (int i = 0; i < 3; ++i) {
    const char name[] = {static_cast<char>('x' + i), '\0'};
    if (!arguments.has(name)) continue;
    const std::string side = arguments.string(name, "");
    if (side != "min" && side != "center" && side != "max") {
      fail_in(kAlign,
              fmt::format("option '{}' must be \"min\", \"center\" or \"max\", got \"{}\"{}", name,
                          side, did_you_mean(side, {"min", "center", "max"})));
    }
    Anchor anchor(0, 0, 0);
    anchor[i] = side == "min" ? -1 : side == "max" ? 1 : 0;
    move[i] = point_of(target, anchor)[i] - point_of(box, anchor)[i];
  }
  push_moved(L, kAlign, translation(move));
  return 1;
}

constexpr Option kCenteredOptions[] = {
    {"axes", T::kBooleans3, "true", "along which axes", true},
};
constexpr FunctionSpec kCentered{"centered",
                                 "Moves the middle of its bounding box into the origin.",
                                 kCenteredOptions,
                                 false,
                                 "cube(10):centered{true, true, false}",
                                 "part",
                                 kPartDoc};

int centered(lua_State* L) {
  part_argument(L, kCentered);
  const Arguments arguments(L, kCentered, 2);
  const auto axes =
      arguments.has("axes") ? arguments.booleans("axes") : std::array<bool, 3>{true, true, true};
  const glm::dvec3 middle = point_of(box_of(L, 1, kCentered), {0, 0, 0});
  push_moved(
      L, kCentered,
      translation({axes[0] ? -middle.x : 0, axes[1] ? -middle.y : 0, axes[2] ? -middle.z : 0}));
  return 1;
}

/// Pushes the union of the part at index 1 under all maps, or the list of these copies.
void push_copies(lua_State* L, const FunctionSpec& spec, const std::vector<Affine>& maps,
                 bool as_list) {
  if (maps.size() > static_cast<size_t>(kMostCopies))
    fail_in(spec, fmt::format("makes {} copies, more than {}", maps.size(), kMostCopies));
  if (as_list) {
    lua_createtable(L, static_cast<int>(maps.size()), 0);
    for (size_t i = 0; i < maps.size(); ++i) {
      push_moved(L, spec, maps[i]);
      marks_of(L, -1)->name.clear();  // there would be many of one name
      lua_rawseti(L, -2, static_cast<lua_Integer>(i + 1));
    }
    return;
  }
  const SourceRef where = session_of(L).source_ref(L);
  if (const SolidValue* solid = to_solid(L, 1)) {
    std::vector<NodePtr> nodes;
    for (const Affine& map : maps) nodes.push_back(Node::transformed(map, solid->node, where));
    push_solid(L, Node::boolean(BooleanOp::kUnion, std::move(nodes), where));
  } else {
    const ShapeValue& shape = *to_shape(L, 1);
    std::vector<Shape2D> shapes;
    for (const Affine& map : maps)
      shapes.push_back(value_or_fail(spec, shape.shape.transformed(map)));
    push_shape(L, value_or_fail(spec, Shape2D::boolean(BooleanOp::kUnion, shapes)),
               shape.appearance);
  }
  keep_marks(L, 1);
}

constexpr Option kMirrorCopyOptions[] = {
    {"v", T::kVector2Or3, "{1, 0, 0}", "normal of the plane through the origin", true},
    {"list", T::kBoolean, "false", "gives both as a list instead of their union", false},
};
constexpr FunctionSpec kMirrorCopy{
    "mirror_copy", "It and its image in a plane through the origin.", kMirrorCopyOptions,
    false,         "cube(2):translate(5, 0, 0):mirror_copy(1, 0, 0)", "part",
    kPartDoc};

int mirror_copy(lua_State* L) {
  part_argument(L, kMirrorCopy);
  const Arguments arguments(L, kMirrorCopy, 2);
  const auto v = arguments.vector("v");
  if (v && v->v == glm::dvec3(0, 0, 0)) fail_in(kMirrorCopy, "option 'v' must not be 0");
  push_copies(L, kMirrorCopy, {{}, reflection(v ? v->v : glm::dvec3(1, 0, 0))},
              arguments.boolean("list", false));
  return 1;
}

int copies_argument(const Arguments& arguments, const FunctionSpec& spec, const char* name) {
  if (!arguments.has(name)) fail_in(spec, "needs how many");
  const double n = arguments.number(name, 1);
  if (n > kMostCopies)
    fail_in(spec, fmt::format("option '{}' must be at most {}, got {:.14g}", name, kMostCopies, n));
  return static_cast<int>(n);
}

constexpr const char* kListDoc = "gives the copies as a list instead of their union";
constexpr Option kLinearArrayOptions[] = {
    {"n", T::kInteger, "", "how many", true, Range::kPositive},
    {"v", T::kVector2Or3, "", "from one to the next", true},
    {"center", T::kBoolean, "false", "the middle of the row stays where it is", false},
    {"list", T::kBoolean, "false", kListDoc, false},
};
constexpr FunctionSpec kLinearArray{"linear_array",
                                    "Copies in a row.",
                                    kLinearArrayOptions,
                                    false,
                                    "cylinder(5, 1):linear_array(4, {10, 0, 0})",
                                    "part",
                                    kPartDoc};

int linear_array(lua_State* L) {
  part_argument(L, kLinearArray);
  const Arguments arguments(L, kLinearArray, 2);
  const int n = copies_argument(arguments, kLinearArray, "n");
  const auto v = arguments.vector("v");
  if (!v) fail_in(kLinearArray, "needs how far it is from one to the next: {x, y, z}");
  if (n > 1 && v->v == glm::dvec3(0, 0, 0))
    fail_in(kLinearArray, "option 'v' must not be 0: all copies would be in one place");
  const double first = arguments.boolean("center", false) ? -(n - 1) / 2.0 : 0;
  std::vector<Affine> maps;
  for (int i = 0; i < n; ++i) maps.push_back(translation((first + i) * v->v));
  push_copies(L, kLinearArray, maps, arguments.boolean("list", false));
  return 1;
}

constexpr Option kGridArrayOptions[] = {
    {"n", T::kVector2Or3, "", "how many along X, Y and Z", true},
    {"step", T::kSize2Or3, "", "from one to the next along each axis", true},
    {"center", T::kBoolean, "false", "the middle of the grid stays where it is", false},
    {"list", T::kBoolean, "false", kListDoc, false},
};
constexpr FunctionSpec kGridArray{
    "grid_array", "Copies in rows and columns, and in layers.", kGridArrayOptions,
    false,        "cylinder(5, 1):grid_array({3, 2}, {10, 8})", "part",
    kPartDoc};

int grid_array(lua_State* L) {
  part_argument(L, kGridArray);
  const Arguments arguments(L, kGridArray, 2);
  const auto n = arguments.vector("n"), step = arguments.vector("step");
  if (!n || !step) fail_in(kGridArray, "needs how many, {nx, ny}, and how far apart, {x, y}");
  glm::dvec3 count = n->v;
  if (n->count == 2) count.z = 1;
  const glm::dvec3 far = step->count == 1 ? glm::dvec3(step->v.x) : step->v;
  for (int i = 0; i < 3; ++i) {
    if (count[i] != std::floor(count[i]) || count[i] < 1 || count[i] > kMostCopies)
      fail_in(kGridArray,
              fmt::format("option 'n' must have whole numbers from 1 on, got {:.14g}", count[i]));
    if (count[i] > 1 && far[i] == 0) {
      fail_in(kGridArray, fmt::format("option 'step' must not be 0 along {}, where there are "
                                      "several copies",
                                      "XYZ"[i]));
    }
  }
  if (count.x * count.y * count.z > kMostCopies)
    fail_in(kGridArray, fmt::format("makes more than {} copies", kMostCopies));
  const bool center = arguments.boolean("center", false);
  std::vector<Affine> maps;
  for (int z = 0; z < count.z; ++z) {
    for (int y = 0; y < count.y; ++y) {
      for (int x = 0; x < count.x; ++x) {
        glm::dvec3 at(x, y, z);
        if (center) at = at - (count - 1.0) / 2.0;
        maps.push_back(translation(at * far));
      }
    }
  }
  push_copies(L, kGridArray, maps, arguments.boolean("list", false));
  return 1;
}

constexpr Option kPolarArrayOptions[] = {
    {"n", T::kInteger, "", "how many", true, Range::kPositive},
    {"angle", T::kNumber, "360",
     "how far around, degrees; less than a full turn has its last copy at the end", true},
    {"axis", T::kVector3, "{0, 0, 1}", "axis to turn about", false},
    {"center", T::kVector2Or3, "{0, 0, 0}", "a point of the axis", false},
    {"turn", T::kBoolean, "true", "copies turn with their place; else they keep looking one way",
     false},
    {"list", T::kBoolean, "false", kListDoc, false},
};
constexpr FunctionSpec kPolarArray{"polar_array",
                                   "Copies in a circle.",
                                   kPolarArrayOptions,
                                   false,
                                   "cube(2):translate(10, 0, 0):polar_array(6)",
                                   "part",
                                   kPartDoc};

int polar_array(lua_State* L) {
  part_argument(L, kPolarArray);
  const Arguments arguments(L, kPolarArray, 2);
  const int n = copies_argument(arguments, kPolarArray, "n");
  const double angle = arguments.number("angle", 360);
  if (n > 1 && angle == 0)
    fail_in(kPolarArray, "option 'angle' must not be 0: all copies would be in one place");
  const auto axis = arguments.vector("axis");
  const auto given_center = arguments.vector("center");
  const glm::dvec3 center = given_center ? given_center->v : glm::dvec3(0, 0, 0);
  if (axis && axis->v == glm::dvec3(0, 0, 0)) fail_in(kPolarArray, "option 'axis' must not be 0");
  const bool is_full = std::abs(angle) == 360;
  const bool turns = arguments.boolean("turn", true);
  glm::dvec3 middle(0, 0, 0);
  if (!turns) middle = point_of(box_of(L, 1, kPolarArray), {0, 0, 0});
  std::vector<Affine> maps;
  for (int i = 0; i < n; ++i) {
    // One rounding: whole steps of a decimal angle stay what they are.
    const double turn = angle * i / (is_full || n == 1 ? n : n - 1);
    Affine map = rotation_about(axis ? axis->v : glm::dvec3(0, 0, 1), turn);
    if (center != glm::dvec3(0, 0, 0))
      map = Affine::compose(translation(center), Affine::compose(map, translation(-center)));
    maps.push_back(turns ? map : translation(map.apply(middle) - middle));
  }
  push_copies(L, kPolarArray, maps, arguments.boolean("list", false));
  return 1;
}

template <const FunctionSpec& Spec, int (*Function)(lua_State*)>
constexpr Binding both() {
  return {&Spec, guarded<Function>, guarded<Function>, guarded<Function>};
}

constexpr Binding kArraysBindings[] = {
    both<kAnchor, anchor>(),
    both<kAttach, attach>(),
    both<kAlign, align>(),
    both<kCentered, centered>(),
    both<kMirrorCopy, mirror_copy>(),
    both<kLinearArray, linear_array>(),
    both<kGridArray, grid_array>(),
    both<kPolarArray, polar_array>(),
};

}  // namespace

std::span<const Binding> array_bindings() { return kArraysBindings; }

}  // namespace csgrun
