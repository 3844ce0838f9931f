// Errors of the public interface: a value or an Error. The only exception that crosses the engine's
// edge is std::bad_alloc.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <variant>

namespace csgrun {

/// Where in a script a node was made. `line` is 1-based; 0 means unknown.
struct SourceRef {
  std::shared_ptr<const std::string> file;
  int line = 0;

  /// "file:line" or an empty string when unknown.
  [[nodiscard]] std::string text() const {
    return file && line > 0 ? *file + ":" + std::to_string(line) : std::string();
  }
};

/// What kind of failure; the ranges are: 1xx input, 2xx geometry, 3xx limits, 4xx files, 9xx ours.
enum class ErrorCode {
  kInvalidArgument = 100,  ///< a number out of range, NaN, infinite, an empty list ...
  kMalformedFile = 101,    ///< a file is truncated or not what its name says
  kInvalidMesh = 110,      ///< open, inconsistently oriented, index out of range ...
  kOutOfRange = 202,       ///< the scene does not fit the grid
  kLimit = 300,            ///< memory or time budget used up
  kCancelled = 301,
  kCannotRead = 400,
  kCannotWrite = 401,
  kInternal = 900,  ///< an invariant of ours is broken
};

struct Error {
  ErrorCode code = ErrorCode::kInternal;
  std::string message;  ///< one sentence: what was wrong, where (coordinates), what was expected
  SourceRef where;      ///< the node it belongs to, when known
};

/// A value or an Error. Use like std::expected: `if (!r) return r.error(); use(*r);`
template <class T>
class [[nodiscard]] Result {
 public:
  Result(T value)
      : state_(std::in_place_index<0>, std::move(value)) {}  // NOLINT: implicit by design
  Result(Error error) : state_(std::in_place_index<1>, std::move(error)) {}  // NOLINT

  [[nodiscard]] bool has_value() const { return state_.index() == 0; }
  explicit operator bool() const { return has_value(); }
  T& operator*() & { return std::get<0>(state_); }
  const T& operator*() const& { return std::get<0>(state_); }
  T&& operator*() && { return std::get<0>(std::move(state_)); }
  T* operator->() { return &std::get<0>(state_); }
  const T* operator->() const { return &std::get<0>(state_); }
  [[nodiscard]] const Error& error() const { return std::get<1>(state_); }

 private:
  std::variant<T, Error> state_;
};

/// Success or an Error, for functions that return nothing.
using Status = Result<std::monostate>;

}  // namespace csgrun
