#include "lua_bindings/model_parts.h"

#include <algorithm>
#include <set>

#include <csgrun/primitives/file_ending.h>
#include <csgrun/primitives/mesh_file.h>

#include "lua_bindings/measure/read_glb.h"

namespace csgrun {
namespace {

PolygonMesh polygon_mesh(TriangleMesh triangles, const std::string& name) {
  PolygonMesh mesh;
  mesh.points = std::move(triangles.points);
  for (const auto& triangle : triangles.triangles) mesh.add_face(triangle);
  const bool has_colours = std::any_of(triangles.appearances.begin(), triangles.appearances.end(),
                                       [](const Appearance& look) { return look != Appearance{}; });
  if (has_colours) {
    mesh.appearance_of = std::move(triangles.appearance_of);
    mesh.appearances = std::move(triangles.appearances);
  }
  mesh.kind = name;
  mesh.keep_facets = true;
  return mesh;
}

Result<std::vector<ModelPart>> read_gltf(const std::string& name, std::string_view bytes,
                                         const ModelPartOptions& options,
                                         std::vector<std::string>* notes) {
  std::vector<std::string> own_notes;
  auto meshes = parse_glb(name, bytes, {GltfFrame::kMillimetres, options.open, &own_notes});
  if (!meshes) return meshes.error();
  for (const std::string& note : own_notes) notes->push_back(name + ": " + note);
  std::vector<ModelPart> parts;
  for (TriangleMesh& mesh : *meshes) {
    if (mesh.triangles.empty()) continue;
    std::string part = mesh.name;
    parts.push_back({std::move(part), polygon_mesh(std::move(mesh), name)});
  }
  if (parts.empty()) return Error{ErrorCode::kMalformedFile, name + ": has no triangles", {}};
  return parts;
}

Result<std::vector<ModelPart>> read_mesh(const std::string& name, std::string_view bytes,
                                         const ModelPartOptions& options,
                                         std::vector<std::string>* notes) {
  std::vector<std::string> material_files;
  auto mesh = parse_mesh(name, bytes, nullptr, options.open ? &material_files : nullptr, notes);
  if (!mesh) return mesh.error();
  for (const std::string& file : material_files) {
    const auto text = options.open(file);
    if (!text) {
      notes->push_back(name + ": no colours: " + text.error().message);
      continue;
    }
    if (Status applied = apply_materials(*mesh, file, *text); !applied) return applied.error();
  }
  const bool has_colours = std::any_of(mesh->appearances.begin(), mesh->appearances.end(),
                                       [](const Appearance& look) { return !look.is_default; });
  if (!has_colours) {
    mesh->appearances.clear();
    mesh->appearance_of.clear();
  }
  return std::vector<ModelPart>{{"", *std::move(mesh)}};
}

/// "a", "a", "b" become "a", "a_2", "b".
void make_names_different(std::vector<ModelPart>& parts) {
  std::set<std::string> taken;
  for (ModelPart& part : parts) {
    if (part.name.empty()) continue;
    const std::string wanted = part.name;
    for (int copy = 2; !taken.insert(part.name).second; ++copy)
      part.name = wanted + "_" + std::to_string(copy);
  }
}

}  // namespace

std::string model_file_format_of(const std::string& path) {
  if (is_3mf_path(path)) return "3mf";
  if (is_amf_path(path)) return "amf";
  for (const char* format : {"glb", "gltf"}) {
    if (has_ending(path, std::string(".") + format)) return format;
  }
  return mesh_format_of(path);
}

Result<std::vector<ModelPart>> read_model_parts(const std::string& name, std::string_view bytes,
                                                const ModelPartOptions& options,
                                                std::vector<std::string>* notes) {
  const std::string format = model_file_format_of(name);
  auto parts = format == "3mf"                       ? parse_3mf(name, bytes, notes)
               : format == "amf"                     ? parse_amf(name, bytes, notes)
               : format == "glb" || format == "gltf" ? read_gltf(name, bytes, options, notes)
                                                     : read_mesh(name, bytes, options, notes);
  if (!parts) return parts;
  for (ModelPart& part : *parts) {
    part.mesh.fill = options.fill;
    std::string note;
    auto solid = options.repair ? repair_solid_mesh(std::move(part.mesh), *options.repair, notes)
                                : make_solid_mesh(std::move(part.mesh), &note);
    if (!solid) {
      Error error = solid.error();
      if (parts->size() > 1) error.message += " (part '" + part.name + "')";
      return error;
    }
    if (!note.empty()) notes->push_back(note);
    part.mesh = *std::move(solid);
  }
  make_names_different(*parts);
  return parts;
}

}  // namespace csgrun
