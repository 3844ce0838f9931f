// The values of the language: solids, 2D shapes, matrices. Immutable; scripts hold references.
#pragma once

#include <initializer_list>
#include <optional>
#include <string>
#include <utility>

#include <lua.hpp>

#include <csgrun/engine/csg_tree.h>
#include <csgrun/engine/solid.h>
#include <csgrun/primitives/shape2d.h>

namespace csgrun {

/// What a script said of a solid or a shape beside its geometry. Transforms, colours and extrusions
/// keep it.
struct Marks {
  std::string name;     ///< of the part that it becomes; empty: none
  bool absent = false;  ///< skipped: no operand and no part; its geometry is empty
  bool only = false;    ///< it alone is to be a part; solids are in Session::only_nodes, too
};

/// What all values have.
struct Value {
  uint64_t serial = 0;  ///< position in the order of making
  Marks marks;
};

struct SolidValue : Value {
  static constexpr const char* kName = "solid";
  explicit SolidValue(NodePtr n) : node(std::move(n)) {}
  NodePtr node;
  SolidPtr evaluated;           ///< once it was asked for: see Session::evaluated
  uint64_t evaluated_with = 0;  ///< the number of the settings that it was evaluated with
  Measuring measuring{};        ///< what `evaluated` has of measures
  double grid_mm = 0;           ///< the step of the grid that it was evaluated on
  [[nodiscard]] bool is_evaluated_with(uint64_t settings) const {
    return evaluated && evaluated_with == settings;
  }
};

struct ShapeValue : Value {
  static constexpr const char* kName = "shape";
  Shape2D shape;
  std::optional<Appearance> appearance;  ///< painted on what is extruded from it
  SourceRef where;
};

struct MatrixValue : Value {
  static constexpr const char* kName = "matrix";
  Affine map;
};

void push_solid(lua_State* L, NodePtr node);
void push_shape(lua_State* L, Shape2D shape, std::optional<Appearance> appearance);
void push_matrix(lua_State* L, const Affine& map);

/// The marks of the solid or shape at `index`, or null when it is something else.
Marks* marks_of(lua_State* L, int index);
/// Gives the value on the top of the stack the marks of the one at `index`.
void keep_marks(lua_State* L, int index);

/// The value at `index`, or null when it is something else.
SolidValue* to_solid(lua_State* L, int index);
ShapeValue* to_shape(lua_State* L, int index);
MatrixValue* to_matrix(lua_State* L, int index);
/// A matrix value, or a list of rows (missing entries from the identity, divided by [4][4]).
/// False when it is neither; throws ScriptError when an entry is no finite number.
bool to_affine(lua_State* L, int index, Affine& map);

/// The serial of a value, or 0 when it is something else.
uint64_t value_serial(lua_State* L, int index);

/// Type name for messages: "solid", "shape", "matrix", "string" ...
std::string kind_name(lua_State* L, int index);

/// Registers the metatables; methods and operators are added by open_api.
void open_values(lua_State* L);

/// A leaf whose mesh counts against the script's memory until it is freed.
NodePtr counted_leaf(lua_State* L, PolygonMesh mesh);

/// A list of numbers {a, b, c}.
void push_list(lua_State* L, std::initializer_list<double> numbers);
/// The name of the metatable of vectors, as vec() makes them.
constexpr const char* kVectorName = "vector";
/// A vector: a list of its coordinates, with .x .y .z and operators. In a plane it has two.
void push_point(lua_State* L, const glm::dvec3& point);
void push_point(lua_State* L, const glm::dvec2& point);

}  // namespace csgrun
