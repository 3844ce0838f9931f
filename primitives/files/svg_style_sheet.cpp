#include "primitives/files/svg_style_sheet.h"

#include <algorithm>

#include "primitives/files/svg_document.h"

namespace csgrun {
namespace {

constexpr std::string_view kBlanks = " \t\n\r\f";
constexpr size_t kRankOfId = 1000000, kRankOfClass = 1000;

std::string without_comments(std::string_view text) {
  std::string plain;
  for (size_t at = 0; at < text.size();) {
    const size_t begin = std::min(text.find("/*", at), text.size());
    plain += text.substr(at, begin - at);
    if (begin == text.size()) break;
    const size_t end = text.find("*/", begin + 2);
    if (end == std::string_view::npos) break;
    plain += ' ';
    at = end + 2;
  }
  return plain;
}

bool is_name(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
         c == '-' || static_cast<unsigned char>(c) >= 0x80;
}

/// The end of the block that opens at `open`, behind its bracket.
size_t end_of_block(std::string_view text, size_t open) {
  size_t depth = 0;
  for (size_t i = open; i < text.size(); ++i) {
    if (text[i] == '{') ++depth;
    if (text[i] == '}' && --depth == 0) return i + 1;
  }
  return text.size();
}

bool has_class(std::string_view list, std::string_view wanted) {
  for (size_t at = 0; at < list.size();) {
    const size_t begin = std::min(list.find_first_not_of(kBlanks, at), list.size());
    const size_t end = std::min(list.find_first_of(kBlanks, begin), list.size());
    if (begin < end && list.substr(begin, end - begin) == wanted) return true;
    at = end;
  }
  return false;
}

}  // namespace

bool SvgStyleSheet::parse_selector(std::string_view text, Selector& selector) {
  size_t at = 0;
  const auto name = [&]() {
    const size_t begin = at;
    while (at < text.size() && is_name(text[at])) ++at;
    return std::string(text.substr(begin, at - begin));
  };
  if (text.empty()) return false;
  if (text[0] == '*') {
    ++at;
  } else if (selector.element = name(); !selector.element.empty()) {
    ++selector.rank;
  }
  while (at < text.size()) {
    const char kind = text[at++];
    const std::string word = name();
    if (word.empty()) return false;
    if (kind == '.') {
      selector.classes.push_back(word);
      selector.rank += kRankOfClass;
    } else if (kind == '#' && (selector.id.empty() || selector.id == word)) {
      selector.id = word;
      selector.rank += kRankOfId;
    } else {
      return false;  // combinators, pseudo-classes, attributes
    }
  }
  return true;
}

bool SvgStyleSheet::matches(const Selector& selector, const pugi::xml_node& node) {
  if (!selector.element.empty() && selector.element != svg_name(node)) return false;
  if (!selector.id.empty() && selector.id != node.attribute("id").value()) return false;
  const std::string_view classes = node.attribute("class").value();
  return std::all_of(selector.classes.begin(), selector.classes.end(),
                     [&](const std::string& word) { return has_class(classes, word); });
}

void SvgStyleSheet::add(std::string_view text, bool (*heeded)(std::string_view property)) {
  const std::string plain = without_comments(text);
  for (size_t at = 0; at < plain.size();) {
    const size_t open = plain.find_first_of(";{}", at);
    if (open == std::string::npos) break;
    if (plain[open] != '{') {  // @import, @charset: no block of their own
      at = open + 1;
      continue;
    }
    const std::string head = trimmed(plain.substr(at, open - at));
    const size_t end = end_of_block(plain, open);
    at = end;
    const std::string body = plain.substr(open + 1, end - open - (plain[end - 1] == '}' ? 2 : 1));
    const size_t first = declarations_.size();
    for (size_t begin = 0; begin < body.size();) {
      const size_t stop = std::min(body.find_first_of(";{}", begin), body.size());
      const size_t colon = body.find_first_of(":;{}", begin);
      if (colon < stop && body[colon] == ':') {
        const std::string property = trimmed(body.substr(begin, colon - begin));
        std::string value = trimmed(body.substr(colon + 1, stop - colon - 1));
        value = trimmed(value.substr(0, value.find("!important")));
        if (heeded(property)) declarations_.push_back({property, value});
      }
      begin = stop + 1;
    }
    const size_t last = declarations_.size();
    if (first == last) continue;
    if (head.starts_with("@")) {  // for print, for screens of a size
      declarations_.resize(first);
      ++unknown_;
      continue;
    }
    for (size_t begin = 0; begin <= head.size();) {
      const size_t comma = std::min(head.find(',', begin), head.size());
      Selector selector;
      if (parse_selector(trimmed(head.substr(begin, comma - begin)), selector)) {
        rules_.push_back({std::move(selector), first, last});
      } else {
        ++unknown_;
      }
      begin = comma + 1;
    }
  }
}

std::string SvgStyleSheet::property(const pugi::xml_node& node, std::string_view name) const {
  size_t rank = 0;
  std::string value;
  const size_t length = std::string_view(node.attribute("class").value()).size();
  for (const Rule& rule : rules_) {
    if (tried_ > kMostTrials) return {};
    tried_ += 1 + rule.selector.classes.size() * (length / 64);
    if (rule.selector.rank < rank || !matches(rule.selector, node)) continue;
    tried_ += (rule.last - rule.first) / 8;
    for (size_t i = rule.first; i < rule.last; ++i) {
      if (declarations_[i].property != name) continue;
      rank = rule.selector.rank;
      value = declarations_[i].value;
    }
  }
  return value;
}

}  // namespace csgrun
