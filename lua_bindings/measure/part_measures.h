// The measures of one part, as they are printed.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>

#include <glm/vec3.hpp>

namespace csgrun {

struct PartMeasures {
  std::string name;
  size_t triangles = 0, vertices = 0;
  double volume = 0, area = 0;
  std::array<glm::dvec3, 2> bbox{};
  int64_t components = 0, genus = 0;
  bool closed = true;
};

}  // namespace csgrun
