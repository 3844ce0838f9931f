// An SVG as a tree of elements, as both of its readers take it: the document, names, limits.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include <pugixml.hpp>

#include <csgrun/engine/error.h>

namespace csgrun {

constexpr int kDeepestSvg = 200;             ///< groups in groups
constexpr size_t kMostSvgElements = 200000;  ///< a `use` counts what it shows

/// The root, an <svg>. Errors: kMalformedFile with the line; entities are refused.
Result<pugi::xml_node> parse_svg_document(const std::string& name, std::string_view bytes,
                                          pugi::xml_document& document);

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
