#include "lua_bindings/openscad_hints.h"

#include <algorithm>
#include <iterator>

namespace csgrun {
namespace {

constexpr const char* kMovers[] = {"translate", "rotate",         "scale",          "mirror",
                                   "color",     "linear_extrude", "rotate_extrude", "offset",
                                   "resize",    "multmatrix",     "projection",     "render"};

bool has(std::string_view text, std::string_view part) {
  return text.find(part) != std::string_view::npos;
}

/// A list in brackets where a value stands: after a parenthesis, a comma or an equals sign.
bool has_list_in_brackets(std::string_view line) {
  for (size_t i = 0; i < line.size(); ++i) {
    if (line[i] != '[') continue;
    const size_t before = line.substr(0, i).find_last_not_of(' ');
    if (before != std::string_view::npos && has("(,=[", line.substr(before, 1))) return true;
  }
  return false;
}

/// a += 1, a++.
bool is_assignment_by(std::string_view line) {
  for (const char* form : {"+=", "-=", "*=", "/=", "++"}) {
    if (has(line, form)) return true;
  }
  return false;
}

}  // namespace

bool is_written_before(std::string_view function) {
  return std::find(std::begin(kMovers), std::end(kMovers), function) != std::end(kMovers);
}

std::string run_time_hint(std::string_view message) {
  if (has(message, "attempt to call a table value") && has(message, "for iterator"))
    return "; the entries of a list are gone through by: for _, x in ipairs(list) do";
  if (has(message, "attempt to index a boolean value"))
    return "; a module that ends without return gives true";
  return {};
}

std::string syntax_hint(std::string_view line, std::string_view message) {
  line.remove_prefix(std::min(line.find_first_not_of(" \t"), line.size()));
  if (line.starts_with("%") || line.starts_with("!") || line.starts_with("#"))
    return "; OpenSCAD's modifiers are not part of Lua: return the part that is to be seen alone";
  if (line.starts_with("for (") || line.starts_with("for("))
    return "; a loop is: for i = 0, 3 do ... end";
  if (line.starts_with("if ") && has(message, "'then' expected") && has(line, "{"))
    return "; a condition is: if a then ... else ... end";
  if (line.starts_with("function ") && has(message, "near '='"))
    return "; a function is: function f(x) return x * 2 end";
  for (const char* form : {"let(", "let (", "assign(", "assign ("}) {
    if (has(line, form)) return "; a name for a value is: local a = 1";
  }
  if (has(line, "each ") && has(message, "near"))
    return "; a list in a list, entry for entry, is: {1, 2, table.unpack(list)}";
  if (has(message, "'?'")) return "; a choice between two values is: condition and a or b";
  if (is_assignment_by(line) && (has(message, "syntax error near") || has(message, "unexpected")))
    return "; it is written out: a = a + 1";
  if (has(message, "'&'") && has(line, "&&")) return "; both together are: a and b";
  if (has(message, "'|'") && has(line, "||")) return "; one or the other is: a or b";
  if (line.starts_with("while ") && has(message, "'do' expected"))
    return "; a loop is: while a do ... end";
  for (const char* form : {"let ", "const ", "var "}) {
    if (line.starts_with(form) && has(message, "syntax error near"))
      return "; a name for a value is: local a = 1";
  }
  if (line.starts_with("module "))
    return "; a module is a function that returns a solid: local function name(...) ... end";
  if (line.starts_with("include <") || line.starts_with("use <"))
    return "; other files of Lua are read by require \"name\"";
  if (line.starts_with("//") || line.starts_with("/*") || has(message, "'//'"))
    return "; a comment begins with --";
  if (has(message, "'$'"))
    return "; the facets are fn, fa and fs: sphere(5, {fn = 64}), or csg.fn = 64 for all";
  if (has(message, "'['") && has_list_in_brackets(line))
    return "; a list stands in braces: {10, 20, 30}";
  if (has(message, "'}' expected")) return "; what stands in braces is separated by commas";
  if (has(message, "'!'")) return "; \"not equal\" is ~=, and \"not\" is not";
  if (has(message, "near '='") && has(message, "')' expected"))
    return "; options by name stand in braces: cube{size = 10, center = true}";
  for (const char* mover : kMovers) {
    if (line.starts_with(mover) || line.starts_with(std::string("return ") + mover)) {
      if (has(message, "expected near") || has(message, "syntax error near"))
        return std::string("; what is changed stands before: cube(10):") + mover + "(...)";
    }
  }
  // After a value it divides by what it was to say.
  if (has(line, "//")) return "; a comment begins with --";
  return {};
}

const char* name_hint(std::string_view name) {
  struct Hint {
    std::string_view name;
    const char* text;
  };
  static constexpr Hint kHints[] = {
      {"echo", "print(...) writes to the log"},
      {"undef", "it is nil"},
      {"null", "it is nil"},
      {"undefined", "it is nil"},
      {"len", "it is #list"},
      {"str", "it is a .. b, or tostring(x)"},
      {"concat", "it is table.move, or a loop"},
      {"chr", "it is utf8.char(code)"},
      {"ord", "it is utf8.codepoint(text)"},
      {"log", "it is math.log(x, base), or ln(x)"},
      {"is_undef", "it is x == nil"},
      {"is_num", "it is type(x) == \"number\""},
      {"is_list", "it is type(x) == \"table\""},
      {"is_string", "it is type(x) == \"string\""},
      {"is_bool", "it is type(x) == \"boolean\""},
      {"is_function", "it is type(x) == \"function\""},
      {"use", "it is require \"name\""},
      {"include", "it is require \"name\""},
      {"children", "a function takes what it works on as an argument"},
      {"intersection_for", "it is intersection(list), of a list that a loop fills"},
      {"search", "it is a loop: for i, x in ipairs(list) do ... end"},
      {"each", "it is table.unpack(list), at the end of a list"},
      {"let", "it is local a = 1, before what uses it"},
      {"assign", "it is local a = 1, before what uses it"},
      {"parent_module", "there is none: a function is told what it needs by its arguments"},
      {"cuboid", "it is cube{20, 10, 5}"},
      {"box", "it is cube{20, 10, 5}"},
      {"cyl", "it is cylinder{h = 10, r = 5}"},
      {"cone", "it is cylinder{h = 10, r1 = 5, r2 = 0}"},
      {"frustum", "it is cylinder{h = 10, r1 = 5, r2 = 2}"},
      {"ngon", "it is regular_polygon{n = 6, r = 5}"},
      {"prism", "it is cylinder{h = 10, r = 5, fn = 6}"},
      {"tube", "it is cylinder{h = 10, r = 5} - cylinder{h = 10, r = 4}"},
      {"roundedCuboid", "it is cube{{20, 10, 5}, r = 2}"},
      {"roundedCube", "it is cube{{20, 10, 5}, r = 2}"},
      {"roundedcube", "it is cube{{20, 10, 5}, r = 2}"},
      {"rounded_cube", "it is cube{{20, 10, 5}, r = 2}"},
      {"rectangle", "it is rect{20, 10}"},
      {"roundedRectangle", "it is rect{{20, 10}, r = 2}"},
      {"roundedRect", "it is rect{{20, 10}, r = 2}"},
      {"rounded_rectangle", "it is rect{{20, 10}, r = 2}"},
      {"rounded_rect", "it is rect{{20, 10}, r = 2}"},
      {"rounded_square", "it is rect{{20, 10}, r = 2}"},
      {"version", "csgrun --version tells"},
      {"hullChain", "it is union{hull(a, b), hull(b, c)}"},
      {"Manifold", "its functions are globals: cube, sphere, union"},
      {"CrossSection", "its functions are globals: square, circle, polygon"},
  };
  const auto* hint = std::find_if(std::begin(kHints), std::end(kHints),
                                  [&](const Hint& each) { return each.name == name; });
  return hint == std::end(kHints) ? nullptr : hint->text;
}

}  // namespace csgrun
