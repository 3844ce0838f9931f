// Parameters as JSON: the files of -p, and the schema of --list-params.
#pragma once

#include <string>
#include <vector>

#include <csgrun/engine/error.h>

#include "lua_bindings/parameters.h"

namespace csgrun {

/// The values of a file of parameters. It holds either names and values, {"size": 3, "label": "x"},
/// or sets of these as OpenSCAD's customizer writes them: {"parameterSets": {"large": {...}}}; then
/// `set` says which, and may be empty if there is only one. Errors: kCannotRead, kMalformedFile,
/// kInvalidArgument (no such set), each with the file's name.
Result<std::vector<Definition>> read_parameter_file(const std::string& path,
                                                    const std::string& set);

/// A JSON schema (draft 2020-12) of a table with these parameters, in the order in which the model
/// asked for them. What JSON has no word for stands as "x-step".
std::string parameters_json(const std::string& model, const std::vector<Parameter>& parameters);

}  // namespace csgrun
