#include "lua_bindings/cli/output_paths.h"

#include <algorithm>
#include <filesystem>
#include <map>

#include <fmt/format.h>

namespace csgrun {

bool is_pattern(const std::string& output) { return output.find("%s") != std::string::npos; }

std::string path_of_part(const std::string& pattern, const std::string& name) {
  std::string step = name, path = pattern;
  std::replace(step.begin(), step.end(), '/', '-');
  return path.replace(path.find("%s"), 2, step);
}

std::string find_clash(const std::vector<std::string>& outputs,
                       const std::vector<std::string>& part_names) {
  struct Use {
    const std::string* output;
    const std::string* part;  ///< null: all of them
  };
  std::map<std::string, Use> taken;
  for (const std::string& output : outputs) {
    const auto take = [&](const std::string& path, const std::string* part) -> std::string {
      const std::string place = std::filesystem::path(path).lexically_normal().string();
      const auto [entry, is_fresh] = taken.emplace(place, Use{&output, part});
      if (is_fresh) return {};
      const Use& other = entry->second;
      if (other.output == &output && part != nullptr) {
        return fmt::format("parts '{}' and '{}' would both be written to '{}'", *other.part, *part,
                           path);
      }
      return fmt::format("-o {} and -o {} would both be written to '{}'", *other.output, output,
                         path);
    };
    if (!is_pattern(output)) {
      if (std::string clash = take(output, nullptr); !clash.empty()) return clash;
      continue;
    }
    for (const std::string& name : part_names) {
      std::string clash = take(path_of_part(output, name), &name);
      if (!clash.empty()) return clash;
    }
  }
  return {};
}

}  // namespace csgrun
