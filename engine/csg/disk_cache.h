// A folder of byte strings by key, which several processes use at once.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_set>

#include "engine/csg/key.h"

namespace csgrun {

/// One file for each entry, with a checksum: a damaged or half-written one is no entry. Files are
/// written under another name and renamed, so that who reads one has all of it; who reads what
/// another process removes keeps what it has opened. Nothing here fails: what cannot be read is not
/// there, and after the first error of writing nothing is written any more.
class DiskCache {
 public:
  /// More entries take long to list and to count, in each run.
  static constexpr uint64_t kMostEntries = 10000;

  /// Makes the folder when it first writes. What it holds beyond `limit` bytes, or so many entries,
  /// is removed when something is written, the least recently used first.
  DiskCache(std::string folder, uint64_t limit);

  /// Whether there are entries, as far as is known: the folder is listed when this is asked first,
  /// and when much is written. O(1) else.
  [[nodiscard]] bool has_entries();
  [[nodiscard]] bool contains(const Key& key);
  /// The entry, which is the most recently used one then.
  std::optional<std::string> read(const Key& key);
  /// Larger entries are not written.
  [[nodiscard]] uint64_t most_bytes() const { return limit_ / 8; }
  void write(const Key& key, std::string_view bytes);
  /// Makes the folder, if need be. Returns why it cannot be written to, or nothing.
  [[nodiscard]] std::string find_fault();

 private:
  void list();
  void make_room();
  [[nodiscard]] std::string path_of(const Key& key) const;

  std::string folder_;
  uint64_t limit_;
  bool is_listed_ = false, may_write_ = true;
  std::unordered_set<Key, KeyHash> entries_;
  std::optional<uint64_t> bytes_;  ///< of all files, once something was written
};

}  // namespace csgrun
