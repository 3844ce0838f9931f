// Model files of several parts: 3MF, AMF; and the materials of OBJ.
#pragma once

#include <functional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include <csgrun/engine/error.h>
#include <csgrun/engine/polygon_mesh.h>

namespace csgrun {

/// One thing in a model file, where the file puts it, in millimetres: not yet checked for
/// closedness. Faces have the colours that the file gives them, or none.
struct ModelPart {
  std::string name;  ///< may be empty, or that of another part as well
  PolygonMesh mesh;
  bool goes_on = false;  ///< not a part of its own: united with the one before, of the same name
};

/// Whether the numbers of a file are in the unit that it names, or millimetres whatever it names,
/// as OpenSCAD takes them.
enum class FileUnit { kNamed, kMillimetre };

/// The parts that a 3MF file builds, in its order: units, transforms, components, base materials
/// and colours are understood, in one document or several. `name` stands in messages. `notes` gets
/// what is not read, though it may be a solid, and when colours were rounded to 4096 at most.
/// Errors: kMalformedFile; kLimit for what unpacks, or multiplies by components, to more than a
/// model would.
Result<std::vector<ModelPart>> parse_3mf(const std::string& name, std::string_view bytes,
                                         std::vector<std::string>* notes = nullptr,
                                         FileUnit unit = FileUnit::kNamed);

/// Whether a path ends in .3mf, in letters of any case.
bool is_3mf_path(const std::string& path);

/// The parts of an AMF file, plain or in an archive: its objects and constellations, each object of
/// a constellation in its place there; units and colours are understood. Where an object has
/// several volumes, each closed, these are meshes that go on. `name` stands in messages.
/// `notes` (may be null) gets what was passed over. Errors as those of parse_3mf.
Result<std::vector<ModelPart>> parse_amf(const std::string& name, std::string_view bytes,
                                         std::vector<std::string>* notes,
                                         FileUnit unit = FileUnit::kNamed);

/// Whether a path ends in .amf, in letters of any case.
bool is_amf_path(const std::string& path);

/// Gives the appearances of an OBJ's mesh, which have the names of its materials, what a material
/// file says of these: Kd, d or Tr, Pm, Pr. Others stay. `known` gets the names of all that the
/// file describes. Errors: kMalformedFile with the line.
Status apply_materials(PolygonMesh& mesh, const std::string& name, std::string_view mtl,
                       std::set<std::string, std::less<>>* known = nullptr);

/// Whether it is what our own files call the look of faces that have none: "default", and in its
/// colour, to the bytes that files have. Other programs' materials of that name have another.
bool is_named_default(const Appearance& look);

}  // namespace csgrun
