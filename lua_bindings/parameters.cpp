#include "lua_bindings/parameters.h"

#include <cmath>
#include <string_view>

#include <fmt/format.h>

#include "lua_bindings/arguments.h"

namespace csgrun {
namespace {

constexpr int kNumber = 0, kBoolean = 1, kString = 2;  // alternatives of ParameterValue

std::string_view trimmed(std::string_view text) {
  const auto blank = [](char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; };
  while (!text.empty() && blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && blank(text.back())) text.remove_suffix(1);
  return text;
}

/// A finite number written as Lua writes them.
std::optional<double> parse_number(lua_State* L, std::string_view text) {
  const std::string copy(trimmed(text));
  if (lua_stringtonumber(L, copy.c_str()) != copy.size() + 1) return std::nullopt;
  const double x = lua_tonumber(L, -1);
  lua_pop(L, 1);
  return std::isfinite(x) ? std::optional(x) : std::nullopt;
}

std::optional<std::vector<double>> parse_list(lua_State* L, std::string_view text) {
  text = trimmed(text);
  if (text.size() < 2) return std::nullopt;
  const bool braces = text.front() == '{' && text.back() == '}';
  const bool brackets = text.front() == '[' && text.back() == ']';
  if (!braces && !brackets) return std::nullopt;
  text = trimmed(text.substr(1, text.size() - 2));
  std::vector<double> list;
  while (!text.empty()) {
    const size_t comma = text.find(',');
    const auto x = parse_number(L, text.substr(0, comma));
    if (!x) return std::nullopt;
    list.push_back(*x);
    text = comma == std::string_view::npos ? std::string_view() : trimmed(text.substr(comma + 1));
  }
  return list;
}

std::string check_number(const Parameter& parameter, double x) {
  if (!std::isfinite(x))
    return fmt::format("must be finite, got {}", std::isnan(x) ? "nan" : x > 0 ? "inf" : "-inf");
  if (parameter.min && x < *parameter.min)
    return fmt::format("must be at least {:.14g}, got {:.14g}", *parameter.min, x);
  if (parameter.max && x > *parameter.max)
    return fmt::format("must be at most {:.14g}, got {:.14g}", *parameter.max, x);
  if (parameter.step) {
    const double step = *parameter.step, from = parameter.min.value_or(0);
    const double steps = std::round((x - from) / step);
    // Decimal steps are not exact in binary: a value within a millionth of a step counts.
    if (std::abs(x - (from + steps * step)) > 1e-6 * step) {
      return fmt::format("must be a whole number of steps of {:.14g} from {:.14g}, got {:.14g}",
                         step, from, x);
    }
  }
  return {};
}

std::string shown(const ParameterValue& value) {
  if (const auto* x = std::get_if<double>(&value)) return fmt::format("{:.14g}", *x);
  if (const auto* flag = std::get_if<bool>(&value)) return *flag ? "true" : "false";
  if (const auto* text = std::get_if<std::string>(&value)) return *text;
  std::string list;
  for (const double x : std::get<std::vector<double>>(value))
    list += fmt::format("{}{:.14g}", list.empty() ? "" : ", ", x);
  return "{" + list + "}";
}

}  // namespace

std::optional<ParameterValue> parameter_value(lua_State* L, int index) {
  switch (lua_type(L, index)) {
    case LUA_TNUMBER:
      return lua_tonumber(L, index);
    case LUA_TBOOLEAN:
      return lua_toboolean(L, index) != 0;
    case LUA_TSTRING: {
      size_t length = 0;
      const char* bytes = lua_tolstring(L, index, &length);
      return std::string(bytes, length);
    }
    case LUA_TTABLE: {
      const lua_Integer length = list_length(L, index);
      if (length < 0) return std::nullopt;
      std::vector<double> list;
      for (lua_Integer i = 1; i <= length; ++i) {
        if (lua_rawgeti(L, index, i) != LUA_TNUMBER) {
          lua_pop(L, 1);
          return std::nullopt;
        }
        list.push_back(lua_tonumber(L, -1));
        lua_pop(L, 1);
      }
      return list;
    }
    default:
      return std::nullopt;
  }
}

void push_parameter_value(lua_State* L, const ParameterValue& value) {
  if (const auto* x = std::get_if<double>(&value)) {
    // Whole numbers as Lua's integers, as they would be in the script's text.
    if (*x == std::floor(*x) && std::abs(*x) < 0x1p53) {
      lua_pushinteger(L, static_cast<lua_Integer>(*x));
    } else {
      lua_pushnumber(L, *x);
    }
  } else if (const auto* flag = std::get_if<bool>(&value)) {
    lua_pushboolean(L, *flag ? 1 : 0);
  } else if (const auto* text = std::get_if<std::string>(&value)) {
    lua_pushlstring(L, text->data(), text->size());
  } else {
    const auto& list = std::get<std::vector<double>>(value);
    lua_createtable(L, static_cast<int>(list.size()), 0);
    for (size_t i = 0; i < list.size(); ++i) {
      push_parameter_value(L, list[i]);
      lua_rawseti(L, -2, static_cast<lua_Integer>(i + 1));
    }
  }
}

std::string parameter_type(const ParameterValue& value) {
  switch (value.index()) {
    case kNumber:
      return "a number";
    case kBoolean:
      return "true or false";
    case kString:
      return "a string";
    default:
      return "a list of numbers";
  }
}

std::optional<ParameterValue> parse_definition(lua_State* L, const ParameterValue& fallback,
                                               const Definition& definition) {
  const std::string_view text = definition.text;
  switch (fallback.index()) {
    case kNumber:
      if (const auto x = parse_number(L, text)) return *x;
      return std::nullopt;
    case kBoolean:
      if (trimmed(text) == "true") return true;
      if (trimmed(text) == "false") return false;
      return std::nullopt;
    case kString: {
      std::string_view value = text;
      const bool quoted = !definition.is_verbatim && value.size() >= 2 &&
                          (value.front() == '"' || value.front() == '\'') &&
                          value.back() == value.front();
      if (quoted) value = value.substr(1, value.size() - 2);
      return std::string(value);
    }
    default:
      if (auto list = parse_list(L, text)) return *std::move(list);
      return std::nullopt;
  }
}

std::string check_parameter(const Parameter& parameter, const ParameterValue& value) {
  if (const auto* x = std::get_if<double>(&value)) {
    if (auto problem = check_number(parameter, *x); !problem.empty()) return problem;
  } else if (const auto* list = std::get_if<std::vector<double>>(&value)) {
    for (size_t i = 0; i < list->size(); ++i) {
      if (auto problem = check_number(parameter, (*list)[i]); !problem.empty())
        return fmt::format("entry {} {}", i + 1, problem);
    }
  }
  if (parameter.choices.empty()) return {};
  std::string names;
  for (const ParameterValue& choice : parameter.choices) {
    if (choice == value) return {};
    names += (names.empty() ? "" : ", ") + shown(choice);
  }
  return "must be one of " + names;
}

}  // namespace csgrun
