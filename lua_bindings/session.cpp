#include "lua_bindings/session.h"

#include <algorithm>
#include <cstring>
#include <utility>

#include "lua_bindings/call_site.h"
#include "lua_bindings/guard.h"

namespace csgrun {
namespace {

constexpr size_t kLongestPartName = 200;

bool is_control(char c) { return static_cast<unsigned char>(c) < 32 || c == 127; }

/// As Lua's literals have them: a message is one line, and ends where it says.
std::string with_visible_controls(const std::string& name) {
  std::string text;
  for (const char c : name) text += is_control(c) ? "\\" + std::to_string(c) : std::string(1, c);
  return text;
}

/// Names become file names ('dir/%s.stl') and node names: nothing in them may leave the folder.
void check_part_name(const std::string& name) {
  if (name.size() > kLongestPartName) throw ScriptError("a part's name is longer than 200 bytes");
  size_t start = 0;
  while (true) {
    const size_t end = std::min(name.find('/', start), name.size());
    const std::string piece = name.substr(start, end - start);
    const bool bad =
        piece.empty() || piece == "." || piece == ".." ||
        std::any_of(piece.begin(), piece.end(), [](char c) { return is_control(c) || c == '\\'; });
    if (bad) {
      throw ScriptError(
          "'" + with_visible_controls(name) +
          "' cannot be a part's name: it must not be empty, '.' or '..', nor have such a step "
          "between slashes, nor backslashes or control characters in it");
    }
    if (end == name.size()) return;
    start = end + 1;
  }
}

}  // namespace

Session::Session(SessionOptions options)
    : facets(options.facets),
      options_(std::move(options)),
      budget_(options_.limits, options_.model),
      files_(options_.model_folder, options_.library_folders),
      fonts_(options_.fonts) {
  definitions = options_.definitions;
  options_.evaluate.cancel = &budget_.cancel();
}

void Session::set_grid(const GridStep& grid) {
  if (grid == options_.evaluate.grid) return;
  options_.evaluate.grid = grid;
  drop_evaluator();
  ++settings_;
}

void Session::set_joins_contacts(bool join) {
  if (join == joins_contacts()) return;
  options_.evaluate.join_contacts = join;
  drop_evaluator();
  ++settings_;
}

Evaluator& Session::evaluator() {
  if (const auto prepare = std::exchange(options_.before_evaluation, nullptr)) prepare();
  if (!evaluator_) evaluator_ = std::make_unique<Evaluator>(options_.evaluate);
  return *evaluator_;
}

void Session::drop_evaluator() {
  if (!evaluator_) return;
  past_stats_ = evaluation_stats();
  try {
    past_warnings_ = evaluation_warnings();
  } catch (const std::bad_alloc&) {
    // Its notes are lost with it: what it has may be half made, and must not be used again.
  }
  evaluator_.reset();
}

std::vector<std::string> Session::evaluation_warnings() const {
  std::vector<std::string> all = past_warnings_;
  if (!evaluator_) return all;
  for (std::string& line :
       evaluator_->warnings([&](const SourceRef& where) { return place_text(where); })) {
    if (std::find(past_warnings_.begin(), past_warnings_.end(), line) == past_warnings_.end()) {
      all.push_back(std::move(line));
    }
  }
  return all;
}

EvaluateStats Session::evaluation_stats() const {
  EvaluateStats all = past_stats_;
  if (evaluator_) all.add(evaluator_->stats());
  return all;
}

SolidPtr Session::evaluate(const NodePtr& node, Measuring measuring) {
  const EvaluationScope scope(budget_);
  auto solid = evaluator().evaluate(node, measuring);
  if (!solid) fail_evaluation(solid.error());
  return *solid;
}

const Solid& Session::evaluated(SolidValue& value, Measuring measuring) {
  if (!value.is_evaluated_with(settings_) || value.measuring < measuring) {
    value.evaluated = evaluate(value.node, measuring);
    value.evaluated_with = settings_;
    value.measuring = measuring;
    value.grid_mm = evaluator().stats().grid_mm;
  }
  return *value.evaluated;
}

Extent Session::extent(const SolidValue& value) {
  if (value.is_evaluated_with(settings_) && value.measuring >= Measuring::kButTheCentre) {
    const Solid& solid = *value.evaluated;
    return {solid.empty(), solid.measures.volume, solid.measures.bbox};
  }
  const EvaluationScope scope(budget_);
  auto extent = evaluator().extent(value.node);
  if (!extent) fail_evaluation(extent.error());
  return *extent;
}

double Session::area(const SolidValue& value) {
  if (value.is_evaluated_with(settings_) && value.measuring >= Measuring::kButTheCentre) {
    return value.evaluated->measures.area;
  }
  const EvaluationScope scope(budget_);
  auto area = evaluator().area(value.node);
  if (!area) fail_evaluation(area.error());
  return *area;
}

std::optional<glm::dvec3> Session::centroid(const SolidValue& value) {
  const EvaluationScope scope(budget_);
  auto centroid = evaluator().centroid(value.node);
  if (!centroid) fail_evaluation(centroid.error());
  return *centroid;
}

void Session::fail_evaluation(const Error& error) {
  if (error.code == ErrorCode::kCancelled && budget_.out_of_time())
    throw ScriptError(budget_.time_message() + " in evaluation");
  std::string message = error.message;
  if (const std::string place = place_text(error.where); !place.empty())
    message += " (made at " + place + ")";
  geometry_failures_.push_back(message);
  throw ScriptError(message);
}

bool Session::is_geometry_failure(const std::string& message) const {
  return std::any_of(
      geometry_failures_.begin(), geometry_failures_.end(),
      [&](const std::string& failure) { return message.find(failure) != std::string::npos; });
}

void Session::warn(lua_State* L, const std::string& text) { warn_at(place_of_call(L), text); }

void Session::warn_at(const std::string& place, const std::string& text) {
  const std::string line = place.empty() ? text : place + ": " + text;
  if (warned_.insert(line).second) warnings_.push_back(line);
}

SourceRef Session::source_ref(lua_State* L) {
  lua_Debug frame{};
  if (!innermost_lua_frame(L, frame)) return {};
  const char* file = chunk_file(frame);
  if (last_file_ != file_names_.end() && last_file_->first == file) {
    return {last_file_->second, frame.currentline};
  }
  return source_ref(std::string(file), frame.currentline);
}

SourceRef Session::source_ref(const std::string& display, int line) {
  const auto [entry, fresh] = file_names_.try_emplace(display);
  if (fresh) {
    entry->second = std::make_shared<const std::string>(files_.name_from_folder(display));
    display_names_.emplace(entry->second, display);
  }
  last_file_ = entry;
  return {entry->second, line};
}

std::string Session::place_text(const SourceRef& where) const {
  const auto entry = display_names_.find(where.file);
  if (entry == display_names_.end() || where.line <= 0) return where.text();
  return entry->second + ":" + std::to_string(where.line);
}

void Session::add_part(ScriptPart part, const std::string& group) {
  const std::string prefix = group.empty() ? "" : group + "/";
  if (part.name.empty()) {
    check_part_name(prefix + "part" + std::to_string(parts_.size() + 1));
    unnamed_.push_back({parts_.size(), prefix});
  } else {
    part.name = prefix + part.name;
    check_part_name(part.name);
    if (!part_names_.insert(part.name).second) {
      throw ScriptError("there are two parts named '" + part.name + "'");
    }
  }
  parts_.push_back(std::move(part));
}

void Session::name_unnamed_parts() {
  std::map<std::string, size_t> numbers;  // the last one in each group
  for (const auto& [part, prefix] : unnamed_) {
    size_t& number = numbers[prefix];
    std::string& name = parts_[part].name;
    do {
      name = prefix + "part" + std::to_string(++number);
    } while (!part_names_.insert(name).second);
  }
  unnamed_.clear();
}

namespace {

/// The subtrees of `root` whose roots are among `wanted`, under the transforms and colours above
/// them. Stops at each that it finds.
std::vector<NodePtr> find_marked(const NodePtr& root,
                                 const std::map<const Node*, NodePtr>& wanted) {
  struct Place {
    NodePtr node;
    Affine map;
    const Appearance* appearance;
  };
  std::vector<NodePtr> found;
  std::vector<Place> pending{{root, {}, nullptr}};
  // Shared subtrees are looked at once in each place: s = s + s would take for ever otherwise.
  std::set<std::tuple<const Node*, decltype(Affine::m), const Appearance*>> seen;
  while (!pending.empty()) {
    const Place place = pending.back();
    pending.pop_back();
    const Node& node = *place.node;
    if (!seen.emplace(&node, place.map.m, place.appearance).second) continue;
    if (wanted.contains(&node)) {
      NodePtr whole = Node::transformed(place.map, place.node, node.where());
      if (place.appearance != nullptr)
        whole = Node::painted(*place.appearance, std::move(whole), node.where());
      found.push_back(std::move(whole));
      continue;
    }
    Place below = place;
    if (node.kind() == NodeKind::kTransform)
      below.map = Affine::compose(place.map, node.transform());
    if (node.kind() == NodeKind::kAppearance && place.appearance == nullptr)
      below.appearance = &node.appearance();
    for (size_t i = node.children().size(); i-- > 0;) {
      below.node = node.children()[i];
      pending.push_back(below);
    }
  }
  return found;
}

}  // namespace

NodePtr Session::only_part_of(const NodePtr& root, const SourceRef& where) const {
  if (only_nodes.empty()) return nullptr;
  std::vector<NodePtr> found = find_marked(root, only_nodes);
  return found.empty() ? nullptr : Node::boolean(BooleanOp::kUnion, std::move(found), where);
}

void Session::keep_only_parts() {
  std::vector<ScriptPart> kept;
  for (const ScriptPart& part : parts_) {
    if (part.solid == nullptr) {
      if (part.only) kept.push_back(part);
      continue;
    }
    NodePtr marked = only_part_of(part.solid, part.where);
    if (!marked) continue;
    kept.push_back(part);
    kept.back().solid = std::move(marked);
  }
  if (!kept.empty()) parts_ = std::move(kept);
}

Session& session_of(lua_State* L) {
  Session* session = nullptr;
  std::memcpy(&session, lua_getextraspace(L), sizeof session);
  return *session;
}

void attach_session(lua_State* L, Session& session) {
  Session* pointer = &session;
  std::memcpy(lua_getextraspace(L), &pointer, sizeof pointer);
}

}  // namespace csgrun
