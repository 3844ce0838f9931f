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
  std::vector<Shape2D> only_shapes;             ///< those of them that alone are to be the result
  std::optional<Appearance> appearance;         ///< of the first shape
  std::string name;                             ///< of the first operand that is not skipped
  bool has_solids = false, has_shapes = false;  ///< skipped ones count here, and are not listed
  bool has_first = false;                       ///< one that is not skipped
  bool drops_colour = false;                    ///< a later shape has another colour than the first

  /// Takes the value at `index`. Throws ScriptError that begins with `function`.
  void add(lua_State* L, int index, const std::string& function);
  /// Cut faces will have the appearance of what is cut, instead of the tools'.
  void paint_tools_as_body();
  /// Warns if what comes of them has one colour, that of the first, and others have other ones: a
  /// 2D shape, a hull or a sum.
  void warn_of_colours(lua_State* L, const std::string& function) const;
  /// Where some of the shapes alone are to be the result, pushes them, so marked; else false.
  bool push_only_shapes(lua_State* L, const std::string& function) const;
  /// The result has the name of the first operand.
  void push_result(lua_State* L, BooleanOp op, const std::string& function) const;
};

/// The arguments one after another, or as lists: f(a, b), f{a, b}, a:f(b). Throws ScriptError.
Operands read_operands(lua_State* L, const FunctionSpec& spec);

/// The solid or shape that a function works on may stand anywhere among its values, as in
/// f(20, shape), OpenSCAD's order, and in f{shape, 16, twist = 90}: it goes to stack index 1, and
/// the rest stays behind it. Where there is none, or more than one, everything stays as it is.
void bring_subject_to_front(lua_State* L);

/// f{a, b, x = 1}, where the list is itself the value of `option`: it goes to that name. Nothing
/// happens to one value, to a list that begins with a number or a string, or without names beside.
void name_list_part(lua_State* L, const char* option);

/// What stands for the subject in tables of options.
constexpr const char* kShapeDoc = "the 2D shape; as a method, shape:f(...), it is left out";

}  // namespace csgrun
