#include "primitives/files/svg_document.h"

#include <algorithm>
#include <cstring>

#include "primitives/files/formats.h"

namespace csgrun {
namespace {

/// The line of a byte. Bytes are counted in UTF-8, to which other encodings are converted first,
/// so the count can lie behind the end of the file.
std::string place(std::string_view bytes, ptrdiff_t offset) {
  const auto end = std::clamp<ptrdiff_t>(offset, 0, static_cast<ptrdiff_t>(bytes.size()));
  return "line " + std::to_string(1 + std::count(bytes.begin(), bytes.begin() + end, '\n'));
}

}  // namespace

Result<pugi::xml_node> parse_svg_document(const std::string& name, std::string_view bytes,
                                          pugi::xml_document& document) {
  if (bytes.find("<!ENTITY") != std::string_view::npos) {
    return malformed(name, "", "entities are refused: <!ENTITY> in a drawing is of no good");
  }
  const pugi::xml_parse_result parsed = document.load_buffer(bytes.data(), bytes.size());
  if (!parsed) return malformed(name, place(bytes, parsed.offset), parsed.description());
  const pugi::xml_node root = document.document_element();
  if (svg_name(root) != "svg") return malformed(name, "", "the root element is not <svg>");
  return root;
}

std::string svg_name(const pugi::xml_node& node) {
  const char* name = node.name();
  const char* colon = std::strrchr(name, ':');
  return colon != nullptr ? colon + 1 : name;
}

std::string trimmed(const std::string& text) {
  constexpr const char* kBlanks = " \t\n\r";
  const size_t begin = text.find_first_not_of(kBlanks);
  if (begin == std::string::npos) return {};
  return text.substr(begin, text.find_last_not_of(kBlanks) - begin + 1);
}

std::string svg_style(const pugi::xml_node& node, const std::string& property) {
  const std::string style = node.attribute("style").value();
  for (size_t begin = 0; begin < style.size();) {
    const size_t end = std::min(style.find(';', begin), style.size());
    const size_t colon = style.find(':', begin);
    if (colon < end && trimmed(style.substr(begin, colon - begin)) == property)
      return trimmed(style.substr(colon + 1, end - colon - 1));
    begin = end + 1;
  }
  return {};
}

Error too_many_in_svg(const std::string& name, const char* what, size_t most) {
  return Error{
      ErrorCode::kLimit, name + ": unfolds to more than " + std::to_string(most) + " " + what, {}};
}

Error too_deep_svg(const std::string& name) {
  return Error{ErrorCode::kLimit,
               name + ": elements are nested deeper than " + std::to_string(kDeepestSvg),
               {}};
}

}  // namespace csgrun
