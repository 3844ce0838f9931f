// What connects a script with the world: import, require, param, emit, render.
#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include <csgrun/primitives/mesh_file.h>

#include "lua_bindings/api.h"
#include "lua_bindings/call_site.h"
#include "lua_bindings/guard.h"
#include "lua_bindings/parameters.h"
#include "lua_bindings/parts.h"
#include "lua_bindings/sandbox.h"
#include "lua_bindings/session.h"

namespace csgrun {
namespace {

using T = ArgumentType;

constexpr Option kImportOptions[] = {
    {"file", T::kString, "",
     "STL, OFF, OBJ or PLY, relative to the file that calls, or else to the folders of -L and\n"
     "          CSGRUN_PATH",
     true},
    {"fill", T::kString, "\"nonzero\"", kFillDoc, false},
    {"repair", T::kValue, "false",
     "makes a broken mesh a closed one and warns of all it does: true, or a table of\n"
     "          weld = MM (0: how far apart points of open edges may be that become one),\n"
     "          fill_holes (false: closes what is open), orient (true: turns faces to agree, "
     "surfaces\n"
     "          outwards), drop_degenerate (true: drops faces whose points lie on one line),\n"
     "          drop_duplicates (true: of faces on the same points those that are too many)",
     false},
};
constexpr FunctionSpec kImport{
    "import",
    "A solid from a mesh file; the mesh must be closed, or is repaired on request. Where it "
    "crosses itself, fill says what is inside.",
    kImportOptions, false, "import(\"scan.stl\", {repair = {weld = 0.01, fill_holes = true}})"};

constexpr Option kRepairOptions[] = {
    {"weld", T::kNumber, "0", "mm", false, Range::kNotNegative},
    {"fill_holes", T::kBoolean, "false", "closes what is open", false},
    {"orient", T::kBoolean, "true", "turns faces to agree, surfaces outwards", false},
    {"drop_degenerate", T::kBoolean, "true", "drops faces whose points lie on one line", false},
    {"drop_duplicates", T::kBoolean, "true", "drops faces on the same points as others", false},
};
constexpr FunctionSpec kRepair{"import: option 'repair'", "", kRepairOptions, false, ""};

/// What option "repair" says; nothing when it was not given or is false.
std::optional<RepairOptions> repair_argument(lua_State* L, const Arguments& arguments) {
  const int index = arguments.stack_index("repair");
  if (index == 0) return std::nullopt;
  RepairOptions options;
  if (lua_isboolean(L, index)) {
    return lua_toboolean(L, index) != 0 ? std::optional(options) : std::nullopt;
  }
  if (!lua_istable(L, index)) {
    fail_in(kImport, "option 'repair' must be true, false or a table of options, got " +
                         describe_value(L, index));
  }
  lua_pushvalue(L, index);
  const Arguments given(L, kRepair, lua_gettop(L));
  options.weld = given.number("weld", options.weld);
  options.fill_holes = given.boolean("fill_holes", options.fill_holes);
  options.orient = given.boolean("orient", options.orient);
  options.drop_degenerate = given.boolean("drop_degenerate", options.drop_degenerate);
  options.drop_duplicates = given.boolean("drop_duplicates", options.drop_duplicates);
  return options;
}

int import_mesh(lua_State* L) {
  const Arguments arguments(L, kImport, 1);
  const std::string path = arguments.string("file", "");
  if (path.empty()) fail_in(kImport, "needs the name of a file");
  if (mesh_format_of(path).empty()) {
    fail_in(kImport, "'" + path + "' has none of the endings .stl, .off, .obj, .ply");
  }
  Session& session = session_of(L);
  Files::Opened file;
  try {
    file = session.files().open(calling_file(L), path);
  } catch (const ScriptError& error) {
    fail_in(kImport, error.what());
  }
  const FillRule fill = fill_argument(arguments, kImport);
  const std::optional<RepairOptions> repair = repair_argument(L, arguments);
  NodePtr& node = session.imported[{file.real, fill, repair}];
  if (!node) {
    const EvaluationScope scope(
        session.budget());  // reading a large mesh is no fault of the script
    PolygonMesh mesh = value_or_fail(kImport, parse_mesh(file.display, file.bytes));
    mesh.fill = fill;
    std::vector<std::string> notes;
    if (repair) {
      mesh = value_or_fail(kImport, repair_solid_mesh(std::move(mesh), *repair, &notes));
    } else {
      std::string note;
      mesh = value_or_fail(kImport, make_solid_mesh(std::move(mesh), &note));
      if (!note.empty()) notes.push_back(note);
    }
    for (const std::string& note : notes) session.warn(L, "import: " + note);
    mesh.kind = session.files().name_from_folder(file.display);  // what is written names it so
    node = counted_leaf(L, std::move(mesh));
  }
  push_solid(L, node);
  return 1;
}

constexpr Option kRequireOptions[] = {
    {"name", T::kString, "",
     "the file name.lua or name/init.lua in the model's folder, in csgrun_modules beside it, in\n"
     "          the folders of -L and in those of CSGRUN_PATH; a dot in the name opens a folder",
     true},
};
constexpr FunctionSpec kRequire{"require", "Runs a module once and gives what it returns.",
                                kRequireOptions, false, "local wheel = require \"parts.wheel\""};

const char kLoadedModules = 0;  // registry: real path -> value
const char kLoadingMark = 0;    // value while a module runs

int require_module(lua_State* L) {
  const Arguments arguments(L, kRequire, 1);
  const std::string name = arguments.string("name", "");
  if (name == "csg") {
    lua_getglobal(L, "csg");
    return 1;
  }
  Files::Opened file;
  try {
    file = session_of(L).files().open_module(name);
  } catch (const ScriptError& error) {
    fail_in(kRequire, error.what());
  }
  if (lua_rawgetp(L, LUA_REGISTRYINDEX, &kLoadedModules) != LUA_TTABLE) {
    lua_pop(L, 1);
    lua_newtable(L);
    lua_pushvalue(L, -1);
    lua_rawsetp(L, LUA_REGISTRYINDEX, &kLoadedModules);
  }
  const int loaded = lua_gettop(L);
  lua_getfield(L, loaded, file.real.c_str());
  if (lua_touserdata(L, -1) == &kLoadingMark)
    fail_in(kRequire, "module '" + name + "' requires itself while it is loaded");
  if (!lua_isnil(L, -1)) return 1;
  lua_pushlightuserdata(L, const_cast<char*>(&kLoadingMark));
  lua_setfield(L, loaded, file.real.c_str());
  load_chunk(L, file.display, file.bytes);
  lua_pushstring(L, name.c_str());
  lua_call(L, 1, 1);
  if (lua_isnil(L, -1)) {
    lua_pop(L, 1);
    lua_pushboolean(L, 1);
  }
  lua_pushvalue(L, -1);
  lua_setfield(L, loaded, file.real.c_str());
  return 1;
}

constexpr Option kParamOptions[] = {
    {"name", T::kString, "", "name, for -D name=value", true},
    {"default", T::kValue, "", "a number, true or false, a string or a list of numbers", true},
    {"min", T::kNumber, "", "least value", false},
    {"max", T::kNumber, "", "greatest value", false},
    {"step", T::kNumber, "", "values are whole steps from min (or from 0)", false,
     Range::kPositive},
    {"choices", T::kValue, "", "list of the values that it may have", false},
    {"doc", T::kString, "", "what it means", false},
};
constexpr FunctionSpec kParam{
    "param", "A parameter of the model: its default, or what -D name=value says.", kParamOptions,
    false, "param(\"hole_radius\", 4, {min = 1, max = 10})"};

/// What is wrong with a number, or with the value at `index`, as this parameter's; empty if
/// nothing.
std::string check_number(const Arguments& arguments, double x) {
  if (arguments.has("min") && x < arguments.number("min", 0)) {
    return fmt::format("must be at least {:.14g}, got {:.14g}", arguments.number("min", 0), x);
  }
  if (arguments.has("max") && x > arguments.number("max", 0)) {
    return fmt::format("must be at most {:.14g}, got {:.14g}", arguments.number("max", 0), x);
  }
  if (arguments.has("step")) {
    const double step = arguments.number("step", 1), from = arguments.number("min", 0);
    const double steps = std::round((x - from) / step);
    // Decimal steps are not exact in binary: a value within a millionth of a step counts.
    if (std::abs(x - (from + steps * step)) > 1e-6 * step) {
      return fmt::format("must be a whole number of steps of {:.14g} from {:.14g}, got {:.14g}",
                         step, from, x);
    }
  }
  return {};
}

std::string check_value(lua_State* L, const Arguments& arguments, int index) {
  if (lua_type(L, index) == LUA_TNUMBER) {
    if (auto problem = check_number(arguments, lua_tonumber(L, index)); !problem.empty())
      return problem;
  } else if (lua_istable(L, index)) {
    const lua_Integer length = list_length(L, index);
    for (lua_Integer i = 1; i <= length; ++i) {
      if (lua_rawgeti(L, index, i) != LUA_TNUMBER) return "must be a list of numbers";
      auto problem = check_number(arguments, lua_tonumber(L, -1));
      lua_pop(L, 1);
      if (!problem.empty()) return fmt::format("entry {} {}", i, problem);
    }
    if (length < 0) return "must be a list of numbers";
  }
  if (const int choices = arguments.stack_index("choices"); choices != 0) {
    if (!lua_istable(L, choices)) fail_in(kParam, "option 'choices' must be a list");
    std::string names;
    const auto length = static_cast<lua_Integer>(lua_rawlen(L, choices));
    for (lua_Integer i = 1; i <= length; ++i) {
      lua_rawgeti(L, choices, i);
      const bool same = lua_rawequal(L, -1, index) != 0;
      if (lua_type(L, -1) == LUA_TSTRING)
        names += std::string(i > 1 ? ", " : "") + lua_tostring(L, -1);
      if (lua_type(L, -1) == LUA_TNUMBER)
        names += std::string(i > 1 ? ", " : "") + describe_value(L, -1);
      lua_pop(L, 1);
      if (same) return {};
    }
    return "must be one of " + names;
  }
  return {};
}

int param(lua_State* L) {
  const Arguments arguments(L, kParam, 1);
  const std::string name = arguments.string("name", "");
  const int fallback = arguments.stack_index("default");
  if (name.empty() || fallback == 0) fail_in(kParam, "needs a name and a default value");
  const std::string type = parameter_type(L, fallback);
  if (type.empty()) {
    fail_in(kParam, "the default of '" + name +
                        "' must be a number, true or false, a string or a list of numbers, got " +
                        describe_value(L, fallback));
  }
  Session& session = session_of(L);
  session.parameter_names.push_back(name);
  if (const std::string problem = check_value(L, arguments, fallback); !problem.empty()) {
    fail_in(kParam, "the default of '" + name + "' " + problem);
  }
  Definition* definition = nullptr;  // the last -D of a name counts
  for (Definition& candidate : session.definitions) {
    if (candidate.name != name) continue;
    candidate.used = true;
    definition = &candidate;
  }
  lua_pushvalue(L, fallback);
  if (definition == nullptr) return 1;
  std::string problem;
  if (!push_definition(L, fallback, definition->text)) {
    problem = "must be " + type;
  } else {
    problem = check_value(L, arguments, lua_gettop(L));
  }
  if (!problem.empty()) {
    session.definition_error =
        fmt::format("-D {}={}: '{}' {}", name, definition->text, name, problem);
    throw ScriptError(*session.definition_error);
  }
  return 1;
}

constexpr Option kEmitOptions[] = {
    {"name", T::kString, "part1, part2, ...", "name of the part, or of the group", false},
};
constexpr const char* kPartDoc = "a solid, a shape, or a table of them";
constexpr FunctionSpec kEmit{
    "emit",
    "Adds a part, or a table of parts, to the result, beside what the script returns.",
    kEmitOptions,
    false,
    "emit(lid, {name = \"lid\"})",
    "part",
    kPartDoc};
constexpr FunctionSpec kRender{"render",
                               "Adds a part to the result: another name of emit.",
                               kEmitOptions,
                               false,
                               "render(lid, {name = \"lid\"})",
                               "part",
                               kPartDoc};

template <const FunctionSpec& Spec>
int emit(lua_State* L) {
  if (lua_gettop(L) == 0) fail_in(Spec, "needs a part");
  // The first argument may be a table of parts, so it is not read as options: emit{lid = a, box =
  // b}.
  const Arguments arguments(L, Spec, 2);
  try {
    add_parts(L, 1, arguments.string("name", ""));
  } catch (const ScriptError& error) {
    fail_in(Spec, error.what());
  }
  return 0;
}

constexpr Binding kBindings[] = {
    {&kImport, guarded<import_mesh>, nullptr, nullptr},
    {&kRequire, guarded<require_module>, nullptr, nullptr},
    {&kParam, guarded<param>, nullptr, nullptr},
    {&kEmit, guarded<emit<kEmit>>, nullptr, nullptr},
    {&kRender, guarded<emit<kRender>>, nullptr, nullptr},
};

}  // namespace

std::span<const Binding> model_bindings() { return kBindings; }

}  // namespace csgrun
