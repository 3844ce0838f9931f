#include "lua_bindings/cli/init.h"

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include <csgrun/export/write.h>

#include "lua_bindings/api_docs.h"
#include "lua_bindings/files.h"
#include "lua_bindings/library_docs.h"

namespace csgrun {
namespace {

constexpr char kSettings[] = ".luarc.json";
constexpr char kLibrary[] = ".csgrun/library";
constexpr char kSettingsText[] =
    "{\n"
    "  \"runtime.version\": \"Lua 5.4\",\n"
    "  \"runtime.builtin\": {\"io\": \"disable\", \"os\": \"disable\", \"debug\": \"disable\"},\n"
    "  \"workspace.library\": [\".csgrun/library\"]\n"
    "}\n";

}  // namespace

Failure init_folder() {
  const FileText old = read_whole_file(kSettings);
  if (old.error.empty() && old.bytes != kSettingsText) {
    return {kExitFiles, std::string("csgrun: ") + kSettings +
                            " is there already; add \".csgrun/library\" to its "
                            "workspace.library, or remove it"};
  }
  std::error_code error;
  std::filesystem::create_directories(std::string(kLibrary) + "/csg", error);
  if (error)
    return {kExitFiles, std::string("csgrun: cannot make ") + kLibrary + ": " + error.message()};
  std::vector<ModelFile> files{{std::string(kLibrary) + "/csgrun.lua", api_definitions()},
                               {kSettings, kSettingsText}};
  for (LibraryDefinitions& module : library_definitions())
    files.push_back({std::string(kLibrary) + "/" + module.file, std::move(module.text)});
  const Status written = write_files(files);
  if (!written) return {kExitFiles, "csgrun: " + written.error().message};
  return {};
}

}  // namespace csgrun
