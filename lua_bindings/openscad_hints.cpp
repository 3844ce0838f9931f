#include "lua_bindings/openscad_hints.h"

#include <algorithm>
#include <cctype>
#include <iterator>
#include <span>

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

/// The word, a blank and a letter.
bool begins_with_words(std::string_view line, std::string_view word) {
  return line.size() > word.size() + 1 && line.starts_with(word) && line[word.size()] == ' ' &&
         std::isalpha(static_cast<unsigned char>(line[word.size() + 1])) != 0;
}

/// {r: 3}, as JavaScript has it.
bool has_option_by_colon(std::string_view line) {
  for (size_t i = 1; i + 1 < line.size(); ++i) {
    const bool follows_name = std::isalnum(static_cast<unsigned char>(line[i - 1])) != 0;
    if (line[i] == ':' && follows_name &&
        (line[i + 1] == ' ' || std::isdigit(static_cast<unsigned char>(line[i + 1])) != 0))
      return true;
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
  if (has(message, "<name> expected near") && has_option_by_colon(line))
    return "; options are: cylinder{r = 3, h = 5}";
  if (has(message, "'?'")) return "; a choice between two values is: condition and a or b";
  if (is_assignment_by(line) && (has(message, "syntax error near") || has(message, "unexpected")))
    return "; it is written out: a = a + 1";
  if (has(message, "'&'") && has(line, "&&"))
    return "; both conditions are: a and b; what solids have in common is a * b";
  if (has(message, "'|'") && has(line, "||"))
    return "; one condition or the other is: a or b; solids together are a + b";
  if (has(message, "near '='") &&
      (has(message, "'then' expected") || has(message, "'do' expected")))
    return "; \"equal\" is ==";
  if (line.starts_with("while ") && has(message, "'do' expected"))
    return "; a loop is: while a do ... end";
  for (const char* form : {"let ", "const ", "var "}) {
    if (line.starts_with(form) && has(message, "syntax error near"))
      return "; a name for a value is: local a = 1";
  }
  if (line.starts_with("module "))
    return "; a module is a function that returns a solid: local function name(...) ... end";
  if (begins_with_words(line, "def")) return "; a function is: function f(x) return x * 2 end";
  if (begins_with_words(line, "import") || begins_with_words(line, "from"))
    return "; other files of Lua are read by require \"name\"";
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
  for (const char* operation : {"near '-'", "near '+'", "near '*'", "near '|'", "near '&'"}) {
    if (has(message, "syntax error") && has(message, operation))
      return "; a value that is made needs a name, or return: part = part - hole";
  }
  if (has(message, "<eof> expected near"))
    return "; return ends a script: nothing may follow it (an `end` too many does the same)";
  // After a value it divides by what it was to say.
  if (has(line, "//")) return "; a comment begins with --";
  return {};
}

namespace {

struct Hint {
  std::string_view name;  // in lower case and without underscores
  const char* text;
};

constexpr char kWriting[] = "what the script returns is written: csgrun model.lua -o part.stl";
constexpr char kShell[] = "a shell is part - part:offset(-2)";
constexpr char kRoundedBox[] = "it is cube{{20, 10, 5}, r = 2}";
constexpr char kRoundedRectangle[] = "it is rect{{20, 10}, r = 2}";
constexpr char kCurve[] =
    "a curve is a list of its points, which a loop fills, for polygon or sweep";
constexpr char kNoPlanes[] = "there are no work planes: a part is made at the origin and moved";
constexpr char kDegrees[] = "angles are degrees; math.rad(x) and math.deg(x) convert";
constexpr char kColourNames[] = "color takes '#rrggbb' and names as they are";
constexpr char kParameters[] = "a parameter is param(\"width\", 20), set by -D width=25";

/// What stands for functions and variables of other programs, and of other languages.
constexpr Hint kNames[] = {
    // OpenSCAD
    {"assign", "it is local a = 1, before what uses it"},
    {"children", "a function takes what it works on as an argument"},
    {"chr", "it is utf8.char(code)"},
    {"concat", "it is table.move, or a loop"},
    {"each", "it is table.unpack(list), at the end of a list"},
    {"echo", "print(...) writes to the log"},
    {"include", "it is require \"name\""},
    {"intersectionfor", "it is intersection(list), of a list that a loop fills"},
    {"isbool", "it is type(x) == \"boolean\""},
    {"isfunction", "it is type(x) == \"function\""},
    {"islist", "it is type(x) == \"table\""},
    {"isnum", "it is type(x) == \"number\""},
    {"isstring", "it is type(x) == \"string\""},
    {"isundef", "it is x == nil"},
    {"len", "it is #list"},
    {"let", "it is local a = 1, before what uses it"},
    {"log", "it is math.log(x, base), or ln(x)"},
    {"ord", "it is utf8.codepoint(text)"},
    {"parentmodule", "there is none: a function is told what it needs by its arguments"},
    {"search", "it is a loop: for i, x in ipairs(list) do ... end"},
    {"str", "it is a .. b, or tostring(x)"},
    {"undef", "it is nil"},
    {"use", "it is require \"name\""},
    {"version", "csgrun --version tells"},
    // other languages, and Lua 5.1
    {"arg", kParameters},
    {"null", "it is nil"},
    {"params", kParameters},
    {"range", "a loop is: for i = 0, 9 do ... end"},
    {"undefined", "it is nil"},
    {"unpack", "it is table.unpack(list)"},
    // solids of other programs
    {"box", "it is cube{20, 10, 5}"},
    {"cone", "it is cylinder{h = 10, r1 = 5, r2 = 0}"},
    {"cuboid", "it is cube{20, 10, 5}"},
    {"cyl", "it is cylinder{h = 10, r = 5}"},
    {"cylinderelliptic", "it is cylinder{h = 10, r = 5}:scale(1, 0.5, 1)"},
    {"dodecahedron", "it is hull(points), of its 20 corners"},
    {"frustum", "it is cylinder{h = 10, r1 = 5, r2 = 2}"},
    {"geodesicsphere", "it is sphere{r = 10, fn = 64}"},
    {"prism", "it is cylinder{h = 10, r = 5, fn = 6}"},
    {"roundedcube", kRoundedBox},
    {"roundedcuboid", kRoundedBox},
    {"roundedcylinder", "it is cylinder{h = 10, r = 5, round = 1}"},
    {"tetrahedron", "it is hull{{1, 1, 1}, {-1, -1, 1}, {-1, 1, -1}, {1, -1, -1}}"},
    {"tube", "it is cylinder{h = 10, r = 5} - cylinder{h = 10, r = 4}"},
    // shapes and curves
    {"arc", kCurve},
    {"bezier", kCurve},
    {"ellipse", "it is circle(10):scale(1, 0.5)"},
    {"helix", kCurve},
    {"line", kCurve},
    {"ngon", "it is regular_polygon{n = 6, r = 5}"},
    {"polyline", kCurve},
    {"rectangle", "it is rect{20, 10}"},
    {"roundedrect", kRoundedRectangle},
    {"roundedrectangle", kRoundedRectangle},
    {"roundedsquare", kRoundedRectangle},
    {"spline", kCurve},
    {"star", "it is polygon(points), of points that a loop fills"},
    {"triangle", "it is polygon{{0, 0}, {20, 0}, {0, 10}}"},
    // what is done with them
    {"bosl", "there are csg.gears, csg.threads and csg.layout: require \"csg.gears\""},
    {"colornametorgb", kColourNames},
    {"cq", kNoPlanes},
    {"crosssection", "its functions are globals: square, circle, polygon"},
    {"degtorad", kDegrees},
    {"hextorgb", kColourNames},
    {"hullchain", "it is union{hull(a, b), hull(b, c)}"},
    {"manifold", "its functions are globals: cube, sphere, union"},
    {"measurearea", "it is part:area()"},
    {"measureboundingbox", "it is part:bbox()"},
    {"measurecenter", "it is part:bbox().center"},
    {"measurecenterofmass", "it is part:centroid()"},
    {"measuredimensions", "it is part:size()"},
    {"measurevolume", "it is part:volume()"},
    {"radtodeg", kDegrees},
    {"scad", "it is load_csg(\"tree.csg\"), of a tree that OpenSCAD wrote"},
    {"setcircularsegments", "it is csg.fn = 64"},
    {"setmincircularangle", "it is csg.fa = 3"},
    {"setmincircularedgelength", "it is csg.fs = 0.5"},
    {"workplane", kNoPlanes},
};

/// What is no method of solids and shapes, nor a function.
constexpr Hint kVerbs[] = {
    {"display", kWriting},   {"export", kWriting},
    {"exportstl", kWriting}, {"hollow", kShell},
    {"save", kWriting},      {"shell", kShell},
    {"show", kWriting},      {"showobject", kWriting},
    {"thicken", kShell},     {"hole", "a hole is part - cylinder{h = 10, d = 5}"},
    {"tostl", kWriting},     {"write", kWriting},
};

const char* find_hint(std::span<const Hint> hints, std::string_view name) {
  std::string folded;
  for (const char c : name) {
    if (c != '_') folded += c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  }
  const auto hint = std::find_if(hints.begin(), hints.end(),
                                 [&](const Hint& each) { return each.name == folded; });
  return hint == hints.end() ? nullptr : hint->text;
}

}  // namespace

const char* name_hint(std::string_view name) {
  const char* hint = find_hint(kNames, name);
  return hint != nullptr ? hint : find_hint(kVerbs, name);
}

const char* method_hint(std::string_view name) { return find_hint(kVerbs, name); }

}  // namespace csgrun
