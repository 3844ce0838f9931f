#include "lua_bindings/files.h"

#include <algorithm>
#include <cerrno>
#include <climits>
#include <cstdlib>
#include <cstring>
#include <filesystem>

#include "lua_bindings/guard.h"
#include "lua_bindings/nearest.h"
#include "lua_bindings/shipped_modules.h"

namespace csgrun {
namespace {

/// The path after symlinks, or empty with errno set.
std::string real_path(const std::string& path) {
  char* resolved = ::realpath(path.empty() ? "." : path.c_str(), nullptr);
  if (resolved == nullptr) return {};
  std::string text = resolved;
  std::free(resolved);
  return text;
}

std::string system_reason() { return std::strerror(errno); }  // messages in English: no setlocale

/// The path with "." and ".." taken out by name alone, seen from the working folder.
std::string plain_path(const std::string& path) {
  std::error_code ignored;
  return std::filesystem::absolute(path, ignored).lexically_normal().string();
}

}  // namespace

bool is_same_file(const std::string& a, const std::string& b) {
  std::error_code error;
  return std::filesystem::equivalent(a, b, error) && !error;
}

std::string folder_of(const std::string& path) {
  const size_t slash = path.rfind('/');
  if (slash == std::string::npos) return {};
  return slash == 0 ? "/" : path.substr(0, slash);
}

std::string join_path(const std::string& folder, const std::string& name) {
  if (folder.empty() || (!name.empty() && name[0] == '/')) return name;
  return folder.back() == '/' ? folder + name : folder + "/" + name;
}

Files::Files(const std::string& model_folder, const std::vector<std::string>& library_folders)
    : library_folders_(library_folders) {
  search_folders_ = {model_folder, join_path(model_folder, "csgrun_modules")};
  search_folders_.insert(search_folders_.end(), library_folders.begin(), library_folders.end());
  // Where the modules folder beside the model is a symlink, its target is a library by intent of
  // whoever put the link there; but a link may come with a downloaded model, so it does not count.
  roots_.push_back(real_path(model_folder));
  for (const std::string& folder : library_folders) roots_.push_back(real_path(folder));
  std::erase(roots_, std::string());
}

std::string Files::name_from_folder(const std::string& display) const {
  size_t longest = 0;
  for (const std::string& folder : search_folders_) {
    const std::string start = join_path(folder, "");
    if (display.rfind(start, 0) == 0) longest = std::max(longest, start.size());
  }
  return display.substr(longest);
}

bool Files::is_allowed(const std::string& real) const {
  return std::any_of(roots_.begin(), roots_.end(), [&](const std::string& root) {
    return root == "/" || (real.size() > root.size() && real.compare(0, root.size(), root) == 0 &&
                           real[root.size()] == '/');
  });
}

/// Whether a path where nothing is would lie below no allowed folder.
bool Files::leads_outside(const std::string& missing) const {
  std::string parent = folder_of(plain_path(missing)), real_parent;
  while ((real_parent = real_path(parent)).empty() && parent != "/") parent = folder_of(parent);
  return !is_allowed(join_path(real_parent, "x"));
}

Files::Opened Files::open(const std::string& caller, const std::string& path) {
  if (path.find('\0') != std::string::npos)
    throw ScriptError("a path must not contain a zero byte");
  std::vector<std::string> folders{folder_of(caller)};
  if (path.empty() || path[0] != '/') {
    folders.insert(folders.end(), library_folders_.begin(), library_folders_.end());
  }
  std::string problem;  // with the first folder; where nothing was, others are added
  bool is_missing = false;
  for (const std::string& folder : folders) {
    Opened opened;
    opened.display = join_path(folder, path);
    opened.real = real_path(opened.display);
    const std::string reason = opened.real.empty() ? system_reason() : "";
    // Whether a file outside exists is nothing that a script may find out.
    const bool outside =
        opened.real.empty() ? leads_outside(opened.display) : !is_allowed(opened.real);
    if (outside) {
      if (problem.empty()) {
        problem = "'" + path + "' lies outside of the model's folder and the library folders (-L)";
      }
      continue;
    }
    if (opened.real.empty()) {
      const std::string shown = "'" + (folder.empty() ? "." : folder) + "'";
      if (problem.empty()) {
        is_missing = true;
        problem = "cannot read '" + path + "': " + reason;
        if (folders.size() > 1) problem += "; looked in " + shown;
      } else if (is_missing) {
        problem += ", " + shown;
      }
      continue;
    }
    FileText text = read_whole_file(opened.real);
    if (!text.error.empty()) throw ScriptError("cannot read '" + path + "': " + text.error);
    opened.bytes = std::move(text.bytes);
    note(opened.real);
    return opened;
  }
  throw ScriptError(problem);
}

namespace {

/// The paths that a list of templates, "./lib/?.lua;./?/init.lua", makes of a module's path.
std::vector<std::string> fill_templates(const std::string& templates, const std::string& folder,
                                        const std::string& module) {
  std::vector<std::string> paths;
  for (size_t start = 0; start < templates.size();) {
    const size_t end = std::min(templates.find(';', start), templates.size());
    std::string path = templates.substr(start, end - start);
    start = end + 1;
    if (path.empty()) continue;
    for (size_t mark = 0; (mark = path.find('?', mark)) != std::string::npos; mark += module.size())
      path.replace(mark, 1, module);
    if (path.rfind("./", 0) == 0) path = path.substr(2);
    paths.push_back(join_path(folder, path));
  }
  return paths;
}

}  // namespace

Files::Opened Files::open_module(const std::string& name, const std::string& search_path) {
  const auto is_name_character = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
           c == '-' || c == '.' || c == '/';
  };
  const bool plain = !name.empty() && name.front() != '.' && name.back() != '.' &&
                     name.front() != '/' && name.back() != '/' &&
                     name.find("..") == std::string::npos &&
                     std::all_of(name.begin(), name.end(), is_name_character);
  if (!plain) {
    throw ScriptError("'" + name +
                      "' is not a module's name: write it as in require \"parts.wheel\"");
  }
  for (const ShippedModule& module : shipped_modules()) {
    if (module.name != name) continue;
    const std::string place = std::string(kShippedPlace) + name;
    return {place, place, std::string(module.text)};
  }
  std::string relative = name;
  std::replace(relative.begin(), relative.end(), '.', '/');
  std::vector<std::string> paths = fill_templates(search_path, search_folders_[0], relative);
  const size_t of_templates = paths.size();
  for (const std::string& folder : search_folders_) {
    for (const char* ending : {".lua", "/init.lua"}) {
      std::string path = join_path(folder, relative + ending);
      if (std::find(paths.begin(), paths.end(), path) == paths.end())
        paths.push_back(std::move(path));
    }
  }
  constexpr std::string_view kOfLibrary = "csg.";
  const bool is_of_library = name.starts_with(kOfLibrary);
  const std::string_view word =
      std::string_view(name).substr(is_of_library ? kOfLibrary.size() : 0);
  std::vector<std::string> shipped;
  for (const ShippedModule& module : shipped_modules()) {
    shipped.emplace_back(std::string_view(module.name).substr(kOfLibrary.size()));
  }
  const std::string nearest = nearest_name(word, shipped);
  std::string tried;
  if (is_of_library || !nearest.empty()) tried += "\n\tnot in the library of csgrun";
  if (!nearest.empty()) {
    tried += " (did you mean '" + std::string(kOfLibrary) + nearest + "'?)";
  }
  for (size_t i = 0; i < paths.size(); ++i) {
    const std::string& path = paths[i];
    const std::string real = real_path(path);
    // Whether a file outside exists is nothing that a script may find out.
    if (real.empty() ? i < of_templates && leads_outside(path) : !is_allowed(real)) {
      tried +=
          "\n\t'" + path + "' leads outside of the model's folder and the library folders (-L)";
    } else if (real.empty()) {
      tried += "\n\tno file '" + path + "'";
    } else {
      FileText text = read_whole_file(real);
      note(real);
      if (text.error.empty()) return {path, real, std::move(text.bytes)};
      tried += "\n\tcannot read '" + path + "': " + text.error;
    }
  }
  constexpr std::string_view kEnding = ".lua";
  if (name.size() > kEnding.size() && name.ends_with(kEnding)) {
    const std::string without_ending(name, 0, name.size() - kEnding.size());
    tried = " (names have no ending: require \"" + without_ending + "\"):" + tried;
  } else {
    tried.insert(0, ":");
  }
  throw ScriptError("module '" + name + "' not found" + tried);
}

}  // namespace csgrun
