// edges, chamfer, fillet: the straight edges of a solid, chosen and cut.
#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include <csgrun/primitives/solid_edges.h>
#include <csgrun/primitives/trig.h>

#include "lua_bindings/api.h"
#include "lua_bindings/guard.h"
#include "lua_bindings/operands.h"
#include "lua_bindings/session.h"
#include "lua_bindings/tolerances.h"

namespace csgrun {
namespace {

using T = ArgumentType;

/// Deeper lists are taken for one that contains itself.
constexpr int kDeepestEdges = 100;
/// Edges that turn by less are facets of what is round.
constexpr const char* kLeastTurn = "10";

constexpr Option kSelectorOptions[] = {
    {"on", T::kValue, "any",
     "edges of the faces that look this way and lie farthest that way: \"top\", \"bottom\", "
     "\"left\",\n          \"right\", \"front\", \"back\", or a vector",
     true},
    {"along", T::kValue, "any", "their direction, either way: \"x\", \"y\", \"z\" or a vector",
     false},
    {"near", T::kVector3, "any", "the one that is nearest to a point", false},
    {"normal", T::kVector3, "any", "edges of faces that look this way, as faces() has it", false},
    {"through", T::kVector3, "any", "edges of faces in a plane through this point", false},
    {"turn", T::kNumber, kLeastTurn, "the least angle between their two faces' normals, in degrees",
     false, Range::kNotNegative},
};
constexpr FunctionSpec kEdges{
    "edges",
    "Its straight edges between flat faces, each {from, to, length, turn, convex, normals}. Those "
    "between facets of one round surface, or of fillets, are left out.",
    kSelectorOptions, false, "#part:edges{along = \"z\"}"};

constexpr const char* kEdgesDoc =
    "which edges: all that are convex; \"x\", \"y\", \"z\" (their direction); \"top\", \"bottom\", "
    "... "
    "(the face\n          they are on); {on = ..., along = ..., near = ..., normal = ..., through "
    "= ..., turn = ...} as\n          edges() takes them; a list of these; what edges() gave, or a "
    "function of such a table that\n          tells";

constexpr Option kChamferOptions[] = {
    {"distance", T::kNumber, "", "from the edge, on both faces, in mm", true, Range::kPositive},
    {"edges", T::kValue, "all", kEdgesDoc, true},
};
constexpr FunctionSpec kChamfer{
    "chamfer",
    "The solid with edges cut off flat. Where all three edges of a corner are cut, so is it.",
    kChamferOptions,
    false,
    "cube(10):chamfer(1.5, {edges = \"top\"})",
    "solid",
    "the solid; as a method, solid:f(...), it is left out"};

constexpr Option kFilletOptions[] = {
    {"r", T::kNumber, "", "radius, in mm", true, Range::kPositive, "radius"},
    {"edges", T::kValue, "all", kEdgesDoc, true},
};
constexpr FunctionSpec kFillet{
    "fillet",
    "The solid with edges rounded off. Where all three edges of a corner are rounded, so is it, by "
    "a ball.",
    kFilletOptions,
    true,
    "cube(10):fillet(2, {edges = \"z\", fn = 32})",
    "solid",
    "the solid; as a method, solid:f(...), it is left out"};

struct Named {
  const char* name;
  glm::dvec3 direction;
};
constexpr Named kAxes[] = {{"x", {1, 0, 0}}, {"y", {0, 1, 0}}, {"z", {0, 0, 1}}};
constexpr Named kFaceNames[] = {{"top", {0, 0, 1}},   {"bottom", {0, 0, -1}}, {"left", {-1, 0, 0}},
                                {"right", {1, 0, 0}}, {"front", {0, -1, 0}},  {"back", {0, 1, 0}}};

std::optional<glm::dvec3> named(std::span<const Named> names, std::string text) {
  if (text.size() == 2 && text[0] == '|') text.erase(0, 1);
  for (char& c : text) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  for (const Named& n : names) {
    if (text == n.name) return n.direction;
  }
  return std::nullopt;
}

/// What a name of CadQuery's for a face is here (">Z": the top), for the end of a message; empty
/// for others.
std::string face_hint(const std::string& text) {
  if (text.size() != 2 || (text[0] != '>' && text[0] != '<')) return {};
  const auto axis = named(kAxes, text.substr(1));
  if (!axis) return {};
  const glm::dvec3 direction = text[0] == '>' ? *axis : -*axis;
  const auto* face = std::find_if(std::begin(kFaceNames), std::end(kFaceNames),
                                  [&](const Named& n) { return n.direction == direction; });
  return fmt::format("; it is \"{}\" here", face->name);
}

bool is_parallel(const glm::dvec3& a, const glm::dvec3& unit) {
  static const double least = cos_deg(kDirectionDegrees);
  return glm::dot(glm::normalize(a), unit) >= least;
}

double distance_to(const SolidEdge& e, const glm::dvec3& p) {
  const glm::dvec3 along = e.to - e.from;
  const double part = glm::dot(p - e.from, along) / glm::dot(along, along);
  return glm::length(p - e.from - std::clamp(part, 0.0, 1.0) * along);
}

/// Which edges of a solid are meant, as options of one function.
class EdgeChoice {
 public:
  EdgeChoice(lua_State* L, const FunctionSpec& spec, const Solid& solid, double grid_mm)
      : L_(L), spec_(spec), edges_(edges_of_solid(solid, grid_mm)), is_chosen_(edges_.size(), 0) {
    for (const glm::dvec3& p : solid.positions) {
      scale_ = std::max({scale_, std::fabs(p.x), std::fabs(p.y), std::fabs(p.z)});
    }
  }

  [[nodiscard]] const std::vector<SolidEdge>& edges() const { return edges_; }

  void add_named(const std::string& text) {
    Filter filter;
    if (text != "all") {
      filter.along = named(kAxes, text);
      filter.on = named(kFaceNames, text);
      if (!filter.along && !filter.on) {
        fail_in(spec_,
                "option 'edges' must be \"all\", \"x\", \"y\", \"z\", \"top\", \"bottom\", "
                "\"left\", \"right\", \"front\" or \"back\", got \"" +
                    text + "\"" + face_hint(text));
      }
    }
    choose(filter, false);
  }

  /// What the options of edges() say.
  void add(const Arguments& arguments, bool with_concave) {
    Filter filter;
    filter.on = direction(arguments, "on", kFaceNames,
                          "\"top\", \"bottom\", \"left\", \"right\", \"front\", \"back\" or a list "
                          "of three numbers");
    filter.along =
        direction(arguments, "along", kAxes, "\"x\", \"y\", \"z\" or a list of three numbers");
    if (const auto v = arguments.vector("near")) filter.near = v->v;
    if (const auto v = arguments.vector("normal")) filter.normal = unit(v->v, "normal");
    if (const auto v = arguments.vector("through")) filter.through = v->v;
    filter.turn = arguments.number("turn", filter.turn);
    choose(filter, with_concave);
  }

  /// What is at a stack index: any form of option 'edges', `depth` lists deep.
  void add_value(int index, int depth = 0) {
    luaL_checkstack(L_, 16, "lists of edges are nested too deep");
    index = lua_absindex(L_, index);
    if (lua_type(L_, index) == LUA_TSTRING) {
      add_named(lua_tostring(L_, index));
    } else if (lua_isfunction(L_, index)) {
      add_told(index);
    } else if (!lua_istable(L_, index)) {
      fail_in(spec_, "option 'edges' must be a name, a table, a list or a function, got " +
                         describe_value(L_, index));
    } else if (is_edge(index)) {
      add_edge(index);
    } else if (lua_rawlen(L_, index) > 0) {
      if (depth == kDeepestEdges) fail_in(spec_, "the lists in option 'edges' are nested too deep");
      const auto length = static_cast<lua_Integer>(lua_rawlen(L_, index));
      for (lua_Integer i = 1; i <= length; ++i) {
        lua_rawgeti(L_, index, i);
        add_value(-1, depth + 1);
        lua_pop(L_, 1);
      }
    } else if (is_empty(index)) {
      return;  // a list that somebody made, and found nothing for
    } else {
      const int top = lua_gettop(L_);
      lua_pushvalue(L_, index);
      add(Arguments(L_, selector_spec(), top + 1), false);
      lua_settop(L_, top);
    }
  }

  /// The chosen ones. Fails when there are none.
  std::vector<uint32_t> chosen() {
    std::vector<uint32_t> result;
    for (uint32_t i = 0; i < edges_.size(); ++i) {
      if (is_chosen_[i] != 0) result.push_back(i);
    }
    if (result.empty()) {
      fail_in(spec_, left_out_ == 0
                         ? std::string("no edge of it is meant")
                         : fmt::format("no convex edge of it is meant, but {} concave", left_out_));
    }
    return result;
  }
  [[nodiscard]] bool is_chosen(size_t i) const { return is_chosen_[i] != 0; }

 private:
  struct Filter {
    std::optional<glm::dvec3> on, along, near, normal, through;
    double turn = 10;
  };

  /// Messages of a table in option 'edges' name the function that it is an option of.
  FunctionSpec selector_spec() const {
    FunctionSpec spec = kEdges;
    spec.name = spec_.name;
    return spec;
  }

  glm::dvec3 unit(const glm::dvec3& v, const char* option) const {
    if (v == glm::dvec3(0)) fail_in(spec_, fmt::format("option '{}' must not be 0", option));
    return glm::normalize(v);
  }

  std::optional<glm::dvec3> direction(const Arguments& arguments, const char* option,
                                      std::span<const Named> names, const char* wanted) const {
    const int index = arguments.stack_index(option);
    if (index == 0) return std::nullopt;
    std::optional<glm::dvec3> found;
    if (lua_type(L_, index) == LUA_TSTRING) {
      found = named(names, lua_tostring(L_, index));
    } else if (const auto v = three_numbers(index)) {
      found = unit(*v, option);
    }
    if (!found) {
      std::string given = describe_value(L_, index);
      if (lua_type(L_, index) == LUA_TSTRING) {
        const std::string text = lua_tostring(L_, index);
        const bool is_of_faces = names.data() == kFaceNames;
        given = fmt::format("\"{}\"{}", text, is_of_faces ? face_hint(text) : "");
      }
      fail_in(spec_, fmt::format("option '{}' must be {}, got {}", option, wanted, given));
    }
    return found;
  }

  void choose(const Filter& filter, bool with_concave) {
    std::vector<uint32_t> found;
    double farthest = -HUGE_VAL;
    if (filter.on) {
      for (const SolidEdge& e : edges_) {
        for (const glm::dvec3& n : e.normals) {
          if (is_parallel(n, *filter.on)) farthest = std::max(farthest, glm::dot(n, e.from));
        }
      }
    }
    for (uint32_t i = 0; i < edges_.size(); ++i) {
      const SolidEdge& e = edges_[i];
      if (e.is_smooth || e.turn < filter.turn) continue;
      const glm::dvec3 along = e.to - e.from;
      if (filter.along && !is_parallel(along, *filter.along) && !is_parallel(-along, *filter.along))
        continue;
      const auto is_on = [&](const glm::dvec3& n) {
        const double height = glm::dot(n, e.from);
        if (filter.on && (!is_parallel(n, *filter.on) || height < farthest - kNearPlane))
          return false;
        if (filter.normal && !is_parallel(n, *filter.normal)) return false;
        return !filter.through || std::fabs(glm::dot(n, *filter.through) - height) <= kNearPlane;
      };
      if (is_on(e.normals[0]) || is_on(e.normals[1])) found.push_back(i);
    }
    if (filter.near) {
      double least = HUGE_VAL;
      for (const uint32_t i : found) least = std::min(least, distance_to(edges_[i], *filter.near));
      // Those that are equally near, at a corner: all of them.
      std::erase_if(found, [&](uint32_t i) {
        return distance_to(edges_[i], *filter.near) > least + 1e-12 * scale_;
      });
    }
    for (const uint32_t i : found) {
      if (edges_[i].is_convex || with_concave || filter.near) {
        is_chosen_[i] = 1;
      } else {
        ++left_out_;
      }
    }
  }

  bool is_empty(int table) const {
    lua_pushnil(L_);
    if (lua_next(L_, table) == 0) return true;
    lua_pop(L_, 2);
    return false;
  }

  bool is_edge(int table) const {
    const int top = lua_gettop(L_);
    const bool has_ends = lua_getfield(L_, table, "from") == LUA_TTABLE &&
                          lua_getfield(L_, table, "to") == LUA_TTABLE;
    lua_settop(L_, top);
    return has_ends;
  }

  /// The list of three finite numbers at a stack index, if it is one.
  [[nodiscard]] std::optional<glm::dvec3> three_numbers(int index) const {
    index = lua_absindex(L_, index);
    if (!lua_istable(L_, index) || list_length(L_, index) != 3) return std::nullopt;
    glm::dvec3 v(0);
    bool is_good = true;
    for (int i = 0; i < 3; ++i) {
      is_good &= lua_rawgeti(L_, index, i + 1) == LUA_TNUMBER;
      v[i] = lua_tonumber(L_, -1);
      is_good &= std::isfinite(v[i]);
      lua_pop(L_, 1);
    }
    return is_good ? std::optional(v) : std::nullopt;
  }

  glm::dvec3 point_in(int table, const char* name) const {
    lua_getfield(L_, table, name);
    const auto p = three_numbers(-1);
    lua_pop(L_, 1);
    if (!p) {
      fail_in(spec_, fmt::format("'{}' of an edge must be a list of three finite numbers", name));
    }
    return *p;
  }

  /// The normals that an edge's table has, if it has them: where solids touch, several edges have
  /// the same ends, and only these tell which one is meant.
  [[nodiscard]] std::optional<std::array<glm::dvec3, 2>> normals_in(int table) const {
    const int top = lua_gettop(L_);
    if (lua_getfield(L_, table, "normals") == LUA_TNIL) {
      lua_settop(L_, top);
      return std::nullopt;
    }
    std::array<glm::dvec3, 2> result;
    for (int k = 0; k < 2; ++k) {
      std::optional<glm::dvec3> n;
      if (lua_istable(L_, top + 1)) {
        lua_rawgeti(L_, top + 1, k + 1);
        n = three_numbers(-1);
        lua_pop(L_, 1);
      }
      if (!n || *n == glm::dvec3(0)) {
        fail_in(spec_, "'normals' of an edge must be two lists of three numbers");
      }
      result[static_cast<size_t>(k)] = glm::normalize(*n);
    }
    lua_settop(L_, top);
    return result;
  }

  void add_edge(int table) {
    const glm::dvec3 from = point_in(table, "from"), to = point_in(table, "to");
    const auto normals = normals_in(table);
    bool is_there = false, has_ends = false;
    for (size_t i = 0; i < edges_.size(); ++i) {
      const SolidEdge& e = edges_[i];
      const double apart = std::min(glm::length(e.from - from) + glm::length(e.to - to),
                                    glm::length(e.from - to) + glm::length(e.to - from));
      if (!(apart <= kNearPlane)) continue;
      has_ends = true;
      const auto looks = [&](size_t a, size_t b) {
        return is_parallel((*normals)[a], e.normals[0]) && is_parallel((*normals)[b], e.normals[1]);
      };
      if (normals && !looks(0, 1) && !looks(1, 0)) continue;
      is_chosen_[i] = 1;
      is_there = true;
    }
    if (!is_there) {
      fail_in(spec_, fmt::format("it has no edge from {{{:.6g}, {:.6g}, {:.6g}}} to {{{:.6g}, "
                                 "{:.6g}, {:.6g}}}{}",
                                 from.x, from.y, from.z, to.x, to.y, to.z,
                                 has_ends ? " with these normals" : ""));
    }
  }

  void add_told(int function);

  lua_State* L_;
  const FunctionSpec& spec_;
  std::vector<SolidEdge> edges_;
  std::vector<uint8_t> is_chosen_;
  double scale_ = 0;
  size_t left_out_ = 0;  ///< concave ones that a choice would have had
};

void push_edge(lua_State* L, const SolidEdge& e) {
  lua_createtable(L, 0, 6);
  push_point(L, e.from);
  lua_setfield(L, -2, "from");
  push_point(L, e.to);
  lua_setfield(L, -2, "to");
  lua_pushnumber(L, glm::length(e.to - e.from));
  lua_setfield(L, -2, "length");
  lua_pushnumber(L, e.turn);
  lua_setfield(L, -2, "turn");
  lua_pushboolean(L, e.is_convex ? 1 : 0);
  lua_setfield(L, -2, "convex");
  lua_createtable(L, 2, 0);
  for (int k = 0; k < 2; ++k) {
    push_point(L, e.normals[static_cast<size_t>(k)]);
    lua_rawseti(L, -2, k + 1);
  }
  lua_setfield(L, -2, "normals");
}

void EdgeChoice::add_told(int function) {
  for (size_t i = 0; i < edges_.size(); ++i) {
    if (edges_[i].is_smooth) continue;
    lua_pushvalue(L_, function);
    push_edge(L_, edges_[i]);
    lua_call(L_, 1, 1);
    const bool is_meant = lua_toboolean(L_, -1) != 0;
    lua_pop(L_, 1);
    if (!is_meant) continue;
    if (edges_[i].is_convex) {
      is_chosen_[i] = 1;
    } else {
      ++left_out_;
    }
  }
}

int edges(lua_State* L) {
  SolidValue& value = solid_argument(L, kEdges);
  const Arguments arguments(L, kEdges, 2);
  const Solid& solid = session_of(L).evaluated(value);
  EdgeChoice choice(L, kEdges, solid, value.grid_mm);
  choice.add(arguments, true);
  lua_newtable(L);
  lua_Integer count = 0;
  for (size_t i = 0; i < choice.edges().size(); ++i) {
    if (!choice.is_chosen(i)) continue;
    push_edge(L, choice.edges()[i]);
    lua_rawseti(L, -2, ++count);
  }
  return 1;
}

std::vector<uint32_t> chosen_edges(lua_State* L, const FunctionSpec& spec, const Solid& solid,
                                   double grid_mm, const Arguments& arguments) {
  EdgeChoice choice(L, spec, solid, grid_mm);
  const int index = arguments.stack_index("edges");
  if (index == 0) {
    choice.add_named("all");
  } else {
    choice.add_value(index);
  }
  return choice.chosen();
}

template <const FunctionSpec& Spec, bool kRound>
int cut(lua_State* L) {
  SolidValue& value = solid_argument(L, Spec);
  const Arguments arguments(L, Spec, 2);
  const char* size = kRound ? "r" : "distance";
  if (!arguments.has(size)) fail_in(Spec, kRound ? "needs a radius" : "needs a distance");
  Session& session = session_of(L);
  session.evaluated(value);
  // Held: a function that chooses edges may measure the same value with other settings.
  const SolidPtr held = value.evaluated;
  const double grid_mm = value.grid_mm;
  const Solid& solid = *held;
  if (solid.empty()) fail_in(Spec, "there is nothing in it");
  const std::vector<uint32_t> chosen = chosen_edges(L, Spec, solid, grid_mm, arguments);
  const double mm = arguments.number(size, 0);
  const EdgeCut cut{value.node, solid, chosen, grid_mm, session.source_ref(L)};
  push_solid(L, value_or_fail(Spec, kRound ? fillet_edges(cut, mm, arguments.facets())
                                           : chamfer_edges(cut, mm)));
  keep_marks(L, 1);
  return 1;
}

constexpr Binding kEdgesBindings[] = {
    {&kChamfer, guarded<cut<kChamfer, false>>, guarded<cut<kChamfer, false>>, nullptr},
    {&kFillet, guarded<cut<kFillet, true>>, guarded<cut<kFillet, true>>, nullptr},
    {&kEdges, nullptr, guarded<edges>, nullptr},
};

}  // namespace

std::span<const Binding> edge_bindings() { return kEdgesBindings; }

}  // namespace csgrun
