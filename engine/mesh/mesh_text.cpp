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
  return std::string("(") + shortest_number(p.x) + ", " + shortest_number(p.y) + ", " +
         shortest_number(p.z) + ")";
}

std::string rough_place_text(const glm::dvec3& p) {
  const auto rough = [](double x) {
    std::array<char, 32> buffer;
    const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), x,
                                   std::chars_format::general, 6)
                         .ptr;
    return std::string(buffer.data(), end);
  };
  return std::string("(") + rough(p.x) + ", " + rough(p.y) + ", " + rough(p.z) + ")";
}

}  // namespace csgrun
