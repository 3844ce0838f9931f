#include "lua_bindings/call_site.h"

#include <cstring>
#include <string_view>

#include "lua_bindings/budget.h"
#include "lua_bindings/openscad_hints.h"
#include "lua_bindings/session.h"
#include "lua_bindings/shipped_calls.h"
#include "lua_bindings/shipped_modules.h"
#include "lua_bindings/text.h"

namespace csgrun {
namespace {

/// How many frames of a deep stack are shown at its top and at its bottom.
constexpr int kTopFrames = 12;
constexpr int kBottomFrames = 10;

/// How far from the top of the stack the function is looked for that a message names.
constexpr int kMessageFrames = 50;

/// How far from the top of the stack running functions are looked for: asking for level n takes n
/// steps.
constexpr int kRunningFrames = 1000;

std::string with_whole_path_of_stack(lua_State* L, const std::string& message) {
  lua_Debug frame{};
  for (int level = 0; level < kMessageFrames && lua_getstack(L, level, &frame) != 0; ++level) {
    lua_getinfo(L, "S", &frame);
    if (frame.source[0] != '@') continue;
    std::string whole = with_whole_path(message, frame.source + 1);
    if (whole != message) return whole;
  }
  return message;
}

/// Number of frames: by bisection, as asking for level n takes n steps.
int stack_depth(lua_State* L) {
  lua_Debug frame{};
  int low = 0, high = 1;
  while (lua_getstack(L, high, &frame) != 0) {
    low = high;
    high *= 2;
  }
  while (low < high) {
    const int middle = (low + high) / 2;
    if (lua_getstack(L, middle, &frame) != 0) {
      low = middle + 1;
    } else {
      high = middle;
    }
  }
  return high;
}

std::string describe_frame(const lua_Debug& frame) {
  std::string text = "\n\t";
  if (frame.currentline > 0) {
    text += std::string(chunk_file(frame)) + ":" + std::to_string(frame.currentline) + ": ";
  } else {
    text += "[C]: ";
  }
  if (std::strcmp(frame.what, "main") == 0) {
    text += "in main chunk";
  } else if (frame.name != nullptr) {
    text += std::string("in ") + (frame.namewhat[0] != '\0' ? frame.namewhat : "function") + " '" +
            frame.name + "'";
  } else if (frame.currentline > 0) {
    text += "in the function at line " + std::to_string(frame.linedefined);
  } else {
    text += "in a built-in function";
  }
  if (frame.istailcall != 0) text += "\n\t(...tail calls...)";
  return text;
}

std::string traceback(lua_State* L) {
  const int depth = stack_depth(L);
  lua_Debug frame{};
  // Level 0 is the message handler itself, the last one our own function that runs the script.
  const int last = depth - 1;
  if (last <= 1) return {};
  std::string text = "\nstack traceback:";
  for (int level = 1; level < last; ++level) {
    if (last > kTopFrames + kBottomFrames + 1 && level == kTopFrames + 1) {
      text += "\n\t... (" + std::to_string(last - kTopFrames - kBottomFrames - 1) + " levels)";
      level = last - kBottomFrames;
    }
    lua_getstack(L, level, &frame);
    lua_getinfo(L, "Slntf", &frame);
    const bool is_unseen = is_shipped_call(L, -1);
    lua_pop(L, 1);
    if (!is_unseen) text += describe_frame(frame);
  }
  return text;
}

}  // namespace

bool innermost_lua_frame(lua_State* L, lua_Debug& frame) {
  lua_Debug innermost{};
  for (int level = 0; lua_getstack(L, level, &frame) != 0; ++level) {
    lua_getinfo(L, "Sl", &frame);
    if (frame.currentline <= 0) continue;
    if (!is_shipped(frame)) return true;
    if (innermost.currentline <= 0) innermost = frame;
  }
  frame = innermost;
  return frame.currentline > 0;
}

const char* chunk_file(const lua_Debug& frame) {
  return frame.source[0] == '@' ? frame.source + 1 : frame.short_src;
}

std::string calling_file(lua_State* L) {
  lua_Debug frame{};
  for (int level = 0; lua_getstack(L, level, &frame) != 0; ++level) {
    lua_getinfo(L, "Sl", &frame);
    if (frame.currentline > 0 && frame.source[0] == '@') return frame.source + 1;
  }
  return session_of(L).options().model;
}

std::string place_of_call(lua_State* L) {
  lua_Debug frame{};
  if (!innermost_lua_frame(L, frame)) return {};
  return std::string(chunk_file(frame)) + ":" + std::to_string(frame.currentline);
}

std::string with_whole_path(const std::string& message, const std::string& path) {
  constexpr size_t kShown = LUA_IDSIZE - 1;
  if (path.size() <= kShown) return message;
  const std::string cut = "..." + path.substr(path.size() - (kShown - 3));
  return message.rfind(cut + ":", 0) == 0 ? path + message.substr(cut.size()) : message;
}

namespace {

/// How long "FILE:line: " at the begin of a message is; 0 when it begins otherwise.
size_t length_of_place(std::string_view message) {
  message = message.substr(0, message.find('\n'));
  for (size_t colon = message.find(':'); colon != std::string_view::npos;
       colon = message.find(':', colon + 1)) {
    size_t end = colon + 1;
    while (end < message.size() && message[end] >= '0' && message[end] <= '9') ++end;
    if (end == colon + 1 || !message.substr(end).starts_with(": ")) continue;
    const std::string_view file = message.substr(0, colon);
    const bool is_file = file.ends_with(".lua") || file.ends_with("stdin") ||
                         file.ends_with(".csg") || file.starts_with(kShippedPlace) ||
                         file.starts_with("[string ");
    return is_file ? end + 2 : 0;
  }
  return 0;
}

/// A message begins with its place once: error(text, 0) gives none, and what is raised in
/// coroutine.wrap has that of the resume before its own. What Lua itself says in the program's own
/// library gets the place of the call in the model; the traceback has the other.
std::string with_place(lua_State* L, std::string message) {
  const size_t first = length_of_place(message);
  if (first == 0) {
    // What load() was given has a name of any kind.
    const std::string place = place_of_call(L);
    return place.empty() || message.starts_with(place + ": ") ? message : place + ": " + message;
  }
  const std::string rest = message.substr(first);
  if (message.starts_with(kShippedPlace)) {
    const std::string place = place_of_call(L);
    return place.empty() ? message : place + ": " + rest;
  }
  const size_t second = length_of_place(rest);
  const bool is_script = second != 0 && rest.substr(0, second).find(".csg:") == std::string::npos;
  return is_script ? rest : message;
}

}  // namespace

std::vector<StackLine> stack_lines(lua_State* L, const std::string& path) {
  std::vector<StackLine> lines;
  lua_Debug frame{};
  for (int level = 0; level < kRunningFrames && lua_getstack(L, level, &frame) != 0; ++level) {
    lua_getinfo(L, "Sl", &frame);
    if (frame.currentline > 0 && frame.source[0] == '@' && path == frame.source + 1)
      lines.push_back({frame.currentline, frame.linedefined});
  }
  return lines;
}

int add_traceback(lua_State* L) {
  std::string message;
  if (lua_type(L, 1) == LUA_TSTRING || lua_type(L, 1) == LUA_TNUMBER) {
    message = with_place(L, with_whole_path_of_stack(L, lua_tostring(L, 1)));
    message += run_time_hint(message);
  } else if (!session_of(L).budget().out_of_time() &&
             luaL_getmetafield(L, 1, "__tostring") != LUA_TNIL) {
    lua_pop(L, 1);
    message = place_of_call(L) + ": " + display_text(L, 1);
  } else {
    message = place_of_call(L) + ": error value of type " + luaL_typename(L, 1);
  }
  message += traceback(L);
  lua_pushlstring(L, message.data(), message.size());
  return 1;
}

}  // namespace csgrun
