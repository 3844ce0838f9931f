#include "primitives/files/svg_css.h"

#include <algorithm>

#include "primitives/files/svg_document.h"

namespace csgrun {
namespace {

/// Behind the quoted text that begins at `open`.
size_t behind_quotes(std::string_view text, size_t open) {
  for (size_t i = open + 1; i < text.size(); ++i) {
    if (text[i] == '\\') {
      ++i;
    } else if (text[i] == text[open]) {
      return i + 1;
    }
  }
  return text.size();
}

/// The end of the declaration that begins at `begin`: a semicolon or a brace, but not one in
/// brackets or quotes (`url(data:image/png;base64,...)`).
size_t end_of_declaration(std::string_view text, size_t begin) {
  size_t depth = 0;
  for (size_t i = begin; i < text.size();) {
    const char c = text[i];
    if (c == '"' || c == '\'') {
      i = behind_quotes(text, i);
      continue;
    }
    if (c == '(') ++depth;
    if (c == ')' && depth > 0) --depth;
    if (c == '{' || c == '}' || (c == ';' && depth == 0)) return i;
    ++i;
  }
  return text.size();
}

}  // namespace

std::string css_lower(std::string_view text) {
  std::string lower(text);
  for (char& c : lower) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return lower;
}

std::vector<std::string> css_words(std::string_view list) {
  constexpr const char* kSeparators = ", \t\r\n\f";
  std::vector<std::string> words;
  for (size_t at = 0; at < list.size();) {
    const size_t begin = std::min(list.find_first_not_of(kSeparators, at), list.size());
    const size_t end = std::min(list.find_first_of(kSeparators, begin), list.size());
    if (begin < end) words.emplace_back(list.substr(begin, end - begin));
    at = end;
  }
  return words;
}

std::string css_without_comments(std::string_view text) {
  std::string plain;
  for (size_t at = 0; at < text.size();) {
    const size_t next = std::min(text.find_first_of("/\"'", at), text.size());
    plain += text.substr(at, next - at);
    at = next;
    if (at == text.size()) break;
    if (text[at] != '/') {
      const size_t end = behind_quotes(text, at);
      plain += text.substr(at, end - at);
      at = end;
    } else if (text.substr(at, 2) == "/*") {
      const size_t end = text.find("*/", at + 2);
      if (end == std::string_view::npos) break;
      plain += ' ';
      at = end + 2;
    } else {
      plain += text[at++];
    }
  }
  return plain;
}

std::vector<CssDeclaration> css_declarations(std::string_view text) {
  std::vector<CssDeclaration> found;
  for (size_t begin = 0; begin < text.size();) {
    const size_t end = end_of_declaration(text, begin);
    const std::string_view part = text.substr(begin, end - begin);
    begin = end + 1;
    const size_t colon = part.find(':');
    if (colon == std::string_view::npos) continue;
    CssDeclaration next;
    next.property = css_lower(trimmed(std::string(part.substr(0, colon))));
    next.value = trimmed(std::string(part.substr(colon + 1)));
    const size_t mark = next.value.rfind('!');
    if (mark != std::string::npos &&
        css_lower(trimmed(next.value.substr(mark + 1))) == "important") {
      next.important = true;
      next.value = trimmed(next.value.substr(0, mark));
    }
    // Nothing is no value, and does not hide one that was declared before it.
    if (!next.property.empty() && !next.value.empty()) found.push_back(std::move(next));
  }
  return found;
}

}  // namespace csgrun
