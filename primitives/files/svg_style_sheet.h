// The style sheets of an SVG: which properties their rules give to an element.
//
// Programs that draw (Illustrator, Figma, CorelDRAW) write what is filled and what is stroked as
// classes: `.cls-1 { fill: none }`. Selectors of one element are known: names, .classes, #ids,
// several of them together, and lists. Those with combinators or pseudo-classes are not, nor are
// rules in @media and the like.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include <pugixml.hpp>

namespace csgrun {

class SvgStyleSheet {
 public:
  /// Adds the text of one <style>. `heeded` says of a property whether the reader asks for it:
  /// rules that have none of these are passed over. Cost: linear in the text.
  void add(std::string_view text, bool (*heeded)(std::string_view property));

  /// What the rules say of a property of this element; of several the most specific counts, of
  /// equal ones the last. Empty where none does.
  [[nodiscard]] std::string property(const pugi::xml_node& node, std::string_view name) const;

  /// How many rules with heeded properties were passed over, because of their selectors.
  [[nodiscard]] size_t unknown_rules() const { return unknown_; }

  /// Whether more selectors were held against elements than a drawing can want; the answers of
  /// property() are empty from then on.
  [[nodiscard]] bool is_exhausted() const { return tried_ > kMostTrials; }

 private:
  struct Selector {
    std::string element;  ///< empty: any
    std::string id;
    std::vector<std::string> classes;
    size_t rank = 0;  ///< ids count most, then classes, then names
  };
  struct Declaration {
    std::string property, value;
  };
  struct Rule {
    Selector selector;
    size_t first, last;  ///< of declarations_
  };

  static bool parse_selector(std::string_view text, Selector& selector);
  static bool matches(const Selector& selector, const pugi::xml_node& node);

  std::vector<Rule> rules_;
  std::vector<Declaration> declarations_;
  size_t unknown_ = 0;
  mutable size_t tried_ = 0;

  static constexpr size_t kMostTrials = 20'000'000;
};

}  // namespace csgrun
