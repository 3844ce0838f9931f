#include "lua_bindings/cli/parameter_file.h"

#include <cmath>
#include <optional>

#include <nlohmann/json.hpp>

#include "lua_bindings/files.h"
#include "lua_bindings/json_fault.h"
#include "lua_bindings/nearest.h"

namespace csgrun {
namespace {

using Json = nlohmann::ordered_json;

constexpr size_t kMostBytes = size_t{16} << 20;
constexpr const char* kSets = "parameterSets";

/// The text that stands for a value, as -D would have it; nothing for null, tables and lists of
/// others than numbers.
std::optional<std::string> text_of(const Json& value) {
  if (value.is_string()) return value.get<std::string>();
  if (value.is_number() || value.is_boolean()) return value.dump();
  if (!value.is_array()) return std::nullopt;
  for (const Json& entry : value) {
    if (!entry.is_number()) return std::nullopt;
  }
  return value.dump();
}

Error fault(const std::string& path, const std::string& what,
            ErrorCode code = ErrorCode::kMalformedFile) {
  return Error{code, "-p " + path + ": " + what, {}};
}

/// The set that is meant, in a file of sets.
Result<Json> choose_set(const std::string& path, const Json& sets, const std::string& set) {
  std::vector<std::string> names;
  if (sets.is_object()) {
    for (const auto& [name, values] : sets.items()) names.push_back(name);
  }
  if (names.empty()) return fault(path, std::string(kSets) + " has no sets");
  if (set.empty() && names.size() == 1) return sets.front();
  if (sets.contains(set)) return sets[set];
  std::string list;
  for (const std::string& name : names) list += (list.empty() ? "" : ", ") + name;
  return fault(path,
               (set.empty() ? "choose a set with -P"
                            : "there is no set '" + set + "'" + did_you_mean(set, names)) +
                   "; there are " + list,
               ErrorCode::kInvalidArgument);
}

Json json_of(const ParameterValue& value) {
  return std::visit(
      [](const auto& alternative) -> Json {
        using V = std::decay_t<decltype(alternative)>;
        if constexpr (std::is_same_v<V, double>) {
          if (alternative == std::floor(alternative) && std::abs(alternative) < 0x1p53)
            return static_cast<int64_t>(alternative);
          return alternative;
        } else if constexpr (std::is_same_v<V, std::vector<double>>) {
          Json list = Json::array();
          for (const double x : alternative) list.push_back(json_of(x));
          return list;
        } else {
          return alternative;
        }
      },
      value);
}

Json schema_of(const Parameter& parameter) {
  Json schema;
  Json range;  // of the number, or of each of the list
  range["type"] = "number";
  if (parameter.min) range["minimum"] = json_of(*parameter.min);
  if (parameter.max) range["maximum"] = json_of(*parameter.max);
  if (parameter.step) {
    // Steps count from the least value, and multiples from 0.
    const double from = parameter.min.value_or(0) / *parameter.step;
    range[from == std::round(from) ? "multipleOf" : "x-step"] = json_of(*parameter.step);
  }
  if (std::holds_alternative<double>(parameter.fallback)) {
    schema = range;
  } else if (std::holds_alternative<bool>(parameter.fallback)) {
    schema["type"] = "boolean";
  } else if (std::holds_alternative<std::string>(parameter.fallback)) {
    schema["type"] = "string";
  } else {
    schema["type"] = "array";
    schema["items"] = range;
    if (const size_t size = std::get<std::vector<double>>(parameter.fallback).size(); size > 0)
      schema["minItems"] = schema["maxItems"] = size;
  }
  schema["default"] = json_of(parameter.fallback);
  for (const ParameterValue& choice : parameter.choices) schema["enum"].push_back(json_of(choice));
  if (!parameter.doc.empty()) schema["description"] = parameter.doc;
  return schema;
}

}  // namespace

Result<std::vector<Definition>> read_parameter_file(const std::string& path,
                                                    const std::string& set) {
  const FileText text = read_whole_file(path);
  if (!text.error.empty())
    return fault(path, "cannot read it: " + text.error, ErrorCode::kCannotRead);
  if (text.bytes.size() > kMostBytes) return fault(path, "larger than 16 MB", ErrorCode::kLimit);
  Json json;
  try {
    json = Json::parse(text.bytes);
  } catch (const Json::parse_error& error) {
    return Error{ErrorCode::kMalformedFile, "-p " + path + ":" + json_fault(text.bytes, error), {}};
  } catch (const Json::out_of_range&) {
    return fault(path, "a number is beyond the range of doubles");
  }
  if (!json.is_object()) return fault(path, "must be a table of names and values");
  if (json.contains(kSets)) {
    Result<Json> chosen = choose_set(path, json[kSets], set);
    if (!chosen) return chosen.error();
    json = *std::move(chosen);
    if (!json.is_object()) return fault(path, "a set must be a table of names and values");
  } else if (!set.empty()) {
    return fault(path, "has no sets, so -P " + set + " has no meaning",
                 ErrorCode::kInvalidArgument);
  }
  std::vector<Definition> definitions;
  for (const auto& [name, value] : json.items()) {
    const auto value_text = text_of(value);
    if (!value_text) {
      return fault(path,
                   "'" + name + "' must be a number, true or false, a string or a list of numbers");
    }
    Definition definition;
    definition.name = name;
    definition.text = *value_text;
    definition.origin = "-p " + path;
    definition.is_verbatim = true;
    definitions.push_back(std::move(definition));
  }
  return definitions;
}

std::string parameters_json(const std::string& model, const std::vector<Parameter>& parameters) {
  Json schema;
  schema["$schema"] = "https://json-schema.org/draft/2020-12/schema";
  schema["title"] = model;
  schema["type"] = "object";
  schema["properties"] = Json::object();
  for (const Parameter& parameter : parameters)
    schema["properties"][parameter.name] = schema_of(parameter);
  schema["additionalProperties"] = false;
  return schema.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace csgrun
