// Scripts: the sandbox, the arguments of all functions, what they build, and its evaluation.
#include "lua_bindings/script.h"

#include <string>
#include <vector>

#include "tests/fuzz/evaluate_small.h"
#include "tests/fuzz/script_session.h"

namespace {

/// Functions of Lua's own that may run for hours in a single call, where no hook interrupts them:
/// csgrun ends the process then, which is no finding. So they get small arguments only. In one
/// line, for the lines of messages.
constexpr const char* kPrelude =
    "do local function small(t, name, check) local f = t[name] "
    "t[name] = function(...) assert(check(...), 'too much for fuzzing') return f(...) end end "
    "local function text(s, p) return #tostring(s) <= 40 and #tostring(p) <= 12 end "
    "for _, name in ipairs{'find', 'match', 'gmatch', 'gsub'} do small(string, name, text) end "
    "small(string, 'rep', function(s, n) return (tonumber(n) or 0) <= 1000 end) "
    "local function range(i, j) return (tonumber(j) or 0) - (tonumber(i) or 0) <= 1000 end "
    "local function list(t) return #t <= 1000 end "
    "small(table, 'move', function(_, i, j) return range(i, j) end) "
    "small(table, 'concat', function(_, _, i, j) return range(i, j) end) "
    "small(table, 'unpack', function(_, i, j) return range(i, j) end) "
    "for _, name in ipairs{'insert', 'remove', 'sort'} do small(table, name, list) end end ";

/// Corners of the leaves of a tree, shared ones once.
size_t count_corners(const csgrun::NodePtr& root) {
  std::vector<const csgrun::Node*> open{root.get()}, seen;
  size_t corners = 0;
  while (!open.empty() && seen.size() < 200) {
    const csgrun::Node* node = open.back();
    open.pop_back();
    if (std::find(seen.begin(), seen.end(), node) != seen.end()) continue;
    seen.push_back(node);
    if (node->mesh() != nullptr) corners += node->mesh()->corners.size();
    for (const csgrun::NodePtr& child : node->children()) open.push_back(child.get());
  }
  return corners;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace csgrun;
  Session session(fuzz::small_session());
  const std::string text = kPrelude + std::string(fuzz::text_of(data, size));
  const ScriptOutcome outcome = run_script(session, "model.lua", text);
  fuzz::expect(outcome.status == ScriptStatus::kGood || !outcome.message.empty(),
               "a failure without a message");
  if (outcome.status != ScriptStatus::kGood) return 0;
  fuzz::expect(!session.parts().empty(), "a script without parts is good");
  std::vector<NodePtr> parts;
  size_t corners = 0;
  for (const ScriptPart& part : session.parts()) {
    if (part.solid == nullptr) continue;
    parts.push_back(part.solid);
    corners += count_corners(part.solid);
  }
  if (!parts.empty() && corners < 5000) fuzz::evaluate_small(parts);
  return 0;
}
