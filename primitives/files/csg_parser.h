// The grammar of .csg files: calls with named arguments, blocks, modifiers. No meaning yet.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <csgrun/engine/error.h>

namespace csgrun {

struct CsgValue {
  enum class Kind { kUndef, kNumber, kBool, kString, kList };
  Kind kind = Kind::kUndef;
  double number = 0;  ///< may be infinite or NaN
  bool boolean = false;
  std::string string;
  std::vector<CsgValue> list;
};

struct CsgCall {
  std::string name;
  std::vector<std::pair<std::string, CsgValue>> arguments;  ///< an empty name: positional
  int line = 0;
  bool background = false;  ///< marked with % or *: no part of the model
  bool root = false;        ///< marked with !: all of the model

  /// The argument of that name; null when there is none or it is undef.
  [[nodiscard]] const CsgValue* find(std::string_view key) const;
};

/// What to say of a node that sources have and trees have not; empty for others.
std::string_view source_hint(std::string_view node);

/// Reads a file piece by piece. Blocks are not matched here: the caller keeps the stack, so nesting
/// costs no stack of the machine.
class CsgParser {
 public:
  enum class Event {
    kOpen,   ///< call() with a block that follows
    kLeaf,   ///< call() without children
    kClose,  ///< the end of a block
    kEnd     ///< the end of the file
  };

  CsgParser(std::shared_ptr<const std::string> file, std::string_view text)
      : file_(std::move(file)), text_(text) {}

  Result<Event> next();
  [[nodiscard]] CsgCall& call() { return call_; }
  [[nodiscard]] int line() const { return line_; }
  /// An error at the current line.
  [[nodiscard]] Error error(const std::string& what) const;

 private:
  [[nodiscard]] char peek() const { return at_ < text_.size() ? text_[at_] : '\0'; }
  void skip_blanks();
  bool skip_comment();
  bool accept(char c);
  Error unexpected(const std::string& wanted) const;
  std::string_view word();
  bool accept_comma(char closing);
  size_t end_of_raw_text();
  bool has_plain_string();
  Status read_arguments();
  Result<CsgValue> read_value(int depth);
  Result<CsgValue> read_string(bool raw);

  std::shared_ptr<const std::string> file_;
  std::string_view text_;
  size_t at_ = 0;
  int line_ = 1;
  size_t raw_end_ = 0;  ///< what end_of_raw_text found last: it may be far
  CsgCall call_;
};

}  // namespace csgrun
