// The style of an element of an SVG: what the rules of style sheets, its attribute `style` and its
// other attributes say of a property.
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

#include "primitives/files/svg_css.h"

namespace csgrun {

class SvgStyleSheet {
 public:
  /// Adds the text of one <style>. `heeded` says of a property whether the reader asks for it:
  /// rules that have none of these are passed over. Cost: linear in the text.
  void add(std::string_view text, bool (*heeded)(std::string_view property));

  struct Found {
    const CssDeclaration* declaration;  ///< lives as long as the sheet, until add()
    size_t rank;                        ///< of its selector: what is more specific ranks higher
  };
  /// Appends the declarations of all rules for this element, in their order.
  void find(const pugi::xml_node& node, std::vector<Found>& found) const;

  /// How many rules with heeded properties were passed over, because of their selectors. Those that
  /// have fonts only are not counted: what they change is areas of text.
  [[nodiscard]] size_t unknown_rules() const { return unknown_; }

  /// Whether more selectors were held against elements than a drawing can want; find() finds
  /// nothing from then on.
  [[nodiscard]] bool is_exhausted() const { return tried_ > kMostTrials; }

 private:
  struct Selector {
    std::string element;  ///< empty: any
    std::string id;
    std::vector<std::string> classes;
    size_t rank = 0;  ///< ids count most, then classes, then names
  };
  struct Rule {
    Selector selector;
    size_t first, last;  ///< of declarations_
  };

  static bool parse_selector(std::string_view text, Selector& selector);
  static bool matches(const Selector& selector, const pugi::xml_node& node);

  std::vector<Rule> rules_;
  std::vector<CssDeclaration> declarations_;
  size_t unknown_ = 0;
  mutable size_t tried_ = 0;

  static constexpr size_t kMostTrials = 20'000'000;
};

/// The cascade of one element: attributes, over them the rules of style sheets by their rank, over
/// these the attribute `style`; what is `!important` over all that is not. The sheet and the
/// element must outlive it.
class SvgElementStyle {
 public:
  SvgElementStyle(const pugi::xml_node& node, const SvgStyleSheet& sheet);

  /// What rules and the attribute `style` say, as it is written; null where they do not.
  [[nodiscard]] const std::string* declared(std::string_view property) const;

  /// That, or what the attribute of this name says, in small letters. Empty where nothing does.
  [[nodiscard]] std::string property(const char* name) const;

 private:
  pugi::xml_node node_;
  std::vector<CssDeclaration> own_;
  std::vector<SvgStyleSheet::Found> found_;  ///< the one that counts of each property
};

}  // namespace csgrun
