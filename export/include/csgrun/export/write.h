// Writing models: GLB, glTF, STL, OBJ, OFF. A file is complete or not there at all.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

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

struct WriteReport {
  std::vector<std::string> warnings;  ///< what rounding to the file's precision did, counted
};

/// "glb", "gltf", "stl", "obj", "off" or empty when the ending of `path` is none of these.
std::string model_format_of(const std::string& path);

/// Whether the format keeps parts apart; the others want one solid (the caller makes the union).
bool keeps_parts(const std::string& format);

/// Writes to a temporary file beside `path`, then renames. Errors: kCannotWrite with the system's
/// reason; the temporary file is removed. An .obj writes its .mtl first.
Result<WriteReport> write_model(const std::string& path, const std::vector<Part>& parts);

/// The bytes of a file, for tests and for standard output.
Result<std::string> encode_model(const std::string& format, const std::vector<Part>& parts,
                                 WriteReport& report);

/// Removes temporary files of writes that are under way; async-signal-safe. For the watchdog.
void remove_temporary_files();

}  // namespace csgrun
