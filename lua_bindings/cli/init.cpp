#include "lua_bindings/cli/init.h"

#include <filesystem>

#include <csgrun/export/write.h>

#include "lua_bindings/api_docs.h"
#include "lua_bindings/files.h"

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
  std::filesystem::create_directories(kLibrary, error);
  if (error)
    return {kExitFiles, std::string("csgrun: cannot make ") + kLibrary + ": " + error.message()};
  const Status written = write_files(
      {{std::string(kLibrary) + "/csgrun.lua", api_definitions()}, {kSettings, kSettingsText}});
  if (!written) return {kExitFiles, "csgrun: " + written.error().message};
  return {};
}

}  // namespace csgrun
