#include "lua_bindings/arguments.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "lua_bindings/guard.h"
#include "lua_bindings/nearest.h"
#include "lua_bindings/session.h"
#include "lua_bindings/vector_rule.h"

namespace csgrun {
namespace {

using T = ArgumentType;

constexpr Option kFacetOptions[] = {
    {"fn", T::kNumber, "csg.fn", "number of facets of a full turn; 0: from fa and fs", false,
     Range::kNotNegative, "segments"},
    {"fa", T::kNumber, "csg.fa", "smallest angle of a facet, degrees, at least 0.01", false,
     Range::kPositive},
    {"fs", T::kNumber, "csg.fs", "smallest length of a facet, mm, at least 0.01", false,
     Range::kPositive},
};

/// Facets beyond this are a mistake (a sphere of them has 5 * 10^9 points), not a model.
constexpr double kSmallestFacet = 0.01;

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

/// The types whose value is a list of lists.
bool takes_lists(T type) {
  return type == T::kPoints2 || type == T::kPoints3 || type == T::kIndexLists || type == T::kMatrix;
}

/// Whether the table at `index` is a list of one list where the first option takes a list of
/// numbers, or a list of one list of lists where it takes a list of lists.
bool is_wrapped_list(lua_State* L, int index, const FunctionSpec& spec) {
  if (spec.options.empty() || !lua_istable(L, index) || list_length(L, index) != 1) return false;
  const T type = spec.options[0].type;
  const bool of_lists = takes_lists(type);
  if (!of_lists && vector_rule(type).most == 0 && type != T::kColor) return false;
  lua_rawgeti(L, index, 1);
  bool wrapped = lua_istable(L, -1);
  if (wrapped && of_lists) {
    wrapped = lua_rawgeti(L, -1, 1) == LUA_TTABLE;
    lua_pop(L, 1);
  }
  lua_pop(L, 1);
  return wrapped;
}

/// Whether the table at `index` is a list that begins with a colour's name, where the first option
/// is a colour: {"red"} and {"red", 0.5} stand for what is in them.
bool is_list_from_color_name(lua_State* L, int index, const FunctionSpec& spec) {
  if (spec.options.empty() || spec.options[0].type != T::kColor || !lua_istable(L, index))
    return false;
  const bool is_name = lua_rawgeti(L, index, 1) == LUA_TSTRING;
  lua_pop(L, 1);
  return is_name && list_length(L, index) > 0;
}

/// What is wrong where an option was given nil.
std::string nil_text(const Option& option) {
  if (option.type != T::kValue) {
    return fmt::format("option '{}' must be {}, got nil", option.name, describe_type(option.type));
  }
  std::string_view doc = option.doc;
  doc = doc.substr(0, doc.find(';'));
  std::string text;  // on one line
  for (const char c : doc) {
    if (c == '\n' || (c == ' ' && text.ends_with(' '))) continue;
    text += c;
  }
  return fmt::format("option '{}' must not be nil: {}", option.name, text);
}

/// Whether the value is the table csg.
bool is_language(lua_State* L, int index) {
  if (!lua_istable(L, index)) return false;
  lua_pushglobaltable(L);
  lua_pushliteral(L, "csg");
  lua_rawget(L, -2);
  const bool is_same = lua_rawequal(L, -1, index) != 0;
  lua_pop(L, 2);
  return is_same;
}

}  // namespace

std::span<const Option> facet_options() { return kFacetOptions; }

Arguments::Arguments(lua_State* L, const FunctionSpec& spec, int first) : L_(L), spec_(spec) {
  luaL_checkstack(L, 32, "arguments");
  int last = lua_gettop(L);
  if (is_language(L, first))
    fail(fmt::format("is called with a dot: csg.{}(...), not csg:{}(...)", spec.name, spec.name));
  // f{...}: one table with names in it, or f(..., {names}).
  if (last >= first && lua_istable(L, last) && has_string_keys(L, last)) {
    if (last > first) read_positional(first, last - 1);
    read_table(last);
  } else if (last >= first) {
    // An empty table is an empty table of options.
    if (lua_istable(L, last) && list_length(L, last) == 0) --last;
    if (last == first && is_list_from_color_name(L, last, spec)) {
      read_list_part(last, list_length(L, last));
    } else {
      // f{value}: the list in a list is the value, as it would be with options beside it.
      if (last == first && is_wrapped_list(L, last, spec)) {
        lua_rawgeti(L, last, 1);
        lua_replace(L, last);
      }
      read_positional(first, last);
    }
  }
  // Facets that cannot be are told also where nothing is round.
  if (has("fn") || has("fa") || has("fs")) static_cast<void>(facets());
}

void Arguments::fail(const std::string& message) const { fail_as(spec_.name, message); }

std::vector<const Option*> Arguments::positional_options() const {
  std::vector<const Option*> options;
  for (const Option& option : spec_.options) {
    if (option.positional) options.push_back(&option);
  }
  return options;
}

/// cube(10, t.w, 5) where t.w is nil, translate(1, "a", 3): numbers were meant, and one of them is
/// none. `count`: how many numbers there are from `first` on before that one; `is_only`: no other
/// argument can stand after the vector.
void Arguments::check_for_gap(const Option& option, int first, int count, int last,
                              bool is_only) const {
  const VectorRule rule = vector_rule(option.type);
  const int gap = first + count;
  if (gap > last || count >= rule.most) return;
  const bool is_nil = lua_isnil(L_, gap);
  // A list, or a value of the argument that follows the vector.
  if (count == 0 && (lua_istable(L_, gap) || lua_isuserdata(L_, gap))) return;
  if (count == 1 && rule.number_too && lua_isboolean(L_, gap)) return;
  bool numbers_were_meant = count > 0 && (is_nil || is_only || (count == 1 && !rule.number_too) ||
                                          (count > 1 && count < rule.least));
  for (int i = gap + 1; i <= std::min(last, first + rule.most - 1); ++i)
    numbers_were_meant = numbers_were_meant || lua_type(L_, i) == LUA_TNUMBER;
  if (!numbers_were_meant) return;
  fail(fmt::format("option '{}' must be {}, but number {} is {}", option.name,
                   describe_type(option.type), count + 1, describe_value(L_, gap)));
}

void Arguments::read_positional(int first, int last) {
  const auto options = positional_options();
  size_t next = 0;
  int index = first;
  if (!options.empty() && vector_rule(options[0]->type).most > 1) {
    // Numbers one after another: the first vector.
    int count = 0;
    while (first + count <= last && lua_type(L_, first + count) == LUA_TNUMBER) ++count;
    check_for_gap(*options[0], first, count, last, options.size() == 1);
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
      if (options.empty()) {
        fail(fmt::format("takes {} here, got {}",
                         spec_.options.empty() ? "no arguments" : "only {name = value}",
                         describe_value(L_, index)));
      }
      fail(fmt::format("too many arguments: after '{}' only {{name = value}} may follow, got {}",
                       options.back()->name, describe_value(L_, index)));
    }
    if (lua_isnil(L_, index)) {
      if (index == last || next == 0) {
        fail(nil_text(*options[next]));
      }
      continue;  // f(a, nil, c): the default of b
    }
    // f(4, 10, 0, 0): numbers up to the last are a vector that stands behind others, too.
    const VectorRule rule = vector_rule(options[next]->type);
    int count = 0;
    while (!rule.number_too && rule.most > 1 && index + count <= last &&
           lua_type(L_, index + count) == LUA_TNUMBER) {
      ++count;
    }
    if (count >= rule.least && count > 1 && count <= rule.most && index + count > last) {
      set_spread(*options[next], index, count);
      ++positional_count_;
      return;
    }
    set(*options[next], index);
    ++positional_count_;
  }
}

/// cube{10, 20, 30, center = true}: the list is the vector. cylinder{20, 5, fn = 8}: its entries
/// are what would stand before the options.
void Arguments::read_list_part(int table, lua_Integer length) {
  const auto options = positional_options();
  if (options.empty()) fail("takes no list of values");
  if (positional_count_ > 0) {
    fail("values without a name must stand before the table of options, or in it, not both");
  }
  const T type = options[0]->type;
  const int first_type = lua_rawgeti(L_, table, 1);
  lua_pop(L_, 1);
  const bool is_list = takes_lists(type)
                           ? length > 1 || first_type != LUA_TTABLE
                           : (vector_rule(type).most > 0 || type == T::kColor) &&
                                 first_type != LUA_TTABLE && first_type != LUA_TSTRING;
  if (!is_list) {
    // One more than there is room for is enough for the message.
    const auto count = std::min(length, static_cast<lua_Integer>(options.size()) + 1);
    const int base = lua_gettop(L_) + 1;
    for (lua_Integer i = 1; i <= count; ++i) lua_rawgeti(L_, table, i);
    read_positional(base, lua_gettop(L_));
    return;
  }
  lua_createtable(L_, static_cast<int>(std::min<lua_Integer>(length, 1 << 16)), 0);
  for (lua_Integer i = 1; i <= length; ++i) {
    lua_rawgeti(L_, table, i);
    lua_rawseti(L_, -2, i);
  }
  options_table_ = table;
  set(*options[0], lua_gettop(L_));
  options_table_ = 0;
}

void Arguments::read_table(int table) {
  const auto length = static_cast<lua_Integer>(lua_rawlen(L_, table));
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
  if (length > 0) read_list_part(table, length);
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
      if (name == option.name || (option.alias != nullptr && name == option.alias)) return &option;
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
    for (const Option& option : kFacetOptions) {
      names.emplace_back(option.name);
      if (option.alias != nullptr) names.emplace_back(option.alias);
    }
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
  std::string signature = spec.subject;
  size_t widest = signature.size();
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
  if (spec.subject[0] != '\0')
    text += fmt::format("    {:<{}}  {}\n", spec.subject, widest, spec.subject_doc);
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
