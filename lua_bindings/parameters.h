// Parameters of a model: param() in the script, -D and -p on the command line.
#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include <lua.hpp>

namespace csgrun {

/// A value for a parameter from outside, and whether a param() asked for it.
struct Definition {
  std::string name, text;
  std::string origin = "-D";  ///< for messages: "-D", "-p file.json"
  bool is_verbatim = false;   ///< the text is a string as it stands: quotes belong to it
  bool used = false;
};

using ParameterValue = std::variant<double, bool, std::string, std::vector<double>>;

/// What a script said of one of its parameters.
struct Parameter {
  std::string name, doc;
  ParameterValue fallback;
  std::optional<double> min, max, step;
  std::vector<ParameterValue> choices;
};

/// The value at `index`; nothing when it is none of a parameter's types.
std::optional<ParameterValue> parameter_value(lua_State* L, int index);
void push_parameter_value(lua_State* L, const ParameterValue& value);

/// What a definition means for a parameter with this default: numbers, true or false, strings raw
/// or in quotes, lists {1, 2} or [1, 2]. Nothing when it does not fit the type.
std::optional<ParameterValue> parse_definition(lua_State* L, const ParameterValue& fallback,
                                               const Definition& definition);

/// "a number", "true or false" ...: what the type takes.
std::string parameter_type(const ParameterValue& value);

/// Why the value is not one that the parameter may have: "must be at least 1, got 0"; else empty.
std::string check_parameter(const Parameter& parameter, const ParameterValue& value);

}  // namespace csgrun
