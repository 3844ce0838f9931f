// The one way in which C++ failures become Lua errors.
//
// A bound function throws ScriptError (or lets the engine's std::bad_alloc pass); guarded<> turns
// it into a message with its place and raises it when nothing is left to destroy. Lua's own errors
// are exceptions of another type (the library is Lua built as C++) and pass through untouched.
#pragma once

#include <exception>
#include <new>
#include <string>
#include <utility>

#include <lua.hpp>

namespace csgrun {

/// Something that the script did wrong; the message has no place yet.
class ScriptError : public std::exception {
 public:
  explicit ScriptError(std::string message) : message_(std::move(message)) {}
  [[nodiscard]] const char* what() const noexcept override { return message_.c_str(); }

 private:
  std::string message_;
};

/// The same, with its place in front already.
class PlacedScriptError : public ScriptError {
 public:
  using ScriptError::ScriptError;
};

/// Pushes "FILE:line: message" for the innermost Lua function of the call stack.
void push_error(lua_State* L, const char* message);

/// Notes the place and pushes the error for memory that C++ code could not get.
void push_memory_error(lua_State* L);

/// Raises the error value on the top of the stack. The only caller of lua_error.
int raise_pushed_error(lua_State* L);

/// Wraps a bound function: what it throws becomes a Lua error.
template <int (*Function)(lua_State*)>
int guarded(lua_State* L) {
  try {
    return Function(L);
  } catch (const PlacedScriptError& error) {
    lua_pushstring(L, error.what());
  } catch (const std::bad_alloc&) {
    push_memory_error(L);
  } catch (const std::exception& error) {
    push_error(L, error.what());
  }
  return raise_pushed_error(L);
}

}  // namespace csgrun
