// Arguments by table: what a function takes is data, and the same data drives parsing, the text of
// errors and `csgrun --help-api`.
//
// Call forms: f(positional...), f{options}, f(main, {options}); a list {x, y, z} anywhere a vector
// is meant, and numbers one after another for the first vector: cube(10), cube(10, 20, 30),
// cube{10, 20, 30, center = true}, cube{{10, 20, 30}, center = true}, cube{size = {10, 20, 30}}.
// Where the first argument is no vector, the list in a table of options holds the first arguments:
// cylinder{20, 5, fn = 8} is cylinder(20, 5, {fn = 8}).
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <lua.hpp>

#include <csgrun/engine/csg_tree.h>
#include <csgrun/primitives/solids.h>

namespace csgrun {

enum class ArgumentType : uint8_t {
  kNumber,
  kInteger,
  kBoolean,
  kBooleans2,     ///< a boolean, or a list of two
  kBooleans3,     ///< a boolean, or a list of three
  kBooleans2Or3,  ///< a boolean, or a list of two or three (the third is then false)
  kString,
  kVector2,     ///< a list of two numbers
  kVector3,     ///< a list of three numbers
  kVector2Or3,  ///< a list of two or three numbers (z is then 0)
  kSize2,       ///< a number, or a list of two
  kSize3,       ///< a number, or a list of three
  kSize2Or3,    ///< a number, or a list of two or three (z is then 1)
  kAngles,      ///< a number, or a list of one to three
  kPoints2,     ///< a list of points {x, y}; messages count them from 0, as indices do
  kPoints3,     ///< a list of points {x, y, z}
  kIndexLists,  ///< a list of lists of indices from 0; messages count the lists from 0 too
  kMatrix,      ///< a matrix, or its rows: a list of up to four lists of up to four numbers
  kColor,       ///< a name, "#rrggbb", or a list of three or four numbers
  kValue,       ///< anything; the function looks at it itself
};

enum class Range : uint8_t { kAny, kPositive, kNotNegative };

struct Option {
  const char* name;
  ArgumentType type;
  const char* fallback;  ///< as the help shows it; "" = it must be given, or has no single default
  const char* doc;
  bool positional = false;
  Range range = Range::kAny;
  const char* alias = nullptr;
};

/// OpenSCAD's number for its preview. Scripts that come from there have it, and it changes nothing.
inline constexpr Option kConvexityOption{"convexity", ArgumentType::kInteger,
                                         "",          "ignored: OpenSCAD needs it for its preview",
                                         false,       Range::kNotNegative};

struct FunctionSpec {
  const char* name;
  const char* doc;
  std::span<const Option> options;
  bool facets = false;  ///< takes fn, fa and fs as well
  const char* example = "";
  const char* subject = "";  ///< what stands before the options: "part", "shape"; else ""
  const char* subject_doc = "";
};

/// A vector as given: how many numbers (1: a bare number), the rest is 0.
struct VectorArgument {
  int count = 0;
  glm::dvec3 v{0, 0, 0};
};

class Arguments {
 public:
  /// Reads the arguments from stack index `first` on. Throws ScriptError, "cube: option 'size' must
  /// be a number or a list of three numbers, got string" and the like.
  Arguments(lua_State* L, const FunctionSpec& spec, int first);

  [[nodiscard]] bool has(std::string_view name) const { return find(name) != nullptr; }
  [[nodiscard]] double number(std::string_view name, double fallback) const;
  [[nodiscard]] bool boolean(std::string_view name, bool fallback) const;
  [[nodiscard]] std::array<bool, 3> booleans(std::string_view name) const;
  [[nodiscard]] std::string string(std::string_view name, const std::string& fallback) const;
  [[nodiscard]] std::optional<VectorArgument> vector(std::string_view name) const;
  [[nodiscard]] std::vector<glm::dvec2> points2(std::string_view name) const;
  [[nodiscard]] const std::vector<glm::dvec3>& points3(std::string_view name) const;
  [[nodiscard]] const std::vector<std::vector<uint32_t>>& index_lists(std::string_view name) const;
  [[nodiscard]] const Affine& matrix(std::string_view name) const;
  /// The stack index of a kValue or kColor, 0 when it was not given.
  [[nodiscard]] int stack_index(std::string_view name) const;
  /// fn, fa, fs as given, else the session's.
  [[nodiscard]] Facets facets() const;
  /// How many arguments were positional (for functions whose meaning depends on it).
  [[nodiscard]] int positional_count() const { return positional_count_; }

 private:
  using Points = std::vector<glm::dvec3>;
  using IndexLists = std::vector<std::vector<uint32_t>>;
  using Value = std::variant<double, bool, std::array<bool, 3>, std::string, VectorArgument, Points,
                             IndexLists, Affine, int>;
  struct Given {
    const Option* option;
    Value value;
  };

  [[nodiscard]] const Value* find(std::string_view name) const;
  const Option* find_option(std::string_view name) const;
  [[nodiscard]] std::string unknown_option(std::string_view name) const;
  void read_positional(int first, int last);
  void check_for_gap(const Option& option, int first, int count, int last, bool is_only) const;
  void read_table(int table);
  void read_list_part(int table, lua_Integer length);
  void set(const Option& option, int index);
  void set_spread(const Option& option, int first, int count);
  Value convert(const Option& option, int index) const;
  VectorArgument convert_vector(const Option& option, int index) const;
  /// Point `number` (from 0) of a list of points.
  glm::dvec3 convert_point(const Option& option, lua_Integer number, int index) const;
  double check_number(const Option& option, int index) const;
  [[nodiscard]] std::string as_call(int list) const;
  [[noreturn]] void wrong_type(const Option& option, int index) const;
  void check_new(const Option& option) const;
  [[noreturn]] void fail(const std::string& message) const;
  std::vector<const Option*> positional_options() const;

  lua_State* L_;
  const FunctionSpec& spec_;
  std::vector<Given> given_;
  int positional_count_ = 0;
  int options_table_ = 0;  ///< where the list part of a table of options is read: that table
};

/// "cube: message" as a ScriptError; a message that begins so already stays as it is.
[[noreturn]] void fail_as(const std::string& function, const std::string& message);

/// "a number or a list of three numbers".
std::string describe_type(ArgumentType type);

/// "table", "a list of 2 values", "nan", "the string "10"" ...: what the user gave, for messages.
std::string describe_value(lua_State* L, int index);

/// The same, but a number is named as one: "the number 5".
std::string describe_given(lua_State* L, int index);

/// Number of entries of a list; -1 when the table has other keys or holes.
lua_Integer list_length(lua_State* L, int index);

/// The first entry that is nil before others that are not: of {1, nil, 3} the second; 0 when there
/// is none, or when the table has other keys.
lua_Integer missing_entry(lua_State* L, int index);

/// Signature, meaning and options of a function, for --help-api.
std::string help_text(const FunctionSpec& spec);

/// What is wrong with facet settings, or an empty string.
std::string check_facets(const Facets& facets);

/// The facet options that every round thing takes.
std::span<const Option> facet_options();

}  // namespace csgrun
