// Operands of functions that take any number of solids, or of shapes: Booleans, hulls, sums.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <lua.hpp>

#include <csgrun/engine/csg_tree.h>
#include <csgrun/primitives/shape2d.h>

#include "lua_bindings/arguments.h"

namespace csgrun {

/// All solids, or all shapes.
struct Operands {
  std::vector<NodePtr> solids;
  std::vector<Shape2D> shapes;
  std::optional<Appearance> appearance;         ///< of the first shape
  std::string name;                             ///< of the first operand
  bool has_solids = false, has_shapes = false;  ///< skipped ones count here, and are not listed
  bool drops_colour = false;                    ///< a later shape has another colour than the first

  /// Takes the value at `index`. Throws ScriptError that begins with `function`.
  void add(lua_State* L, int index, const std::string& function);
  /// Cut faces will have the appearance of what is cut, instead of the tools'.
  void paint_tools_as_body();
  /// Warns if what comes of them has one colour, that of the first, and others have other ones: a
  /// 2D shape, a hull or a sum.
  void warn_of_colours(lua_State* L, const std::string& function) const;
  /// The result has the name of the first operand.
  void push_result(lua_State* L, BooleanOp op, const std::string& function) const;
};

/// The arguments one after another, or as lists: f(a, b), f{a, b}, a:f(b). Throws ScriptError.
Operands read_operands(lua_State* L, const FunctionSpec& spec);

/// f{shape, 16, twist = 90}: the shape or solid comes out of the list to stack index 1, and the
/// rest stays a table of options behind it. Anything else stays as it is.
void take_subject_out_of_list(lua_State* L);

/// What stands for the subject in tables of options.
constexpr const char* kShapeDoc = "the 2D shape; as a method, shape:f(...), it is left out";

}  // namespace csgrun
