// The functions of the language: each is a table of its arguments and one to three C functions.
#pragma once

#include <span>
#include <string>
#include <vector>

#include <lua.hpp>

#include <csgrun/engine/error.h>
#include <csgrun/engine/polygon_mesh.h>
#include <csgrun/primitives/shape2d.h>

#include "lua_bindings/arguments.h"
#include "lua_bindings/values.h"

namespace csgrun {

/// One name of the language. Null where it does not exist in that form.
struct Binding {
  const FunctionSpec* spec;
  lua_CFunction function;                 ///< as a global and in `csg`
  lua_CFunction solid_method;             ///< as solid:name(...)
  lua_CFunction shape_method;             ///< as shape:name(...)
  lua_CFunction matrix_method = nullptr;  ///< as matrix:name(...)
};

std::span<const Binding> solid_bindings();
std::span<const Binding> shape_bindings();
std::span<const Binding> outline_bindings();
std::span<const Binding> construction_bindings();
std::span<const Binding> section_bindings();
std::span<const Binding> edge_bindings();
std::span<const Binding> surface_bindings();
std::span<const Binding> text_bindings();
std::span<const Binding> sweep_bindings();
std::span<const Binding> transform_bindings();
std::span<const Binding> boolean_bindings();
std::span<const Binding> measure_bindings();
std::span<const Binding> math_bindings();
std::span<const Binding> vector_bindings();
std::span<const Binding> color_bindings();
std::span<const Binding> mark_bindings();
std::span<const Binding> polyhedron_bindings();
std::span<const Binding> array_bindings();
std::span<const Binding> selecting_bindings();
std::span<const Binding> parameter_bindings();
std::span<const Binding> file_bindings();
std::span<const Binding> model_bindings();

/// Functions that belong together, for the pages of the language.
struct BindingGroup {
  const char* title;
  const char* result;  ///< what most of them give: "Solid", "number", or "same" as their subject
  std::span<const Binding> bindings;
};
std::vector<BindingGroup> binding_groups();

/// All of them, group after group.
std::vector<Binding> all_bindings();

/// Sets globals, `csg`, methods and operators.
void open_api(lua_State* L);

/// The text of `csgrun --help-api`.
std::string api_help();

// For the bindings.

/// "cube: message" as a ScriptError.
[[noreturn]] void fail_in(const FunctionSpec& spec, const std::string& message);
/// The same, of what the primitives say: the name of the one that says it is left out.
[[noreturn]] void fail_making(const FunctionSpec& spec, const std::string& message);
/// The value, or a ScriptError that names the function.
template <class V>
V value_or_fail(const FunctionSpec& spec, Result<V> result) {
  if (!result) fail_making(spec, result.error().message);
  return *std::move(result);
}
/// The shape at stack index 1, or an error that says what is wanted.
ShapeValue& shape_argument(lua_State* L, const FunctionSpec& spec);
SolidValue& solid_argument(lua_State* L, const FunctionSpec& spec);
/// The same for what is made of the solid as it is now. One that has parts marked by only() in it
/// gives way to these, as it does in the result: they cannot be found in what is made of it.
SolidValue& final_solid_argument(lua_State* L, const FunctionSpec& spec);
/// Sees to it that a solid or a shape is at stack index 1.
void part_argument(lua_State* L, const FunctionSpec& spec);
/// What option "fill" says (nonzero when it was not given), or an error that lists the rules.
FillRule fill_argument(const Arguments& arguments, const FunctionSpec& spec);
/// The meaning of option "fill", for tables of options.
constexpr char kFillDoc[] =
    "what is inside where the surface crosses itself, by how often it wraps around a point, one\n"
    "          way less the other: \"nonzero\" (wherever that is not 0: overlaps are united, but "
    "an\n"
    "          inverted part cancels what it overlaps), \"positive\" (inverted parts are cut "
    "away),\n"
    "          \"evenodd\" (an odd number: overlaps cancel)";
/// Pushes a mesh as a solid, with the shape's colour if it has one.
void push_leaf(lua_State* L, PolygonMesh mesh, const std::optional<Appearance>& appearance = {});
/// Pushes the shape at `index` under a map, with its colour and marks. Warns of what leaves its
/// plane.
void push_moved_shape(lua_State* L, int index, const Affine& map, const std::string& function);
/// Sets the operators of solids, shapes and matrices.
void open_operators(lua_State* L);
/// Registers what vec() gives.
void open_vectors(lua_State* L);
/// Registers what bbox() gives.
void open_boxes(lua_State* L);

}  // namespace csgrun
