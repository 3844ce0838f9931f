// Places of a mesh as text, for messages.
#pragma once

#include <string>

#include <glm/vec3.hpp>

namespace csgrun {

/// "(0, 0.1, -2)": each number is the shortest text that reads back as the same one.
std::string place_text(const glm::dvec3& p);

/// The same to six digits: for places that are computed, near which something is.
std::string rough_place_text(const glm::dvec3& p);

/// The shortest text that reads back as the same number.
std::string shortest_number(double x);

}  // namespace csgrun
