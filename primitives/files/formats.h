// One parser a format. All fill a PolygonMesh whose kind is the file's name.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <csgrun/engine/error.h>
#include <csgrun/engine/polygon_mesh.h>
#include <csgrun/primitives/mesh_file.h>

namespace csgrun {

/// What stands before UTF-8, which every text may be.
constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";

Result<PolygonMesh> parse_stl(const std::string& name, std::string_view bytes,
                              std::vector<std::string>* notes);
Result<PolygonMesh> parse_off(const std::string& name, std::string_view bytes,
                              std::vector<std::string>* notes);
Result<PolygonMesh> parse_obj(const std::string& name, std::string_view bytes,
                              std::vector<MeshObject>* objects,
                              std::vector<std::string>* material_files,
                              std::vector<std::string>* notes);
Result<PolygonMesh> parse_ply(const std::string& name, std::string_view bytes,
                              std::vector<std::string>* notes);

/// What is passed over: how often, and where it was first.
struct PassedOver {
  uint64_t count = 0;
  std::string first;

  void add(std::string place) {
    if (count++ == 0) first = std::move(place);
  }
};

/// Notes faces of fewer than three corners, if there were any: they bound nothing.
void note_small_faces(const PassedOver& faces, std::vector<std::string>* notes);

/// "part.obj:12: face index 9 is out of range, there are 8 points" for the place "line 12";
/// "part.stl: facet 3: ..." for any other.
Error malformed(const std::string& name, const std::string& place, const std::string& what);

/// An error if `count` records of at least `bytes_each` cannot be in the `present` bytes that are
/// left: asked before any memory is set aside for them. `place` tells where they are, if they
/// cannot.
std::optional<Error> check_count(const std::string& name, const std::function<std::string()>& place,
                                 std::string_view what, uint64_t count, uint64_t bytes_each,
                                 uint64_t present);

/// A word for a message: short, printable.
std::string quoted(std::string_view word);

}  // namespace csgrun
