// What connects a script with the world: import, require, emit, render.
#include <algorithm>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include <fmt/format.h>

#include <csgrun/primitives/flat_file.h>

#include "lua_bindings/affine_maps.h"
#include "lua_bindings/api.h"
#include "lua_bindings/call_site.h"
#include "lua_bindings/guard.h"
#include "lua_bindings/model_parts.h"
#include "lua_bindings/parts.h"
#include "lua_bindings/sandbox.h"
#include "lua_bindings/session.h"
#include "lua_bindings/shipped_calls.h"
#include "lua_bindings/shipped_modules.h"

namespace csgrun {
namespace {

using T = ArgumentType;

constexpr Option kImportOptions[] = {
    {"file", T::kString, "",
     "STL, OFF, OBJ, PLY, GLB, glTF, 3MF, AMF, SVG or DXF, relative to the file that calls, or "
     "else to "
     "the\n          folders of -L and CSGRUN_PATH",
     true},
    {"parts", T::kBoolean, "false",
     "gives a list of its parts, which have the names that the file has for them, instead of their "
     "union;\n          of a drawing: the outermost elements of an SVG, the layers of a DXF\n"
     "          (without parts they are one drawing: where two overlap is a hole)",
     false},
    {"fill", T::kString, "\"nonzero\"", kFillDoc, false},
    {"repair", T::kValue, "false",
     "makes a broken mesh a closed one and warns of all it does: true, or a table of\n"
     "          weld = MM (0: how far apart points of open edges may be that become one),\n"
     "          fill_holes (false: closes what is open), orient (true: turns faces to agree, "
     "surfaces\n"
     "          outwards), drop_degenerate (true: drops faces whose points lie on one line),\n"
     "          drop_duplicates (true: of faces on the same points those that are too many)",
     false},
    {"layer", T::kString, "", "of a drawing: only this layer (in an SVG one of Inkscape)", false},
    {"id", T::kString, "", "of an SVG: only the element of this id, with what is in it", false},
    {"dpi", T::kNumber, "72",
     "of an SVG with a viewBox: user units an inch, where its size has no unit", false,
     Range::kPositive},
    {"origin", T::kVector2, "{0, 0}",
     "of a DXF, whose points go to the nearest 1/1024: this one becomes the origin", false},
    {"scale", T::kNumber, "1", "of a DXF: a factor", false, Range::kPositive},
    {"center", T::kBoolean, "false", "the middle of its box becomes the origin", false},
    {"as_openscad", T::kBoolean, "false",
     "of a drawing: by OpenSCAD's rules of what is area and how many pieces curves have;\n"
     "          a layer or an id that is not there is empty, and what is damaged or hidden in a\n"
     "          DXF is read as OpenSCAD does",
     false},
    kConvexityOption,
};
constexpr FunctionSpec kImport{
    "import",
    "A solid from a file, with its colours; its meshes must be closed, or are repaired on request. "
    "Where one crosses itself, fill says what is inside. A shape from a drawing: what is filled or "
    "closed.",
    kImportOptions, true, "import(\"scan.stl\", {repair = {weld = 0.01, fill_holes = true}})"};

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

/// The parts of a file as nodes; read once.
const std::vector<SolidPart>& import_parts(lua_State* L, const Files::Opened& file,
                                           const ModelPartOptions& options) {
  Session& session = session_of(L);
  auto& parts = session.imported[{file.real, options.fill, options.repair}];
  if (!parts.empty()) return parts;
  const EvaluationScope scope(session.budget());  // reading a large file is no fault of the script
  std::vector<std::string> notes;
  std::vector<ModelPart> read =
      value_or_fail(kImport, read_model_parts(file.display, file.bytes, options, &notes));
  for (const std::string& note : notes) session.warn(L, "import: " + note);
  return parts = solid_parts_of(std::move(read), session.source_ref(L), [&](PolygonMesh mesh) {
           mesh.kind =
               session.files().name_from_folder(file.display);  // what is written names it so
           return counted_leaf(L, std::move(mesh));
         });
}

/// The parts moved together, so that the middle of their box lies in the origin.
void center_parts(Session& session, const SourceRef& where, std::vector<SolidPart>& parts) {
  std::vector<NodePtr> nodes;
  for (const SolidPart& part : parts) nodes.push_back(part.node);
  const Extent extent =
      session.extent(SolidValue(Node::boolean(BooleanOp::kUnion, std::move(nodes), where)));
  if (extent.empty) return;
  const glm::dvec3 middle = (extent.bbox[0] + extent.bbox[1]) / 2.0;
  for (SolidPart& part : parts)
    part.node = Node::transformed(translation(-middle), part.node, where);
}

/// A drawing as a shape.
int import_drawing(lua_State* L, const Arguments& arguments, const std::string& path) {
  const std::string format = flat_file_format_of(path);
  for (const char* name : {"fill", "repair"}) {
    if (arguments.has(name))
      fail_in(kImport, fmt::format("option '{}' is for meshes, not for drawings", name));
  }
  for (const auto& [name, of] : {std::pair{"id", "svg"}, std::pair{"dpi", "svg"},
                                 std::pair{"origin", "dxf"}, std::pair{"scale", "dxf"}}) {
    if (arguments.has(name) && format != of)
      fail_in(kImport, fmt::format("option '{}' is for .{} files", name, of));
  }
  FlatFileOptions options;
  const auto given = [&](const char* name) -> std::optional<std::string> {
    std::string text = arguments.string(name, "");
    if (text.empty()) return std::nullopt;
    return text;
  };
  options.layer = given("layer");
  options.id = given("id");
  options.as_openscad = arguments.boolean("as_openscad", false);
  if (options.layer && options.id && !options.as_openscad)
    fail_in(kImport, "give either 'layer' or 'id', not both");
  options.parts = arguments.boolean("parts", false);
  if (options.parts && (options.layer || options.id))
    fail_in(kImport,
            "option 'parts' gives all parts of a drawing: it goes with neither 'layer' nor 'id'");
  if (options.parts && options.as_openscad)
    fail_in(kImport, "option 'parts' does not go with 'as_openscad'");
  options.dpi = arguments.number("dpi", 72);
  options.scale = arguments.number("scale", 1);
  if (const auto origin = arguments.vector("origin")) options.origin = {origin->v.x, origin->v.y};
  options.center = arguments.boolean("center", false);
  options.facets = arguments.facets();
  Session& session = session_of(L);
  Files::Opened file;
  try {
    file = session.files().open(calling_file(L), path);
  } catch (const ScriptError& error) {
    fail_in(kImport, error.what());
  }
  FlatFile drawing = value_or_fail(kImport, parse_flat(file.display, file.bytes, options));
  for (const std::string& note : drawing.notes) session.warn(L, "import: " + note);
  if (!options.parts) {
    push_shape(L, std::move(drawing.shape), {});
    return 1;
  }
  lua_createtable(L, static_cast<int>(drawing.parts.size()), 0);
  for (size_t i = 0; i < drawing.parts.size(); ++i) {
    push_shape(L, std::move(drawing.parts[i].shape), {});
    marks_of(L, -1)->name = drawing.parts[i].name;
    lua_rawseti(L, -2, static_cast<lua_Integer>(i + 1));
  }
  return 1;
}

int import_file(lua_State* L) {
  const Arguments arguments(L, kImport, 1);
  const std::string path = arguments.string("file", "");
  if (path.empty()) fail_in(kImport, "needs the name of a file");
  if (!flat_file_format_of(path).empty()) return import_drawing(L, arguments, path);
  if (model_file_format_of(path).empty()) {
    fail_in(kImport, "'" + path +
                         "' has none of the endings .stl, .off, .obj, .ply, .glb, .gltf, .3mf, "
                         ".amf, .svg, .dxf" +
                         (path.ends_with(".lua")   ? "; a script is read by require \"name\""
                          : path.ends_with(".csg") ? "; a tree is read by load_csg(file)"
                                                   : ""));
  }
  for (const char* name :
       {"layer", "id", "dpi", "origin", "scale", "as_openscad", "fn", "fa", "fs"}) {
    if (arguments.has(name))
      fail_in(kImport, fmt::format("option '{}' is for drawings, not for meshes", name));
  }
  Session& session = session_of(L);
  Files::Opened file;
  try {
    file = session.files().open(calling_file(L), path);
  } catch (const ScriptError& error) {
    fail_in(kImport, error.what());
  }
  ModelPartOptions options;
  options.fill = fill_argument(arguments, kImport);
  options.repair = repair_argument(L, arguments);
  options.open = [&](const std::string& name) -> Result<std::string> {
    try {
      return session.files().open(file.display, name).bytes;
    } catch (const ScriptError& error) {
      return Error{ErrorCode::kCannotRead, error.what(), {}};
    }
  };
  std::vector<SolidPart> parts = import_parts(L, file, options);
  if (arguments.boolean("center", false)) center_parts(session, session.source_ref(L), parts);
  if (arguments.boolean("parts", false)) {
    lua_createtable(L, static_cast<int>(parts.size()), 0);
    for (size_t i = 0; i < parts.size(); ++i) {
      push_solid(L, parts[i].node);
      marks_of(L, -1)->name = parts[i].name;
      lua_rawseti(L, -2, static_cast<lua_Integer>(i + 1));
    }
  } else if (parts.size() == 1) {
    push_solid(L, parts[0].node);
  } else {
    std::vector<NodePtr> nodes;
    for (const auto& part : parts) nodes.push_back(part.node);
    push_solid(L, Node::boolean(BooleanOp::kUnion, std::move(nodes), session.source_ref(L)));
  }
  return 1;
}

constexpr Option kRequireOptions[] = {
    {"name", T::kString, "",
     "a module of csgrun's own library (csg.gears, csg.layout, csg.options, csg.threads), or the\n"
     "          file name.lua or name/init.lua in the model's folder, in csgrun_modules beside it, "
     "in\n"
     "          the folders of -L and in those of CSGRUN_PATH, and before these where package.path "
     "says;\n"
     "          a dot in the name opens a folder",
     true},
};
constexpr FunctionSpec kRequire{"require", "Runs a module once and gives what it returns.",
                                kRequireOptions, false, "local wheel = require \"parts.wheel\""};

const char kLoadedModules = 0;  // registry: real path -> value

/// A module while it runs.
class LoadingModule {
 public:
  LoadingModule(Session& session, const std::string& place)
      : all_(session.loading_modules), is_first_(all_.insert(place).second), place_(place) {}
  ~LoadingModule() {
    if (is_first_) all_.erase(place_);
  }
  LoadingModule(const LoadingModule&) = delete;
  LoadingModule& operator=(const LoadingModule&) = delete;
  /// Whether it does not run already.
  [[nodiscard]] bool is_first() const { return is_first_; }

 private:
  std::set<std::string>& all_;
  const bool is_first_;
  const std::string place_;
};

int require_module(lua_State* L) {
  const Arguments arguments(L, kRequire, 1);
  if (!arguments.has("name")) fail_in(kRequire, "needs the name of a module");
  const std::string name = arguments.string("name", "");
  if (name == "csg" || name == "luacad") {  // what a script has without asking
    lua_getglobal(L, "csg");
    return 1;
  }
  Files::Opened file;
  try {
    file = session_of(L).files().open_module(name, package_path(L));
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
  if (!lua_isnil(L, -1)) return 1;
  const LoadingModule loading(session_of(L), file.real);
  if (!loading.is_first())
    fail_in(kRequire, "module '" + name + "' requires itself while it is loaded");
  load_chunk(L, file.display, file.bytes);
  const bool is_shipped = file.real.starts_with(kShippedPlace);
  if (is_shipped) give_kept_globals(L);
  lua_pushstring(L, name.c_str());
  lua_call(L, 1, 1);
  if (is_shipped) guard_shipped_module(L, name);
  if (lua_isnil(L, -1)) {
    lua_pop(L, 1);
    lua_pushboolean(L, 1);
  }
  lua_pushvalue(L, -1);
  lua_setfield(L, loaded, file.real.c_str());
  return 1;
}

constexpr Option kEmitOptions[] = {
    {"name", T::kString, "part1, part2, ...", "name of the part, or of the group", true},
};
constexpr const char* kNamedDoc =
    "a solid, a shape, or a table of them; several may stand one after another";
constexpr FunctionSpec kEmit{
    "emit",
    "Adds a part, or a table of parts, to the result, beside what the script returns.",
    kEmitOptions,
    false,
    "emit(lid, \"lid\")",
    "part",
    kNamedDoc};
constexpr FunctionSpec kRender{"render",
                               "Adds a part to the result: another name of emit.",
                               kEmitOptions,
                               false,
                               "render(lid, {name = \"lid\"})",
                               "part",
                               kNamedDoc};

/// render(a, b, c): several parts one after another are a table of them.
void pack_parts(lua_State* L) {
  int count = 1;
  while (count < lua_gettop(L) && marks_of(L, count + 1) != nullptr) ++count;
  if (count == 1 || lua_istable(L, 1)) return;
  lua_createtable(L, count, 0);
  for (int i = 1; i <= count; ++i) {
    lua_pushvalue(L, i);
    lua_rawseti(L, -2, i);
  }
  lua_replace(L, 1);
  for (; count > 1; --count) lua_remove(L, 2);
}

template <const FunctionSpec& Spec>
int emit(lua_State* L) {
  if (lua_gettop(L) == 0) fail_in(Spec, "needs a part");
  if (lua_type(L, 1) == LUA_TSTRING && marks_of(L, 2) != nullptr)
    fail_in(Spec, "the part stands first, then its name");
  pack_parts(L);
  // The first argument may be a table of parts, so it is not read as options: emit{lid = a, box =
  // b}.
  const Arguments arguments(L, Spec, 2);
  if (arguments.has("name") && arguments.string("name", "").empty())
    fail_in(Spec, "option 'name' must not be empty");
  try {
    add_parts(L, 1, arguments.string("name", ""));
  } catch (const ScriptError& error) {
    fail_in(Spec, error.what());
  }
  return 0;
}

constexpr Binding kModelBindings[] = {
    {&kImport, guarded<import_file>, nullptr, nullptr},
    {&kRequire, guarded<require_module>, nullptr, nullptr},
    {&kEmit, guarded<emit<kEmit>>, nullptr, nullptr},
    {&kRender, guarded<emit<kRender>>, nullptr, nullptr},
};

}  // namespace

std::span<const Binding> model_bindings() { return kModelBindings; }

}  // namespace csgrun
