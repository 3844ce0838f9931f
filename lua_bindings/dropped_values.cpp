#include "lua_bindings/dropped_values.h"

#include <algorithm>
#include <cctype>
#include <functional>
#include <initializer_list>
#include <set>

#include "lua_bindings/openscad_hints.h"

namespace csgrun {
namespace {

struct Token {
  enum class Kind { kName, kKeyword, kValue, kMark, kEnd };
  Kind kind = Kind::kEnd;
  std::string_view text;
  size_t line = 0;

  [[nodiscard]] bool is(std::string_view mark) const { return text == mark; }
};

bool is_one_of(std::string_view word, std::initializer_list<std::string_view> words) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

bool is_keyword(std::string_view word) {
  return is_one_of(word, {"and",      "break",  "do",   "else", "elseif", "end",  "false", "for",
                          "function", "goto",   "if",   "in",   "local",  "nil",  "not",   "or",
                          "repeat",   "return", "then", "true", "until",  "while"});
}

/// What these give is all that they do.
bool only_gives(std::string_view function) {
  if (function == "render") return false;  // makes a part of what it is given
  return is_written_before(function) ||
         is_one_of(function, {"union", "difference", "intersection", "hull", "minkowski", "cube",
                              "sphere", "cylinder", "polyhedron", "square", "circle", "polygon"});
}

/// A text that Lua accepts, token by token.
class Lexer {
 public:
  explicit Lexer(std::string_view text) : text_(text) {
    if (text_.starts_with('#')) skip_line();
  }

  Token next() {
    skip_blanks();
    if (at_ == text_.size()) return {Token::Kind::kEnd, {}, line_};
    const size_t start = at_, line = line_;
    const auto token = [&](Token::Kind kind) {
      return Token{kind, text_.substr(start, at_ - start), line};
    };
    const char c = text_[at_];
    if (is_letter(c)) {
      while (at_ < text_.size() && (is_letter(text_[at_]) || is_digit(text_[at_]))) ++at_;
      return token(is_keyword(text_.substr(start, at_ - start)) ? Token::Kind::kKeyword
                                                                : Token::Kind::kName);
    }
    if (is_digit(c)) {
      // Close enough: 0x1p-3, 1e+5.
      while (at_ < text_.size() &&
             (is_letter(text_[at_]) || is_digit(text_[at_]) || text_[at_] == '.' ||
              (is_sign(text_[at_]) && is_one_of(text_.substr(at_ - 1, 1), {"e", "E", "p", "P"})))) {
        ++at_;
      }
      return token(Token::Kind::kValue);
    }
    if (c == '"' || c == '\'') {
      skip_string(c);
      return token(Token::Kind::kValue);
    }
    if (skip_long_bracket()) return token(Token::Kind::kValue);
    ++at_;
    return token(Token::Kind::kMark);
  }

 private:
  static bool is_letter(char c) {
    return std::isalpha(static_cast<unsigned char>(c)) != 0 || c == '_';
  }
  static bool is_digit(char c) { return c >= '0' && c <= '9'; }
  static bool is_sign(char c) { return c == '+' || c == '-'; }

  void skip_line() { at_ = std::min(text_.find('\n', at_), text_.size()); }

  void skip_blanks() {
    while (at_ < text_.size()) {
      if (text_.substr(at_, 2) == "--") {
        at_ += 2;
        if (!skip_long_bracket()) skip_line();
      } else if (std::isspace(static_cast<unsigned char>(text_[at_])) != 0) {
        line_ += text_[at_++] == '\n' ? 1 : 0;
      } else {
        break;
      }
    }
  }

  void skip_string(char quote) {
    for (++at_; at_ < text_.size() && text_[at_] != quote; ++at_) {
      if (text_[at_] == '\\') ++at_;
      if (at_ < text_.size() && text_[at_] == '\n') ++line_;
    }
    at_ = std::min(at_ + 1, text_.size());
  }

  /// [[ ... ]], [==[ ... ]==].
  bool skip_long_bracket() {
    if (at_ == text_.size() || text_[at_] != '[') return false;
    const size_t second = std::min(text_.find_first_not_of('=', at_ + 1), text_.size());
    if (second == text_.size() || text_[second] != '[') return false;
    const std::string close = "]" + std::string(second - at_ - 1, '=') + "]";
    const size_t end = std::min(text_.find(close, second), text_.size());
    line_ +=
        static_cast<size_t>(std::count(text_.begin() + static_cast<std::ptrdiff_t>(at_),
                                       text_.begin() + static_cast<std::ptrdiff_t>(end), '\n'));
    at_ = std::min(end + close.size(), text_.size());
    return true;
  }

  std::string_view text_;
  size_t at_ = 0, line_ = 1;
};

/// What is open at a token of a text that Lua accepts: functions, blocks and brackets.
class Nesting {
 public:
  [[nodiscard]] bool is_in_brackets() const { return !open_.empty() && open_.back().is_bracket; }
  /// Where the innermost function begins; 0 if there is none.
  [[nodiscard]] size_t function_line() const {
    return open_.empty() ? 0 : open_.back().function_line;
  }

  void pass(const Token& token) {
    if (token.is("function")) {
      open_.push_back({false, token.line});
    } else if (is_one_of(token.text, {"do", "if", "repeat"})) {
      open_.push_back({false, function_line()});
    } else if (is_one_of(token.text, {"(", "{", "["})) {
      open_.push_back({true, function_line()});
    } else if (is_one_of(token.text, {"end", "until", ")", "}", "]"}) && !open_.empty()) {
      open_.pop_back();
    }
  }

 private:
  struct Open {
    bool is_bracket;
    size_t function_line;
  };
  std::vector<Open> open_;
};

class Finder {
 public:
  explicit Finder(std::string_view text) {
    Lexer lexer(text);
    do {
      tokens_.push_back(lexer.next());
    } while (tokens_.back().kind != Token::Kind::kEnd);
  }

  std::vector<DroppedValue> find() {
    find_own_functions();
    std::vector<DroppedValue> found;
    Nesting nesting;
    for (size_t i = 0; i + 1 < tokens_.size(); nesting.pass(tokens_[i++])) {
      const bool may_begin = tokens_[i].kind == Token::Kind::kName && !nesting.is_in_brackets();
      if (!may_begin || !begins_statement(i)) continue;
      const Calls calls = calls_at(i);
      if (!only_gives(calls.last) || own_.contains(calls.last)) continue;
      found.push_back({tokens_[i].line, message(tokens_[i], std::string(calls.last)),
                       tokens_[calls.end - 1].line, nesting.function_line()});
    }
    return found;
  }

 private:
  /// A statement that is calls of methods one after another, or of one function and its methods.
  struct Calls {
    std::string_view last;  ///< the name of the last function; empty if it is something else
    size_t end = 0;         ///< the token behind the statement
  };

  static std::string message(const Token& first, const std::string& name) {
    const std::string object(first.text), dropped = "what " + name + "(...) gives is dropped: ";
    if (!only_gives(object)) {
      return dropped + "a solid does not change, write " + object + " = " + object + ":" + name +
             "(...)";
    }
    if (!is_written_before(name)) return dropped + "return it, or give it a name";
    return dropped + "it stands behind what it is made of, as in cube(10):translate(0, 0, 5)";
  }

  /// `function cube`, `local cube`, `cube = `, and parameters of that name.
  void find_own_functions() {
    for (size_t i = 0; i + 1 < tokens_.size(); ++i) {
      if (tokens_[i].kind != Token::Kind::kName || !only_gives(tokens_[i].text)) continue;
      const bool is_after = i > 0 && (tokens_[i - 1].is("function") || tokens_[i - 1].is("local"));
      const bool is_before =
          tokens_[i + 1].is("=") || tokens_[i + 1].is(",") || tokens_[i + 1].is(")");
      if (is_after || is_before) own_.emplace(tokens_[i].text);
    }
  }

  /// Whether what stands before the token can only be the end of a statement, or what opens a
  /// block. (A name behind a name or a value is no expression.)
  [[nodiscard]] bool begins_statement(size_t i) const {
    if (i == 0) return true;
    const Token& before = tokens_[i - 1];
    switch (before.kind) {
      case Token::Kind::kName:
      case Token::Kind::kValue:
        return true;
      case Token::Kind::kKeyword:
        return is_one_of(before.text,
                         {"do", "then", "else", "repeat", "end", "true", "false", "nil"});
      default:
        return is_one_of(before.text, {")", "}", "]", ";"});
    }
  }

  [[nodiscard]] Calls calls_at(size_t i) const {
    size_t function = i, at = i + 1;
    while (true) {
      if (tokens_[at].is(":") && tokens_[at + 1].kind == Token::Kind::kName) {
        function = at + 1;
        at += 2;
      }
      const size_t after = end_of_arguments(at);
      if (after == at) return {};
      at = after;
      if (!tokens_[at].is(":")) break;
    }
    const Token& next = tokens_[at];
    const bool ends =
        next.kind == Token::Kind::kKeyword
            ? !is_one_of(next.text, {"and", "or"})
            : next.kind == Token::Kind::kEnd || next.kind == Token::Kind::kName || next.is(";");
    return ends ? Calls{tokens_[function].text, at} : Calls{};
  }

  /// Behind the arguments of a call that begin at a token; that token if none do.
  [[nodiscard]] size_t end_of_arguments(size_t at) const {
    if (tokens_[at].kind == Token::Kind::kValue) return at + 1;
    if (!tokens_[at].is("(") && !tokens_[at].is("{")) return at;
    int depth = 0;
    do {
      if (is_one_of(tokens_[at].text, {"(", "{", "["})) ++depth;
      if (is_one_of(tokens_[at].text, {")", "}", "]"})) --depth;
      ++at;
    } while (depth > 0 && tokens_[at].kind != Token::Kind::kEnd);
    return at;
  }

  std::vector<Token> tokens_;
  std::set<std::string, std::less<>> own_;
};

}  // namespace

std::vector<DroppedValue> find_dropped_values(std::string_view text) { return Finder(text).find(); }

}  // namespace csgrun
