// Written files, read back by small readers that share nothing with the writers.
#pragma once

#include <array>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include <csgrun/export/write.h>

#include "tests/unit/export/hand_made.h"

namespace csgrun {

using Loop = std::vector<uint32_t>;

struct Polygons {
  std::vector<glm::dvec3> points;
  std::vector<Loop> loops;
};

double volume(const Polygons& mesh);

/// Every directed edge once, and its reverse once.
bool is_closed(const std::vector<Loop>& loops);

std::string encode(const std::string& format, const std::vector<Part>& parts,
                   WriteReport* report = nullptr);

Polygons read_stl(const std::string& bytes);

Polygons read_obj(const std::string& text);

struct Glb {
  nlohmann::json json;
  std::string bin;
};

Glb read_glb(const std::string& bytes);

template <class T, size_t n>
std::vector<std::array<T, n>> accessor(const Glb& glb, size_t index) {
  const auto& a = glb.json["accessors"][index];
  const auto& view = glb.json["bufferViews"][a["bufferView"].get<size_t>()];
  std::vector<std::array<T, n>> values(a["count"].get<size_t>());
  std::memcpy(values.data(),
              glb.bin.data() + view.value("byteOffset", 0) + a.value("byteOffset", 0),
              values.size() * sizeof values[0]);
  if (a.contains("sparse")) {
    const auto& s = a["sparse"];
    const auto bytes = [&](const char* part) {
      const auto& v = glb.json["bufferViews"][s[part]["bufferView"].get<size_t>()];
      return glb.bin.data() + v.value("byteOffset", 0) + s[part].value("byteOffset", 0);
    };
    for (size_t i = 0; i < s["count"].get<size_t>(); ++i) {
      uint32_t at = 0;
      std::memcpy(&at, bytes("indices") + 4 * i, 4);
      std::memcpy(&values[at], bytes("values") + sizeof values[0] * i, sizeof values[0]);
    }
  }
  return values;
}

/// The manifold of one mesh of a GLB, as EXT_mesh_manifold describes it.
Polygons manifold_of(const Glb& glb, size_t mesh_index);

Appearance colour(float r, float g, float b, float alpha = 1);

SolidPtr hexagon_wheel(int corners);

}  // namespace csgrun
