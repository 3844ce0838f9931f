// Names of parts, and OpenSCAD's modifiers: what a value says beside its geometry.
#include <fmt/format.h>

#include "lua_bindings/api.h"
#include "lua_bindings/guard.h"
#include "lua_bindings/session.h"

namespace csgrun {
namespace {

/// Pushes the value at index 1 anew: another value of the same geometry and marks.
void push_copy(lua_State* L, const FunctionSpec& spec) {
  if (const SolidValue* solid = to_solid(L, 1)) {
    push_solid(L, solid->node);
  } else if (const ShapeValue* shape = to_shape(L, 1)) {
    push_shape(L, shape->shape, shape->appearance);
    to_shape(L, -1)->where = shape->where;
  } else {
    fail_in(spec, fmt::format("the first argument must be a solid or a shape, got {}",
                              describe_value(L, 1)));
  }
  keep_marks(L, 1);
}

constexpr Option kNameOptions[] = {
    {"name", ArgumentType::kString, "", "name of the part that it becomes", true},
};
constexpr FunctionSpec kName{
    "name",
    "The same with a name: as a part of the result it is called so. Transforms, colours and "
    "Booleans (of their first operand) keep it.",
    kNameOptions, false, "render(lid:name(\"lid\"))"};

int set_name(lua_State* L) {
  push_copy(L, kName);
  lua_insert(L, 2);
  const int value = 2;
  const Arguments arguments(L, kName, 3);
  const std::string name = arguments.string("name", "");
  if (name.empty()) fail_in(kName, "needs a name");
  marks_of(L, value)->name = name;
  lua_settop(L, value);
  return 1;
}

constexpr FunctionSpec kClone{
    "clone",
    "The same again. Values never change, so nobody needs it: it is there for LuaCAD.",
    {},
    false,
    "part:clone()"};
constexpr FunctionSpec kCopy{
    "copy", "The same again: another name of clone.", {}, false, "part:copy()"};
constexpr FunctionSpec kDebug{"debug",
                              "OpenSCAD's # marks for the eye only; the result is the same.",
                              {},
                              false,
                              "part - hole:debug()"};
constexpr FunctionSpec kD{
    "d", "A short form: d(part) is part:debug().", {}, false, "part - d(hole)"};

template <const FunctionSpec& Spec>
int copy(lua_State* L) {
  if (lua_gettop(L) > 1) fail_in(Spec, "takes no arguments");
  push_copy(L, Spec);
  return 1;
}

constexpr FunctionSpec kSkip{"skip",
                             "OpenSCAD's *: no part, and as an operand as if it were not there.",
                             {},
                             false,
                             "part - hole:skip()"};
constexpr FunctionSpec kS{
    "s", "A short form: s(part) is part:skip().", {}, false, "part - s(hole)"};
constexpr FunctionSpec kTransparent{
    "transparent",
    "OpenSCAD's %: shown in previews, so to a file the same as skip.",
    {},
    false,
    "render(part:transparent())"};
constexpr FunctionSpec kT{
    "t", "A short form: t(part) is part:transparent().", {}, false, "render(t(part))"};

template <const FunctionSpec& Spec>
int skip(lua_State* L) {
  if (lua_gettop(L) > 1) fail_in(Spec, "takes no arguments");
  push_copy(L, Spec);
  if (to_solid(L, 1) != nullptr) {
    push_solid(L, Node::empty(session_of(L).source_ref(L)));
  } else {
    push_shape(L, {}, {});
  }
  keep_marks(L, 1);
  marks_of(L, -1)->absent = true;
  return 1;
}

constexpr FunctionSpec kOnly{
    "only",
    "OpenSCAD's !: where a part has it in it, the result is this alone, in its place, without "
    "the Booleans that it stands in.",
    {},
    false,
    "render(part - hole:only())"};
constexpr FunctionSpec kO{
    "o", "A short form: o(part) is part:only().", {}, false, "render(part - o(hole))"};

template <const FunctionSpec& Spec>
int only(lua_State* L) {
  if (lua_gettop(L) > 1) fail_in(Spec, "takes no arguments");
  push_copy(L, Spec);
  if (SolidValue* solid = to_solid(L, -1)) {
    // A node of its own: the same subtree elsewhere is not meant.
    solid->node = Node::transformed({}, solid->node, solid->node->where());
    session_of(L).only_nodes.emplace(solid->node.get(), solid->node);
  }
  marks_of(L, -1)->only = true;
  return 1;
}

template <const FunctionSpec& Spec, int (*Function)(lua_State*)>
constexpr Binding method() {
  return {&Spec, nullptr, guarded<Function>, guarded<Function>};
}
template <const FunctionSpec& Spec, int (*Function)(lua_State*)>
constexpr Binding function() {
  return {&Spec, guarded<Function>, nullptr, nullptr};
}

constexpr Binding kMarksBindings[] = {
    method<kName, set_name>(),
    method<kClone, copy<kClone>>(),
    method<kCopy, copy<kCopy>>(),
    method<kSkip, skip<kSkip>>(),
    method<kOnly, only<kOnly>>(),
    method<kDebug, copy<kDebug>>(),
    method<kTransparent, skip<kTransparent>>(),
    function<kS, skip<kS>>(),
    function<kO, only<kO>>(),
    function<kD, copy<kD>>(),
    function<kT, skip<kT>>(),
};

}  // namespace

std::span<const Binding> mark_bindings() { return kMarksBindings; }

}  // namespace csgrun
