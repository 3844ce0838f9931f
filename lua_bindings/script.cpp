#include "lua_bindings/script.h"

#include <algorithm>
#include <memory>
#include <new>
#include <vector>

#include "lua_bindings/api.h"
#include "lua_bindings/call_site.h"
#include "lua_bindings/dropped_values.h"
#include "lua_bindings/guard.h"
#include "lua_bindings/nearest.h"
#include "lua_bindings/parts.h"
#include "lua_bindings/sandbox.h"
#include "lua_bindings/shipped_calls.h"

namespace csgrun {
namespace {

struct StateCloser {
  void operator()(lua_State* L) const { lua_close(L); }
};

struct Program {
  Session* session;
  const std::string* name;
  const std::string* text;
  bool is_loaded = false;
  std::vector<StackLine> stopped_at;  ///< where its functions stood when it failed
};

/// The last line that has code, for complaints about what the whole script returned.
int last_line(lua_State* L, int function) {
  lua_Debug info{};
  lua_pushvalue(L, function);
  lua_getinfo(L, ">L", &info);
  int last = 1;
  if (lua_istable(L, -1)) {
    lua_pushnil(L);
    while (lua_next(L, -2) != 0) {
      lua_pop(L, 1);
      last = std::max(last, static_cast<int>(lua_tointeger(L, -1)));
    }
  }
  lua_pop(L, 1);
  return last;
}

/// Everything that needs protection: opening the libraries, loading, running, taking the result.
int run_program(lua_State* L) {
  Program& program = *static_cast<Program*>(lua_touserdata(L, 1));
  open_sandbox(L, *program.session);
  open_api(L);
  keep_globals_for_shipped(L);
  load_chunk(L, *program.name, *program.text);
  program.is_loaded = true;
  const int function = lua_gettop(L);
  lua_pushvalue(L, function);
  lua_call(L, 0, LUA_MULTRET);
  try {
    const int top = lua_gettop(L);
    for (int index = function + 1; index <= top; ++index) {
      if (!lua_isnil(L, index)) add_parts(L, index, "");
    }
    program.session->name_unnamed_parts();
    program.session->keep_only_parts();
    if (program.session->parts().empty()) {
      // Where JSCAD's scripts end, without a word that calls it.
      lua_pushglobaltable(L);
      lua_pushliteral(L, "main");
      const bool has_main = lua_rawget(L, -2) == LUA_TFUNCTION;
      throw ScriptError(program.session->has_absent_parts
                            ? "the script makes no part: all that it gave are skipped"
                        : has_main ? "the script makes no part: 'main' is a function like any "
                                     "other, return main()"
                                   : "the script makes no part: return a solid, or call "
                                     "emit(solid)");
    }
  } catch (const ScriptError& error) {
    throw PlacedScriptError(*program.name + ":" + std::to_string(last_line(L, function)) + ": " +
                            error.what());
  }
  return 0;
}

/// The message handler. Upvalue 1: the program.
int note_failure(lua_State* L) {
  Program& program = *static_cast<Program*>(lua_touserdata(L, lua_upvalueindex(1)));
  program.stopped_at = stack_lines(L, *program.name);
  return add_traceback(L);
}

/// What a statement gave is dropped; one in which the program stopped gave nothing.
void warn_of_dropped_values(const Program& program) {
  for (const DroppedValue& value : find_dropped_values(*program.text)) {
    const bool is_unfinished = std::any_of(
        program.stopped_at.begin(), program.stopped_at.end(), [&](const StackLine& stopped) {
          const auto line = static_cast<size_t>(stopped.line);
          return line >= value.line && line <= value.last_line &&
                 static_cast<size_t>(stopped.function_line) == value.function_line;
        });
    if (is_unfinished) continue;
    program.session->warn_at(*program.name + ":" + std::to_string(value.line), value.message);
  }
}

/// The first line that gives a variable of that name a value of its own, from 1; 0: none does.
size_t line_that_sets(const std::string& name, std::string_view text) {
  for (size_t line = 1; !text.empty(); ++line) {
    const size_t end = std::min(text.find('\n'), text.size());
    std::string_view rest = text.substr(0, end);
    const auto skip = [&](std::string_view what) {
      if (!rest.starts_with(what)) return false;
      rest.remove_prefix(what.size());
      return true;
    };
    const auto skip_blanks = [&] {
      rest.remove_prefix(std::min(rest.find_first_not_of(" \t"), rest.size()));
    };
    skip_blanks();
    if (skip("local ") || skip("local\t")) skip_blanks();
    if (skip(name)) {
      skip_blanks();
      if (rest.starts_with('=') && !rest.starts_with("==")) return line;
    }
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return 0;
}

/// Definitions that no param() asked for.
std::string unknown_definition(const Session& session, std::string_view text) {
  for (const Definition& definition : session.definitions) {
    if (definition.used) continue;
    std::vector<std::string> names;
    for (const Parameter& parameter : session.parameters) names.push_back(parameter.name);
    std::string message =
        definition.origin + " " + definition.name + ": the model has no such parameter";
    if (const size_t line = line_that_sets(definition.name, text); line != 0) {
      return message + " (line " + std::to_string(line) + " sets a variable of that name; " +
             definition.name + " = param(\"" + definition.name + "\", DEFAULT) makes it one)";
    }
    return message + did_you_mean(definition.name, names);
  }
  return {};
}

std::string first_line(const std::string& text) { return text.substr(0, text.find('\n')); }

/// Runs the program in a state of its own, which is gone afterwards.
ScriptOutcome run_in_state(Session& session, const std::string& name, const std::string& text) {
  Budget& budget = session.budget();
  const std::unique_ptr<lua_State, StateCloser> state(lua_newstate(&Budget::allocate, &budget));
  if (!state) throw std::bad_alloc();
  lua_State* L = state.get();
  attach_session(L, session);
  Program program{&session, &name, &text, false, {}};

  lua_pushlightuserdata(L, &program);
  lua_pushcclosure(L, guarded<note_failure>, 1);
  lua_pushcfunction(L, guarded<run_program>);
  lua_pushlightuserdata(L, &program);
  budget.start_script(L);
  const int status = lua_pcall(L, 1, 0, 1);
  budget.stop_script();

  if (status == LUA_ERRMEM) throw std::bad_alloc();
  std::string message = status == LUA_OK                 ? ""
                        : lua_type(L, -1) == LUA_TSTRING ? lua_tostring(L, -1)
                                                         : name + ": failed";
  if (budget.out_of_time()) {
    return {ScriptStatus::kOutOfTime,
            message.empty() ? name + ": " + budget.time_message() : message};
  }
  if (session.definition_error) return {ScriptStatus::kUsage, *session.definition_error};
  if (status != LUA_OK) {
    if (program.is_loaded) warn_of_dropped_values(program);
    const bool geometry = session.is_geometry_failure(first_line(message));
    return {geometry ? ScriptStatus::kGeometry : ScriptStatus::kFailed, message};
  }
  if (std::string problem = unknown_definition(session, text); !problem.empty()) {
    return {ScriptStatus::kUsage, std::move(problem)};
  }
  warn_of_dropped_values(program);
  return {};
}

}  // namespace

ScriptOutcome run_script(Session& session, const std::string& name, const std::string& text) {
  try {
    return run_in_state(session, name, text);
  } catch (const std::bad_alloc&) {
    // The state and what it held are gone, so there is memory again for the message.
    session.budget().stop_script();
    const std::string place = session.budget().memory_place();
    return {ScriptStatus::kFailed,
            (place.empty() ? name : place) + ": " + session.budget().memory_message()};
  }
}

}  // namespace csgrun
