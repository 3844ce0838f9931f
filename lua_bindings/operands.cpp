#include "lua_bindings/operands.h"

#include <algorithm>
#include <string_view>

#include <fmt/format.h>

#include "lua_bindings/api.h"
#include "lua_bindings/guard.h"
#include "lua_bindings/repaint.h"
#include "lua_bindings/session.h"

namespace csgrun {

void Operands::add(lua_State* L, int index, const std::string& function) {
  if (const SolidValue* solid = to_solid(L, index)) {
    has_solids = true;
    if (!solid->marks.absent) solids.push_back(solid->node);
  } else if (const ShapeValue* shape = to_shape(L, index)) {
    has_shapes = true;
    if (shapes.empty()) {
      appearance = shape->appearance;
    } else if (shape->appearance && shape->appearance != appearance) {
      drops_colour = true;
    }
    if (!shape->marks.absent) shapes.push_back(shape->shape);
    if (shape->marks.only) only_shapes.push_back(shape->shape);
  } else {
    throw ScriptError(fmt::format("{}: an operand must be a solid or a shape, got {}", function,
                                  describe_value(L, index)));
  }
  const Marks& marks = *marks_of(L, index);
  if (!has_first && !marks.absent) {
    has_first = true;
    name = marks.name;
  }
  if (has_solids && has_shapes) {
    throw ScriptError(
        function +
        ": a solid and a 2D shape cannot be combined; make a solid of the shape first, "
        "with linear_extrude or rotate_extrude");
  }
}

void Operands::paint_tools_as_body() {
  if (solids.empty()) return;
  const Appearance body = first_appearance(solids[0]);
  for (size_t i = 1; i < solids.size(); ++i)
    solids[i] = Node::painted(body, solids[i], solids[i]->where());
}

void Operands::warn_of_colours(lua_State* L, const std::string& function) const {
  if (drops_colour) {
    session_of(L).warn(L, function +
                              ": a 2D shape has one colour, that of the first; to keep the colours "
                              "of all, combine what is extruded from them");
  }
  if (solids.empty()) return;
  const Appearance kept = first_appearance(solids[0]);
  const auto is_lost = [&](const NodePtr& solid) {
    const Appearance own = first_appearance(solid);
    return !own.is_default && own != kept;
  };
  if (std::none_of(solids.begin(), solids.end(), is_lost)) return;
  session_of(L).warn(L, function + ": the result has one colour, that of the first");
}

bool Operands::push_only_shapes(lua_State* L, const std::string& function) const {
  if (only_shapes.empty()) return false;
  auto shape = Shape2D::boolean(BooleanOp::kUnion, only_shapes);
  if (!shape) throw ScriptError(function + ": " + shape.error().message);
  push_shape(L, *std::move(shape), appearance);
  marks_of(L, -1)->only = true;
  return true;
}

void Operands::push_result(lua_State* L, BooleanOp op, const std::string& function) const {
  if (!has_shapes) {
    push_solid(L, Node::boolean(op, solids, session_of(L).source_ref(L)));
  } else if (shapes.empty()) {
    push_shape(L, {}, appearance);
  } else {
    if (op != BooleanOp::kDifference) warn_of_colours(L, function);
    if (!push_only_shapes(L, function)) {
      auto shape = Shape2D::boolean(op, shapes);
      if (!shape) throw ScriptError(function + ": " + shape.error().message);
      push_shape(L, *std::move(shape), appearance);
    }
  }
  marks_of(L, -1)->name = name;
}

namespace {

/// Deeper lists are taken for one that contains itself.
constexpr int kDeepestList = 100;

/// What the table at `index` has that lists do not have, for the end of a message: the key 0, or
/// the first of its names.
std::string strange_key(lua_State* L, int index) {
  index = lua_absindex(L, index);
  const bool has_place_0 = lua_rawgeti(L, index, 0) != LUA_TNIL;
  lua_pop(L, 1);
  if (has_place_0) return ", got the key 0: they begin at 1";
  std::string first;
  lua_pushnil(L);
  while (lua_next(L, index) != 0) {
    lua_pop(L, 1);
    if (lua_type(L, -1) != LUA_TSTRING) continue;
    const std::string name = lua_tostring(L, -1);
    if (first.empty() || name < first) first = name;
  }
  return first.empty() ? first : ", got the key '" + first + "'";
}

/// The value at `index`: an operand, or a list of values such as this one.
void add_operands(lua_State* L, int index, const FunctionSpec& spec, int depth,
                  Operands& operands) {
  if (!lua_istable(L, index)) return operands.add(L, index, spec.name);
  const lua_Integer length = list_length(L, index);
  if (length < 0 && missing_entry(L, index) != 0)
    fail_in(spec, "an operand must be a solid or a shape, got " + describe_value(L, index));
  if (length < 0) {
    fail_in(spec, "takes lists of solids or shapes without holes and names in them" +
                      strange_key(L, index));
  }
  if (depth == kDeepestList)
    fail_in(spec, "its lists are nested too deep (does one contain itself?)");
  luaL_checkstack(L, 4, "lists are nested too deep");
  for (lua_Integer i = 1; i <= length; ++i) {
    lua_rawgeti(L, index, i);
    add_operands(L, lua_gettop(L), spec, depth + 1, operands);
    lua_pop(L, 1);
  }
}

}  // namespace

Operands read_operands(lua_State* L, const FunctionSpec& spec) {
  Operands operands;
  const int count = lua_gettop(L);
  for (int index = 1; index <= count; ++index) add_operands(L, index, spec, 0, operands);
  return operands;
}

namespace {

bool is_subject(lua_State* L, int index) {
  return to_shape(L, index) != nullptr || to_solid(L, index) != nullptr;
}

/// The place of the only solid or shape in the list at the top of the stack; 0 if there is not one.
lua_Integer place_of_subject(lua_State* L) {
  lua_Integer found = 0;
  const auto length = static_cast<lua_Integer>(lua_rawlen(L, -1));
  for (lua_Integer place = 1; place <= length; ++place) {
    lua_rawgeti(L, -1, place);
    const bool here = is_subject(L, lua_gettop(L));
    lua_pop(L, 1);
    if (here && found != 0) return 0;
    if (here) found = place;
  }
  return found;
}

/// f{shape, 16, twist = 90}: the subject comes to stack index 1, what is left of the table to 2.
void take_subject_out_of_list(lua_State* L) {
  const lua_Integer subject = place_of_subject(L);
  if (subject == 0) return;
  lua_rawgeti(L, 1, subject);
  lua_insert(L, 1);  // subject, table
  lua_newtable(L);
  lua_pushnil(L);
  while (lua_next(L, 2) != 0) {
    lua_pushvalue(L, -2);
    if (lua_isinteger(L, -1) != 0) {
      const lua_Integer place = lua_tointeger(L, -1);
      lua_pop(L, 1);
      if (place == subject) {
        lua_pop(L, 1);
        continue;
      }
      lua_pushinteger(L, place > subject ? place - 1 : place);
    }
    lua_insert(L, -2);
    lua_rawset(L, 3);
  }
  lua_replace(L, 2);
}

}  // namespace

void bring_subject_to_front(lua_State* L) {
  const int top = lua_gettop(L);
  if (top == 0 || is_subject(L, 1)) return;
  if (top == 1) {
    if (lua_istable(L, 1)) take_subject_out_of_list(L);
    return;
  }
  int found = 0;
  for (int index = 2; index <= top; ++index) {
    if (!is_subject(L, index)) continue;
    if (found != 0) return;
    found = index;
  }
  if (found == 0) return;
  lua_pushvalue(L, found);
  lua_remove(L, found);
  lua_insert(L, 1);
}

void name_list_part(lua_State* L, const char* option) {
  if (lua_gettop(L) != 1 || !lua_istable(L, 1) || lua_rawlen(L, 1) < 2) return;
  bool has_names = false;
  lua_pushnil(L);
  while (lua_next(L, 1) != 0) {
    lua_pop(L, 1);
    if (lua_type(L, -1) != LUA_TSTRING) continue;
    has_names = true;
    if (std::string_view(lua_tostring(L, -1)) == option) {
      lua_pop(L, 1);
      return;
    }
  }
  lua_rawgeti(L, 1, 1);
  const bool is_list = lua_istable(L, -1) || lua_isuserdata(L, -1);
  lua_pop(L, 1);
  if (!has_names || !is_list) return;
  lua_newtable(L);  // 2: the options
  lua_newtable(L);  // 3: the list
  lua_pushnil(L);
  while (lua_next(L, 1) != 0) {
    lua_pushvalue(L, -2);
    lua_insert(L, -2);
    lua_rawset(L, lua_type(L, -2) == LUA_TSTRING ? 2 : 3);
  }
  lua_setfield(L, 2, option);
  lua_replace(L, 1);
}

}  // namespace csgrun
