// Declarations of CSS: what stands between the braces of a rule, and in the attribute `style`.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace csgrun {

struct CssDeclaration {
  std::string property;  ///< in small letters
  std::string value;     ///< without `!important`, and without blanks about it
  bool important = false;
};

/// The text with a blank for each comment; what is quoted has none. Cost: linear.
std::string css_without_comments(std::string_view text);

/// The declarations of a text without comments, in its order. Braces end one as a semicolon does,
/// so of a block with rules in it these declarations are found as well. Cost: linear.
std::vector<CssDeclaration> css_declarations(std::string_view text);

/// In small letters, as ASCII has them.
std::string css_lower(std::string_view text);

/// What stands between blanks and commas.
std::vector<std::string> css_words(std::string_view list);

}  // namespace csgrun
