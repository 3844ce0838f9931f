// vec, cross, norm; lookup, rands; abs, sqrt, floor and the like as globals.
//
// A vector is a list of three numbers with operators: whatever takes a list takes a vector.
#include <algorithm>
#include <bit>
#include <cmath>

#include <fmt/format.h>

#include <csgrun/primitives/trig.h>

#include "lua_bindings/api.h"
#include "lua_bindings/guard.h"
#include "lua_bindings/nearest.h"
#include "lua_bindings/session.h"

namespace csgrun {
namespace {

using T = ArgumentType;

constexpr lua_Integer kMostRandomNumbers = 10'000'000;

/// Of vectors in a plane the result is one, too: `count` says how many numbers they have at most.
void push_vector(lua_State* L, const glm::dvec3& v, lua_Integer count = 3) {
  if (count == 2) return push_point(L, glm::dvec2(v.x, v.y));
  push_point(L, v);
}

/// How many numbers the vector at `index` has.
lua_Integer size_at(lua_State* L, int index) {
  return static_cast<lua_Integer>(lua_rawlen(L, index));
}

double dot(const glm::dvec3& a, const glm::dvec3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

glm::dvec3 cross(const glm::dvec3& a, const glm::dvec3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// The two or three numbers of a list.
glm::dvec3 read_vector(lua_State* L, int index, const char* function) {
  const lua_Integer length = lua_istable(L, index) ? list_length(L, index) : 0;
  glm::dvec3 v(0, 0, 0);
  bool good = length == 2 || length == 3;
  for (int i = 0; good && i < length; ++i) {
    good = lua_rawgeti(L, index, i + 1) == LUA_TNUMBER;
    v[i] = lua_tonumber(L, -1);
    lua_pop(L, 1);
  }
  if (!good) {
    throw ScriptError(fmt::format("{}: a vector is a list of two or three numbers, got {}",
                                  function, describe_value(L, index)));
  }
  return v;
}

constexpr Option kVecOptions[] = {
    {"v", T::kVector2Or3, "", "x, y and z; z is 0 if it is left out", true},
};
constexpr FunctionSpec kVec{
    "vec",
    "A list {x, y, z} with + - * / and ==, and with len, unit, cross, scalar, normal, rot as "
    "methods; * of two is their scalar product.",
    kVecOptions, false, "vec(1, 0, 0) * 10 + vec(0, 5)"};
constexpr FunctionSpec kVector{"vector", "Another name of vec.", kVecOptions, false,
                               "vector(1, 2, 3):len()"};

template <const FunctionSpec& Spec>
int make_vector(lua_State* L) {
  const Arguments arguments(L, Spec, 1);
  const auto v = arguments.vector("v");
  if (!v) fail_in(Spec, "needs two or three numbers");
  push_vector(L, v->v);
  return 1;
}

constexpr Option kCrossOptions[] = {
    {"a", T::kVector3, "", "a vector", true},
    {"b", T::kVector3, "", "another", true},
};
constexpr FunctionSpec kCross{"cross", "The vector product.", kCrossOptions, false,
                              "cross({1, 0, 0}, {0, 1, 0})"};

int cross_product(lua_State* L) {
  const Arguments arguments(L, kCross, 1);
  const auto a = arguments.vector("a"), b = arguments.vector("b");
  if (!a || !b) fail_in(kCross, "needs two vectors");
  push_vector(L, cross(a->v, b->v));
  return 1;
}

constexpr Option kNormOptions[] = {{"v", T::kVector2Or3, "", "a vector", true}};
constexpr FunctionSpec kNorm{"norm", "The length of a vector.", kNormOptions, false,
                             "norm{3, 4, 0}"};

int norm(lua_State* L) {
  const Arguments arguments(L, kNorm, 1);
  const auto v = arguments.vector("v");
  if (!v) fail_in(kNorm, "needs a vector");
  const double square = dot(v->v, v->v);
  // Squares may be beyond what doubles hold.
  const bool is_normal =
      std::isnormal(square) || !(std::fabs(v->v.x) + std::fabs(v->v.y) + std::fabs(v->v.z) > 0);
  lua_pushnumber(L, is_normal ? std::sqrt(square) : std::hypot(v->v.x, v->v.y, v->v.z));
  return 1;
}

constexpr Option kLookupOptions[] = {
    {"key", T::kNumber, "", "where to look", true},
    {"table", T::kPoints2, "", "pairs {key, value}, in any order", true},
};
constexpr FunctionSpec kLookup{
    "lookup", "The value at key, on straight lines between the pairs; beyond them the outermost's.",
    kLookupOptions, false, "lookup(5, {{0, 0}, {10, 100}})"};

int lookup(lua_State* L) {
  const Arguments arguments(L, kLookup, 1);
  if (!arguments.has("key") || arguments.points3("table").empty())
    fail_in(kLookup, "needs a key and a table of pairs");
  const double key = arguments.number("key", 0);
  std::vector<glm::dvec2> pairs = arguments.points2("table");
  std::stable_sort(pairs.begin(), pairs.end(), [](auto a, auto b) { return a.x < b.x; });
  const auto above = std::find_if(pairs.begin(), pairs.end(), [&](auto p) { return p.x >= key; });
  if (above == pairs.begin() || above == pairs.end()) {
    lua_pushnumber(L, above == pairs.end() ? pairs.back().y : above->y);
    return 1;
  }
  const glm::dvec2 low = above[-1], high = *above;
  lua_pushnumber(L, low.y + (high.y - low.y) * ((key - low.x) / (high.x - low.x)));
  return 1;
}

constexpr Option kRandsOptions[] = {
    {"min", T::kNumber, "", "the least", true},
    {"max", T::kNumber, "", "the greatest", true},
    {"n", T::kInteger, "", "how many", true, Range::kNotNegative},
    {"seed", T::kNumber, "", "the same seed, the same numbers; without one it goes on", true},
};
constexpr FunctionSpec kRands{"rands",
                              "A list of random numbers: the same on every run and machine.",
                              kRandsOptions, false, "rands(0, 1, 3, 42)"};

/// splitmix64 (Steele, Lea & Flood 2014).
uint64_t next_random(uint64_t& state) {
  uint64_t z = state += 0x9e3779b97f4a7c15U;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9U;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebU;
  return z ^ (z >> 31);
}

int rands(lua_State* L) {
  const Arguments arguments(L, kRands, 1);
  if (!arguments.has("min") || !arguments.has("max") || !arguments.has("n"))
    fail_in(kRands, "needs min, max and how many");
  const double low = arguments.number("min", 0), high = arguments.number("max", 1);
  const auto count = static_cast<lua_Integer>(arguments.number("n", 0));
  if (count > kMostRandomNumbers)
    fail_in(kRands, fmt::format("'n' must be at most {}, got {}", kMostRandomNumbers, count));
  uint64_t own = std::bit_cast<uint64_t>(arguments.number("seed", 0) + 0.0);
  uint64_t& state = arguments.has("seed") ? own : session_of(L).random_state;
  lua_createtable(L, static_cast<int>(count), 0);
  for (lua_Integer i = 1; i <= count; ++i) {
    const double fraction = static_cast<double>(next_random(state) >> 11) * 0x1p-53;
    lua_pushnumber(L, low + fraction * (high - low));
    lua_rawseti(L, -2, i);
  }
  return 1;
}

constexpr Option kX[] = {{"x", T::kNumber, "", "a number", true}};
constexpr Option kPower[] = {
    {"x", T::kNumber, "", "base", true},
    {"y", T::kNumber, "", "exponent", true},
};
constexpr Option kValues[] = {
    {"values", T::kValue, "", "numbers, one after another or as a list", true},
};
constexpr FunctionSpec kAbs{"abs", "The number without its sign.", kX, false, "abs(-3)"};
constexpr FunctionSpec kSign{"sign", "-1, 0 or 1.", kX, false, "sign(-0.5)"};
constexpr FunctionSpec kFloor{"floor", "The next whole number below.", kX, false, "floor(2.7)"};
constexpr FunctionSpec kCeil{"ceil", "The next whole number above.", kX, false, "ceil(2.1)"};
constexpr FunctionSpec kRound{"round", "The nearest whole number, halves away from 0.", kX, false,
                              "round(2.5)"};
constexpr FunctionSpec kSqrt{"sqrt", "The square root.", kX, false, "sqrt(2)"};
constexpr FunctionSpec kExp{"exp", "e to the power of x.", kX, false, "exp(1)"};
constexpr FunctionSpec kLn{"ln", "The natural logarithm.", kX, false, "ln(2)"};
constexpr FunctionSpec kPow{"pow", "x to the power of y.", kPower, false, "pow(2, 10)"};
constexpr FunctionSpec kMin{"min", "The least.", kValues, false, "min(3, 1, 2)"};
constexpr FunctionSpec kMax{"max", "The greatest.", kValues, false, "max{3, 1, 2}"};

/// Pushes a whole number as Lua's integer where it fits, as math.floor does.
void push_whole(lua_State* L, double x) {
  if (std::abs(x) < 0x1p53) {
    lua_pushinteger(L, static_cast<lua_Integer>(x));
  } else {
    lua_pushnumber(L, x);
  }
}

template <const FunctionSpec& Spec>
double only_number(lua_State* L) {
  const Arguments arguments(L, Spec, 1);
  if (!arguments.has("x")) fail_in(Spec, "needs a number");
  return arguments.number("x", 0);
}

template <const FunctionSpec& Spec, double (*Function)(double)>
int whole(lua_State* L) {
  push_whole(L, Function(only_number<Spec>(L)));
  return 1;
}

int absolute(lua_State* L) {
  const bool is_integer = lua_isinteger(L, 1) != 0;
  const double x = std::abs(only_number<kAbs>(L));
  is_integer ? push_whole(L, x) : lua_pushnumber(L, x);
  return 1;
}

double sign_of(double x) { return x > 0 ? 1 : x < 0 ? -1 : 0; }
double floor_of(double x) { return std::floor(x); }
double ceil_of(double x) { return std::ceil(x); }
double round_of(double x) { return std::round(x); }

int square_root(lua_State* L) {
  const double x = only_number<kSqrt>(L);
  if (x < 0) fail_in(kSqrt, fmt::format("the number must not be negative, got {:.14g}", x));
  lua_pushnumber(L, std::sqrt(x));
  return 1;
}

int exponential(lua_State* L) {
  lua_pushnumber(L, std::exp(only_number<kExp>(L)));
  return 1;
}

int logarithm(lua_State* L) {
  const double x = only_number<kLn>(L);
  if (!(x > 0)) fail_in(kLn, fmt::format("the number must be positive, got {:.14g}", x));
  lua_pushnumber(L, std::log(x));
  return 1;
}

int power(lua_State* L) {
  const Arguments arguments(L, kPow, 1);
  if (!arguments.has("x") || !arguments.has("y")) fail_in(kPow, "needs a base and an exponent");
  const double x = arguments.number("x", 0), y = arguments.number("y", 0);
  if (x < 0 && y != std::trunc(y))
    fail_in(kPow, fmt::format("a power of {:.14g} needs a whole exponent, got {:.14g}", x, y));
  lua_pushnumber(L, std::pow(x, y));
  return 1;
}

/// The extreme of the arguments, or of the one list, as it was given.
template <const FunctionSpec& Spec, bool kGreatest>
int extreme(lua_State* L) {
  if (lua_gettop(L) == 1 && lua_istable(L, 1)) {
    const lua_Integer length = list_length(L, 1);
    if (length < 0) fail_in(Spec, "takes numbers or a list of numbers");
    luaL_checkstack(L, static_cast<int>(std::min<lua_Integer>(length, 1 << 20)), Spec.name);
    for (lua_Integer i = 1; i <= length; ++i) lua_rawgeti(L, 1, i);
    lua_remove(L, 1);
  }
  const int count = lua_gettop(L);
  if (count == 0) fail_in(Spec, "needs a number");
  int best = 1;
  for (int i = 1; i <= count; ++i) {
    if (lua_type(L, i) != LUA_TNUMBER)
      fail_in(Spec, "takes numbers or a list of numbers, got " + describe_value(L, i));
    if (std::isnan(lua_tonumber(L, i)))
      fail_in(Spec, fmt::format("takes numbers, but number {} is not a number (nan)", i));
    const int low = kGreatest ? best : i, high = kGreatest ? i : best;
    if (lua_compare(L, low, high, LUA_OPLT) != 0) best = i;
  }
  lua_pushvalue(L, best);
  return 1;
}

// Methods and operators of vectors.

template <int Axis>
int coordinate(lua_State* L) {
  lua_pushnumber(L, read_vector(L, 1, "vector")[Axis]);
  return 1;
}

int vector_length(lua_State* L) {
  const glm::dvec3 v = read_vector(L, 1, "vector:len");
  lua_pushnumber(L, std::sqrt(dot(v, v)));
  return 1;
}

int vector_unit(lua_State* L) {
  const glm::dvec3 v = read_vector(L, 1, "vector:unit");
  const double length = std::sqrt(dot(v, v));
  push_vector(L, length > 0 ? glm::dvec3(v.x / length, v.y / length, v.z / length) : v,
              size_at(L, 1));
  return 1;
}

int vector_cross(lua_State* L) {
  push_vector(L, cross(read_vector(L, 1, "vector:cross"), read_vector(L, 2, "vector:cross")));
  return 1;
}

int vector_scalar(lua_State* L) {
  lua_pushnumber(L, dot(read_vector(L, 1, "vector:scalar"), read_vector(L, 2, "vector:scalar")));
  return 1;
}

/// In the plane, turned by 90 degrees; the other way round with a negative factor.
int vector_normal(lua_State* L) {
  const glm::dvec3 v = read_vector(L, 1, "vector:normal");
  const double factor = luaL_optnumber(L, 2, 1);
  push_vector(L, {-v.y * factor, v.x * factor, 0});
  return 1;
}

int vector_rot(lua_State* L) {
  const glm::dvec3 v = read_vector(L, 1, "vector:rot");
  if (lua_type(L, 2) != LUA_TNUMBER || !std::isfinite(lua_tonumber(L, 2))) {
    throw ScriptError("vector:rot: wants an angle in degrees, got " + describe_value(L, 2));
  }
  if (!lua_isnoneornil(L, 3) && lua_type(L, 3) != LUA_TSTRING) {
    throw ScriptError("vector:rot: the axis must be \"x\", \"y\" or \"z\", got " +
                      describe_value(L, 3));
  }
  const double angle = lua_tonumber(L, 2), c = cos_deg(angle), s = sin_deg(angle);
  const std::string axis = luaL_optstring(L, 3, "z");
  if (axis == "x") {
    push_vector(L, {v.x, v.y * c - v.z * s, v.y * s + v.z * c});
  } else if (axis == "y") {
    push_vector(L, {v.x * c + v.z * s, v.y, -v.x * s + v.z * c});
  } else if (axis == "z") {
    push_vector(L, {v.x * c - v.y * s, v.x * s + v.y * c, v.z});
  } else {
    throw ScriptError("vector:rot: the axis must be \"x\", \"y\" or \"z\", got \"" + axis + "\"");
  }
  return 1;
}

template <int Sign>
int vector_sum(lua_State* L) {
  const char* name = Sign > 0 ? "'+'" : "'-'";
  const glm::dvec3 a = read_vector(L, 1, name), b = read_vector(L, 2, name);
  push_vector(L, a + static_cast<double>(Sign) * b, std::max(size_at(L, 1), size_at(L, 2)));
  return 1;
}

int vector_times(lua_State* L) {
  if (lua_type(L, 1) == LUA_TNUMBER) lua_rotate(L, 1, 1);  // factor * vector
  if (lua_type(L, 2) == LUA_TNUMBER) {
    push_vector(L, lua_tonumber(L, 2) * read_vector(L, 1, "'*'"), size_at(L, 1));
  } else {
    lua_pushnumber(L, dot(read_vector(L, 1, "'*'"), read_vector(L, 2, "'*'")));
  }
  return 1;
}

int vector_divided(lua_State* L) {
  if (lua_type(L, 2) != LUA_TNUMBER || lua_tonumber(L, 2) == 0)
    throw ScriptError("'/': a vector is divided by a number other than 0, got " +
                      describe_value(L, 2));
  const glm::dvec3 v = read_vector(L, 1, "'/'");
  const double x = lua_tonumber(L, 2);
  push_vector(L, {v.x / x, v.y / x, v.z / x}, size_at(L, 1));
  return 1;
}

int vector_minus(lua_State* L) {
  const glm::dvec3 v = read_vector(L, 1, "'-'");
  push_vector(L, {0 - v.x, 0 - v.y, 0 - v.z}, size_at(L, 1));
  return 1;
}

int vector_equal(lua_State* L) {
  lua_pushboolean(L, read_vector(L, 1, "'=='") == read_vector(L, 2, "'=='") ? 1 : 0);
  return 1;
}

int vector_text(lua_State* L) {
  const glm::dvec3 v = read_vector(L, 1, "tostring");
  const std::string text = size_at(L, 1) == 2
                               ? fmt::format("vec({:.14g}, {:.14g})", v.x, v.y)
                               : fmt::format("vec({:.14g}, {:.14g}, {:.14g})", v.x, v.y, v.z);
  lua_pushlstring(L, text.data(), text.size());
  return 1;
}

/// The place in the list of "x", "y" or "z"; 0 for another key.
int axis_of(lua_State* L, int key) {
  if (lua_type(L, key) != LUA_TSTRING) return 0;
  const std::string name = lua_tostring(L, key);
  return name == "x" ? 1 : name == "y" ? 2 : name == "z" ? 3 : 0;
}

/// Upvalue 1: the methods.
int vector_index(lua_State* L) {
  if (const int axis = axis_of(L, 2); axis != 0) {
    lua_rawgeti(L, 1, axis);
    return 1;
  }
  if (lua_type(L, 2) != LUA_TSTRING) return 0;  // a list ends in nil: ipairs needs it
  lua_pushvalue(L, 2);
  if (lua_rawget(L, lua_upvalueindex(1)) != LUA_TNIL) return 1;
  const std::string name = lua_tostring(L, 2);
  throw ScriptError("a vector has no '" + name + "'" +
                    did_you_mean(name, {"x", "y", "z", "getx", "gety", "getz", "len", "unit",
                                        "cross", "scalar", "dot", "normal", "rot"}));
}

int vector_assign(lua_State* L) {
  const int axis = axis_of(L, 2);
  if (axis == 0 || lua_type(L, 3) != LUA_TNUMBER)
    throw ScriptError("a vector has three numbers, and nothing else can be set in it");
  lua_rawseti(L, 1, axis);
  return 0;
}

constexpr Binding kVectorsBindings[] = {
    {&kVec, guarded<make_vector<kVec>>, nullptr, nullptr},
    {&kVector, guarded<make_vector<kVector>>, nullptr, nullptr},
    {&kCross, guarded<cross_product>, nullptr, nullptr},
    {&kNorm, guarded<norm>, nullptr, nullptr},
    {&kLookup, guarded<lookup>, nullptr, nullptr},
    {&kRands, guarded<rands>, nullptr, nullptr},
    {&kAbs, guarded<absolute>, nullptr, nullptr},
    {&kSign, guarded<whole<kSign, sign_of>>, nullptr, nullptr},
    {&kFloor, guarded<whole<kFloor, floor_of>>, nullptr, nullptr},
    {&kCeil, guarded<whole<kCeil, ceil_of>>, nullptr, nullptr},
    {&kRound, guarded<whole<kRound, round_of>>, nullptr, nullptr},
    {&kSqrt, guarded<square_root>, nullptr, nullptr},
    {&kExp, guarded<exponential>, nullptr, nullptr},
    {&kLn, guarded<logarithm>, nullptr, nullptr},
    {&kPow, guarded<power>, nullptr, nullptr},
    {&kMin, guarded<extreme<kMin, false>>, nullptr, nullptr},
    {&kMax, guarded<extreme<kMax, true>>, nullptr, nullptr},
};

}  // namespace

std::span<const Binding> vector_bindings() { return kVectorsBindings; }

void open_vectors(lua_State* L) {
  luaL_newmetatable(L, kVectorName);
  constexpr luaL_Reg kOperators[] = {
      {"__add", guarded<vector_sum<1>>},
      {"__sub", guarded<vector_sum<-1>>},
      {"__mul", guarded<vector_times>},
      {"__div", guarded<vector_divided>},
      {"__unm", guarded<vector_minus>},
      {"__eq", guarded<vector_equal>},
      {"__tostring", guarded<vector_text>},
      {"__newindex", guarded<vector_assign>},
      {nullptr, nullptr},
  };
  luaL_setfuncs(L, kOperators, 0);
  constexpr luaL_Reg kMethods[] = {
      {"getx", guarded<coordinate<0>>},
      {"gety", guarded<coordinate<1>>},
      {"getz", guarded<coordinate<2>>},
      {"len", guarded<vector_length>},
      {"unit", guarded<vector_unit>},
      {"cross", guarded<vector_cross>},
      {"scalar", guarded<vector_scalar>},
      {"dot", guarded<vector_scalar>},
      {"normal", guarded<vector_normal>},
      {"rot", guarded<vector_rot>},
      {nullptr, nullptr},
  };
  lua_newtable(L);
  luaL_setfuncs(L, kMethods, 0);
  lua_pushcclosure(L, guarded<vector_index>, 1);
  lua_setfield(L, -2, "__index");
  lua_pushboolean(L, 0);
  lua_setfield(L, -2, "__metatable");
  lua_pop(L, 1);
}

}  // namespace csgrun
