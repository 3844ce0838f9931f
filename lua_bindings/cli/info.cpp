#include "lua_bindings/cli/info.h"

#include <algorithm>
#include <filesystem>
#include <new>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include <csgrun/engine/heap.h>
#include <csgrun/export/write.h>
#include <csgrun/primitives/file_ending.h>
#include <csgrun/primitives/flat_file.h>
#include <csgrun/primitives/mesh_file.h>

#include "lua_bindings/budget.h"
#include "lua_bindings/cli/report.h"
#include "lua_bindings/files.h"
#include "lua_bindings/measure/mesh_measures.h"
#include "lua_bindings/measure/read_glb.h"
#include "lua_bindings/model_parts.h"

namespace csgrun {
namespace {

bool is_gltf(std::string_view path) {
  return has_ending(path, ".glb") || has_ending(path, ".gltf");
}

/// The objects of a file as parts; what stands before the first, or has no name, is called as the
/// file. A file of one object is one part of the file's name.
std::vector<TriangleMesh> parts_of(const PolygonMesh& mesh, std::vector<MeshObject> objects,
                                   const std::string& stem, bool weld_points) {
  if (objects.size() == 1 && objects[0].first_face == 0) objects.clear();
  if (objects.empty() || objects[0].first_face > 0) objects.insert(objects.begin(), {"", 0});
  std::vector<PolygonMesh> meshes;
  if (objects.size() > 1) {
    std::vector<uint32_t> object_of(mesh.face_count());
    uint32_t o = 0;
    for (uint32_t f = 0; f < object_of.size(); ++f) {
      while (o + 1 < objects.size() && objects[o + 1].first_face <= f) ++o;
      object_of[f] = o;
    }
    meshes = split_mesh(mesh, object_of, static_cast<uint32_t>(objects.size()));
  } else {
    meshes.push_back(mesh);
  }
  std::vector<TriangleMesh> parts;
  for (size_t i = 0; i < objects.size(); ++i) {
    parts.push_back(triangulated(meshes[i], weld_points));
    parts.back().name = objects[i].name.empty() ? stem : objects[i].name;
  }
  return parts;
}

/// What is measured has no colours.
void append(const TriangleMesh& more, TriangleMesh& mesh) {
  const auto first = static_cast<uint32_t>(mesh.points.size());
  mesh.points.insert(mesh.points.end(), more.points.begin(), more.points.end());
  for (auto [a, b, c] : more.triangles) mesh.triangles.push_back({first + a, first + b, first + c});
}

Result<std::vector<TriangleMesh>> read_meshes(const std::string& path, const std::string& bytes,
                                              std::vector<std::string>& notes) {
  if (is_gltf(path)) {
    GltfOptions options;
    options.open = [&](const std::string& name) -> Result<std::string> {
      FileText text = read_whole_file(join_path(folder_of(path), name));
      if (text.error.empty()) return std::move(text.bytes);
      return Error{
          ErrorCode::kCannotRead, fmt::format("cannot read '{}': {}", name, text.error), {}};
    };
    std::vector<std::string> own_notes;
    options.notes = &own_notes;
    auto meshes = parse_glb(path, bytes, options);
    for (const std::string& note : own_notes) notes.push_back(path + ": " + note);
    return meshes;
  }
  const std::string stem = std::filesystem::path(path).stem().string();
  if (is_3mf_path(path) || is_amf_path(path)) {
    auto parts =
        is_3mf_path(path) ? parse_3mf(path, bytes, &notes) : parse_amf(path, bytes, &notes);
    if (!parts) return parts.error();
    std::vector<TriangleMesh> meshes;
    for (const ModelPart& part : *parts) {
      if (part.goes_on) {
        append(triangulated(part.mesh, false), meshes.back());
        continue;
      }
      meshes.push_back(triangulated(part.mesh, false));
      meshes.back().name = part.name.empty() ? stem : part.name;
    }
    return meshes;
  }
  std::vector<MeshObject> objects;
  auto mesh = parse_mesh(path, bytes, &objects, nullptr, &notes);
  if (!mesh) return mesh.error();
  // STL has no indices: equal coordinates are one point. The others say themselves what is one.
  return parts_of(*mesh, std::move(objects), stem, mesh_format_of(path) == "stl");
}

Failure refused(const std::string& path, const std::string& message) {
  return {kExitScript, message.rfind(path, 0) == 0 ? message : path + ": " + message};
}

Failure measure_drawing(const std::string& path, const std::string& bytes, bool json,
                        std::string& output) {
  auto file = parse_flat(path, bytes, {});
  if (!file) return refused(path, file.error().message);
  const FlatResult part{std::filesystem::path(path).stem().string(), std::move(file->shape)};
  output +=
      json ? flat_info_json(path, part, file->notes) : flat_info_text(path, part, file->notes);
  return {};
}

/// `memory`: the bytes that the process may have.
Failure measure_file(const std::string& path, bool json, size_t memory, std::string& output,
                     std::vector<std::string>& notes) {
  const FileText text = read_whole_file(path);
  if (!text.error.empty())
    return {kExitFiles, fmt::format("csgrun: cannot read '{}': {}", path, text.error)};
  if (!flat_file_format_of(path).empty()) return measure_drawing(path, text.bytes, json, output);
  auto meshes = read_meshes(path, text.bytes, notes);
  if (!meshes) return refused(path, meshes.error().message);
  make_room_for_meshes(HeapPages::kMeasured, memory);
  std::vector<PartMeasures> parts;
  std::vector<std::string> warnings;
  CountedCrossings crossings;
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
    const uint64_t count = count_crossings(mesh);
    crossings.count += count;
    if (count >= kMostCrossings) crossings.at_least = true;
  }
  output += json ? info_json(path, parts, crossings, warnings)
                 : info_text(path, parts, crossings, warnings);
  return {};
}

}  // namespace

bool is_info_path(const std::string& path) {
  return !model_file_format_of(path).empty() || !flat_file_format_of(path).empty();
}

Failure run_info(const std::string& path, bool json, std::string& output,
                 std::vector<std::string>& notes) {
  const size_t memory = default_process_memory();
  limit_process_memory(memory);
  try {
    return measure_file(path, json, memory, output, notes);
  } catch (const std::bad_alloc&) {
    return {kExitGeometry, path + ": not enough memory"};
  }
}

}  // namespace csgrun
