// The command line as data.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <csgrun/engine/evaluate.h>
#include <csgrun/primitives/solids.h>

#include "lua_bindings/parameters.h"

namespace csgrun {

enum class Command : uint8_t { kRun, kInfo, kHelpApi, kInit, kDone };
enum class ApiForm : uint8_t { kText, kMarkdown, kDefinitions, kJson };
enum class StatsForm : uint8_t { kNone, kText, kJson };

struct CommandLine {
  Command command = Command::kRun;
  ApiForm api_form = ApiForm::kText;
  int exit_code = 0;  ///< for kDone: help, version, or a usage error that was told already
  std::string model;
  std::vector<std::string> outputs;
  std::vector<Definition> definitions;       ///< of -p, then those of -D
  bool list_params = false;                  ///< print what the model asks for, and no more
  std::vector<std::string> library_folders;  ///< -L, then CSGRUN_PATH
  Facets facets;
  unsigned threads = 0;
  GridStep grid;
  StatsForm stats = StatsForm::kNone;
  std::optional<double> timeout_seconds;
  std::optional<size_t> memory_bytes;
  bool check = false;         ///< prove every written mesh free of defects, or repair it
  bool system_fonts = false;  ///< text may use the fonts of the machine
  bool strict = false;        ///< what would be replaced with a warning is an error
  bool quiet = false;
  DiskCacheOptions disk_cache;
  bool info_json = false;
};

/// Whether the path names an OpenSCAD tree.
bool is_csg_path(const std::string& path);

/// Reads the command line; usage errors are told on standard error.
CommandLine parse_command_line(int argc, char** argv);

}  // namespace csgrun
