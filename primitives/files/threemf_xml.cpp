#include "primitives/files/threemf_xml.h"

#include <cstring>

#include "primitives/files/formats.h"
#include "primitives/files/text_scanner.h"

namespace csgrun {

std::string_view local_name(const char* name) {
  const char* colon = std::strchr(name, ':');
  return colon == nullptr ? name : colon + 1;
}

pugi::xml_attribute find_attribute(const pugi::xml_node& node, std::string_view name) {
  for (const pugi::xml_attribute& attribute : node.attributes()) {
    if (local_name(attribute.name()) == name) return attribute;
  }
  return {};
}

pugi::xml_node find_child(const pugi::xml_node& node, std::string_view name) {
  for (const pugi::xml_node& each : node.children()) {
    if (local_name(each.name()) == name) return each;
  }
  return {};
}

uint32_t index_of(const pugi::xml_node& node, const char* name) {
  const pugi::xml_attribute attribute = find_attribute(node, name);
  const auto value = parse_integer<uint32_t>(attribute.value());
  if (!value) {
    throw ModelFault{std::string("a ") + node.name() + " has no " + name +
                     " that is a whole number: " + quoted(attribute.value())};
  }
  return *value;
}

double number_of(const pugi::xml_node& node, const char* name) {
  const auto value = parse_finite(find_attribute(node, name).value());
  if (!value) {
    throw ModelFault{std::string("a ") + node.name() + " has no finite " + name + ": " +
                     quoted(find_attribute(node, name).value())};
  }
  return *value;
}

Affine map_of(const pugi::xml_node& node) {
  Affine map;
  const pugi::xml_attribute attribute = find_attribute(node, "transform");
  if (!attribute) return map;
  TextScanner scanner(attribute.value());
  for (size_t column = 0; column < 4; ++column) {
    for (size_t row = 0; row < 3; ++row) {
      const auto value = parse_finite(scanner.word_anywhere());
      if (!value) throw ModelFault{"a transform must be twelve finite numbers"};
      map.m[row][column] = *value;
    }
  }
  if (!scanner.word_anywhere().empty())
    throw ModelFault{"a transform must be twelve finite numbers"};
  return map;
}

}  // namespace csgrun
