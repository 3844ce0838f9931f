#include "lua_bindings/api_docs.h"

#include <algorithm>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "lua_bindings/api.h"
#include "lua_bindings/library_docs.h"
#include "lua_bindings/vector_rule.h"

namespace csgrun {
namespace {

using T = ArgumentType;

/// The type of an argument as the language server writes it.
const char* type_name(T type) {
  switch (type) {
    case T::kNumber:
      return "number";
    case T::kInteger:
      return "integer";
    case T::kBoolean:
      return "boolean";
    case T::kBooleans2:
    case T::kBooleans3:
    case T::kBooleans2Or3:
      return "boolean|boolean[]";
    case T::kString:
      return "string";
    case T::kVector2:
    case T::kVector3:
    case T::kVector2Or3:
      return "number[]";
    case T::kSize2:
    case T::kSize3:
    case T::kSize2Or3:
    case T::kAngles:
      return "number|number[]";
    case T::kPoints2:
    case T::kPoints3:
      return "number[][]";
    case T::kIndexLists:
      return "integer[][]";
    case T::kMatrix:
      return "Matrix|number[][]";
    case T::kColor:
      return "string|number[]";
    case T::kValue:
      return "any";
  }
  return "any";
}

/// Docs are broken into lines for the terminal; here they are one line.
std::string one_line_of(const char* doc) {
  std::string text;
  for (const char* c = doc; *c != '\0'; ++c) {
    if (*c == '\n') {
      while (c[1] == ' ') ++c;
      text += ' ';
    } else {
      text += *c;
    }
  }
  return text;
}

std::vector<const Option*> options_of(const FunctionSpec& spec) {
  std::vector<const Option*> options;
  for (const Option& option : spec.options) options.push_back(&option);
  if (spec.facets) {
    for (const Option& option : facet_options()) options.push_back(&option);
  }
  return options;
}

/// The other name of an option, or null: an option of the function's own may have that name (the
/// segments of linear_extrude are not fn).
const char* alias_of(const FunctionSpec& spec, const Option& option) {
  if (option.alias == nullptr) return nullptr;
  for (const Option& own : spec.options) {
    if (std::string_view(own.name) == option.alias) return nullptr;
  }
  return option.alias;
}

std::string positional_of(const FunctionSpec& spec) {
  std::string text = spec.subject;
  for (const Option& option : spec.options) {
    if (option.positional) text += (text.empty() ? "" : ", ") + std::string(option.name);
  }
  return text;
}

std::string forms_of(const Binding& binding) {
  std::vector<std::string> methods;
  if (binding.solid_method != nullptr) methods.emplace_back("solids");
  if (binding.shape_method != nullptr) methods.emplace_back("shapes");
  if (binding.matrix_method != nullptr) methods.emplace_back("matrices");
  if (methods.empty()) return {};
  std::string list = methods[0];
  for (size_t i = 1; i < methods.size(); ++i)
    list += (i + 1 == methods.size() ? " and " : ", ") + methods[i];
  return (binding.function == nullptr ? "A method of " : "Also a method of ") + list + ".";
}

std::string in_table(std::string text) {
  for (size_t at = 0; (at = text.find('|', at)) != std::string::npos; at += 2)
    text.replace(at, 1, "\\|");
  return text;
}

void append_function_page(std::string& page, const Binding& binding) {
  const FunctionSpec& spec = *binding.spec;
  page += fmt::format("\n### {}\n\n`{}({})`\n\n{}", spec.name, spec.name, positional_of(spec),
                      one_line_of(spec.doc));
  if (const std::string forms = forms_of(binding); !forms.empty()) page += " " + forms;
  page += "\n";
  const auto options = options_of(spec);
  if (spec.subject[0] != '\0' || !options.empty()) {
    page += "\n| option | takes | default | meaning |\n| --- | --- | --- | --- |\n";
    if (spec.subject[0] != '\0')
      page += fmt::format("| `{}` | | | {} |\n", spec.subject, in_table(spec.subject_doc));
    for (const Option* option : options) {
      const char* const alias = alias_of(spec, *option);
      const std::string names = alias != nullptr ? fmt::format("`{}`, `{}`", option->name, alias)
                                                 : fmt::format("`{}`", option->name);
      const std::string fallback =
          option->fallback[0] != '\0' ? fmt::format("{}", option->fallback) : "";
      page += fmt::format("| {} | {} | {} | {} |\n", names, in_table(describe_type(option->type)),
                          in_table(fallback), in_table(one_line_of(option->doc)));
    }
  }
  page += fmt::format("\n```lua\n{}\n```\n", spec.example);
}

const char* range_name(Range range) {
  switch (range) {
    case Range::kAny:
      return "any";
    case Range::kPositive:
      return "positive";
    case Range::kNotNegative:
      return "not negative";
  }
  return "any";
}

/// A word that Lua does not let be a parameter's name.
std::string parameter_name(const char* name) {
  const std::string text = name;
  return text == "end" || text == "function" || text == "repeat" ? text + "_" : text;
}

void append_options_class(std::string& text, const FunctionSpec& spec) {
  const auto options = options_of(spec);
  if (options.empty()) return;
  text += fmt::format("\n---@class (exact) csgrun.{}\n---@field [integer] any\n", spec.name);
  for (const Option* option : options) {
    text += fmt::format("---@field {}? {} {}\n", option->name, type_name(option->type),
                        one_line_of(option->doc));
    if (const char* const alias = alias_of(spec, *option))
      text += fmt::format("---@field {}? {} the same as {}\n", alias, type_name(option->type),
                          option->name);
  }
}

void append_definition(std::string& text, const Binding& binding, const char* owner,
                       const std::string& result) {
  const FunctionSpec& spec = *binding.spec;
  text += fmt::format("\n---{}\n---\n---Example: `{}`\n", one_line_of(spec.doc), spec.example);
  const bool has_options = !options_of(spec).empty();
  const bool is_method = owner[0] != '\0';
  std::vector<std::string> names;
  std::string parameters;
  if (spec.subject[0] != '\0' && !is_method) {
    names.emplace_back(spec.subject);
    parameters += fmt::format("---@param {} any {}\n", spec.subject, one_line_of(spec.subject_doc));
  }
  bool is_open = false;  // any number of values may stand there
  for (const Option& option : spec.options) {
    if (!option.positional) continue;
    if (std::string_view(option.name) == "operands" || std::string_view(option.name) == "values") {
      is_open = true;
      parameters += fmt::format("---@param ... any {}\n", one_line_of(option.doc));
      continue;
    }
    names.push_back(parameter_name(option.name));
    parameters += fmt::format("---@param {}? {} {}\n", names.back(), type_name(option.type),
                              one_line_of(option.doc));
  }
  if (has_options && !is_open) {
    names.emplace_back("options");
    parameters += fmt::format("---@param options? csgrun.{}\n", spec.name);
  }
  const std::string self = is_method ? fmt::format("self: {}, ", owner) : "";
  if (has_options && !is_open && (spec.subject[0] == '\0' || is_method))
    text += fmt::format("---@overload fun({}options: csgrun.{}): {}\n", self, spec.name, result);
  // cube(10, 20, 30): the first vector as numbers one after another.
  if (!spec.options.empty() && spec.options[0].positional) {
    const VectorRule rule = vector_rule(spec.options[0].type);
    if (rule.most > 1) {
      text += fmt::format("---@overload fun({}x: number, y{}: number, z?: number, ...): {}\n", self,
                          rule.least > 1 && !rule.number_too ? "" : "?", result);
    }
  }
  if (is_open) names.emplace_back("...");
  text += parameters;
  if (!result.empty()) text += fmt::format("---@return {}\n", result);
  text += fmt::format("function {}{}{}({}) end\n", owner, is_method ? ":" : "", spec.name,
                      fmt::join(names, ", "));
}

/// What a function gives when it is not what its group gives.
std::string result_of(const Binding& binding, const BindingGroup& group, const char* owner) {
  static const std::map<std::string, std::string> kResults = {
      {"bbox", "{min: number[], max: number[], size: number[], center: number[]}"},
      {"edges",
       "{from: number[], to: number[], length: number, turn: number, convex: boolean, normals: "
       "number[][]}[]"},
      {"size", "number[]"},
      {"centroid", "number[]"},
      {"components", "integer"},
      {"genus", "integer"},
      {"is_empty", "boolean"},
      {"contains", "boolean"},
      {"mesh", "{points: number[][], faces: integer[][]}"},
      {"anchor", "number[]"},
      {"perimeter", "number"},
      {"points", "number[][]"},
      {"paths", "integer[][]"},
      {"outlines", "number[][][]"},
      {"decompose", "any[]"},
      {"project", "Shape"},
      {"projection", "Shape"},
      {"slice", "Shape"},
      {"split", "Solid, Solid"},
      {"vec", "Vector"},
      {"vector", "Vector"},
      {"cross", "Vector"},
      {"rands", "number[]"},
      {"inverse", "Matrix"},
      {"text3d", "Solid"},
      {"text_metrics", "table"},
      {"textmetrics", "table"},
      {"font_metrics", "table"},
      {"fontmetrics", "table"},
      {"read_text", "string"},
      {"load_csg", "any"},
      {"linear_extrude", "Solid"},
      {"rotate_extrude", "Solid"},
      {"import", "Solid"},
      {"faces", "{normal: number[], area: number, center: number[], loops: number[][][]}[]"},
      {"ray", "{distance: number, point: number[], normal: number[], entering: boolean}[]"},
      {"emit", ""},
      {"render", ""},
  };
  const auto found = kResults.find(binding.spec->name);
  if (found != kResults.end()) return found->second;
  const std::string result = group.result;
  if (result == "same") return owner[0] != '\0' ? owner : "any";
  return result;
}

}  // namespace

std::string api_markdown() {
  std::string page =
      "# The functions of the language\n\n"
      "Made by `csgrun --help-api=markdown` from the tables that check arguments; do not edit.\n\n"
      "Every function is a global and stands in the table `csg`. Calls: `f(values...)`, "
      "`f{name = value, ...}`,\n`f(values..., {name = value})` or `f{values..., name = value}`; a "
      "list `{x, y, z}` wherever a vector is meant,\nand numbers one after another for the first "
      "vector. Lengths are millimetres, angles degrees, Z is up.\n\n"
      "Operators: `a + b` and `a | b` union, `a - b` difference, `a * b` and `a & b` intersection, "
      "`a ~ b` symmetric\ndifference, `M * a` transforms by a matrix. Settings: `csg.fn`, "
      "`csg.fa`, "
      "`csg.fs`, `csg.grid`, `csg.contacts`.\n";
  for (const BindingGroup& group : binding_groups()) {
    page += fmt::format("\n## {}\n", group.title);
    for (const Binding& binding : group.bindings) append_function_page(page, binding);
  }
  return page + library_docs(true);
}

std::string api_json() {
  using Json = nlohmann::ordered_json;
  Json functions = Json::array();
  for (const BindingGroup& group : binding_groups()) {
    for (const Binding& binding : group.bindings) {
      const FunctionSpec& spec = *binding.spec;
      Json options = Json::array();
      for (const Option* option : options_of(spec)) {
        const char* const alias = alias_of(spec, *option);
        options.push_back({{"name", option->name},
                           {"alias", alias != nullptr ? Json(alias) : Json()},
                           {"takes", describe_type(option->type)},
                           {"range", range_name(option->range)},
                           {"default", option->fallback},
                           {"positional", option->positional},
                           {"doc", one_line_of(option->doc)}});
      }
      Json methods = Json::array();
      if (binding.solid_method != nullptr) methods.push_back("solid");
      if (binding.shape_method != nullptr) methods.push_back("shape");
      if (binding.matrix_method != nullptr) methods.push_back("matrix");
      functions.push_back({{"name", spec.name},
                           {"group", group.title},
                           {"doc", one_line_of(spec.doc)},
                           {"function", binding.function != nullptr},
                           {"methods", std::move(methods)},
                           {"subject", spec.subject},
                           {"options", std::move(options)},
                           {"example", spec.example}});
    }
  }
  return Json{{"functions", std::move(functions)}}.dump(1) + "\n";
}

std::string api_definitions() {
  std::string text =
      "---@meta\n"
      "-- Made by `csgrun --help-api=luals` from the tables that check arguments; do not edit.\n"
      "-- `csgrun --init` puts it where the Lua language server finds it.\n\n"
      "---@class csg\n---@field fn number\n---@field fa number\n---@field fs number\n"
      "---@field grid number|string|nil\n---@field contacts \"separate\"|\"join\"\n"
      "---@field PI number\ncsg = {}\n\n---@type number\nPI = nil\n\n"
      "---@class Vector: number[]\n---@field x number\n---@field y number\n---@field z number\n"
      "---@operator add(number[]): Vector\n---@operator sub(number[]): Vector\n"
      "---@operator mul(number): Vector\n---@operator div(number): Vector\n"
      "---@operator unm: Vector\nlocal Vector = {}\n\n"
      "---@class Matrix\n---@operator mul(any): any\nlocal Matrix = {}\n";
  for (const char* kind : {"Solid", "Shape"}) {
    text += fmt::format("\n---@class {0}\n", kind);
    for (const char* name : {"add", "sub", "mul", "bor", "band", "bxor"})
      text += fmt::format("---@operator {}({}): {}\n", name, kind, kind);
    text += fmt::format("local {} = {{}}\n", kind);
  }
  // A name may be bound in two groups (of solids, and of shapes): each form is told once.
  std::vector<std::string> classes;
  for (const BindingGroup& group : binding_groups()) {
    for (const Binding& binding : group.bindings) {
      const std::string name = binding.spec->name;
      if (std::find(classes.begin(), classes.end(), name) == classes.end()) {
        classes.push_back(name);
        append_options_class(text, *binding.spec);
      }
      if (binding.function != nullptr) {
        append_definition(text, binding, "", result_of(binding, group, ""));
        text += fmt::format("csg.{0} = {0}\n", name);
      }
      if (binding.solid_method != nullptr)
        append_definition(text, binding, "Solid", result_of(binding, group, "Solid"));
      if (binding.shape_method != nullptr)
        append_definition(text, binding, "Shape", result_of(binding, group, "Shape"));
      if (binding.matrix_method != nullptr)
        append_definition(text, binding, "Matrix", result_of(binding, group, "Matrix"));
    }
  }
  return text;
}

}  // namespace csgrun
