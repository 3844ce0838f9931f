// param and var: values that a model takes from outside.
#include <algorithm>

#include <fmt/format.h>

#include "lua_bindings/api.h"
#include "lua_bindings/guard.h"
#include "lua_bindings/parameters.h"
#include "lua_bindings/session.h"

namespace csgrun {
namespace {

using T = ArgumentType;

constexpr Option kParamOptions[] = {
    {"name", T::kString, "", "name, for -D name=value", true},
    {"default", T::kValue, "", "a number, true or false, a string or a list of numbers", true},
    {"min", T::kNumber, "", "least value", false},
    {"max", T::kNumber, "", "greatest value", false},
    {"step", T::kNumber, "", "values are whole steps from min (or from 0)", false,
     Range::kPositive},
    {"choices", T::kValue, "", "list of the values that it may have", false},
    {"doc", T::kString, "", "what it means", false},
};
constexpr FunctionSpec kParam{
    "param", "A parameter of the model: its default, or what -D name=value or a file of -p says.",
    kParamOptions, false, "param(\"hole_radius\", 4, {min = 1, max = 10})"};

constexpr Option kVarOptions[] = {
    {"doc", T::kString, "", "what it means; -D \"doc=value\" sets it by this", true},
    {"default", T::kValue, "", "a number, true or false, a string or a list of numbers", true},
};
constexpr FunctionSpec kVar{"var", "A parameter of the model, as LuaCAD writes it.", kVarOptions,
                            false, "var(\"Radius of the hole\", 4)"};

std::vector<ParameterValue> read_choices(lua_State* L, const Arguments& arguments,
                                         const Parameter& parameter) {
  const int index = arguments.stack_index("choices");
  if (index == 0) return {};
  const lua_Integer length = lua_istable(L, index) ? list_length(L, index) : -1;
  if (length < 1)
    fail_in(kParam, "option 'choices' must be a list of values, got " + describe_value(L, index));
  std::vector<ParameterValue> choices;
  for (lua_Integer i = 1; i <= length; ++i) {
    lua_rawgeti(L, index, i);
    const auto choice = parameter_value(L, lua_gettop(L));
    if (!choice || choice->index() != parameter.fallback.index()) {
      fail_in(kParam, fmt::format("choice {} of '{}' must be {}, as its default is, got {}", i,
                                  parameter.name, parameter_type(parameter.fallback),
                                  describe_value(L, -1)));
    }
    choices.push_back(*choice);
    lua_pop(L, 1);
  }
  return choices;
}

/// In what two of one name differ, so that one value could not be meant for both; null if in
/// nothing.
const char* difference(const Parameter& a, const Parameter& b) {
  if (a.fallback.index() != b.fallback.index()) return "types";
  if (a.fallback != b.fallback) return "defaults";
  if (a.min != b.min || a.max != b.max || a.step != b.step) return "ranges";
  if (a.choices != b.choices) return "lists of choices";
  return nullptr;
}

/// What is wrong with a value from outside. A model that names the entries of a list (x, y, z)
/// would fail over a shorter one far from here; one of none may be of any length.
std::string check_given(const Parameter& parameter, const ParameterValue& value) {
  const auto* list = std::get_if<std::vector<double>>(&value);
  const auto* fallback = std::get_if<std::vector<double>>(&parameter.fallback);
  if (list != nullptr && fallback != nullptr && !fallback->empty() &&
      list->size() != fallback->size()) {
    return fmt::format("must be a list of {} numbers, as its default is, got {}", fallback->size(),
                       list->size());
  }
  return check_parameter(parameter, value);
}

/// Pushes the value of a parameter whose default is at index `fallback`.
void push_parameter(lua_State* L, const FunctionSpec& spec, Parameter parameter, int fallback) {
  if (const std::string problem = check_parameter(parameter, parameter.fallback);
      !problem.empty()) {
    fail_in(spec, "the default of '" + parameter.name + "' " + problem);
  }
  Session& session = session_of(L);
  const auto known =
      std::find_if(session.parameters.begin(), session.parameters.end(),
                   [&](const Parameter& other) { return other.name == parameter.name; });
  if (known == session.parameters.end()) {
    session.parameters.push_back(parameter);
  } else if (const char* what = difference(*known, parameter); what != nullptr) {
    fail_in(spec, fmt::format("'{}' is asked for twice, with two {}", parameter.name, what));
  }
  const Definition* definition = nullptr;  // the last of a name counts
  for (Definition& candidate : session.definitions) {
    if (candidate.name != parameter.name) continue;
    candidate.used = true;
    definition = &candidate;
  }
  if (definition == nullptr) {
    lua_pushvalue(L, fallback);
    return;
  }
  const auto value = parse_definition(L, parameter.fallback, *definition);
  const std::string problem =
      value ? check_given(parameter, *value) : "must be " + parameter_type(parameter.fallback);
  if (!problem.empty()) {
    session.definition_error = fmt::format("{} {}={}: '{}' {}", definition->origin, parameter.name,
                                           definition->text, parameter.name, problem);
    throw ScriptError(*session.definition_error);
  }
  push_parameter_value(L, *value);
}

/// The name and default that both functions take.
Parameter read_parameter(lua_State* L, const Arguments& arguments, const FunctionSpec& spec,
                         const char* name) {
  Parameter parameter;
  parameter.name = arguments.string(name, "");
  const int fallback = arguments.stack_index("default");
  if (parameter.name.empty() || fallback == 0) fail_in(spec, "needs a name and a default value");
  const auto value = parameter_value(L, fallback);
  if (!value) {
    fail_in(spec, "the default of '" + parameter.name +
                      "' must be a number, true or false, a string or a list of numbers, got " +
                      describe_value(L, fallback));
  }
  parameter.fallback = *value;
  return parameter;
}

/// param("holes", {}): an empty list behind a name is the default, and no table of options.
void take_empty_default(lua_State* L) {
  if (lua_gettop(L) != 2 || !lua_istable(L, 2)) return;
  lua_pushnil(L);
  if (lua_next(L, 2) != 0) {
    lua_pop(L, 2);
    return;
  }
  lua_newtable(L);
}

int param(lua_State* L) {
  take_empty_default(L);
  const Arguments arguments(L, kParam, 1);
  Parameter parameter = read_parameter(L, arguments, kParam, "name");
  const bool is_text = std::holds_alternative<bool>(parameter.fallback) ||
                       std::holds_alternative<std::string>(parameter.fallback);
  for (const char* range : {"min", "max", "step"}) {
    if (is_text && arguments.has(range)) {
      fail_in(kParam, fmt::format("option '{}' goes with numbers, and the default of '{}' is {}",
                                  range, parameter.name, parameter_type(parameter.fallback)));
    }
  }
  if (arguments.has("min")) parameter.min = arguments.number("min", 0);
  if (arguments.has("max")) parameter.max = arguments.number("max", 0);
  if (arguments.has("step")) parameter.step = arguments.number("step", 1);
  if (parameter.min && parameter.max && *parameter.min > *parameter.max) {
    fail_in(kParam,
            fmt::format("option 'min' of '{}' must be at most 'max', got {:.14g} and {:.14g}",
                        parameter.name, *parameter.min, *parameter.max));
  }
  parameter.doc = arguments.string("doc", "");
  parameter.choices = read_choices(L, arguments, parameter);
  push_parameter(L, kParam, std::move(parameter), arguments.stack_index("default"));
  return 1;
}

int var(lua_State* L) {
  take_empty_default(L);
  const Arguments arguments(L, kVar, 1);
  Parameter parameter = read_parameter(L, arguments, kVar, "doc");
  parameter.doc = parameter.name;
  push_parameter(L, kVar, std::move(parameter), arguments.stack_index("default"));
  return 1;
}

constexpr Binding kParametersBindings[] = {
    {&kParam, guarded<param>, nullptr, nullptr},
    {&kVar, guarded<var>, nullptr, nullptr},
};

}  // namespace

std::span<const Binding> parameter_bindings() { return kParametersBindings; }

}  // namespace csgrun
