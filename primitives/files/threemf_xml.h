// What every element of a 3MF document is read with.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include <pugixml.hpp>

#include <csgrun/engine/csg_tree.h>
#include <csgrun/engine/error.h>

namespace csgrun {

/// What is wrong, without the file's name. Thrown within the reader of 3MF, never out of it.
struct ModelFault {
  std::string what;
  ErrorCode code = ErrorCode::kMalformedFile;
};

/// The name of an element or attribute without its namespace's prefix.
std::string_view local_name(const char* name);

/// By local name; empty when there is none.
pugi::xml_attribute find_attribute(const pugi::xml_node& node, std::string_view name);
pugi::xml_node find_child(const pugi::xml_node& node, std::string_view name);

/// A whole number from 0 on, or a finite number, that must be there. Throw ModelFault.
uint32_t index_of(const pugi::xml_node& node, const char* name);
double number_of(const pugi::xml_node& node, const char* name);

/// The map of the attribute "transform": twelve numbers, its columns and its translation; the
/// identity when there is none. Throws ModelFault.
Affine map_of(const pugi::xml_node& node);

}  // namespace csgrun
