// Meshes from files: STL (ASCII, binary), OFF, OBJ, PLY.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <csgrun/engine/error.h>
#include <csgrun/engine/polygon_mesh.h>
#include <csgrun/engine/repair.h>

namespace csgrun {

/// A named run of the faces of a file, up to the next one's first face.
struct MeshObject {
  std::string name;
  uint32_t first_face = 0;
};

/// A mesh as the file has it: not yet checked for closedness. Polygons stay polygons; STL triangles
/// are welded by equal coordinates. keep_facets is set.
/// `name` is used in messages and its ending chooses the format. Errors: kMalformedFile with the
/// line or byte where reading stopped, kLimit when a count field promises more than the file holds.
/// `objects`, if given, gets the objects of an OBJ that have faces, in the order of the file.
/// `material_files`, if given, gets the material files that an OBJ names; then its faces have
/// appearances with the names of their materials, without a colour (see apply_materials). A
/// material file that is not below the OBJ's folder is an error in any case.
/// Faces of OFF and PLY have the colours that the file gives them, or the mean of those that it
/// gives their corners. `notes`, if given, gets what was done to them: "part.ply: 9000 colours of
/// faces were rounded to 212".
Result<PolygonMesh> parse_mesh(const std::string& name, std::string_view bytes,
                               std::vector<MeshObject>* objects = nullptr,
                               std::vector<std::string>* material_files = nullptr,
                               std::vector<std::string>* notes = nullptr);

/// Faces apart, by the number of the piece of each, from 0 to before `count`: each piece has the
/// points and the appearances that it uses, in the order in which it does. O(n + count).
std::vector<PolygonMesh> split_mesh(const PolygonMesh& mesh,
                                    const std::vector<uint32_t>& piece_of_face, uint32_t count);

/// Reads a regular file (a FIFO, a directory or a device is refused) and parses it.
Result<PolygonMesh> read_mesh_file(const std::string& path);

/// Makes a leaf of a mesh from outside: welds, checks closedness and orientation; a closed mesh
/// that is inside out is turned over, with a note, unless its fill rule is kPositive. What is wrong
/// is an error with counts and first places, and with the repair that would help.
/// Bent faces of four corners are cut as OpenSCAD cuts them where they lie; if there are any,
/// `uncut` gets the mesh without that, and not turned over.
Result<PolygonMesh> make_solid_mesh(PolygonMesh mesh, std::string* note,
                                    PolygonMesh* uncut = nullptr);

/// Makes a leaf of a mesh from outside by repair_mesh; each thing that was done is one of the
/// notes. Notes and errors start with the mesh's kind; errors end with the options that would help.
/// `uncut` as above.
Result<PolygonMesh> repair_solid_mesh(PolygonMesh mesh, const RepairOptions& options,
                                      std::vector<std::string>* notes,
                                      PolygonMesh* uncut = nullptr);

/// "stl", "off", "obj", "ply" or empty: the lower-case ending of a path when it is readable here.
std::string mesh_format_of(const std::string& path);

}  // namespace csgrun
