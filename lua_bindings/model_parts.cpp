#include "lua_bindings/model_parts.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <set>
#include <sstream>
#include <utility>

#include <csgrun/engine/validate.h>
#include <csgrun/primitives/file_ending.h>
#include <csgrun/primitives/file_path.h>
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

/// Whether a mesh is a solid by itself, and no void of another.
bool is_solid(PolygonMesh mesh) {
  weld_points(mesh);
  const MeshReport report = check_mesh(mesh);
  return report.open_edges == 0 && report.misoriented_edges == 0 && signed_volume(mesh) > 0;
}

/// The objects of a file as parts of their names, where each is a solid. Others are surfaces of one
/// solid; and rules other than "nonzero" say what is inside of all objects together.
std::vector<ModelPart> objects_of(PolygonMesh mesh, std::vector<MeshObject> objects,
                                  FillRule fill) {
  if (!objects.empty() && objects[0].first_face > 0) objects.insert(objects.begin(), {"", 0});
  std::vector<ModelPart> parts;
  if (objects.size() > 1 && fill == FillRule::kNonZero) {
    std::vector<uint32_t> object_of;
    for (uint32_t o = 0; o < objects.size(); ++o) {
      const bool is_last = o + 1 == objects.size();
      object_of.resize(is_last ? mesh.face_count() : objects[o + 1].first_face, o);
    }
    std::vector<PolygonMesh> meshes =
        split_mesh(mesh, object_of, static_cast<uint32_t>(objects.size()));
    if (std::all_of(meshes.begin(), meshes.end(), is_solid)) {
      for (size_t o = 0; o < objects.size(); ++o)
        parts.push_back({objects[o].name, std::move(meshes[o])});
      return parts;
    }
  }
  parts.push_back({objects.size() == 1 ? objects[0].name : "", std::move(mesh)});
  return parts;
}

/// The files of one mtllib statement with their bytes: it may name several, and one may have blanks
/// in its name. What cannot be read is noted.
std::vector<std::pair<std::string, std::string>> open_materials(const std::string& name,
                                                                const std::string& statement,
                                                                const ModelPartOptions& options,
                                                                std::vector<std::string>* notes) {
  auto whole = options.open(statement);
  if (whole) return {{statement, *std::move(whole)}};
  std::istringstream words(statement);
  std::vector<std::string> files{std::istream_iterator<std::string>(words), {}};
  const bool has_several = files.size() > 1 && std::all_of(files.begin(), files.end(), [](auto& f) {
                             return f.ends_with(".mtl") && !leads_out_of_folder(f);
                           });
  if (!has_several) files = {statement};
  std::vector<std::pair<std::string, std::string>> found;
  for (const std::string& file : files) {
    auto text = has_several ? options.open(file) : whole;
    if (text) {
      found.emplace_back(file, *std::move(text));
    } else {
      notes->push_back(name + ": no colours: " + text.error().message);
    }
  }
  return found;
}

/// Notes the materials that faces have and no file describes.
void note_unknown_materials(const std::string& name, const PolygonMesh& mesh,
                            const std::set<std::string, std::less<>>& known,
                            std::vector<std::string>* notes) {
  size_t count = 0;
  std::string first;
  for (const Appearance& look : mesh.appearances) {
    if (look.name.empty() || known.contains(look.name)) continue;
    if (count++ == 0) first = look.name;
  }
  if (count == 0) return;
  notes->push_back(name + ": no colours: " +
                   (count == 1
                        ? "the material '" + first + "' is"
                        : std::to_string(count) + " materials, the first '" + first + "', are") +
                   " in none of its material files");
}

Result<std::vector<ModelPart>> read_mesh(const std::string& name, std::string_view bytes,
                                         const ModelPartOptions& options,
                                         std::vector<std::string>* notes) {
  std::vector<std::string> material_files;
  std::vector<MeshObject> objects;
  auto mesh = parse_mesh(name, bytes, &objects, options.open ? &material_files : nullptr, notes);
  if (!mesh) return mesh.error();
  std::set<std::string, std::less<>> known{"default"};
  const size_t notes_before = notes->size();
  for (const std::string& statement : material_files) {
    for (const auto& [file, text] : open_materials(name, statement, options, notes)) {
      if (Status applied = apply_materials(*mesh, file, text, &known); !applied)
        return applied.error();
    }
  }
  // What cannot be read may have described them.
  if (!material_files.empty() && notes->size() == notes_before)
    note_unknown_materials(name, *mesh, known, notes);
  const bool has_colours = std::any_of(mesh->appearances.begin(), mesh->appearances.end(),
                                       [](const Appearance& look) { return !look.is_default; });
  if (!has_colours) {
    mesh->appearances.clear();
    mesh->appearance_of.clear();
  }
  return objects_of(*std::move(mesh), objects, options.fill);
}

/// "a", "a", "b" become "a", "a_2", "b".
void make_names_different(std::vector<ModelPart>& parts) {
  std::set<std::string> taken;
  std::map<std::string, int> copies;  // by the wanted name: where to go on, for many of one name
  for (ModelPart& part : parts) {
    if (part.name.empty() || part.goes_on) continue;
    if (taken.insert(part.name).second) continue;
    int& copy = copies.try_emplace(part.name, 2).first->second;
    const std::string wanted = part.name;
    do {
      part.name = wanted + "_" + std::to_string(copy++);
    } while (!taken.insert(part.name).second);
  }
}

/// A name that a part can have: they become those of nodes and of files, where "/" makes groups.
/// Empty when nothing is left of it.
std::string clean_name(const std::string& name) {
  constexpr size_t kLongest = 180;  // parts have 200 bytes, some of them for a number
  std::string clean;
  for (size_t start = 0; start <= name.size();) {
    const size_t end = std::min(name.find('/', start), name.size());
    std::string piece = name.substr(start, end - start);
    start = end + 1;
    if (piece.empty() || piece == "." || piece == "..") continue;
    for (char& c : piece) {
      const auto byte = static_cast<unsigned char>(c);
      if (byte < 32 || byte == 127 || c == '\\') c = '_';
    }
    clean += (clean.empty() ? "" : "/") + piece;
  }
  if (clean.size() <= kLongest) return clean;
  size_t end = kLongest;  // not within a letter of UTF-8
  while (end > 0 && (static_cast<unsigned char>(clean[end]) & 0xc0) == 0x80) --end;
  clean.resize(end);
  while (clean.ends_with('/')) clean.pop_back();
  return clean;
}

void clean_names(const std::string& file, std::vector<ModelPart>& parts,
                 std::vector<std::string>* notes) {
  size_t count = 0;
  std::string first;
  for (ModelPart& part : parts) {
    std::string clean = clean_name(part.name);
    if (clean == part.name) continue;
    if (count++ == 0) first = clean;
    part.name = std::move(clean);
  }
  if (count == 0) return;
  notes->push_back(
      file + ": " +
      (count == 1 ? "1 name of a part is" : std::to_string(count) + " names of parts are") +
      " changed to what parts can be called" + (first.empty() ? "" : " (first: '" + first + "')"));
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

std::vector<SolidPart> solid_parts_of(std::vector<ModelPart> parts, const SourceRef& where,
                                      const std::function<NodePtr(PolygonMesh)>& leaf) {
  std::vector<SolidPart> result;
  std::vector<NodePtr> leaves;  // of the part that is being made
  for (size_t i = 0; i < parts.size(); ++i) {
    leaves.push_back(leaf(std::move(parts[i].mesh)));
    if (i + 1 < parts.size() && parts[i + 1].goes_on) continue;
    const bool is_one = leaves.size() == 1;
    // Parts that go on have the name of the first of them, or none.
    result.push_back({parts[i + 1 - leaves.size()].name,
                      is_one ? leaves[0] : Node::boolean(BooleanOp::kUnion, leaves, where)});
    leaves.clear();
  }
  return result;
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
  clean_names(name, *parts, notes);
  make_names_different(*parts);
  return parts;
}

}  // namespace csgrun
