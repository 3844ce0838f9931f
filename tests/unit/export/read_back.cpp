#include "tests/unit/export/read_back.h"

#include <cmath>
#include <cstring>
#include <map>
#include <sstream>
#include <utility>

#include <gtest/gtest.h>

namespace csgrun {

double volume(const Polygons& mesh) {
  double six = 0;
  for (const Loop& loop : mesh.loops) {
    for (size_t i = 1; i + 1 < loop.size(); ++i) {
      const glm::dvec3 &a = mesh.points[loop[0]], &b = mesh.points[loop[i]],
                       &c = mesh.points[loop[i + 1]];
      six += a.x * (b.y * c.z - b.z * c.y) - a.y * (b.x * c.z - b.z * c.x) +
             a.z * (b.x * c.y - b.y * c.x);
    }
  }
  return six / 6;
}

bool is_closed(const std::vector<Loop>& loops) {
  std::map<std::pair<uint32_t, uint32_t>, int> edges;
  for (const Loop& loop : loops) {
    for (size_t i = 0; i < loop.size(); ++i) ++edges[{loop[i], loop[(i + 1) % loop.size()]}];
  }
  for (const auto& [edge, count] : edges) {
    const auto reverse = edges.find({edge.second, edge.first});
    if (count != 1 || reverse == edges.end()) return false;
  }
  return !loops.empty();
}

std::string encode(const std::string& format, const std::vector<Part>& parts, WriteReport* report) {
  WriteReport unused;
  Result<std::string> bytes = encode_model(format, parts, report ? *report : unused);
  EXPECT_TRUE(bytes) << bytes.error().message;
  return bytes ? *bytes : std::string();
}

Polygons read_stl(const std::string& bytes) {
  Polygons mesh;
  uint32_t count = 0;
  std::memcpy(&count, bytes.data() + 80, 4);
  EXPECT_EQ(bytes.size(), 84 + 50 * size_t{count});
  for (uint32_t t = 0; t < count; ++t) {
    float f[12];
    std::memcpy(f, bytes.data() + 84 + 50 * size_t{t}, sizeof f);
    Loop loop;
    for (int corner = 1; corner < 4; ++corner) {
      loop.push_back(static_cast<uint32_t>(mesh.points.size()));
      mesh.points.emplace_back(f[3 * corner], f[3 * corner + 1], f[3 * corner + 2]);
    }
    mesh.loops.push_back(loop);
  }
  return mesh;
}

Polygons read_obj(const std::string& text) {
  Polygons mesh;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string key;
    words >> key;
    if (key == "v") {
      glm::dvec3 p;
      words >> p.x >> p.y >> p.z;
      mesh.points.push_back(p);
    } else if (key == "f") {
      Loop loop;
      for (uint32_t v; words >> v;) loop.push_back(v - 1);
      mesh.loops.push_back(loop);
    }
  }
  return mesh;
}

Glb read_glb(const std::string& bytes) {
  Glb glb;
  uint32_t header[5];
  std::memcpy(header, bytes.data(), sizeof header);
  EXPECT_EQ(bytes.substr(0, 4), "glTF");
  EXPECT_EQ(header[2], bytes.size());
  glb.json = nlohmann::json::parse(bytes.substr(20, header[3]));
  if (bytes.size() > 28 + header[3]) glb.bin = bytes.substr(28 + header[3]);
  return glb;
}

Polygons manifold_of(const Glb& glb, size_t mesh_index) {
  const auto& extension = glb.json["meshes"][mesh_index]["extensions"]["EXT_mesh_manifold"];
  const auto& primitive = extension["manifoldPrimitive"];
  Polygons mesh;
  for (const auto& p : accessor<float, 3>(glb, primitive["attributes"]["POSITION"])) {
    mesh.points.emplace_back(p[0], p[1], p[2]);
  }
  Loop indices;
  for (const auto& i : accessor<uint32_t, 1>(glb, primitive["indices"])) indices.push_back(i[0]);
  for (size_t i = 0; i < indices.size(); i += 3) {
    mesh.loops.push_back({indices[i], indices[i + 1], indices[i + 2]});
  }
  return mesh;
}

Appearance colour(float r, float g, float b, float alpha) {
  Appearance a;
  a.red = r;
  a.green = g;
  a.blue = b;
  a.alpha = alpha;
  a.is_default = false;
  return a;
}

SolidPtr hexagon_wheel(int corners) {
  std::vector<std::pair<double, double>> outline;
  for (int i = 0; i < corners; ++i) {
    const double angle = 2 * std::acos(-1.0) * i / corners;
    outline.emplace_back(std::cos(angle), std::sin(angle));
  }
  testing::HandMade made;
  made.prism(outline, 1, 1);
  return made.share();
}

}  // namespace csgrun
