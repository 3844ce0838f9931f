// The files that a script may read: below the model's folder and the library folders, nothing else.
#pragma once

#include <set>
#include <string>
#include <vector>

#include <csgrun/primitives/read_file.h>

namespace csgrun {

/// Whether two paths lead to one file that is there.
bool is_same_file(const std::string& a, const std::string& b);

/// The folder of a path: "a/b.lua" -> "a", "b.lua" -> "" (the working folder).
std::string folder_of(const std::string& path);
/// `name` seen from `folder`.
std::string join_path(const std::string& folder, const std::string& name);

class Files {
 public:
  Files(const std::string& model_folder, const std::vector<std::string>& library_folders);

  struct Opened {
    std::string display;  ///< as it is named in messages
    std::string real;     ///< after symlinks
    std::string bytes;
  };
  /// Reads what `path` means to the file `caller` (a path as in messages): seen from its folder, or
  /// else from the library folders, in their order. Throws ScriptError: not below an allowed folder
  /// after symlinks, missing, or not a regular file.
  Opened open(const std::string& caller, const std::string& path);
  /// Reads the module `name` ("parts.wheel"). The names of the shipped modules are theirs; others
  /// are looked for by the templates "./lib/?.lua;..." of `search_path`, seen from the model's
  /// folder, then in the folders that are searched in any case. Throws ScriptError that lists the
  /// tried paths.
  Opened open_module(const std::string& name, const std::string& search_path);
  /// The paths of all files that were read here, or noted.
  [[nodiscard]] const std::set<std::string>& sources() const { return sources_; }
  void note(const std::string& path) { sources_.insert(path); }
  /// The part of a path behind the longest of the searched folders that it starts with.
  [[nodiscard]] std::string name_from_folder(const std::string& display) const;

 private:
  [[nodiscard]] bool is_allowed(const std::string& real) const;
  [[nodiscard]] bool leads_outside(const std::string& missing) const;

  std::vector<std::string> library_folders_;  // as shown in messages
  std::vector<std::string> search_folders_;   // for modules, in order, as shown in messages
  std::vector<std::string> roots_;            // real paths below which files may be read
  std::set<std::string> sources_;
};

}  // namespace csgrun
