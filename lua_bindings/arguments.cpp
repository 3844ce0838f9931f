#include "lua_bindings/arguments.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "lua_bindings/guard.h"
#include "lua_bindings/nearest.h"
#include "lua_bindings/session.h"
#include "lua_bindings/values.h"

namespace csgrun {
namespace {

using T = ArgumentType;

constexpr Option kFacetOptions[] = {
    {"fn", T::kNumber, "csg.fn", "number of facets of a full turn; 0: from fa and fs", false,
     Range::kNotNegative},
    {"fa", T::kNumber, "csg.fa", "smallest angle of a facet, degrees, at least 0.01", false,
     Range::kPositive},
    {"fs", T::kNumber, "csg.fs", "smallest length of a facet, mm, at least 0.01", false,
     Range::kPositive},
};

/// Facets beyond this are a mistake (a sphere of them has 5 * 10^9 points), not a model.
constexpr double kMostFacets = 100000;
constexpr double kSmallestFacet = 0.01;

struct VectorRule {
  int least, most;
  bool number_too;
};

/// Which lists of numbers a type takes; `most` 0: it is no vector.
VectorRule vector_rule(T type) {
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

bool has_string_keys(lua_State* L, int table) {
  lua_pushnil(L);
  while (lua_next(L, table) != 0) {
    lua_pop(L, 1);
    if (lua_type(L, -1) == LUA_TSTRING) {
      lua_pop(L, 1);
      return true;
    }
  }
  return false;
}

/// Whether the table at `index` is a list of one list where the first option takes a list of
/// numbers, or a list of one list of lists where it takes a list of lists.
bool is_wrapped_list(lua_State* L, int index, const FunctionSpec& spec) {
  if (spec.options.empty() || !lua_istable(L, index) || list_length(L, index) != 1) return false;
  const T type = spec.options[0].type;
  const bool of_lists =
      type == T::kPoints2 || type == T::kPoints3 || type == T::kIndexLists || type == T::kMatrix;
  if (!of_lists && vector_rule(type).most == 0) return false;
  lua_rawgeti(L, index, 1);
  bool wrapped = lua_istable(L, -1);
  if (wrapped && of_lists) {
    wrapped = lua_rawgeti(L, -1, 1) == LUA_TTABLE;
    lua_pop(L, 1);
  }
  lua_pop(L, 1);
  return wrapped;
}

}  // namespace

std::span<const Option> facet_options() { return kFacetOptions; }

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
      if (length < 0) return "table";
      return length == 1 ? "a list of one value" : fmt::format("a list of {} values", length);
    }
    case LUA_TNONE:
      return "nothing";
    default:
      return kind_name(L, index);
  }
}

Arguments::Arguments(lua_State* L, const FunctionSpec& spec, int first) : L_(L), spec_(spec) {
  luaL_checkstack(L, 32, "arguments");
  int last = lua_gettop(L);
  // f{...}: one table with names in it, or f(..., {names}).
  if (last >= first && lua_istable(L, last) && has_string_keys(L, last)) {
    if (last > first) read_positional(first, last - 1);
    read_table(last);
  } else if (last >= first) {
    // An empty table is an empty table of options.
    if (lua_istable(L, last) && lua_rawlen(L, last) == 0) --last;
    // f{value}: the list in a list is the value, as it would be with options beside it.
    if (last == first && is_wrapped_list(L, last, spec)) {
      lua_rawgeti(L, last, 1);
      lua_replace(L, last);
    }
    read_positional(first, last);
  }
}

void Arguments::fail(const std::string& message) const {
  throw ScriptError(std::string(spec_.name) + ": " + message);
}

std::vector<const Option*> Arguments::positional_options() const {
  std::vector<const Option*> options;
  for (const Option& option : spec_.options) {
    if (option.positional) options.push_back(&option);
  }
  return options;
}

void Arguments::read_positional(int first, int last) {
  const auto options = positional_options();
  size_t next = 0;
  int index = first;
  if (!options.empty() && vector_rule(options[0]->type).most > 1 &&
      lua_type(L_, first) == LUA_TNUMBER) {
    // Numbers one after another: the first vector.
    int count = 1;
    while (first + count <= last && lua_type(L_, first + count) == LUA_TNUMBER) ++count;
    if (count > 1) {
      const VectorRule rule = vector_rule(options[0]->type);
      if (count > rule.most || count < rule.least) {
        fail(fmt::format("option '{}' must be {}, got {} numbers", options[0]->name,
                         describe_type(options[0]->type), count));
      }
      set_spread(*options[0], first, count);
      index = first + count;
      next = 1;
      positional_count_ = count;
    }
  }
  for (; index <= last; ++index, ++next) {
    if (next >= options.size()) {
      if (options.empty())
        fail(fmt::format("takes no arguments here, got {}", describe_value(L_, index)));
      fail(fmt::format("too many arguments: after '{}' only {{name = value}} may follow, got {}",
                       options.back()->name, describe_value(L_, index)));
    }
    if (lua_isnil(L_, index)) {
      if (index == last || next == 0) {
        fail(fmt::format("option '{}' must be {}, got nil", options[next]->name,
                         describe_type(options[next]->type)));
      }
      continue;  // f(a, nil, c): the default of b
    }
    set(*options[next], index);
    ++positional_count_;
  }
}

void Arguments::read_table(int table) {
  const auto length = static_cast<lua_Integer>(lua_rawlen(L_, table));
  if (length > 0) {
    // The list part is the main argument: cube{10, 20, 30, center = true}.
    const auto options = positional_options();
    if (options.empty()) fail("takes no list of values");
    if (positional_count_ > 0) {
      fail("values without a name must stand before the table of options, or in it, not both");
    }
    lua_rawgeti(L_, table, 1);
    // One table, or one string, is the argument itself: color{"red", alpha = 0.5}. One number is
    // not: cube{10} could as well be the beginning of a list.
    if (length > 1 || (!lua_istable(L_, -1) && lua_type(L_, -1) != LUA_TSTRING)) {
      lua_pop(L_, 1);
      lua_createtable(L_, static_cast<int>(length), 0);
      for (lua_Integer i = 1; i <= length; ++i) {
        lua_rawgeti(L_, table, i);
        lua_rawseti(L_, -2, i);
      }
    }
    set(*options[0], lua_gettop(L_));
  }
  // In the order of the table of options, so that of two mistakes always the same one is told.
  lua_pushnil(L_);
  std::string unknown;
  std::vector<std::pair<const Option*, std::string>> named;
  while (lua_next(L_, table) != 0) {
    lua_pop(L_, 1);
    if (lua_type(L_, -1) == LUA_TSTRING) {
      const std::string key = lua_tostring(L_, -1);
      const Option* option = find_option(key);
      if (option == nullptr) {
        if (unknown.empty() || key < unknown) unknown = key;
      } else {
        named.emplace_back(option, key);
      }
    } else if (lua_isinteger(L_, -1) == 0 || lua_tointeger(L_, -1) < 1 ||
               lua_tointeger(L_, -1) > length) {
      fail("a table of options has names and a list from 1 on as keys, got the key " +
           describe_value(L_, -1));
    }
  }
  if (!unknown.empty()) fail(unknown_option(unknown));
  const auto place = [&](const Option* option) {
    for (size_t i = 0; i < spec_.options.size(); ++i) {
      if (&spec_.options[i] == option) return i;
    }
    return spec_.options.size() + static_cast<size_t>(option - kFacetOptions);
  };
  std::sort(named.begin(), named.end(), [&](const auto& a, const auto& b) {
    return std::pair(place(a.first), a.second) < std::pair(place(b.first), b.second);
  });
  for (const auto& [option, key] : named) {
    luaL_checkstack(L_, 4, "options");
    lua_getfield(L_, table, key.c_str());
    set(*option, lua_gettop(L_));
  }
}

const Option* Arguments::find_option(std::string_view name) const {
  for (const Option& option : spec_.options) {
    if (name == option.name || (option.alias != nullptr && name == option.alias)) return &option;
  }
  if (spec_.facets) {
    for (const Option& option : kFacetOptions) {
      if (name == option.name) return &option;
    }
  }
  return nullptr;
}

std::string Arguments::unknown_option(std::string_view name) const {
  std::vector<std::string> names;
  for (const Option& option : spec_.options) {
    names.emplace_back(option.name);
    if (option.alias != nullptr) names.emplace_back(option.alias);
  }
  if (spec_.facets) {
    for (const Option& option : kFacetOptions) names.emplace_back(option.name);
  }
  std::string_view word = name;
  if (!word.empty() && word[0] == '$') word.remove_prefix(1);  // OpenSCAD's $fn
  const std::string hint = did_you_mean(word, names);
  if (!hint.empty() || names.empty()) return fmt::format("unknown option '{}'{}", name, hint);
  return fmt::format("unknown option '{}' (there are {})", name, fmt::join(names, ", "));
}

void Arguments::check_new(const Option& option) const {
  if (find(option.name) == nullptr) return;
  fail(option.alias != nullptr
           ? fmt::format("option '{}' (or '{}') is given twice", option.name, option.alias)
           : fmt::format("option '{}' is given twice", option.name));
}

void Arguments::set(const Option& option, int index) {
  check_new(option);
  given_.push_back({&option, convert(option, index)});
}

void Arguments::set_spread(const Option& option, int first, int count) {
  VectorArgument vector{count, {0, 0, 0}};
  for (int i = 0; i < count; ++i) vector.v[i] = check_number(option, first + i);
  given_.push_back({&option, vector});
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

void Arguments::wrong_type(const Option& option, int index) const {
  std::string hint;
  if (lua_istable(L_, index) && list_length(L_, index) >= 1) {
    lua_rawgeti(L_, index, 1);
    const bool takes_number = option.type == T::kNumber || vector_rule(option.type).number_too;
    if (takes_number && option.positional && lua_type(L_, -1) == LUA_TNUMBER &&
        list_length(L_, index) == 1) {
      hint = fmt::format("; write {}({}) without the list", spec_.name, describe_value(L_, -1));
    }
    lua_pop(L_, 1);
  }
  fail(fmt::format("option '{}' must be {}, got {}{}", option.name, describe_type(option.type),
                   lua_type(L_, index) == LUA_TNUMBER ? "the number " + describe_value(L_, index)
                                                      : describe_value(L_, index),
                   hint));
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

Arguments::Value Arguments::convert(const Option& option, int index) const {
  const int type = lua_type(L_, index);
  switch (option.type) {
    case T::kNumber:
      if (type != LUA_TNUMBER) wrong_type(option, index);
      return check_number(option, index);
    case T::kInteger: {
      if (type != LUA_TNUMBER) wrong_type(option, index);
      const double x = check_number(option, index);
      if (x != std::floor(x) || std::abs(x) > 1e9) wrong_type(option, index);
      return x;
    }
    case T::kBoolean:
      if (type != LUA_TBOOLEAN) wrong_type(option, index);
      return lua_toboolean(L_, index) != 0;
    case T::kBooleans2:
    case T::kBooleans3: {
      std::array<bool, 3> flags{};
      if (type == LUA_TBOOLEAN) {
        flags.fill(lua_toboolean(L_, index) != 0);
        return flags;
      }
      const int count = option.type == T::kBooleans2 ? 2 : 3;
      if (type != LUA_TTABLE || list_length(L_, index) != count) wrong_type(option, index);
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
        const Option point{option.name, option.type == T::kPoints2 ? T::kVector2 : T::kVector3, "",
                           ""};
        if (!lua_istable(L_, -1)) {
          fail(fmt::format("option '{}' must be {}, but entry {} is {}", option.name,
                           describe_type(option.type), i, describe_value(L_, -1)));
        }
        points.push_back(convert_vector(point, lua_gettop(L_)).v);
        lua_pop(L_, 1);
      }
      return points;
    }
    case T::kIndexLists: {
      const lua_Integer length = type == LUA_TTABLE ? list_length(L_, index) : -1;
      if (length < 0) wrong_type(option, index);
      IndexLists lists(static_cast<size_t>(length));
      for (lua_Integer i = 1; i <= length; ++i) {
        lua_rawgeti(L_, index, i);
        const lua_Integer count = lua_istable(L_, -1) ? list_length(L_, -1) : -1;
        if (count < 0) wrong_type(option, index);
        for (lua_Integer k = 1; k <= count; ++k) {
          lua_rawgeti(L_, -1, k);
          int whole = 0;
          const lua_Integer value =
              lua_type(L_, -1) == LUA_TNUMBER ? lua_tointegerx(L_, -1, &whole) : 0;
          if (whole == 0 || value < 0 || value > UINT32_MAX) {
            fail(fmt::format("option '{}': entry {} of list {} must be an index from 0 on, got {}",
                             option.name, k, i, describe_value(L_, -1)));
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
      if (!to_affine(L_, index, map)) wrong_type(option, index);
      return map;
    }
    case T::kColor:
    case T::kValue:
      return index;
  }
  return index;
}

const Arguments::Value* Arguments::find(std::string_view name) const {
  for (const Given& given : given_) {
    if (name == given.option->name) return &given.value;
  }
  return nullptr;
}

double Arguments::number(std::string_view name, double fallback) const {
  const Value* value = find(name);
  return value != nullptr ? std::get<double>(*value) : fallback;
}

bool Arguments::boolean(std::string_view name, bool fallback) const {
  const Value* value = find(name);
  return value != nullptr ? std::get<bool>(*value) : fallback;
}

std::array<bool, 3> Arguments::booleans(std::string_view name) const {
  const Value* value = find(name);
  return value != nullptr ? std::get<std::array<bool, 3>>(*value) : std::array<bool, 3>{};
}

std::string Arguments::string(std::string_view name, const std::string& fallback) const {
  const Value* value = find(name);
  return value != nullptr ? std::get<std::string>(*value) : fallback;
}

std::optional<VectorArgument> Arguments::vector(std::string_view name) const {
  const Value* value = find(name);
  return value != nullptr ? std::optional(std::get<VectorArgument>(*value)) : std::nullopt;
}

const std::vector<glm::dvec3>& Arguments::points3(std::string_view name) const {
  static const Points kNone;
  const Value* value = find(name);
  return value != nullptr ? std::get<Points>(*value) : kNone;
}

std::vector<glm::dvec2> Arguments::points2(std::string_view name) const {
  std::vector<glm::dvec2> points;
  for (const glm::dvec3& p : points3(name)) points.emplace_back(p.x, p.y);
  return points;
}

const std::vector<std::vector<uint32_t>>& Arguments::index_lists(std::string_view name) const {
  static const IndexLists kNone;
  const Value* value = find(name);
  return value != nullptr ? std::get<IndexLists>(*value) : kNone;
}

const Affine& Arguments::matrix(std::string_view name) const {
  static const Affine kIdentity;
  const Value* value = find(name);
  return value != nullptr ? std::get<Affine>(*value) : kIdentity;
}

int Arguments::stack_index(std::string_view name) const {
  const Value* value = find(name);
  return value != nullptr ? std::get<int>(*value) : 0;
}

Facets Arguments::facets() const {
  Facets facets = session_of(L_).facets;
  facets.fn = number("fn", facets.fn);
  facets.fa = number("fa", facets.fa);
  facets.fs = number("fs", facets.fs);
  if (const std::string problem = check_facets(facets); !problem.empty()) fail(problem);
  return facets;
}

std::string check_facets(const Facets& facets) {
  if (!(facets.fn >= 0) || facets.fn > kMostFacets) {
    return fmt::format("fn must be from 0 to {:g}, got {:g}", kMostFacets, facets.fn);
  }
  if (!(facets.fa >= kSmallestFacet) || !std::isfinite(facets.fa)) {
    return fmt::format("fa must be at least {:g}, got {:g}", kSmallestFacet, facets.fa);
  }
  if (!(facets.fs >= kSmallestFacet) || !std::isfinite(facets.fs)) {
    return fmt::format("fs must be at least {:g}, got {:g}", kSmallestFacet, facets.fs);
  }
  return {};
}

std::string help_text(const FunctionSpec& spec) {
  std::string signature;
  size_t widest = 0;
  const auto names = [](const Option& option) {
    return option.alias != nullptr ? fmt::format("{}, {}", option.name, option.alias)
                                   : std::string(option.name);
  };
  std::vector<const Option*> options;
  for (const Option& option : spec.options) options.push_back(&option);
  if (spec.facets) {
    for (const Option& option : kFacetOptions) options.push_back(&option);
  }
  for (const Option* option : options) {
    if (option->positional)
      signature += (signature.empty() ? "" : ", ") + std::string(option->name);
    widest = std::max(widest, names(*option).size());
  }
  std::string text = fmt::format("{}({})\n  {}\n", spec.name, signature, spec.doc);
  for (const Option* option : options) {
    const std::string fallback =
        option->fallback[0] != '\0' ? fmt::format(" [{}]", option->fallback) : "";
    text += fmt::format("    {:<{}}  {}; {}{}\n", names(*option), widest, option->doc,
                        describe_type(option->type), fallback);
  }
  if (spec.example[0] != '\0') text += fmt::format("  Example: {}\n", spec.example);
  return text;
}

}  // namespace csgrun
