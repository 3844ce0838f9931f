// union, difference, intersection, symmetric_difference, outer_hull; the operators.
#include <fmt/format.h>

#include "lua_bindings/api.h"
#include "lua_bindings/guard.h"
#include "lua_bindings/nearest.h"
#include "lua_bindings/operands.h"
#include "lua_bindings/session.h"

namespace csgrun {
namespace {

constexpr Option kOperandOptions[] = {
    {"operands", ArgumentType::kValue, "",
     "solids or shapes, one after another or as lists (of lists)", true},
};
constexpr Option kDifferenceOptions[] = {
    kOperandOptions[0],
    {"cut", ArgumentType::kString, "\"tool\"",
     "which colour cut faces have: \"tool\", that of what cuts, or \"body\", that of the first\n"
     "          solid (of its first leaf, where it has several)",
     false},
};
constexpr FunctionSpec kUnion{"union", "What is in any of them.", kOperandOptions, false,
                              "union{a, b, c}"};
constexpr FunctionSpec kAdd{"add", "What is in any of them: another name of union.",
                            kOperandOptions, false, "a:add(b, c)"};
constexpr FunctionSpec kDifference{"difference", "What is in the first and in none of the others.",
                                   kDifferenceOptions, false, "plate:difference(hole, slot)"};
constexpr FunctionSpec kSub{"sub",
                            "What is in the first and in none of the others: another name of "
                            "difference.",
                            kDifferenceOptions, false, "plate:sub(hole, {cut = \"body\"})"};
constexpr FunctionSpec kSubtract{"subtract",
                                 "What is in the first and in none of the others: another name of "
                                 "difference.",
                                 kDifferenceOptions, false, "plate:subtract(hole)"};
constexpr FunctionSpec kIntersection{"intersection", "What is in all of them.", kOperandOptions,
                                     false, "a:intersection(b)"};
constexpr FunctionSpec kIntersect{"intersect",
                                  "What is in all of them: another name of intersection.",
                                  kOperandOptions, false, "a:intersect(b)"};
constexpr FunctionSpec kSymmetricDifference{"symmetric_difference",
                                            "What is in an odd number of them.", kOperandOptions,
                                            false, "a:symmetric_difference(b)"};

/// Takes option "cut" out of the tables among the arguments: whether it says "body".
bool take_cut_option(lua_State* L, const FunctionSpec& spec) {
  bool cut_as_body = false;
  if (spec.options.size() < 2) return cut_as_body;
  const int count = lua_gettop(L);
  for (int index = 1; index <= count; ++index) {
    if (!lua_istable(L, index)) continue;
    lua_newtable(L);  // what is left: the list
    const int rest = lua_gettop(L);
    lua_pushnil(L);
    while (lua_next(L, index) != 0) {
      if (lua_type(L, -2) != LUA_TSTRING) {
        lua_pushvalue(L, -2);
        lua_insert(L, -2);
        lua_rawset(L, rest);
        continue;
      }
      const std::string key = lua_tostring(L, -2);
      if (key != "cut")
        fail_in(spec, fmt::format("unknown option '{}'{}", key, did_you_mean(key, {"cut"})));
      const std::string value = lua_type(L, -1) == LUA_TSTRING ? lua_tostring(L, -1) : "";
      if (value != "tool" && value != "body") {
        fail_in(spec, "option 'cut' must be \"tool\" or \"body\", got " +
                          (value.empty() ? describe_value(L, -1) : "\"" + value + "\""));
      }
      cut_as_body = value == "body";
      lua_pop(L, 1);
    }
    lua_replace(L, index);
  }
  return cut_as_body;
}

template <const FunctionSpec& Spec, BooleanOp Op>
int boolean_function(lua_State* L) {
  const bool cut_as_body = take_cut_option(L, Spec);
  Operands operands = read_operands(L, Spec);
  if (cut_as_body) operands.paint_tools_as_body();
  operands.push_result(L, Op, Spec.name);
  return 1;
}

constexpr Option kOuterHullOptions[] = {
    {"orientation_sensitive", ArgumentType::kBoolean, "false",
     "the way through a surface from its back to its front is open: inverted parts vanish, and a\n"
     "          body parts where it is thinner than nothing",
     false},
    {"keep_voids", ArgumentType::kBoolean, "false",
     "voids inside stay empty instead of being filled", false},
};
constexpr FunctionSpec kOuterHull{
    "outer_hull",
    "What cannot be reached from outside without crossing the surface, as it crosses itself.",
    kOuterHullOptions,
    false,
    "outer_hull(import(\"scan.stl\"), {orientation_sensitive = true})",
    "solid",
    "a solid"};

int outer_hull(lua_State* L) {
  const NodePtr node = solid_argument(L, kOuterHull).node;
  const Arguments arguments(L, kOuterHull, 2);
  OuterHull options;
  options.orientation_sensitive = arguments.boolean("orientation_sensitive", false);
  options.keep_voids = arguments.boolean("keep_voids", false);
  push_solid(L, Node::outer_hull(options, node, session_of(L).source_ref(L)));
  keep_marks(L, 1);
  return 1;
}

/// "a solid and a number": both sides of an operator that does not fit.
[[noreturn]] void fail_operator(lua_State* L, const char* symbol) {
  const bool has_list = lua_istable(L, 1) || lua_istable(L, 2);
  throw ScriptError(fmt::format("'{}' needs two solids, or two shapes, got {} and {}{}", symbol,
                                kind_name(L, 1), kind_name(L, 2),
                                has_list ? "; a list of them is one by union(list)" : ""));
}

constexpr char kPlus[] = "+", kOr[] = "|", kMinus[] = "-", kTimes[] = "*", kAnd[] = "&",
               kTilde[] = "~";

template <const char* Symbol, BooleanOp Op>
int boolean_operator(lua_State* L) {
  const auto is_geometry = [L](int index) {
    return to_solid(L, index) != nullptr || to_shape(L, index) != nullptr;
  };
  if (!is_geometry(1) || !is_geometry(2)) fail_operator(L, Symbol);
  Operands operands;
  operands.add(L, 1, fmt::format("'{}'", Symbol));
  operands.add(L, 2, fmt::format("'{}'", Symbol));
  operands.push_result(L, Op, fmt::format("'{}'", Symbol));
  return 1;
}

/// M * solid, M * shape, M * M, M * {x, y, z}; else the intersection.
int times(lua_State* L) {
  Affine map;
  const bool geometry_left = to_solid(L, 1) != nullptr || to_shape(L, 1) != nullptr;
  if (geometry_left || !to_affine(L, 1, map)) {
    if (geometry_left && to_matrix(L, 2) != nullptr)
      throw ScriptError("a matrix stands on the left: M * solid");
    return boolean_operator<kTimes, BooleanOp::kIntersection>(L);
  }
  if (const SolidValue* solid = to_solid(L, 2)) {
    push_solid(L, Node::transformed(map, solid->node, session_of(L).source_ref(L)));
    keep_marks(L, 2);
  } else if (to_shape(L, 2) != nullptr) {
    push_moved_shape(L, 2, map, "'*'");
  } else if (const MatrixValue* matrix = to_matrix(L, 2)) {
    push_matrix(L, Affine::compose(map, matrix->map));
  } else if (lua_istable(L, 2) && (list_length(L, 2) == 3 || list_length(L, 2) == 2)) {
    glm::dvec3 p(0, 0, 0);
    for (int i = 0; i < static_cast<int>(lua_rawlen(L, 2)); ++i) {
      if (lua_rawgeti(L, 2, i + 1) != LUA_TNUMBER)
        throw ScriptError("'*': a point is a list of two or three numbers");
      p[i] = lua_tonumber(L, -1);
    }
    const glm::dvec3 q = map.apply(p);
    push_point(L, q);
  } else {
    throw ScriptError("'*': a matrix moves a solid, a shape, a matrix or a point {x, y, z}, got " +
                      describe_value(L, 2));
  }
  return 1;
}

/// Equal geometry, exactly, whatever it was made from; colours count.
int equal(lua_State* L) {
  bool same = false;
  if (SolidValue* a = to_solid(L, 1), *b = to_solid(L, 2); a != nullptr && b != nullptr) {
    same = a->node == b->node;
    if (!same) {
      Session& session = session_of(L);
      const auto hash = [&](SolidValue& value) {
        return session.evaluated(value, Measuring::kButTheCentre).canonical_hash;
      };
      same = hash(*a) == hash(*b);
    }
  } else if (const ShapeValue* s = to_shape(L, 1), *t = to_shape(L, 2);
             s != nullptr && t != nullptr) {
    same = s->shape.loops() == t->shape.loops() && s->appearance == t->appearance;
  } else if (const MatrixValue* m = to_matrix(L, 1), *n = to_matrix(L, 2);
             m != nullptr && n != nullptr) {
    same = m->map == n->map;
  }
  lua_pushboolean(L, same ? 1 : 0);
  return 1;
}

template <const FunctionSpec& Spec, BooleanOp Op>
constexpr Binding boolean_binding() {
  return {&Spec, guarded<boolean_function<Spec, Op>>, guarded<boolean_function<Spec, Op>>,
          guarded<boolean_function<Spec, Op>>};
}
/// Names that would be too common for globals.
template <const FunctionSpec& Spec, BooleanOp Op>
constexpr Binding boolean_method() {
  return {&Spec, nullptr, guarded<boolean_function<Spec, Op>>, guarded<boolean_function<Spec, Op>>};
}

constexpr Binding kBooleansBindings[] = {
    boolean_binding<kUnion, BooleanOp::kUnion>(),
    boolean_binding<kDifference, BooleanOp::kDifference>(),
    boolean_binding<kIntersection, BooleanOp::kIntersection>(),
    boolean_binding<kSymmetricDifference, BooleanOp::kSymmetricDifference>(),
    boolean_method<kAdd, BooleanOp::kUnion>(),
    boolean_method<kSub, BooleanOp::kDifference>(),
    boolean_method<kSubtract, BooleanOp::kDifference>(),
    boolean_method<kIntersect, BooleanOp::kIntersection>(),
    {&kOuterHull, guarded<outer_hull>, guarded<outer_hull>, nullptr},
};

}  // namespace

std::span<const Binding> boolean_bindings() { return kBooleansBindings; }

void open_operators(lua_State* L) {
  constexpr luaL_Reg kGeometryOperators[] = {
      {"__add", guarded<boolean_operator<kPlus, BooleanOp::kUnion>>},
      {"__bor", guarded<boolean_operator<kOr, BooleanOp::kUnion>>},
      {"__sub", guarded<boolean_operator<kMinus, BooleanOp::kDifference>>},
      {"__band", guarded<boolean_operator<kAnd, BooleanOp::kIntersection>>},
      {"__bxor", guarded<boolean_operator<kTilde, BooleanOp::kSymmetricDifference>>},
      {nullptr, nullptr},
  };
  for (const char* kind : {SolidValue::kName, ShapeValue::kName, MatrixValue::kName}) {
    luaL_getmetatable(L, kind);
    if (kind != MatrixValue::kName) luaL_setfuncs(L, kGeometryOperators, 0);
    lua_pushcfunction(L, guarded<times>);
    lua_setfield(L, -2, "__mul");
    lua_pushcfunction(L, guarded<equal>);
    lua_setfield(L, -2, "__eq");
    lua_pop(L, 1);
  }
}

}  // namespace csgrun
