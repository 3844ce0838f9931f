// Which format, reading the bytes, and what to say when something is wrong. OpenMesh's readers are
// not used: they go through float and abort on bad faces.
#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <utility>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <csgrun/primitives/file_ending.h>
#include <csgrun/primitives/mesh_file.h>

#include "primitives/files/formats.h"
#include "primitives/files/read_file.h"
#include "primitives/solids/bent_quads.h"
#include "primitives/solids/finish_solid.h"

namespace csgrun {

std::string mesh_format_of(const std::string& path) {
  for (const char* known : {"stl", "off", "obj", "ply"}) {
    if (has_ending(path, std::string(".") + known)) return known;
  }
  return {};
}

Error malformed(const std::string& name, const std::string& place, const std::string& what) {
  constexpr std::string_view kLine = "line ";
  std::string message = name;
  if (place.starts_with(kLine)) {
    message += ":" + place.substr(kLine.size());
  } else if (!place.empty()) {
    message += ": " + place;
  }
  message += ": " + what;
  return Error{ErrorCode::kMalformedFile, std::move(message), {}};
}

void note_small_faces(const PassedOver& faces, std::vector<std::string>* notes) {
  if (faces.count == 0 || notes == nullptr) return;
  const std::string which = faces.count == 1 ? "1 face" : std::to_string(faces.count) + " faces";
  notes->push_back(which + " of fewer than three corners left out (first: " + faces.first + ")");
}

std::optional<Error> check_count(const std::string& name, const std::function<std::string()>& place,
                                 std::string_view what, uint64_t count, uint64_t bytes_each,
                                 uint64_t present) {
  if (count <= present / std::max<uint64_t>(bytes_each, 1)) return std::nullopt;
  Error error = malformed(name, place(),
                          std::to_string(count) + " " + std::string(what) + " promised, but only " +
                              std::to_string(present) + " bytes follow");
  error.code = ErrorCode::kLimit;
  return error;
}

namespace {

/// The character, or "\x1a" for what is none to see.
std::string printable(char c) {
  if (c >= ' ' && c <= '~') return {c};
  constexpr std::string_view kDigits = "0123456789abcdef";
  const auto byte = static_cast<unsigned char>(c);
  return {'\\', 'x', kDigits[byte / 16], kDigits[byte % 16]};
}

}  // namespace

std::string quoted(std::string_view word) {
  constexpr size_t kMost = 24;
  std::string text = "\"";
  for (const char c : word.substr(0, kMost)) text += printable(c);
  text += word.size() > kMost ? "...\"" : "\"";
  return text;
}

Result<PolygonMesh> parse_mesh(const std::string& name, std::string_view bytes,
                               std::vector<MeshObject>* objects,
                               std::vector<std::string>* material_files,
                               std::vector<std::string>* notes) {
  const std::string format = mesh_format_of(name);
  if (format.empty()) {
    return Error{ErrorCode::kCannotRead,
                 name + ": not a mesh file: its name must end in .stl, .off, .obj or .ply",
                 {}};
  }
  if (bytes.empty()) return malformed(name, "", "the file is empty");
  std::vector<std::string> own_notes;
  // STL looks for it itself: a binary header is any 80 bytes.
  if (format != "stl" && bytes.starts_with(kByteOrderMark))
    bytes.remove_prefix(kByteOrderMark.size());
  Result<PolygonMesh> mesh = format == "stl"   ? parse_stl(name, bytes, &own_notes)
                             : format == "off" ? parse_off(name, bytes, &own_notes)
                             : format == "obj"
                                 ? parse_obj(name, bytes, objects, material_files, &own_notes)
                                 : parse_ply(name, bytes, &own_notes);
  if (!mesh) return mesh;
  if (mesh->face_count() == 0) {
    std::string what = "has no faces";
    for (const std::string& note : own_notes) what += "; " + note;
    return malformed(name, "", what);
  }
  mesh->kind = name;
  mesh->keep_facets = true;
  if (notes != nullptr) {
    for (const std::string& note : own_notes) notes->push_back(name + ": " + note);
  }
  return mesh;
}

Result<PolygonMesh> read_mesh_file(const std::string& path) {
  const Result<std::string> bytes = read_regular_file(path);
  if (!bytes) return bytes.error();
  return parse_mesh(path, *bytes);
}

Result<PolygonMesh> make_solid_mesh(PolygonMesh mesh, std::string* note, PolygonMesh* uncut) {
  const std::string name = mesh.kind.empty() ? "mesh" : mesh.kind;
  return finish_solid(std::move(mesh), name, note, true, uncut);
}

Result<PolygonMesh> repair_solid_mesh(PolygonMesh mesh, const RepairOptions& options,
                                      std::vector<std::string>* notes, PolygonMesh* uncut) {
  const std::string name = mesh.kind.empty() ? "mesh" : mesh.kind;
  RepairReport report;
  Result<PolygonMesh> repaired = repair_mesh(mesh, options, &report);
  if (!repaired) {
    const std::string& reason = repaired.error().message;
    return Error{
        repaired.error().code, name + ": " + reason + repair_hint(mesh, name, options, reason), {}};
  }
  if (uncut != nullptr && has_bent_quads(*repaired)) *uncut = *repaired;
  cut_bent_quads(*repaired);
  for (const RepairStep& step : report.steps) notes->push_back(name + ": repair: " + step.text());
  return repaired;
}

}  // namespace csgrun
