#include "engine/mesh/mesh_text.h"

#include <array>
#include <charconv>

namespace csgrun {

std::string shortest_number(double x) {
  std::array<char, 32> buffer;
  const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), x).ptr;
  return {buffer.data(), end};
}

std::string place_text(const glm::dvec3& p) {
  return "(" + shortest_number(p.x) + ", " + shortest_number(p.y) + ", " + shortest_number(p.z) +
         ")";
}

}  // namespace csgrun
