#include "lua_bindings/cli/info.h"

#include <filesystem>
#include <new>

#include <fmt/format.h>

#include <csgrun/primitives/mesh_file.h>

#include "lua_bindings/budget.h"
#include "lua_bindings/cli/report.h"
#include "lua_bindings/files.h"
#include "lua_bindings/measure/mesh_measures.h"
#include "lua_bindings/measure/read_glb.h"

namespace csgrun {
namespace {

bool is_glb(const std::string& path) {
  const std::string ending = std::filesystem::path(path).extension().string();
  return ending == ".glb" || ending == ".GLB";
}

Result<std::vector<TriangleMesh>> read_meshes(const std::string& path, const std::string& bytes) {
  if (is_glb(path)) return parse_glb(path, bytes);
  auto mesh = parse_mesh(path, bytes);
  if (!mesh) return mesh.error();
  // STL has no indices: equal coordinates are one point. The others say themselves what is one.
  TriangleMesh triangles = triangulated(*mesh, mesh_format_of(path) == "stl");
  triangles.name = std::filesystem::path(path).stem().string();
  return std::vector<TriangleMesh>{std::move(triangles)};
}

Failure measure_file(const std::string& path, bool json, std::string& output) {
  const FileText text = read_whole_file(path);
  if (!text.error.empty())
    return {kExitFiles, fmt::format("csgrun: cannot read '{}': {}", path, text.error)};
  auto meshes = read_meshes(path, text.bytes);
  if (!meshes) {
    const std::string& message = meshes.error().message;
    return {kExitScript, message.rfind(path, 0) == 0 ? message : path + ": " + message};
  }
  std::vector<PartMeasures> parts;
  std::vector<std::string> warnings;
  uint64_t crossings = 0;
  for (TriangleMesh& mesh : *meshes) {
    parts.push_back(measure(mesh));
    if (!parts.back().closed) warnings.push_back(fmt::format("part '{}' is not closed", mesh.name));
    if (parts.back().volume < 0)
      warnings.push_back(fmt::format("part '{}' is inside out", mesh.name));
    if (const uint64_t count = count_degenerate(mesh); count > 0) {
      warnings.push_back(fmt::format("part '{}' has {} triangle{} without area", mesh.name, count,
                                     count == 1 ? "" : "s"));
    }
    weld(mesh);  // surfaces that were split where they touch do not cross there
    crossings += count_crossings(mesh);
  }
  output += json ? info_json(path, parts, crossings, warnings)
                 : info_text(path, parts, crossings, warnings);
  return {};
}

}  // namespace

bool is_info_path(const std::string& path) { return is_glb(path) || !mesh_format_of(path).empty(); }

Failure run_info(const std::string& path, bool json, std::string& output) {
  limit_process_memory(default_process_memory());
  try {
    return measure_file(path, json, output);
  } catch (const std::bad_alloc&) {
    return {kExitGeometry, path + ": not enough memory"};
  }
}

}  // namespace csgrun
