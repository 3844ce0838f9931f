#include "primitives/files/svg_style_sheet.h"

#include <algorithm>
#include <cstdint>
#include <tuple>
#include <utility>

#include "primitives/files/svg_document.h"

namespace csgrun {
namespace {

constexpr std::string_view kBlanks = " \t\n\r\f";
constexpr size_t kRankOfId = 1000000, kRankOfClass = 1000;

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
  const std::string plain = css_without_comments(text);
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
    bool only_fonts = true;
    for (CssDeclaration& next : css_declarations(body)) {
      if (!heeded(next.property)) continue;
      if (!next.property.starts_with("font")) only_fonts = false;
      declarations_.push_back(std::move(next));
    }
    const size_t last = declarations_.size();
    if (first == last) continue;
    const size_t counted = only_fonts ? 0 : 1;
    if (head.starts_with("@")) {  // for print, for screens of a size
      declarations_.resize(first);
      unknown_ += counted;
      continue;
    }
    for (size_t begin = 0; begin <= head.size();) {
      const size_t comma = std::min(head.find(',', begin), head.size());
      Selector selector;
      if (parse_selector(trimmed(head.substr(begin, comma - begin)), selector)) {
        rules_.push_back({std::move(selector), first, last});
      } else {
        unknown_ += counted;
      }
      begin = comma + 1;
    }
  }
}

void SvgStyleSheet::find(const pugi::xml_node& node, std::vector<Found>& found) const {
  const size_t length = std::string_view(node.attribute("class").value()).size();
  for (const Rule& rule : rules_) {
    if (is_exhausted()) {
      found.clear();
      return;
    }
    tried_ += 1 + rule.selector.classes.size() * (length / 64);
    if (!matches(rule.selector, node)) continue;
    tried_ += rule.last - rule.first;
    for (size_t i = rule.first; i < rule.last; ++i)
      found.push_back({&declarations_[i], rule.selector.rank});
  }
}

SvgElementStyle::SvgElementStyle(const pugi::xml_node& node, const SvgStyleSheet& sheet)
    : node_(node) {
  constexpr size_t kRankOfStyle = SIZE_MAX;
  std::vector<SvgStyleSheet::Found> all;
  sheet.find(node, all);
  if (const pugi::xml_attribute style = node.attribute("style")) {
    own_ = css_declarations(css_without_comments(style.value()));
    for (const CssDeclaration& declaration : own_) all.push_back({&declaration, kRankOfStyle});
  }
  // The one that counts of each property comes last, and is kept.
  std::stable_sort(all.begin(), all.end(), [](const auto& a, const auto& b) {
    const CssDeclaration &p = *a.declaration, &q = *b.declaration;
    return std::tie(p.property, p.important, a.rank) < std::tie(q.property, q.important, b.rank);
  });
  for (const SvgStyleSheet::Found& next : all) {
    if (!found_.empty() && found_.back().declaration->property == next.declaration->property)
      found_.pop_back();
    found_.push_back(next);
  }
}

const std::string* SvgElementStyle::declared(std::string_view property) const {
  const auto at = std::lower_bound(found_.begin(), found_.end(), property,
                                   [](const SvgStyleSheet::Found& a, std::string_view b) {
                                     return a.declaration->property < b;
                                   });
  if (at == found_.end() || at->declaration->property != property) return nullptr;
  return &at->declaration->value;
}

std::string SvgElementStyle::property(const char* name) const {
  if (const std::string* value = declared(name)) return css_lower(*value);
  return css_lower(trimmed(node_.attribute(name).value()));
}

}  // namespace csgrun
