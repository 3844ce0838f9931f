// One run: MODEL to parts, parts to solids, solids to files.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include <csgrun/engine/evaluate.h>
#include <csgrun/export/write.h>

#include "lua_bindings/cli/exit_codes.h"
#include "lua_bindings/cli/flat_report.h"
#include "lua_bindings/cli/options.h"

namespace csgrun {

/// What --check found in one file.
struct FileCheck {
  std::string file;
  std::vector<MeshCheck> meshes;
};

/// What a run has to tell.
struct RunReport {
  std::vector<Parameter> parameters;  ///< with --list-params
  std::vector<Part> parts;
  std::vector<FlatResult> flat_parts;  ///< instead, when the model is a drawing
  EvaluateStats stats;
  std::vector<std::string> warnings;
  std::vector<FileCheck> checks;  ///< one for each file when --check was given
  bool check_failed = false;      ///< why the run failed: a mesh that could not be repaired
  unsigned threads = 0;
  double script_seconds = 0, export_seconds = 0, total_seconds = 0;
  std::shared_ptr<void> run;  ///< all that it made: a process that ends need not free it
};

/// Runs everything. Files are written whole or not at all.
Failure run_model(const CommandLine& line, RunReport& report);

}  // namespace csgrun
