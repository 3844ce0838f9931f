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
                                          pugi::xml_document& document, SvgLines* lines) {
  if (bytes.starts_with("\x1f\x8b")) {
    return malformed(name, "",
                     "it is compressed by gzip, as .svgz files are: expected the text of an SVG "
                     "(gunzip unpacks it)");
  }
  if (bytes.find("<!ENTITY") != std::string_view::npos) {
    return malformed(name, "", "entities are refused: <!ENTITY> in a drawing is of no good");
  }
  const pugi::xml_parse_result parsed = document.load_buffer(bytes.data(), bytes.size());
  if (!parsed) return malformed(name, place(bytes, parsed.offset), parsed.description());
  if (lines != nullptr) *lines = SvgLines(bytes, parsed.encoding);
  const pugi::xml_node root = document.document_element();
  if (svg_name(root) != "svg") return malformed(name, "", "the root element is not <svg>");
  return root;
}

SvgLines::SvgLines(std::string_view bytes, pugi::xml_encoding encoding)
    : known_(encoding == pugi::encoding_utf8 || encoding == pugi::encoding_latin1) {
  if (!known_) return;
  ptrdiff_t at = 0;
  for (const char c : bytes) {
    if (c == '\n') ends_.push_back(at);
    const bool two = encoding == pugi::encoding_latin1 && static_cast<unsigned char>(c) >= 0x80;
    at += two ? 2 : 1;
  }
}

std::string SvgLines::of(const pugi::xml_node& node) const {
  const ptrdiff_t at = known_ ? node.offset_debug() : -1;
  if (at < 0) return {};
  const auto line = std::lower_bound(ends_.begin(), ends_.end(), at) - ends_.begin() + 1;
  return "line " + std::to_string(line);
}

pugi::xml_attribute svg_attribute_of(const pugi::xml_node& node, std::string_view space,
                                     std::string_view usual, std::string_view local) {
  for (const pugi::xml_attribute& attribute : node.attributes()) {
    const std::string_view name = attribute.name();
    const size_t colon = name.find(':');
    if (colon == std::string_view::npos || name.substr(colon + 1) != local) continue;
    const std::string prefix(name.substr(0, colon));
    const std::string declaration = "xmlns:" + prefix;
    pugi::xml_attribute declared;
    for (pugi::xml_node at = node; at && !declared; at = at.parent())
      declared = at.attribute(declaration.c_str());
    if (declared ? declared.value() == space : prefix == usual) return attribute;
  }
  return {};
}

pugi::xml_attribute xlink_href(const pugi::xml_node& node) {
  return svg_attribute_of(node, "http://www.w3.org/1999/xlink", "xlink", "href");
}

pugi::xml_attribute inkscape_attribute(const pugi::xml_node& node, std::string_view local) {
  return svg_attribute_of(node, "http://www.inkscape.org/namespaces/inkscape", "inkscape", local);
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
