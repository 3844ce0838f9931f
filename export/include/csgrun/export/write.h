// Writing models: GLB, glTF, STL, 3MF, OBJ, OFF, PLY, exact JSON. A file is complete or not there
// at all.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

#include <csgrun/engine/csg_tree.h>
#include <csgrun/engine/error.h>
#include <csgrun/engine/solid.h>

namespace csgrun {

/// One named part of a model: a solid in its place. Parts may share a solid.
struct Part {
  std::string name;  ///< may have groups: "case/lid"
  SolidPtr solid;
  Affine placement;  ///< identity unless parts share one solid at several places
};

/// More crossings of one mesh than this are not looked for.
constexpr uint64_t kMostCrossings = 1'000'000;

/// What can be wrong with a mesh after rounding; each is found exactly.
struct MeshDefects {
  /// Pairs of triangles that meet in more than corners and edges of both; kMostCrossings stands for
  /// "at least so many".
  uint64_t crossings = 0;
  uint64_t degenerate = 0;  ///< triangles whose corners lie on one line
  uint64_t flipped = 0;     ///< triangles turned by more than 90 degrees from their exact face
  /// Connected surfaces with a winding number other than 0 in front: turned inside out, or on the
  /// wrong side of another. Looked for where nothing crosses.
  uint64_t inverted = 0;
  [[nodiscard]] bool none() const {
    return crossings == 0 && degenerate == 0 && flipped == 0 && inverted == 0;
  }
};

enum class DefectKind : uint8_t { kCrossing, kDegenerate, kFlipped, kInverted, kVanished };

struct DefectPlace {
  DefectKind kind{};
  glm::dvec3 at{};                   ///< mm, in the mesh's own coordinates
  std::vector<std::string> sources;  ///< what made the triangles: "cube, model.lua:3"
};

enum class CheckVerdict : uint8_t { kClean, kRepaired, kFailed };

/// What the check found in one mesh of a file, and did about it.
struct MeshCheck {
  std::string part;  ///< the first part that shows the mesh
  CheckVerdict verdict = CheckVerdict::kClean;
  MeshDefects found;                ///< as rounded
  MeshDefects left;                 ///< after the last round of repair
  std::vector<DefectPlace> places;  ///< of the first of those found of each kind
  unsigned rounds = 0;              ///< of repair
  uint64_t moved = 0;               ///< vertices that repair snapped to a lattice, or merged
  unsigned unions = 0;              ///< self-unions that it took
  /// mm: no point of the surface is farther from the solid's, rounding and repair together.
  double distance = 0;
  /// Connected surfaces of the solid of which nothing is left: bodies, or voids.
  uint64_t vanished = 0;
  /// mm: twice the volume that each of those enclosed, divided by its area, is at most this.
  double thickness = 0;
  std::array<uint64_t, 2> triangles{};  ///< as rounded, as written
  std::array<double, 2> volume{};       ///< mm^3, likewise
  std::string problem;  ///< why repair gave up, if it did before its rounds were used up
};

struct WriteOptions {
  /// Proves every mesh free of defects, as it is written; what is not is repaired if it can be.
  /// Polygons that rounding bent are written as triangles.
  bool check = false;
  unsigned threads = 0;  ///< for checks and repairs; 0: as many as the process may use
  const std::atomic<bool>* cancel = nullptr;  ///< as in EvaluateOptions
  /// Called before each round of a mesh's repair: its number, from 1 on, and how many places are
  /// wrong.
  std::function<void(unsigned, size_t)> repairing;
};

struct WriteReport {
  std::vector<std::string> warnings;  ///< what rounding to the file's precision did, counted
  std::vector<MeshCheck> checks;      ///< one for each mesh, when asked for
};

/// One of the files of a model, complete.
struct ModelFile {
  std::string path, bytes;
};

/// "glb", "gltf", "stl", "3mf", "obj", "off", "ply", "exact.json" or empty when the ending of
/// `path` is none of these.
std::string model_format_of(const std::string& path);

/// Whether the format keeps parts apart; the others want one solid (the caller makes the union).
bool keeps_parts(const std::string& format);

/// The files of a model, in the order in which they must be there: an .obj after its .mtl. A mesh
/// that failed its check is in them all the same: ask the report before writing. Errors:
/// kInvalidArgument (an unknown ending, several parts for a format of one, a part without a solid;
/// for exact JSON one with a placement, or without Solid::exact_points), kCancelled, kLimit,
/// kInternal, kOutOfRange.
Result<std::vector<ModelFile>> encode_files(const std::string& path, const std::vector<Part>& parts,
                                            const WriteOptions& options, WriteReport& report);

/// Writes files to temporary ones beside them, all of them, then renames. Errors: kCannotWrite.
Status write_files(const std::vector<ModelFile>& files);

/// encode_files and write_files without a check. Writes to a temporary file beside `path`, then
/// renames. Errors: kCannotWrite with the system's reason; the temporary file is removed. An .obj
/// writes its .mtl first.
Result<WriteReport> write_model(const std::string& path, const std::vector<Part>& parts);

/// The bytes of a file, for tests and for standard output.
Result<std::string> encode_model(const std::string& format, const std::vector<Part>& parts,
                                 WriteReport& report);

/// Removes temporary files of writes that are under way; async-signal-safe. For the watchdog.
void remove_temporary_files();

}  // namespace csgrun
