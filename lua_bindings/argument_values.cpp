// One argument from Lua to C++: what its type takes, and what is said when it does not fit.
#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "lua_bindings/arguments.h"
#include "lua_bindings/guard.h"
#include "lua_bindings/values.h"
#include "lua_bindings/vector_rule.h"

namespace csgrun {

using T = ArgumentType;

VectorRule vector_rule(ArgumentType type) {
  switch (type) {
    case T::kVector2:
      return {2, 2, false};
    case T::kVector3:
      return {3, 3, false};
    case T::kVector2Or3:
      return {2, 3, false};
    case T::kSize2:
      return {2, 2, true};
    case T::kSize3:
      return {3, 3, true};
    case T::kSize2Or3:
      return {2, 3, true};
    case T::kAngles:
      return {1, 3, true};
    default:
      return {0, 0, false};
  }
}

std::string describe_type(ArgumentType type) {
  switch (type) {
    case T::kNumber:
      return "a number";
    case T::kInteger:
      return "a whole number";
    case T::kBoolean:
      return "true or false";
    case T::kBooleans2:
      return "true, false or a list of two of them";
    case T::kBooleans3:
      return "true, false or a list of three of them";
    case T::kBooleans2Or3:
      return "true, false or a list of two or three of them";
    case T::kString:
      return "a string";
    case T::kVector2:
      return "a list of two numbers";
    case T::kVector3:
      return "a list of three numbers";
    case T::kVector2Or3:
      return "a list of two or three numbers";
    case T::kSize2:
      return "a number or a list of two numbers";
    case T::kSize3:
      return "a number or a list of three numbers";
    case T::kSize2Or3:
      return "a number or a list of two or three numbers";
    case T::kAngles:
      return "a number or a list of up to three numbers";
    case T::kPoints2:
      return "a list of points {x, y}";
    case T::kPoints3:
      return "a list of points {x, y, z}";
    case T::kIndexLists:
      return "a list of lists of indices (from 0)";
    case T::kMatrix:
      return "a matrix or a list of rows of numbers";
    case T::kColor:
      return "a colour's name, '#rrggbb' or a list of three or four numbers from 0 to 1";
    case T::kValue:
      return "a value";
  }
  return {};
}

namespace {

/// A string for a message: short, and on one line.
std::string in_quotes(std::string_view text) {
  constexpr size_t kMost = 40;
  size_t length = std::min(text.size(), kMost);
  const auto is_within_character = [&](size_t i) {
    return i < text.size() && (static_cast<unsigned char>(text[i]) & 0xc0) == 0x80;
  };
  while (length > 0 && is_within_character(length)) --length;
  std::string quoted = "\"";
  for (const char c : text.substr(0, length)) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < ' ' || byte == 0x7f) {
      quoted += c == '\n' ? "\\n" : fmt::format("\\{}", byte);  // as Lua writes them
    } else {
      quoted += c;
    }
  }
  return quoted + (length < text.size() ? "...\"" : "\"");
}

}  // namespace

lua_Integer list_length(lua_State* L, int index) {
  index = lua_absindex(L, index);
  const auto length = static_cast<lua_Integer>(lua_rawlen(L, index));
  lua_Integer entries = 0;
  lua_pushnil(L);
  while (lua_next(L, index) != 0) {
    lua_pop(L, 1);
    const bool inside =
        lua_isinteger(L, -1) != 0 && lua_tointeger(L, -1) >= 1 && lua_tointeger(L, -1) <= length;
    if (!inside) {
      lua_pop(L, 1);
      return -1;
    }
    ++entries;
  }
  return entries == length ? length : -1;
}

lua_Integer missing_entry(lua_State* L, int index) {
  index = lua_absindex(L, index);
  lua_Integer last = 0;
  lua_pushnil(L);
  while (lua_next(L, index) != 0) {
    lua_pop(L, 1);
    if (lua_isinteger(L, -1) == 0 || lua_tointeger(L, -1) < 1) {
      lua_pop(L, 1);
      return 0;
    }
    last = std::max(last, lua_tointeger(L, -1));
  }
  for (lua_Integer i = 1; i < last; ++i) {
    const bool is_missing = lua_rawgeti(L, index, i) == LUA_TNIL;
    lua_pop(L, 1);
    if (is_missing) return i;
  }
  return 0;
}

std::string describe_value(lua_State* L, int index) {
  switch (lua_type(L, index)) {
    case LUA_TNUMBER: {
      const double x = lua_tonumber(L, index);
      return std::isnan(x)   ? "nan"
             : std::isinf(x) ? (x > 0 ? "inf" : "-inf")
                             : fmt::format("{:.14g}", x);
    }
    case LUA_TTABLE: {
      const lua_Integer length = list_length(L, index);
      if (length < 0) {
        const lua_Integer missing = missing_entry(L, index);
        return missing == 0 ? "table" : fmt::format("a list whose entry {} is nil", missing);
      }
      return length == 1 ? "a list of one value" : fmt::format("a list of {} values", length);
    }
    case LUA_TSTRING: {
      size_t length = 0;
      const char* const text = lua_tolstring(L, index, &length);
      return "the string " + in_quotes({text, length});
    }
    case LUA_TNONE:
      return "nothing";
    default:
      return kind_name(L, index);
  }
}

std::string describe_given(lua_State* L, int index) {
  const std::string value = describe_value(L, index);
  return lua_type(L, index) == LUA_TNUMBER ? "the number " + value : value;
}

void fail_as(const std::string& function, const std::string& message) {
  const std::string prefix = function + ": ";
  throw ScriptError(message.rfind(prefix, 0) == 0 ? message : prefix + message);
}

double Arguments::check_number(const Option& option, int index) const {
  const double x = lua_tonumber(L_, index);
  if (!std::isfinite(x)) {
    fail(fmt::format("option '{}' must be finite, got {}", option.name, describe_value(L_, index)));
  }
  if (option.range == Range::kPositive && !(x > 0)) {
    fail(fmt::format("option '{}' must be positive, got {:.14g}", option.name, x));
  }
  if (option.range == Range::kNotNegative && !(x >= 0)) {
    fail(fmt::format("option '{}' must not be negative, got {:.14g}", option.name, x));
  }
  return x;
}

/// How the list at `list` is written as arguments: "cube(10, {center = true})"; empty when that
/// would be no help.
std::string Arguments::as_call(int list) const {
  const auto text_of = [&](int index) -> std::string {
    switch (lua_type(L_, index)) {
      case LUA_TNUMBER:
        return describe_value(L_, index);
      case LUA_TBOOLEAN:
        return lua_toboolean(L_, index) != 0 ? "true" : "false";
      case LUA_TSTRING:
        return lua_rawlen(L_, index) > 40 ? "..." : fmt::format("\"{}\"", lua_tostring(L_, index));
      default:
        return "...";
    }
  };
  std::string text;
  const lua_Integer length = list_length(L_, list);
  for (lua_Integer i = 1; i <= length; ++i) {
    lua_rawgeti(L_, list, i);
    text += (i > 1 ? ", " : "") + text_of(lua_gettop(L_));
    lua_pop(L_, 1);
  }
  if (options_table_ == 0) return fmt::format("{}({})", spec_.name, text);
  std::vector<std::string> named;
  lua_pushnil(L_);
  while (lua_next(L_, options_table_) != 0) {
    if (lua_type(L_, -2) == LUA_TSTRING)
      named.push_back(fmt::format("{} = {}", lua_tostring(L_, -2), text_of(lua_gettop(L_))));
    lua_pop(L_, 1);
  }
  std::sort(named.begin(), named.end());
  return fmt::format("{}({}, {{{}}})", spec_.name, text, fmt::join(named, ", "));
}

void Arguments::wrong_type(const Option& option, int index) const {
  std::string hint;
  // cube{10}, cylinder{20, 5}: the values are good, only the braces are not.
  const lua_Integer length = lua_istable(L_, index) ? list_length(L_, index) : 0;
  if (option.positional && length >= 1) {
    const bool takes_number = option.type == T::kNumber || vector_rule(option.type).number_too;
    lua_rawgeti(L_, index, 1);
    const bool fits = (takes_number && lua_type(L_, -1) == LUA_TNUMBER) ||
                      (option.type == T::kString && lua_type(L_, -1) == LUA_TSTRING);
    lua_pop(L_, 1);
    const auto room = std::count_if(spec_.options.begin(), spec_.options.end(),
                                    [](const Option& each) { return each.positional; });
    if (fits && length <= (vector_rule(option.type).most > 0 ? 1 : room) &&
        &option == &spec_.options[0]) {
      hint = "; write " + as_call(index) + (options_table_ == 0 ? " without the list" : "");
    }
  }
  fail(fmt::format("option '{}' must be {}, got {}{}", option.name, describe_type(option.type),
                   describe_given(L_, index), hint));
}

VectorArgument Arguments::convert_vector(const Option& option, int index) const {
  const VectorRule rule = vector_rule(option.type);
  if (lua_type(L_, index) == LUA_TNUMBER && rule.number_too) {
    return {1, {check_number(option, index), 0, 0}};
  }
  if (!lua_istable(L_, index)) wrong_type(option, index);
  const lua_Integer length = list_length(L_, index);
  if (length < rule.least || length > rule.most) wrong_type(option, index);
  VectorArgument vector{static_cast<int>(length), {0, 0, 0}};
  // A list of one number is still a list of angles, not a bare number.
  if (option.type == T::kAngles && length == 1) vector.count = 3;
  for (lua_Integer i = 1; i <= length; ++i) {
    lua_rawgeti(L_, index, i);
    if (lua_type(L_, -1) != LUA_TNUMBER) {
      fail(fmt::format("option '{}' must be {}, but entry {} is {}", option.name,
                       describe_type(option.type), i, describe_value(L_, -1)));
    }
    vector.v[static_cast<int>(i - 1)] = check_number(option, lua_gettop(L_));
    lua_pop(L_, 1);
  }
  return vector;
}

glm::dvec3 Arguments::convert_point(const Option& option, lua_Integer number, int index) const {
  const ArgumentType type = option.type == T::kPoints2 ? T::kVector2 : T::kVector3;
  const int size = vector_rule(type).most;
  if (!lua_istable(L_, index) || list_length(L_, index) != size) {
    fail(fmt::format("point {} must be {}, got {}", number, describe_type(type),
                     describe_value(L_, index)));
  }
  glm::dvec3 point(0, 0, 0);
  for (int i = 0; i < size; ++i) {
    if (lua_rawgeti(L_, index, i + 1) != LUA_TNUMBER) {
      fail(fmt::format("point {} must be {}, but its {} is {}", number, describe_type(type),
                       "xyz"[i], describe_value(L_, -1)));
    }
    point[i] = lua_tonumber(L_, -1);
    if (!std::isfinite(point[i])) {
      fail(fmt::format("point {}: its {} must be finite, got {}", number, "xyz"[i],
                       describe_value(L_, -1)));
    }
    lua_pop(L_, 1);
  }
  return point;
}

Arguments::Value Arguments::convert(const Option& option, int index) const {
  const int type = lua_type(L_, index);
  switch (option.type) {
    case T::kNumber:
      if (type != LUA_TNUMBER) wrong_type(option, index);
      return check_number(option, index);
    case T::kInteger: {
      if (type != LUA_TNUMBER) wrong_type(option, index);
      const double x = check_number(option, index);
      constexpr double kMost = 1e9;
      if (x != std::floor(x)) wrong_type(option, index);
      if (std::abs(x) > kMost) {
        fail(fmt::format("option '{}' must be within {:.0f} of 0, got {:.14g}", option.name, kMost,
                         x));
      }
      return x;
    }
    case T::kBoolean:
      if (type != LUA_TBOOLEAN) wrong_type(option, index);
      return lua_toboolean(L_, index) != 0;
    case T::kBooleans2:
    case T::kBooleans3:
    case T::kBooleans2Or3: {
      std::array<bool, 3> flags{};
      if (type == LUA_TBOOLEAN) {
        flags.fill(lua_toboolean(L_, index) != 0);
        return flags;
      }
      const lua_Integer count = type == LUA_TTABLE ? list_length(L_, index) : -1;
      const bool fits = (count == 2 && option.type != T::kBooleans3) ||
                        (count == 3 && option.type != T::kBooleans2);
      if (!fits) wrong_type(option, index);
      for (int i = 0; i < count; ++i) {
        if (lua_rawgeti(L_, index, i + 1) != LUA_TBOOLEAN) wrong_type(option, index);
        flags[static_cast<size_t>(i)] = lua_toboolean(L_, -1) != 0;
        lua_pop(L_, 1);
      }
      return flags;
    }
    case T::kString: {
      if (type != LUA_TSTRING) wrong_type(option, index);
      size_t length = 0;
      const char* bytes = lua_tolstring(L_, index, &length);
      return std::string(bytes, length);
    }
    case T::kVector2:
    case T::kVector3:
    case T::kVector2Or3:
    case T::kSize2:
    case T::kSize3:
    case T::kSize2Or3:
    case T::kAngles:
      return convert_vector(option, index);
    case T::kPoints2:
    case T::kPoints3: {
      const lua_Integer length = type == LUA_TTABLE ? list_length(L_, index) : -1;
      if (length < 0) wrong_type(option, index);
      Points points;
      for (lua_Integer i = 1; i <= length; ++i) {
        lua_rawgeti(L_, index, i);
        points.push_back(convert_point(option, i - 1, lua_gettop(L_)));
        lua_pop(L_, 1);
      }
      return points;
    }
    case T::kIndexLists: {
      const lua_Integer length = type == LUA_TTABLE ? list_length(L_, index) : -1;
      if (length < 0) wrong_type(option, index);
      IndexLists lists(static_cast<size_t>(length));
      std::string one = option.name;  // "faces": each is a face
      if (one.ends_with('s')) one.pop_back();
      for (lua_Integer i = 1; i <= length; ++i) {
        lua_rawgeti(L_, index, i);
        const lua_Integer count = lua_istable(L_, -1) ? list_length(L_, -1) : -1;
        if (count < 0) {
          fail(fmt::format("{} {} must be a list of indices, got {}", one, i - 1,
                           describe_value(L_, -1)));
        }
        for (lua_Integer k = 1; k <= count; ++k) {
          lua_rawgeti(L_, -1, k);
          int whole = 0;
          const lua_Integer value =
              lua_type(L_, -1) == LUA_TNUMBER ? lua_tointegerx(L_, -1, &whole) : 0;
          if (whole == 0 || value < 0 || value > UINT32_MAX) {
            fail(fmt::format("{} {}: index {} must be a whole number from 0 on", one, i - 1,
                             describe_value(L_, -1)));
          }
          lists[static_cast<size_t>(i - 1)].push_back(static_cast<uint32_t>(value));
          lua_pop(L_, 1);
        }
        lua_pop(L_, 1);
      }
      return lists;
    }
    case T::kMatrix: {
      Affine map;
      bool good = false;
      try {
        good = to_affine(L_, index, map);
      } catch (const ScriptError& error) {
        fail(fmt::format("option '{}': {}", option.name, error.what()));
      }
      if (!good) wrong_type(option, index);
      return map;
    }
    case T::kColor:
    case T::kValue:
      return index;
  }
  return index;
}

}  // namespace csgrun
