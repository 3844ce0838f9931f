#include "lua_bindings/values.h"

#include <algorithm>
#include <cmath>
#include <new>
#include <utility>

#include "lua_bindings/arguments.h"
#include "lua_bindings/guard.h"
#include "lua_bindings/session.h"

namespace csgrun {
namespace {

/// Memory of a node and its place in its parent, for the collector: Lua sees 40 bytes of it.
constexpr size_t kNodeBytes = 256;
constexpr size_t kCollectorStepBytes = size_t{1} << 20;

template <class V>
V* to_value(lua_State* L, int index) {
  return static_cast<V*>(luaL_testudata(L, index, V::kName));
}

template <class V>
void push_value(lua_State* L, V value) {
  value.serial = session_of(L).next_serial();
  void* place = lua_newuserdatauv(L, sizeof(V), 0);
  new (place) V(std::move(value));
  luaL_setmetatable(L, V::kName);
}

template <class V>
int collect(lua_State* L) {
  static_cast<V*>(lua_touserdata(L, 1))->~V();
  return 0;
}

template <class V>
void open_value(lua_State* L) {
  luaL_newmetatable(L, V::kName);
  lua_pushcfunction(L, collect<V>);
  lua_setfield(L, -2, "__gc");
  lua_pushstring(L, V::kName);
  lua_setfield(L, -2, "__metatable");  // scripts can neither read nor change it
  lua_pop(L, 1);
}

/// Tells the collector of memory that it does not see, so that dropped meshes are freed in time.
void account(lua_State* L, size_t bytes) {
  static_assert(kCollectorStepBytes % 1024 == 0);
  size_t& debt = session_of(L).collector_debt;
  debt += bytes;
  if (debt < kCollectorStepBytes) return;
  const size_t kilobytes = debt / 1024;
  debt = 0;
  lua_gc(L, LUA_GCSTEP, static_cast<int>(std::min<size_t>(kilobytes, 1u << 20)));
}

size_t mesh_bytes(const PolygonMesh& mesh) {
  return sizeof(PolygonMesh) + mesh.points.capacity() * sizeof(mesh.points[0]) +
         (mesh.corners.capacity() + mesh.loop_starts.capacity() + mesh.face_starts.capacity() +
          mesh.surface.capacity() + mesh.appearance_of.capacity()) *
             sizeof(uint32_t);
}

}  // namespace

void open_values(lua_State* L) {
  open_value<SolidValue>(L);
  open_value<ShapeValue>(L);
  open_value<MatrixValue>(L);
}

void push_solid(lua_State* L, NodePtr node) {
  push_value(L, SolidValue(std::move(node)));
  account(L, kNodeBytes);
}

void push_shape(lua_State* L, Shape2D shape, std::optional<Appearance> appearance) {
  const size_t bytes = kNodeBytes + shape.bytes();
  ShapeValue value;
  value.shape = std::move(shape);
  value.appearance = std::move(appearance);
  value.where = session_of(L).source_ref(L);
  push_value(L, std::move(value));
  account(L, bytes);
}

void push_matrix(lua_State* L, const Affine& map) { push_value(L, MatrixValue{{}, map}); }

Marks* marks_of(lua_State* L, int index) {
  if (SolidValue* solid = to_solid(L, index)) return &solid->marks;
  if (ShapeValue* shape = to_shape(L, index)) return &shape->marks;
  return nullptr;
}

void keep_marks(lua_State* L, int index) {
  const Marks* const marks = marks_of(L, index);
  if (marks == nullptr) return;
  *marks_of(L, -1) = *marks;
  // A solid that was made of the only one is the only one, wherever it stands.
  const SolidValue* const solid = marks->only ? to_solid(L, -1) : nullptr;
  if (solid != nullptr) session_of(L).only_nodes.emplace(solid->node.get(), solid->node);
}

SolidValue* to_solid(lua_State* L, int index) { return to_value<SolidValue>(L, index); }
ShapeValue* to_shape(lua_State* L, int index) { return to_value<ShapeValue>(L, index); }
MatrixValue* to_matrix(lua_State* L, int index) { return to_value<MatrixValue>(L, index); }

bool to_affine(lua_State* L, int index, Affine& map) {
  if (const MatrixValue* value = to_matrix(L, index)) {
    map = value->map;
    return true;
  }
  if (!lua_istable(L, index)) return false;
  index = lua_absindex(L, index);
  double m[4][4] = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}};
  const auto rows = static_cast<int>(std::min<size_t>(lua_rawlen(L, index), 5));
  if (rows == 0 || rows > 4) return false;
  for (int i = 0; i < rows; ++i) {
    lua_rawgeti(L, index, i + 1);
    const auto columns =
        lua_istable(L, -1) ? static_cast<int>(std::min<size_t>(lua_rawlen(L, -1), 5)) : 5;
    if (columns > 4) {
      lua_pop(L, 1);
      return false;
    }
    for (int j = 0; j < columns; ++j) {
      if (lua_rawgeti(L, -1, j + 1) != LUA_TNUMBER || !std::isfinite(lua_tonumber(L, -1))) {
        throw ScriptError("entry [" + std::to_string(i + 1) + "][" + std::to_string(j + 1) +
                          "] of a matrix must be a finite number, got " + describe_value(L, -1));
      }
      m[i][j] = lua_tonumber(L, -1);
      lua_pop(L, 1);
    }
    lua_pop(L, 1);
  }
  if (m[3][0] != 0 || m[3][1] != 0 || m[3][2] != 0 || m[3][3] == 0) {
    throw ScriptError("the last row of a matrix must be {0, 0, 0, w} with w other than 0");
  }
  for (size_t i = 0; i < 3; ++i) {
    for (size_t j = 0; j < 4; ++j) map.m[i][j] = m[i][j] / m[3][3];
  }
  return true;
}

uint64_t value_serial(lua_State* L, int index) {
  if (const auto* solid = to_solid(L, index)) return solid->serial;
  if (const auto* shape = to_shape(L, index)) return shape->serial;
  if (const auto* matrix = to_matrix(L, index)) return matrix->serial;
  return 0;
}

std::string kind_name(lua_State* L, int index) {
  if (to_solid(L, index) != nullptr) return SolidValue::kName;
  if (to_shape(L, index) != nullptr) return ShapeValue::kName;
  if (to_matrix(L, index) != nullptr) return MatrixValue::kName;
  return luaL_typename(L, index);
}

NodePtr counted_leaf(lua_State* L, PolygonMesh mesh) {
  Session& session = session_of(L);
  const size_t bytes = mesh_bytes(mesh);
  const auto counter = session.budget().held_bytes();
  const std::shared_ptr<const PolygonMesh> owned(
      new PolygonMesh(std::move(mesh)), [bytes, counter](const PolygonMesh* dead) {
        counter->fetch_sub(bytes, std::memory_order_relaxed);
        delete dead;
      });
  counter->fetch_add(bytes, std::memory_order_relaxed);
  if (!session.budget().within_heap()) {
    lua_gc(L, LUA_GCCOLLECT);  // as Lua does before it gives up
    if (!session.budget().within_heap()) throw ScriptError(session.budget().memory_message());
  }
  account(L, bytes);
  return Node::leaf(owned, session.source_ref(L));
}

void push_list(lua_State* L, std::initializer_list<double> numbers) {
  lua_createtable(L, static_cast<int>(numbers.size()), 0);
  lua_Integer i = 0;
  for (const double x : numbers) {
    lua_pushnumber(L, x);
    lua_rawseti(L, -2, ++i);
  }
}

void push_point(lua_State* L, const glm::dvec3& point) {
  push_list(L, {point.x, point.y, point.z});
  luaL_setmetatable(L, kVectorName);
}

void push_point(lua_State* L, const glm::dvec2& point) {
  push_list(L, {point.x, point.y});
  luaL_setmetatable(L, kVectorName);
}

}  // namespace csgrun
