#include "primitives/files/csg_parser.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstddef>
#include <limits>

#include "primitives/files/formats.h"
#include "primitives/files/text_scanner.h"

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
  return is_too_small(word) ? 0.0 : std::numeric_limits<double>::infinity();
}

/// Where the string of text() ends, which OpenSCAD does not escape: with the next argument.
constexpr std::string_view kEndOfRawText = "\", size = ";

/// For what only a source can have: variables, modules, expressions.
constexpr const char* kSourceHint =
    "; a tree has calls and values only: openscad in.scad -o out.csg makes one of a source";

}  // namespace

std::string_view source_hint(std::string_view node) {
  constexpr std::array<std::string_view, 12> kOfSources{
      "translate", "rotate", "scale",  "mirror", "for",      "intersection_for",
      "if",        "let",    "assert", "echo",   "children", "assign"};
  const bool is_of_source =
      std::find(kOfSources.begin(), kOfSources.end(), node) != kOfSources.end();
  return is_of_source ? kSourceHint : "";
}

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
  if (text_.starts_with("\xff\xfe") || text_.starts_with("\xfe\xff")) {
    return error("the file is in UTF-16; save it in UTF-8");
  }
  const char c = text_[at_];
  const bool may_be_source = c > ' ' && c <= '~' && c != '"' && c != '{' && c != '}';
  return error("expected " + wanted + ", got " + quoted(text_.substr(at_, 1)) +
               (may_be_source ? kSourceHint : ""));
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
  while (accept(';')) {
  }
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
  if (!accept('(')) return unexpected("\"(\" after " + quoted(call_.name));
  if (auto status = read_arguments(); !status) return status.error();
  if (accept(';')) return Event::kLeaf;
  if (accept('{')) return Event::kOpen;
  return unexpected("\";\" or \"{\"");
}

/// Whether there is a comma, and more than the closing bracket behind it.
bool CsgParser::accept_comma(char closing) {
  if (!accept(',')) return false;
  skip_blanks();
  return peek() != closing;
}

/// Where the string of a text() ends that starts here, as OpenSCAD writes it; npos if nowhere.
size_t CsgParser::end_of_raw_text() {
  if (raw_end_ <= at_) raw_end_ = text_.find(kEndOfRawText, at_ + 1);
  return raw_end_;
}

/// Whether the string of a text() that starts here is one that somebody wrote by hand: it ends at
/// the next quote, as others do, and the call before what ends it as OpenSCAD writes it, which has
/// the spacing behind the size, and each call on a line of its own.
bool CsgParser::has_plain_string() {
  size_t end = at_ + 1;
  while (end < text_.size() && text_[end] != '"') end += text_[end] == '\\' ? 2 : 1;
  const size_t next = text_.find_first_not_of(" \t\r\n", std::min(end, text_.size() - 1) + 1);
  if (next == std::string_view::npos || (text_[next] != ',' && text_[next] != ')')) return false;
  const size_t written = end_of_raw_text();
  if (written == std::string_view::npos) return true;
  if (written <= end) return false;
  const std::string_view between = text_.substr(end, written - end);
  for (const std::string_view line_end : {";\n", ";\r\n"}) {
    if (between.find(line_end) != std::string_view::npos) return true;
  }
  const size_t size = written + kEndOfRawText.size();
  const size_t behind = std::min(text_.find(',', size), text_.size());
  const bool is_of_openscad = text_.substr(behind).starts_with(", spacing = ");
  return !is_of_openscad && between.find(';') != std::string_view::npos;
}

Status CsgParser::read_arguments() {
  if (accept(')')) return std::monostate();
  do {
    std::string key;
    skip_blanks();
    const size_t begin = at_, line = line_;
    const std::string_view name = word();
    if (!name.empty() && accept('=')) {
      key = std::string(name);
    } else {
      at_ = begin, line_ = line;  // a value without a name
    }
    skip_blanks();
    const bool raw = call_.name == "text" && key == "text" && peek() == '"' && !has_plain_string();
    Result<CsgValue> value = raw ? read_string(true) : read_value(0);
    if (!value) return value.error();
    call_.arguments.emplace_back(std::move(key), *std::move(value));
  } while (accept_comma(')'));
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
    } while (accept_comma(']'));
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
  const size_t end = raw ? end_of_raw_text() : 0;
  ++at_;  // the opening quote
  if (raw) {
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
