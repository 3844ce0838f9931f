// What one run of a script has beside the Lua state: settings, parameters, parts, warnings, files,
// and the evaluator that measures.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include <lua.hpp>

#include <csgrun/engine/csg_tree.h>
#include <csgrun/engine/evaluate.h>
#include <csgrun/engine/repair.h>
#include <csgrun/primitives/shape2d.h>
#include <csgrun/primitives/solids.h>
#include <csgrun/primitives/text.h>

#include "lua_bindings/budget.h"
#include "lua_bindings/files.h"
#include "lua_bindings/model_parts.h"
#include "lua_bindings/parameters.h"
#include "lua_bindings/values.h"

namespace csgrun {

/// Something that a script gave as its result: a solid, or a 2D shape.
struct ScriptPart {
  std::string name;  ///< unique; groups are separated by '/'
  NodePtr solid;     ///< null for a shape
  Shape2D shape;
  SourceRef where;    ///< where it was emitted or made
  bool only = false;  ///< of a shape: it alone is to be in the result
  std::optional<Appearance> appearance = std::nullopt;  ///< of a shape
};

struct SessionOptions {
  std::string model;         ///< as the user gave it: for messages and relative paths
  std::string model_folder;  ///< where the model's own files are
  std::vector<std::string> library_folders;  ///< -L and CSGRUN_PATH, in order
  std::vector<Definition> definitions;       ///< of several for one name the last counts
  Facets facets;
  EvaluateOptions evaluate;
  BudgetLimits limits;
  FontOptions fonts;
  std::function<void()> before_evaluation;  ///< called once, before the first; may be empty
};

class Session {
 public:
  explicit Session(SessionOptions options);

  [[nodiscard]] const SessionOptions& options() const { return options_; }
  [[nodiscard]] Budget& budget() { return budget_; }
  [[nodiscard]] Files& files() { return files_; }
  [[nodiscard]] const Files& files() const { return files_; }
  [[nodiscard]] FontBook& fonts() { return fonts_; }

  /// csg.fn, csg.fa, csg.fs; csg.grid.
  Facets facets;
  [[nodiscard]] const GridStep& grid() const { return options_.evaluate.grid; }
  /// Another grid means another evaluator (drop_evaluator).
  void set_grid(const GridStep& grid);
  /// csg.contacts: whether solids that touch along an edge are joined there. As with the grid.
  [[nodiscard]] bool joins_contacts() const { return options_.evaluate.join_contacts; }
  void set_joins_contacts(bool join);

  /// Lives as long as the grid and csg.contacts stay the same and memory suffices.
  Evaluator& evaluator();
  /// Drops the evaluator and all that it has cached, but not what it noted and counted. What it has
  /// is of no use with other settings, and half made where memory ran out in the midst of its work.
  void drop_evaluator();
  /// Notes of all evaluations so far, each once, and their figures.
  [[nodiscard]] std::vector<std::string> evaluation_warnings() const;
  [[nodiscard]] EvaluateStats evaluation_stats() const;
  /// The solid of a tree, on the script's clock. Throws ScriptError, with the place of the node.
  SolidPtr evaluate(const NodePtr& node, Measuring measuring = Measuring::kNothing);
  /// The same, kept with the value for as long as the grid and csg.contacts stay the same: who
  /// calls Lua meanwhile holds `value.evaluated`.
  const Solid& evaluated(SolidValue& value, Measuring measuring = Measuring::kNothing);
  /// Volume and box of a solid, without its triangles if these were not made yet. Fails as
  /// evaluated does.
  Extent extent(const SolidValue& value);
  /// The same of the area, and the centroid; nothing of what is empty.
  double area(const SolidValue& value);
  std::optional<glm::dvec3> centroid(const SolidValue& value);
  /// Whether the message is that of an evaluation that failed in a script: exit 3 rather than 1.
  [[nodiscard]] bool is_geometry_failure(const std::string& message) const;
  /// Throws ScriptError for an engine error.
  [[noreturn]] void fail_evaluation(const Error& error);

  /// Adds "FILE:line: text" once.
  void warn(lua_State* L, const std::string& text);
  /// The same of a place that is given ("model.lua:3"), or of none.
  void warn_at(const std::string& place, const std::string& text);
  [[nodiscard]] const std::vector<std::string>& warnings() const { return warnings_; }

  /// The place of the running Lua code, sharing one copy of each file name. The name is seen from
  /// the model's folder (or the library's): it goes into written files, and these must not depend
  /// on where the program was started.
  SourceRef source_ref(lua_State* L);
  /// The same for a file that is not Lua.
  SourceRef source_ref(const std::string& display, int line);
  /// "FILE:line" with FILE as messages have it; empty when the place is unknown.
  [[nodiscard]] std::string place_text(const SourceRef& where) const;

  /// Takes a part, which may have no name. Throws ScriptError for a bad or taken name.
  void add_part(ScriptPart part, const std::string& group);
  /// Gives those without a name "part1", "part2", ... in their group, but for names that others
  /// have, also later ones.
  void name_unnamed_parts();
  /// The modules that run now, by the places of their files.
  std::set<std::string> loading_modules;
  /// Nodes that alone are to be in the result, wherever in a part they occur.
  std::map<const Node*, NodePtr> only_nodes;
  /// The union of those that are in a tree, in their places there; null if there are none.
  [[nodiscard]] NodePtr only_part_of(const NodePtr& root, const SourceRef& where) const;
  /// Where parts have such nodes in them, or are such shapes: leaves these and nothing else.
  void keep_only_parts();
  bool has_absent_parts = false;  ///< skipped ones were given as parts
  [[nodiscard]] const std::vector<ScriptPart>& parts() const { return parts_; }

  /// Whether a script gave any colour a material: then colours must be changed face by face.
  bool has_materials = false;

  std::vector<Definition> definitions;
  std::vector<Parameter> parameters;            ///< that the script asked for, each name once
  std::optional<std::string> definition_error;  ///< a value that does not fit: a usage error

  /// Numbers values in the order of their making.
  uint64_t next_serial() { return ++last_serial_; }
  uint64_t random_state = 42;  ///< of rands() without a seed: the same on every run
  size_t collector_debt =
      0;  ///< bytes outside of the Lua heap that the collector was not told of yet

  /// Files by their real path and how they were asked for: read once.
  std::map<std::tuple<std::string, FillRule, std::optional<RepairOptions>>, std::vector<SolidPart>>
      imported;

 private:
  SessionOptions options_;
  Budget budget_;
  Files files_;
  FontBook fonts_;
  std::unique_ptr<Evaluator> evaluator_;
  std::vector<std::string> past_warnings_;  ///< of evaluators that were dropped
  EvaluateStats past_stats_;                ///< theirs
  uint64_t settings_ = 0;  ///< a number for the settings of the evaluator: one more for each change
  std::vector<std::string> warnings_;
  std::set<std::string> warned_;
  std::vector<ScriptPart> parts_;
  std::set<std::string> part_names_;
  std::vector<std::pair<size_t, std::string>> unnamed_;  ///< parts, with what stands before a name
  /// By name in messages: the name from the model's folder. And back.
  std::map<std::string, std::shared_ptr<const std::string>, std::less<>> file_names_;
  std::map<std::shared_ptr<const std::string>, std::string> display_names_;
  decltype(file_names_)::const_iterator last_file_ = file_names_.end();
  std::vector<std::string> geometry_failures_;
  uint64_t last_serial_ = 0;
};

/// The session of a Lua state and of all its coroutines.
Session& session_of(lua_State* L);
void attach_session(lua_State* L, Session& session);

}  // namespace csgrun
