// The meshes that an import() of a tree reads.
#pragma once

#include <string>
#include <vector>

#include <csgrun/engine/error.h>
#include <csgrun/primitives/model_file.h>

namespace csgrun {

/// The parts of a file of meshes, one if it has no parts, in millimetres, whatever unit it says;
/// with the middle of their box at the origin if they are to be centred. Appends what a reader of
/// the file should know to `notes`. Errors as of the file's format.
Result<std::vector<ModelPart>> csg_import_parts(const std::string& path, const std::string& bytes,
                                                bool center, std::vector<std::string>& notes);

}  // namespace csgrun
