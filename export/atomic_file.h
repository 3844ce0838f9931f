// Files that are complete or not there: written beside their target, then renamed.
#pragma once

#include <string>
#include <string_view>

#include <csgrun/engine/error.h>

namespace csgrun {

/// A file under way. Whatever happens before commit() leaves the target as it was; the destructor
/// removes the temporary file. Targets that are no regular files (a terminal, /dev/null, a pipe)
/// are written in place.
class AtomicFile {
 public:
  AtomicFile() = default;
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  /// Writes all bytes to a temporary file in the target's folder. Errors: kCannotWrite with the
  /// system's reason.
  Status write(const std::string& target, std::string_view bytes);
  /// Puts the file in its place. Errors: kCannotWrite.
  Status commit();

 private:
  std::string shown_;      // the target as the user wrote it
  std::string target_;     // with symbolic links followed; empty when written in place
  std::string temporary_;  // empty when there is none
  int slot_ = -1;          // of the registry of temporary files
};

}  // namespace csgrun
