// Arguments of .csg calls, and the primitives and extrusions made from them.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include <csgrun/engine/csg_tree.h>
#include <csgrun/primitives/flat_file.h>
#include <csgrun/primitives/mesh_file.h>
#include <csgrun/primitives/roof.h>
#include <csgrun/primitives/shape2d.h>
#include <csgrun/primitives/shape_operations.h>
#include <csgrun/primitives/solids.h>
#include <csgrun/primitives/text.h>

#include "primitives/files/csg_parser.h"

namespace csgrun {

/// Typed access to the arguments of one call. A missing argument gives the default; one of the
/// wrong type is remembered as an error.
class CsgArguments {
 public:
  explicit CsgArguments(const CsgCall& call) : call_(call) {}

  double number(std::string_view name, double otherwise);
  bool boolean(std::string_view name, bool otherwise);
  std::string string(std::string_view name, const std::string& otherwise);
  /// Exactly `size` numbers.
  std::vector<double> numbers(std::string_view name, size_t size, std::vector<double> otherwise);
  /// The same, or one number that is all of them.
  std::vector<double> size(std::string_view name, size_t size);
  /// A radius, or half a diameter, which counts before it.
  double radius(std::string_view r, std::string_view d, double otherwise);
  std::vector<std::vector<double>> rows(std::string_view name, size_t row_size);
  /// Lists of indices; those that are not below `limit` are left out, with a warning.
  std::vector<std::vector<uint32_t>> index_lists(std::string_view name, size_t limit,
                                                 std::vector<std::string>& warnings);
  /// $fn, $fa, $fs and $fe. A $fn above kMostFacets is an error (kLimit).
  Facets facets();
  /// The argument m as a 4x4 matrix.
  std::optional<Affine> matrix();
  [[nodiscard]] bool has(std::string_view name) const { return call_.find(name) != nullptr; }

  /// What was wrong with the arguments asked for so far.
  [[nodiscard]] const std::optional<Error>& error() const { return error_; }

 private:
  void wrong_type(std::string_view name, const std::string& wanted);
  /// What OpenSCAD takes, and makes nothing of.
  void impossible(std::string_view name, const std::string& wanted);

  const CsgCall& call_;
  std::optional<Error> error_;
};

/// What the least repair that fills no hole makes of a mesh that was refused, with what it did
/// among the notes: nobody can ask for one in a .csg file. Where none helps, the refusal.
/// `uncut` as of repair_solid_mesh.
Result<PolygonMesh> repaired_or(Result<PolygonMesh> refused, PolygonMesh given,
                                std::vector<std::string>& notes, PolygonMesh* uncut);

bool is_solid_primitive(std::string_view name);
bool is_flat_primitive(std::string_view name);

/// `warnings` gets what was left out. An impossible size is a kInvalidArgument. With `open`, the
/// faces of a polyhedron that is refused (kInvalidMesh) go there as they are given, where they are
/// not repaired. `uncut` gets the mesh before its bent faces were cut, if it has any.
MeshResult make_csg_solid(const CsgCall& call, std::vector<std::string>& warnings,
                          PolygonMesh& uncut, PolygonMesh* open = nullptr);
Result<Shape2D> make_csg_shape(const CsgCall& call, std::vector<std::string>& warnings);
/// The arguments of import.
struct CsgImport {
  std::string file;
  FlatFileOptions options;
};
Result<CsgImport> csg_import(const CsgCall& call);

/// The arguments of text, and the description of its font, without its features.
struct CsgText {
  TextOptions options;
  std::string font;
  bool upside_down = false;  ///< the size was negative: half a turn is to be made
};
/// Alignments and directions that there are not are those of no argument, as in OpenSCAD:
/// `warnings` says so.
Result<CsgText> csg_text(const CsgCall& call, std::vector<std::string>& warnings);

/// The arguments of offset: `r` counts before `delta`.
Result<OffsetOptions> csg_offset(const CsgCall& call);

/// The arguments of resize; lengths that are not positive are 0.
struct CsgResize {
  std::array<double, 3> newsize{};
  std::array<bool, 3> automatic{};
};
Result<CsgResize> csg_resize(const CsgCall& call);

/// The argument of color; nothing if it names no colour.
Result<std::optional<Appearance>> csg_color(const CsgCall& call);

/// The arguments of roof. OpenSCAD takes methods that it does not know for "voronoi": `warnings`
/// says so.
Result<RoofOptions> csg_roof(const CsgCall& call, std::vector<std::string>& warnings);

/// linear_extrude and rotate_extrude, made at `where`.
Result<NodePtr> extrude_csg(const CsgCall& call, const Shape2D& shape, const SourceRef& where);

}  // namespace csgrun
