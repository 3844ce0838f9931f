// Files out of a zip file in memory.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include <csgrun/engine/error.h>

namespace csgrun {

/// The directory of a zip file. What it refers to must outlive it.
class ZipArchive {
 public:
  /// Zip64 as well, and with other data in front. `name` stands in messages. Errors:
  /// kMalformedFile.
  static Result<ZipArchive> open(std::string name, std::string_view bytes);

  /// The bytes of the entry of this path; nothing when the archive has none. Letters of any case
  /// are the same (Open Packaging Conventions, 6.3.5), as are both slashes. Errors: kMalformedFile;
  /// kLimit where the entries that were asked for unpack to far more than models do: told before
  /// memory is taken. O(1) in the number of entries.
  Result<std::optional<std::string>> entry(const std::string& path);
  /// The same of the first entry whose path ends so.
  Result<std::optional<std::string>> first(const std::string& ending);

 private:
  struct Entry {
    std::string path;
    std::string key;  ///< the path as paths are compared
    uint64_t packed = 0, unpacked = 0, offset = 0;
    uint32_t checksum = 0, method = 0, flags = 0;
  };

  Error damaged(const std::string& place) const;
  Result<std::optional<std::string>> unpack(const Entry& entry);

  std::string name_;
  std::string_view bytes_;
  uint64_t unpacked_ = 0;  ///< so far, of all entries
  std::vector<Entry> entries_;
  std::unordered_map<std::string, size_t> by_key_;  ///< the first of each
};

}  // namespace csgrun
