#include "primitives/files/csg_parser.h"

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <limits>

#include "primitives/files/formats.h"

namespace csgrun {
namespace {

bool is_word_character(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
         c == '$' || c == '+' || c == '-' || c == '.';
}

std::optional<double> number_of(std::string_view word) {
  if (!word.empty() && word.front() == '+') word.remove_prefix(1);
  double value = 0;
  const auto [rest, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (rest != word.data() + word.size() || word.empty()) return std::nullopt;
  if (error == std::errc()) return value;  // also "inf", "-inf", "nan" and "-nan"
  const bool tiny = word.find("e-") != std::string_view::npos;
  return tiny ? 0.0 : std::numeric_limits<double>::infinity();
}

/// For what only a source can have: variables, modules, expressions.
constexpr const char* kSourceHint =
    "; a tree has calls and values only: openscad in.scad -o out.csg makes one of a source";

}  // namespace

const CsgValue* CsgCall::find(std::string_view key) const {
  for (const auto& [name_of_value, value] : arguments) {
    if (name_of_value == key) return value.kind == CsgValue::Kind::kUndef ? nullptr : &value;
  }
  return nullptr;
}

Error CsgParser::error(const std::string& what) const {
  return Error{ErrorCode::kMalformedFile, what, SourceRef{file_, line_}};
}

Error CsgParser::unexpected(const std::string& wanted) const {
  if (at_ >= text_.size()) return error("the file ends where " + wanted + " should be");
  return error("expected " + wanted + ", got " + quoted(text_.substr(at_, 1)));
}

void CsgParser::skip_blanks() {
  for (; at_ < text_.size(); ++at_) {
    const char c = text_[at_];
    if (c == '\n') {
      ++line_;
    } else if (c == '/') {
      if (!skip_comment()) return;
    } else if (c != ' ' && c != '\t' && c != '\r') {
      return;
    }
  }
}

/// Goes to the last character of a comment, or to where the file ends. OpenSCAD writes none, people
/// do.
bool CsgParser::skip_comment() {
  const char next = at_ + 1 < text_.size() ? text_[at_ + 1] : '\0';
  if (next != '/' && next != '*') return false;
  if (next == '/') {
    at_ = std::min(text_.find('\n', at_), text_.size()) - 1;  // the line ends after it
    return true;
  }
  const size_t end = std::min(text_.find("*/", at_ + 2), text_.size());
  line_ += static_cast<int>(std::count(text_.begin() + static_cast<std::ptrdiff_t>(at_),
                                       text_.begin() + static_cast<std::ptrdiff_t>(end), '\n'));
  at_ = std::min(end + 1, text_.size() - 1);
  return true;
}

bool CsgParser::accept(char c) {
  skip_blanks();
  if (at_ >= text_.size() || text_[at_] != c) return false;
  ++at_;
  return true;
}

std::string_view CsgParser::word() {
  skip_blanks();
  const size_t begin = at_;
  while (at_ < text_.size() && is_word_character(text_[at_])) ++at_;
  return text_.substr(begin, at_ - begin);
}

Result<CsgParser::Event> CsgParser::next() {
  skip_blanks();
  if (at_ >= text_.size()) return Event::kEnd;
  if (accept('}')) return Event::kClose;
  call_ = CsgCall();
  for (;;) {
    if (accept('%') || accept('*')) {
      call_.background = true;
    } else if (accept('!')) {
      call_.root = true;
    } else if (!accept('#')) {
      break;
    }
  }
  call_.name = std::string(word());
  call_.line = line_;
  if (call_.name.empty()) return unexpected("a node");
  if (!accept('(')) {
    Error fault = unexpected("\"(\" after " + quoted(call_.name));
    if (at_ < text_.size()) fault.message += kSourceHint;
    return fault;
  }
  if (auto status = read_arguments(); !status) return status.error();
  if (accept(';')) return Event::kLeaf;
  if (accept('{')) return Event::kOpen;
  return unexpected("\";\" or \"{\"");
}

Status CsgParser::read_arguments() {
  if (accept(')')) return std::monostate();
  do {
    std::string key;
    skip_blanks();
    const size_t begin = at_;
    const std::string_view name = word();
    if (!name.empty() && accept('=')) {
      key = std::string(name);
    } else {
      at_ = begin;  // a value without a name
    }
    skip_blanks();
    // OpenSCAD does not escape the string of text(): it ends where the next argument begins.
    const bool raw = call_.name == "text" && key == "text" && peek() == '"';
    Result<CsgValue> value = raw ? read_string(true) : read_value(0);
    if (!value) return value.error();
    call_.arguments.emplace_back(std::move(key), *std::move(value));
  } while (accept(','));
  if (!accept(')')) return unexpected("\",\" or \")\"");
  return std::monostate();
}

Result<CsgValue> CsgParser::read_value(int depth) {
  constexpr int kDeepestList = 32;  // the deepest that OpenSCAD writes is 2
  skip_blanks();
  if (peek() == '"') return read_string(false);
  CsgValue value;
  if (accept('[')) {
    if (depth == kDeepestList) return error("lists are nested too deeply");
    value.kind = CsgValue::Kind::kList;
    if (accept(']')) return value;
    do {
      Result<CsgValue> entry = read_value(depth + 1);
      if (!entry) return entry;
      value.list.push_back(*std::move(entry));
    } while (accept(','));
    if (!accept(']')) return unexpected("\",\" or \"]\"");
    return value;
  }
  const std::string_view text = word();
  if (text.empty()) return unexpected("a value");
  if (text == "undef") return value;
  if (text == "true" || text == "false") {
    value.kind = CsgValue::Kind::kBool;
    value.boolean = text == "true";
    return value;
  }
  const std::optional<double> number = number_of(text);
  if (!number) return error("expected a value, got " + quoted(text) + kSourceHint);
  value.kind = CsgValue::Kind::kNumber;
  value.number = *number;
  return value;
}

Result<CsgValue> CsgParser::read_string(bool raw) {
  CsgValue value;
  value.kind = CsgValue::Kind::kString;
  ++at_;  // the opening quote
  if (raw) {
    const size_t end = text_.find("\", size = ", at_);
    if (end == std::string_view::npos) return error("a text without end");
    for (; at_ < end; ++at_) {
      if (text_[at_] == '\n') ++line_;
      value.string += text_[at_];
    }
    ++at_;
    return value;
  }
  for (; at_ < text_.size(); ++at_) {
    char c = text_[at_];
    if (c == '"') {
      ++at_;
      return value;
    }
    if (c == '\n') ++line_;
    if (c == '\\' && at_ + 1 < text_.size()) {
      c = text_[++at_];
      if (c == 'n') c = '\n';
      if (c == 't') c = '\t';
      if (c == 'r') c = '\r';
    }
    value.string += c;
  }
  return error("a string without end");
}

}  // namespace csgrun
