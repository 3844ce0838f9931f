// What --check found, in words and as JSON.
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "lua_bindings/cli/run_model.h"

namespace csgrun {

/// One line about a mesh that was repaired, or could not be, or lost something: what was found,
/// where, what became of it.
std::string check_text(const MeshCheck& check);

/// The list of --stats=json: an object for each file, with one for each of its meshes.
nlohmann::ordered_json check_json(const std::vector<FileCheck>& checks);

/// "clean", "repaired", "failed": the worst of a file's meshes; "exact" of a file that holds
/// fractions, whose meshes there is no need to check.
const char* verdict_text(const FileCheck& check);

}  // namespace csgrun
