#include "lua_bindings/api.h"

#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "lua_bindings/guard.h"
#include "lua_bindings/library_docs.h"
#include "lua_bindings/nearest.h"
#include "lua_bindings/openscad_hints.h"
#include "lua_bindings/operands.h"
#include "lua_bindings/session.h"
#include "lua_bindings/text.h"

namespace csgrun {
namespace {

const std::vector<std::string> kSettings = {"fn", "fa", "fs", "grid", "contacts"};

/// csg.fn and the like: read.
int read_setting(lua_State* L) {
  const Session& session = session_of(L);
  const std::string name = lua_type(L, 2) == LUA_TSTRING ? lua_tostring(L, 2) : "";
  if (name == "fn") {
    lua_pushnumber(L, session.facets.fn);
  } else if (name == "fa") {
    lua_pushnumber(L, session.facets.fa);
  } else if (name == "fs") {
    lua_pushnumber(L, session.facets.fs);
  } else if (name == "contacts") {
    lua_pushstring(L, session.joins_contacts() ? "join" : "separate");
  } else if (name == "grid") {
    if (session.grid().automatic()) {
      lua_pushnil(L);
    } else {
      lua_pushnumber(L, session.grid().millimetres());
    }
  } else {
    std::vector<std::string> names = kSettings;
    for (const Binding& binding : all_bindings()) {
      if (binding.function != nullptr) names.emplace_back(binding.spec->name);
    }
    throw ScriptError("csg has no '" + name + "'" + did_you_mean(name, names));
  }
  return 1;
}

void set_grid(lua_State* L, Session& session) {
  std::string text;
  if (lua_type(L, 3) == LUA_TSTRING) {
    text = lua_tostring(L, 3);
  } else if (lua_type(L, 3) == LUA_TNUMBER) {
    text = fmt::format("{}", lua_tonumber(L, 3));  // the shortest decimal that is this number
  } else if (!lua_isnil(L, 3)) {
    throw ScriptError("csg.grid must be a step in mm such as 0.001 or '2^-20mm', got " +
                      describe_value(L, 3));
  }
  if (text.empty()) {
    session.set_grid({});
    return;
  }
  const auto step = GridStep::parse(text);
  if (!step) throw ScriptError("csg.grid: " + step.error().message);
  session.set_grid(*step);
}

/// csg.fn = 64 and the like.
int write_setting(lua_State* L) {
  Session& session = session_of(L);
  const std::string name = lua_type(L, 2) == LUA_TSTRING ? lua_tostring(L, 2) : "";
  if (name == "grid") {
    set_grid(L, session);
    return 0;
  }
  if (name == "contacts") {
    const std::string value = lua_type(L, 3) == LUA_TSTRING ? lua_tostring(L, 3) : "";
    if (value != "join" && value != "separate") {
      throw ScriptError("csg.contacts must be \"separate\" or \"join\", got " +
                        (value.empty()
                             ? describe_value(L, 3)
                             : "\"" + value + "\"" + did_you_mean(value, {"separate", "join"})));
    }
    session.set_joins_contacts(value == "join");
    return 0;
  }
  if (name != "fn" && name != "fa" && name != "fs") {
    throw ScriptError("csg has no setting '" + name + "'" + did_you_mean(name, kSettings));
  }
  if (lua_type(L, 3) != LUA_TNUMBER) {
    throw ScriptError("csg." + name + " must be a number, got " + describe_value(L, 3));
  }
  Facets facets = session.facets;
  (name == "fn" ? facets.fn : name == "fa" ? facets.fa : facets.fs) = lua_tonumber(L, 3);
  if (const std::string problem = check_facets(facets); !problem.empty())
    throw ScriptError("csg." + problem);
  session.facets = facets;
  return 0;
}

/// Which values have a method that solids or shapes lack; null when there are none.
const char* other_owner(const std::string& kind, const std::string& name) {
  for (const Binding& binding : all_bindings()) {
    if (name != binding.spec->name) continue;
    if (kind == SolidValue::kName && binding.shape_method != nullptr) return "2D shapes";
    if (kind == ShapeValue::kName && binding.solid_method != nullptr) return "solids";
  }
  return nullptr;
}

/// Whether there is a function of that name that makes a solid or a shape.
bool makes_parts(const std::string& name) {
  for (const BindingGroup& group : binding_groups()) {
    const std::string gives = group.result;
    if (gives != "Solid" && gives != "Shape") continue;
    for (const Binding& binding : group.bindings) {
      if (binding.function != nullptr && name == binding.spec->name) return true;
    }
  }
  return false;
}

/// Upvalue 1: the table of methods; upvalue 2: "solid" or "shape".
int find_method(lua_State* L) {
  lua_pushvalue(L, 2);
  if (lua_rawget(L, lua_upvalueindex(1)) != LUA_TNIL) return 1;
  const std::string kind = lua_tostring(L, lua_upvalueindex(2));
  if (lua_type(L, 2) != LUA_TSTRING)
    throw ScriptError("a " + kind + " has methods only, got the key " + describe_value(L, 2));
  std::vector<std::string> names;
  lua_pushnil(L);
  while (lua_next(L, lua_upvalueindex(1)) != 0) {
    lua_pop(L, 1);
    names.emplace_back(lua_tostring(L, -1));
  }
  const std::string name = lua_tostring(L, 2);
  if (const char* owner = other_owner(kind, name))
    throw ScriptError("a " + kind + " has no method '" + name + "', which is one of " + owner);
  if (makes_parts(name)) {
    throw ScriptError("a " + kind + " has no method '" + name + "', which is a function: " + name +
                      "(...)");
  }
  if (const char* hint = method_hint(name))
    throw ScriptError("a " + kind + " has no method '" + name + "' (" + hint + ")");
  throw ScriptError("a " + kind + " has no method '" + name + "'" + did_you_mean(name, names));
}

int refuse_assignment(lua_State* L) {
  throw ScriptError("a " + kind_name(L, 1) + " cannot be changed: methods return new values");
}

/// difference() { ... } and translate(...) cube(1) in parentheses, as OpenSCAD has them.
int refuse_call(lua_State* L) {
  const std::string kind = kind_name(L, 1);
  if (kind == MatrixValue::kName)
    throw ScriptError("a matrix stands before what it moves: M * part, or part:translate(...)");
  // local cube = cube(5), and then cube(1).
  lua_Debug call{};
  if (lua_getstack(L, 0, &call) != 0 && lua_getinfo(L, "n", &call) != 0 && call.name != nullptr) {
    const std::string name = call.name;
    lua_getglobal(L, "csg");
    if (lua_istable(L, -1)) {
      lua_pushstring(L, name.c_str());
      if (lua_rawget(L, -2) == LUA_TFUNCTION) {
        throw ScriptError("the variable '" + name +
                          "' hides the function of this name, which is csg." + name + " still");
      }
    }
  }
  throw ScriptError("a " + kind +
                    " is no function: operands stand in the parentheses, "
                    "difference(a, b), or between them, a - b");
}

int value_text(lua_State* L) {
  const std::string kind = kind_name(L, 1);
  lua_pushlstring(L, kind.data(), kind.size());
  return 1;
}

void open_methods(lua_State* L, const char* kind, lua_CFunction Binding::*form) {
  luaL_getmetatable(L, kind);
  lua_newtable(L);
  for (const Binding& binding : all_bindings()) {
    if (binding.*form == nullptr) continue;
    lua_pushcfunction(L, binding.*form);
    lua_setfield(L, -2, binding.spec->name);
  }
  lua_pushstring(L, kind);
  lua_pushcclosure(L, guarded<find_method>, 2);
  lua_setfield(L, -2, "__index");
  lua_pop(L, 1);
}

}  // namespace

std::vector<BindingGroup> binding_groups() {
  return {
      {"Solids", "Solid", solid_bindings()},
      {"More solids", "Solid", polyhedron_bindings()},
      {"Shapes, and solids of them", "Shape", shape_bindings()},
      {"Outlines", "Shape", outline_bindings()},
      {"Text", "Shape", text_bindings()},
      {"Sweeps", "Solid", sweep_bindings()},
      {"Hulls and sums", "same", construction_bindings()},
      {"Sections and parts", "Solid", section_bindings()},
      {"Edges", "Solid", edge_bindings()},
      {"Free forms", "Solid", surface_bindings()},
      {"Transforms", "same", transform_bindings()},
      {"Places and copies", "same", array_bindings()},
      {"Booleans", "same", boolean_bindings()},
      {"Colours and materials", "same", color_bindings()},
      {"Names and modifiers", "same", mark_bindings()},
      {"Measuring", "number", measure_bindings()},
      {"Selecting", "number", selecting_bindings()},
      {"Trigonometry, in degrees", "number", math_bindings()},
      {"Vectors and numbers", "number", vector_bindings()},
      {"Parameters", "any", parameter_bindings()},
      {"Files as values", "any", file_bindings()},
      {"The model", "any", model_bindings()},
  };
}

std::vector<Binding> all_bindings() {
  std::vector<Binding> all;
  for (const BindingGroup& group : binding_groups())
    all.insert(all.end(), group.bindings.begin(), group.bindings.end());
  return all;
}

void open_api(lua_State* L) {
  open_values(L);
  open_operators(L);
  open_vectors(L);
  open_boxes(L);
  lua_pushglobaltable(L);
  lua_newtable(L);  // csg
  for (const Binding& binding : all_bindings()) {
    if (binding.function == nullptr) continue;
    lua_pushcfunction(L, binding.function);
    lua_pushvalue(L, -1);
    lua_setfield(L, -3, binding.spec->name);
    lua_setfield(L, -3, binding.spec->name);
  }
  for (const int table : {-1, -2}) {  // csg, then the globals
    lua_pushnumber(L, std::numbers::pi);
    lua_setfield(L, table - 1, "PI");
  }
  lua_createtable(L, 0, 3);
  lua_pushcfunction(L, guarded<read_setting>);
  lua_setfield(L, -2, "__index");
  lua_pushcfunction(L, guarded<write_setting>);
  lua_setfield(L, -2, "__newindex");
  lua_pushboolean(L, 0);
  lua_setfield(L, -2, "__metatable");
  lua_setmetatable(L, -2);
  lua_setfield(L, -2, "csg");
  lua_pop(L, 1);

  open_methods(L, SolidValue::kName, &Binding::solid_method);
  open_methods(L, ShapeValue::kName, &Binding::shape_method);
  open_methods(L, MatrixValue::kName, &Binding::matrix_method);
  for (const char* kind : {SolidValue::kName, ShapeValue::kName, MatrixValue::kName}) {
    luaL_getmetatable(L, kind);
    lua_pushcfunction(L, guarded<refuse_assignment>);
    lua_setfield(L, -2, "__newindex");
    lua_pushcfunction(L, guarded<value_text>);
    lua_setfield(L, -2, "__tostring");
    lua_pushcfunction(L, guarded<refuse_call>);
    lua_setfield(L, -2, "__call");
    lua_pop(L, 1);
  }
}

std::string api_help() {
  std::string text =
      "Every function is a global and stands in the table csg. Calls: f(values...), f{name = "
      "value, ...},\n"
      "f(values..., {name = value, ...}) or f{values..., name = value}; a list {x, y, z} wherever "
      "a "
      "vector is meant.\n"
      "Lengths are millimetres, angles degrees, Z is up.\n"
      "Operators: a + b, a | b union; a - b difference; a * b, a & b intersection; a ~ b "
      "symmetric\n"
      "difference; M * a transforms by a matrix. Settings: csg.fn, csg.fa, csg.fs, csg.grid;\n"
      "csg.contacts = \"separate\" keeps solids that touch along an edge apart, \"join\" joins "
      "them.\n";
  for (const Binding& binding : all_bindings()) {
    text += '\n';
    text += help_text(*binding.spec);
    std::string forms;
    if (binding.function == nullptr) forms = "a method";
    if (binding.function != nullptr &&
        (binding.solid_method != nullptr || binding.shape_method != nullptr)) {
      forms = "also a method";
    }
    if (!forms.empty()) {
      const char* of = binding.solid_method == nullptr   ? "shapes"
                       : binding.shape_method == nullptr ? "solids"
                                                         : "solids and shapes";
      text += fmt::format("  It is {} of {}.\n", forms, of);
    }
  }
  return text + library_docs(false);
}

void fail_in(const FunctionSpec& spec, const std::string& message) { fail_as(spec.name, message); }

void fail_making(const FunctionSpec& spec, const std::string& message) {
  // What a function makes with the help of another one is its own: "rect: r must be", not "rect:
  // square: r must be".
  const size_t end = message.find(": ");
  for (const Binding& binding : all_bindings()) {
    if (end != std::string::npos && message.compare(0, end, binding.spec->name) == 0)
      fail_as(spec.name, message.substr(end + 2));
  }
  fail_as(spec.name, message);
}

ShapeValue& shape_argument(lua_State* L, const FunctionSpec& spec) {
  bring_subject_to_front(L);
  if (ShapeValue* shape = to_shape(L, 1)) return *shape;
  fail_in(
      spec,
      fmt::format("the first argument must be a 2D shape, got {}; as a method it is called with a "
                  "colon, shape:{}(...)",
                  describe_value(L, 1), spec.name));
}

SolidValue& solid_argument(lua_State* L, const FunctionSpec& spec) {
  bring_subject_to_front(L);
  if (SolidValue* solid = to_solid(L, 1)) return *solid;
  fail_in(spec,
          fmt::format("the first argument must be a solid, got {}; as a method it is called with a "
                      "colon, solid:{}(...)",
                      describe_value(L, 1), spec.name));
}

SolidValue& final_solid_argument(lua_State* L, const FunctionSpec& spec) {
  SolidValue& solid = solid_argument(L, spec);
  NodePtr marked = session_of(L).only_part_of(solid.node, solid.node->where());
  if (!marked) return solid;
  push_solid(L, std::move(marked));
  keep_marks(L, 1);
  marks_of(L, -1)->only = true;
  lua_replace(L, 1);
  return *to_solid(L, 1);
}

void part_argument(lua_State* L, const FunctionSpec& spec) {
  bring_subject_to_front(L);
  if (to_solid(L, 1) != nullptr || to_shape(L, 1) != nullptr) return;
  fail_in(spec, fmt::format("the first argument must be a solid or a shape, got {}; as a method it "
                            "is called with a colon, part:{}(...)",
                            describe_value(L, 1), spec.name));
}

FillRule fill_argument(const Arguments& arguments, const FunctionSpec& spec) {
  const std::string name = arguments.string("fill", "nonzero");
  if (name == "nonzero") return FillRule::kNonZero;
  if (name == "positive") return FillRule::kPositive;
  if (name == "evenodd") return FillRule::kEvenOdd;
  fail_in(spec, fmt::format("option 'fill' must be \"nonzero\", \"positive\" or \"evenodd\", got "
                            "\"{}\"{}",
                            name, did_you_mean(name, {"nonzero", "positive", "evenodd"})));
}

void push_leaf(lua_State* L, PolygonMesh mesh, const std::optional<Appearance>& appearance) {
  NodePtr node = counted_leaf(L, std::move(mesh));
  if (appearance) node = Node::painted(*appearance, node, session_of(L).source_ref(L));
  push_solid(L, std::move(node));
}

}  // namespace csgrun
