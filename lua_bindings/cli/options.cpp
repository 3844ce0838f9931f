// The only file that sees CLI11.
#include "lua_bindings/cli/options.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <csgrun/export/write.h>
#include <csgrun/export/write_flat.h>
#include <csgrun/primitives/flat_file.h>

#include "lua_bindings/arguments.h"
#include "lua_bindings/cli/exit_codes.h"
#include "lua_bindings/cli/info.h"
#include "lua_bindings/cli/parameter_file.h"
#include "lua_bindings/files.h"
#include "lua_bindings/model_parts.h"
#include "lua_bindings/nearest.h"

namespace csgrun {
namespace {

constexpr unsigned kMostThreads = 1024;
constexpr double kLeastMegabytes = 16;

/// A usage error: what is wrong, in one sentence.
struct UsageError {
  std::string message;
};

/// The ending of a path with its dot, in lower case; empty if it has none.
std::string ending_of(const std::string& path) {
  std::string ending = std::filesystem::path(path).extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(), [](char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  });
  return ending;
}

void check_output(const std::string& path, const CommandLine& line) {
  const size_t first = path.find("%s");
  if (first != std::string::npos && path.find("%s", first + 1) != std::string::npos) {
    throw UsageError{
        fmt::format("'{}': %s, the place of the part's name, can stand there only once", path)};
  }
  if (model_format_of(path).empty() && flat_format_of(path).empty()) {
    throw UsageError{fmt::format(
        "'{}': the ending must be one of .glb, .gltf, .stl, .3mf, .obj, .off, .ply, .exact.json, "
        ".svg, .dxf",
        path)};
  }
  if (path[0] == '=') {  // that of a short option is part of the value
    throw UsageError{fmt::format("-o{}: write -o {}", path, path.substr(1))};
  }
  const auto plain = [](const std::string& output) {
    return std::filesystem::path(output).lexically_normal();
  };
  if (std::count_if(line.outputs.begin(), line.outputs.end(),
                    [&](const std::string& other) { return plain(other) == plain(path); }) > 1) {
    throw UsageError{fmt::format("'{}' is given twice with -o", path)};
  }
  if (is_same_file(path, line.model)) {
    throw UsageError{fmt::format("'{}' is the model itself and would be overwritten", path)};
  }
}

void check_model(const std::string& model) {
  if (model == "-" || !model_file_format_of(model).empty() || !flat_file_format_of(model).empty())
    return;
  const std::string ending = ending_of(model);
  if (ending == ".scad") {
    throw UsageError{fmt::format(
        "'{}' is OpenSCAD's language; OpenSCAD makes a tree of it: openscad '{}' -o out.csg", model,
        model)};
  }
  if (ending != ".lua" && ending != ".csg") {
    throw UsageError{
        fmt::format("'{}': the model must end in .lua, .csg, .stl, .off, .obj, .ply, .glb, .gltf, "
                    ".3mf, .amf, .svg "
                    "or .dxf, or be - for Lua from standard input",
                    model)};
  }
}

Definition split_definition(const std::string& text) {
  const size_t equals = text.find('=');
  if (equals == std::string::npos || equals == 0) {
    throw UsageError{fmt::format("-D {}: write it as -D name=value", text)};
  }
  Definition definition;
  definition.name = text.substr(0, equals);
  if (definition.name == "$fn" || definition.name == "$fa" || definition.name == "$fs") {
    throw UsageError{fmt::format("-D {}: the facets are not a parameter; write --{} {}", text,
                                 definition.name.substr(1), text.substr(equals + 1))};
  }
  definition.text = text.substr(equals + 1);
  return definition;
}

/// What the options are read into before they are checked.
struct RawOptions {
  std::vector<std::string> definitions;
  std::string parameter_file, parameter_set;
  std::string grid, stats, cache_folder;
  double timeout = 0, megabytes = 0;
  bool no_cache = false, init = false;
  std::string help_api;
};

/// Where intermediate meshes are kept: in the folder that was asked for, or where the system has
/// such things for this user.
DiskCacheOptions disk_cache(const std::string& folder) {
  DiskCacheOptions options;
  if (!folder.empty()) {
    options.folder = folder;
    options.least_seconds = 0;
    options.warn_if_unusable = true;
    return options;
  }
  // As the XDG base directory specification has it: a path that is not absolute does not count.
  const auto is_absolute = [](const char* path) { return path != nullptr && path[0] == '/'; };
  if (const char* cache = std::getenv("XDG_CACHE_HOME"); is_absolute(cache)) {
    options.folder = std::string(cache) + "/csgrun";
  } else if (const char* home = std::getenv("HOME"); is_absolute(home)) {
    options.folder = std::string(home) + "/.cache/csgrun";
  }
  return options;
}

void check_all(CommandLine& line, const RawOptions& raw, const CLI::App& app) {
  check_model(line.model);
  for (const std::string& path : line.outputs) check_output(path, line);
  if (raw.parameter_file.empty() && !raw.parameter_set.empty())
    throw UsageError{"-P names a set in a file: give the file with -p"};
  if (!raw.parameter_file.empty()) {
    auto set = read_parameter_file(raw.parameter_file, raw.parameter_set);
    if (!set) throw UsageError{set.error().message};
    line.definitions = *std::move(set);
  }
  for (const std::string& text : raw.definitions)
    line.definitions.push_back(split_definition(text));
  for (const std::string& folder : line.library_folders) {
    std::error_code unreadable;
    if (!std::filesystem::is_directory(folder, unreadable))
      throw UsageError{fmt::format("-L {}: there is no such folder", folder)};
  }
  if (const char* path = std::getenv("CSGRUN_PATH")) {
    for (const char* start = path; *start != '\0';) {
      const char* end = std::strchr(start, ':');
      if (end == nullptr) end = start + std::strlen(start);
      if (end != start) line.library_folders.emplace_back(start, end);
      start = *end == ':' ? end + 1 : end;
    }
  }
  if (const std::string problem = check_facets(line.facets); !problem.empty())
    throw UsageError{"--" + problem};
  if (app.count("--threads") > 0 && (line.threads < 1 || line.threads > kMostThreads)) {
    throw UsageError{fmt::format("--threads must be from 1 to {}", kMostThreads)};
  }
  if (!raw.grid.empty()) {
    const auto step = GridStep::parse(raw.grid);
    if (!step) throw UsageError{"--grid " + raw.grid + ": " + step.error().message};
    line.grid = *step;
  }
  if (!raw.stats.empty()) {
    if (raw.stats != "text" && raw.stats != "json")
      throw UsageError{"--stats can be =json or nothing"};
    line.stats = raw.stats == "json" ? StatsForm::kJson : StatsForm::kText;
  }
  if (app.count("--timeout") > 0) {
    // More is no time that a clock has, and would be over at once.
    constexpr double kMostSeconds = 1e9;
    if (!(raw.timeout > 0 && raw.timeout <= kMostSeconds)) {
      throw UsageError{
          fmt::format("--timeout must be a positive number of seconds, at most {:g}, got {:g}",
                      kMostSeconds, raw.timeout)};
    }
    line.timeout_seconds = raw.timeout;
  }
  if (app.count("--max-memory") > 0) {
    constexpr double kMostMegabytes = 1e9;
    if (!(raw.megabytes >= kLeastMegabytes && raw.megabytes <= kMostMegabytes)) {
      throw UsageError{fmt::format("--max-memory must be from {:g} to {:g} (MB), got {:g}",
                                   kLeastMegabytes, kMostMegabytes, raw.megabytes)};
    }
    line.memory_bytes = static_cast<size_t>(raw.megabytes * 1048576.0);
  }
  if (app.count("--cache-dir") > 0 && raw.cache_folder.empty())
    throw UsageError{"--cache-dir needs the name of a folder"};
  if (!raw.no_cache) line.disk_cache = disk_cache(raw.cache_folder);
  if (line.list_params && (!line.outputs.empty() || line.stats != StatsForm::kNone))
    throw UsageError{"--list-params writes no model: leave -o and --stats out"};
  if (line.outputs.empty() && line.stats == StatsForm::kNone && !line.list_params) {
    throw UsageError{"nothing to do: give an output with -o, or --stats"};
  }
  if (line.check && line.outputs.empty())
    throw UsageError{"--check proves what is written: give an output with -o"};
  for (const std::string& path : line.outputs) {
    if (line.check && !flat_format_of(path).empty())
      throw UsageError{fmt::format("--check proves meshes, and '{}' is a drawing", path)};
  }
}

CommandLine finished(int code) {
  CommandLine line;
  line.command = Command::kDone;
  line.exit_code = code;
  return line;
}

/// For the first option that there is not, the nearest of those that there are; for the command
/// that stands behind an option, where it belongs.
std::string what_was_meant(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::Option* option : app.get_options()) {
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  }
  for (const std::string& word : app.remaining()) {
    if (word.starts_with("--")) return did_you_mean(word.substr(0, word.find('=')), names);
  }
  const CLI::Option* model = app.get_option_no_throw("MODEL");
  if (model != nullptr && model->count() > 0 && model->as<std::string>() == "info")
    return "; info is the first word: csgrun info FILE";
  return {};
}

/// Prints help or a usage error as CLI11 has it.
CommandLine finish_parse(const CLI::App& app, const CLI::ParseError& error) {
  if (error.get_exit_code() == 0) {
    app.exit(error);
    return finished(kExitGood);
  }
  std::fputs(fmt::format("{}: {}{} (--help tells more)\n", app.get_name(), error.what(),
                         what_was_meant(app))
                 .c_str(),
             stderr);
  return finished(kExitUsage);
}

CommandLine parse_info(int argc, char** argv) {
  CommandLine line;
  line.command = Command::kInfo;
  CLI::App app("Measures a mesh file exactly, on its own coordinates.", "csgrun info");
  app.add_option("FILE", line.model, "STL, OFF, OBJ, PLY, GLB, glTF, 3MF, AMF, SVG or DXF")
      ->required();
  app.add_flag("--json", line.info_json, "as one JSON object");
  try {
    app.parse(argc - 1, argv + 1);
  } catch (const CLI::ParseError& error) {
    return finish_parse(app, error);
  }
  if (!is_info_path(line.model)) {
    std::fputs(
        fmt::format("csgrun info: '{}': the ending must be one of .stl, .off, .obj, .ply, .glb, "
                    ".gltf, .3mf, .amf, .svg, .dxf\n",
                    line.model)
            .c_str(),
        stderr);
    return finished(kExitUsage);
  }
  return line;
}

}  // namespace

bool is_csg_path(const std::string& path) { return ending_of(path) == ".csg"; }

CommandLine parse_command_line(int argc, char** argv) {
  if (argc > 1 && std::strcmp(argv[1], "info") == 0) return parse_info(argc, argv);

  CommandLine line;
  RawOptions raw;
  CLI::App app("Evaluates a Lua script that builds a CSG tree, exactly, and writes a mesh.",
               "csgrun");
  app.footer(
      "`csgrun info FILE [--json]` measures a mesh file.\n"
      "Exit codes: 0 good, 1 script, 2 usage, 3 geometry, 4 files, 124 out of time.");
  app.set_version_flag("--version", "csgrun " CSGRUN_VERSION);
  auto* model = app.add_option(
      "MODEL", line.model,
      "a script (.lua), an OpenSCAD tree (.csg), a mesh, or - for Lua from standard input");
  app.add_option("-o", line.outputs,
                 "output: .glb .gltf .stl .3mf .obj .off .ply, .exact.json (coordinates as "
                 "fractions), of shapes .svg .dxf; 'dir/%s.stl' writes one file a part")
      ->allow_extra_args(false)
      ->type_name("OUT");
  app.add_option("-D", raw.definitions, "sets a parameter of the model")
      ->allow_extra_args(false)
      ->type_name("name=value");
  app.add_option("-p", raw.parameter_file,
                 "a JSON file with values of parameters: {\"name\": value}, or OpenSCAD's sets")
      ->type_name("FILE");
  app.add_option("-P", raw.parameter_set, "which set of the file")->type_name("SET");
  app.add_flag("--list-params", line.list_params,
               "prints the parameters that the model asks for, as a JSON schema");
  app.add_option("-L", line.library_folders, "a folder of modules and meshes")
      ->allow_extra_args(false)
      ->type_name("DIR");
  app.add_option("--fn", line.facets.fn, "number of facets of a full turn (0: from --fa and --fs)")
      ->type_name("N");
  app.add_option("--fa", line.facets.fa, "smallest angle of a facet, degrees (12)")->type_name("A");
  app.add_option("--fs", line.facets.fs, "smallest length of a facet, mm (2)")->type_name("S");
  app.add_option("--threads", line.threads, "number of threads (as many as the process may use)")
      ->type_name("N");
  app.add_option("--grid", raw.grid, "step of the grid: 0.001, 2^-20mm (from the model's extent)")
      ->type_name("MM");
  app.add_flag(
      "--check", line.check,
      "proves that the written meshes do not cross themselves, at their file's precision, and "
      "repairs them if they do");
  app.add_flag("--stats{text}", raw.stats,
               "measures: as text on standard error, or --stats=json on standard output");
  app.add_flag("--no-cache", raw.no_cache, "reads and keeps no intermediate meshes on disk");
  app.add_option("--cache-dir", raw.cache_folder,
                 "folder for all intermediate meshes (~/.cache/csgrun, for those that take a "
                 "quarter of a second)")
      ->type_name("DIR");
  app.add_option("--timeout", raw.timeout, "seconds for everything (60 for the script alone)")
      ->type_name("S");
  app.add_option("--max-memory", raw.megabytes,
                 "MB for the process (three quarters of what is there)")
      ->type_name("MB");
  app.add_flag("--system-fonts", line.system_fonts,
               "text may use the fonts of this machine, not only the one of the program");
  app.add_flag("--strict", line.strict, "a font that is not there is an error, not a warning");
  app.add_flag("-q,--quiet", line.quiet, "no progress, no warnings");
  app.add_flag("--help-api{text}", raw.help_api,
               "prints the functions that a script has; =markdown as a page, =luals as definitions "
               "for editors, =json as data");
  app.add_flag("--init", raw.init,
               "writes .luarc.json and the definitions for editors into the working folder");
  try {
    app.parse(argc, argv);
    if (!raw.help_api.empty()) {
      line.command = Command::kHelpApi;
      line.api_form = raw.help_api == "markdown" ? ApiForm::kMarkdown
                      : raw.help_api == "luals"  ? ApiForm::kDefinitions
                      : raw.help_api == "json"   ? ApiForm::kJson
                                                 : ApiForm::kText;
      if (line.api_form == ApiForm::kText && raw.help_api != "text")
        throw UsageError{"--help-api can be =markdown, =luals, =json or nothing"};
      return line;
    }
    if (raw.init) {
      if (model->count() > 0) throw UsageError{"--init takes no model"};
      line.command = Command::kInit;
      return line;
    }
    if (model->count() == 0)
      throw UsageError{"which model? (csgrun MODEL -o OUT; --help tells more)"};
    check_all(line, raw, app);
  } catch (const CLI::ParseError& error) {
    return finish_parse(app, error);
  } catch (const UsageError& error) {
    std::fputs(("csgrun: " + error.message + "\n").c_str(), stderr);
    return finished(kExitUsage);
  }
  return line;
}

}  // namespace csgrun
