// Writing models: GLB, glTF, STL, OBJ, OFF, exact JSON. A file is complete or not there at all.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
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

/// What can be wrong with a mesh after rounding; each is found exactly.
struct MeshDefects {
  uint64_t crossings = 0;   ///< pairs of triangles that meet in more than corners and edges of both
  uint64_t degenerate = 0;  ///< triangles whose corners lie on one line
  uint64_t flipped = 0;     ///< triangles turned by more than 90 degrees from their exact face
  [[nodiscard]] bool none() const { return crossings == 0 && degenerate == 0 && flipped == 0; }
};

enum class DefectKind : uint8_t { kCrossing, kDegenerate, kFlipped };

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
  MeshDefects found;  ///< as rounded
  MeshDefects left;   ///< after the last round of repair
  std::vector<DefectPlace>
      places;           ///< of the first of those found, or of those left when it failed
  unsigned rounds = 0;  ///< of repair
  uint64_t moved = 0;   ///< vertices that repair snapped to a coarser lattice
  unsigned unions = 0;  ///< self-unions that it took
  std::array<uint64_t, 2> triangles{};  ///< as rounded, as written
  std::array<double, 2> volume{};       ///< mm^3, likewise
  std::string problem;                  ///< why repair stopped before its last round, if it did
};

struct WriteOptions {
  /// Proves every mesh free of defects, as it is written; what is not is repaired if it can be.
  /// Polygons that rounding bent are written as triangles.
  bool check = false;
  unsigned threads = 0;                       ///< for repairs; 0: as many as the process may use
  const std::atomic<bool>* cancel = nullptr;  ///< as in EvaluateOptions
};

struct WriteReport {
  std::vector<std::string> warnings;  ///< what rounding to the file's precision did, counted
  std::vector<MeshCheck> checks;      ///< one for each mesh, when asked for
};

/// One of the files of a model, complete.
struct ModelFile {
  std::string path, bytes;
};

/// "glb", "gltf", "stl", "obj", "off", "exact.json" or empty when the ending of `path` is none of
/// these.
std::string model_format_of(const std::string& path);

/// Whether the format keeps parts apart; the others want one solid (the caller makes the union).
bool keeps_parts(const std::string& format);

/// The files of a model, in the order in which they must be there: an .obj after its .mtl. A mesh
/// that failed its check is in them all the same: ask the report before writing. Errors:
/// kCancelled, kLimit, kInternal, kOutOfRange.
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
