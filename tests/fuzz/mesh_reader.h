// What all targets of mesh files do with their input: as a model (`csgrun part.stl`) and as a file
// to be measured (`csgrun info part.stl`).
#pragma once

#include <cmath>
#include <memory>
#include <string>

#include <csgrun/engine/repair.h>
#include <csgrun/primitives/mesh_file.h>

#include "lua_bindings/measure/mesh_measures.h"
#include "tests/fuzz/evaluate_small.h"

namespace csgrun::fuzz {

inline void measure_as_info_does(TriangleMesh mesh) {
  for (const auto& t : mesh.triangles) {
    for (const uint32_t corner : t) expect(corner < mesh.points.size(), "a corner without a point");
  }
  const PartMeasures measures = measure(mesh);
  expect(!std::isnan(measures.volume) && !std::isnan(measures.area), "a measure is no number");
  count_degenerate(mesh);
  weld(mesh);
  count_crossings(mesh);
}

inline int read_mesh(const std::string& name, const uint8_t* data, size_t size) {
  auto mesh = parse_mesh(name, text_of(data, size));
  if (!mesh) {
    expect_users_fault(mesh.error());
    expect(mesh.error().message.rfind(name + ":", 0) == 0, "an error that names no file");
    return 0;
  }
  for (const glm::dvec3& p : mesh->points) {
    expect(std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z), "a point is not finite");
  }
  for (const uint32_t corner : mesh->corners)
    expect(corner < mesh->points.size(), "a corner without a point");
  measure_as_info_does(triangulated(*mesh, mesh_format_of(name) == "stl"));

  std::string note;
  auto solid = make_solid_mesh(*mesh, &note);
  if (!solid) {  // as the message suggests, if it does
    expect_users_fault(solid.error());
    const auto options = suggest_repair(*mesh);
    if (!options) return 0;
    solid = repair_mesh(*std::move(mesh), *options, nullptr);
    expect(solid.has_value(), "a repair that was suggested fails");
  }
  expect_leaf(*solid);
  evaluate_small({Node::leaf(std::make_shared<const PolygonMesh>(*std::move(solid)))});
  return 0;
}

}  // namespace csgrun::fuzz
