// An SVG as a tree of elements, as both of its readers take it: the document, names, limits.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include <pugixml.hpp>

#include <csgrun/engine/error.h>

namespace csgrun {

constexpr int kDeepestSvg = 200;             ///< groups in groups
constexpr size_t kMostSvgElements = 200000;  ///< a `use` counts what it shows

/// In which lines of a file its elements are.
class SvgLines {
 public:
  SvgLines() = default;
  /// Of a document that was parsed from these bytes.
  SvgLines(std::string_view bytes, pugi::xml_encoding encoding);

  /// "line 12"; empty for encodings in which bytes are not counted (UTF-16, UTF-32).
  [[nodiscard]] std::string of(const pugi::xml_node& node) const;

 private:
  bool known_ = false;
  std::vector<ptrdiff_t> ends_;  ///< of the lines, in bytes of UTF-8
};

/// The root, an <svg>. Errors: kMalformedFile with the line; entities are refused.
Result<pugi::xml_node> parse_svg_document(const std::string& name, std::string_view bytes,
                                          pugi::xml_document& document, SvgLines* lines = nullptr);

/// An attribute by its name without a prefix, and the namespace that its prefix stands for. Where
/// nothing says what this prefix stands for, `usual` is known.
pugi::xml_attribute svg_attribute_of(const pugi::xml_node& node, std::string_view space,
                                     std::string_view usual, std::string_view local);
/// `xlink:href`.
pugi::xml_attribute xlink_href(const pugi::xml_node& node);
/// `inkscape:label` and the like.
pugi::xml_attribute inkscape_attribute(const pugi::xml_node& node, std::string_view local);

/// An element's name without its namespace.
std::string svg_name(const pugi::xml_node& node);

/// Without blanks before and behind.
std::string trimmed(const std::string& text);

/// A property of the attribute `style`; empty where it is not given.
std::string svg_style(const pugi::xml_node& node, const std::string& property);

/// "unfolds to more than 200000 elements".
Error too_many_in_svg(const std::string& name, const char* what, size_t most);
Error too_deep_svg(const std::string& name);

}  // namespace csgrun
