// Results of other runs, on disk.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>

#include <csgrun/engine/evaluate.h>

#include "engine/csg/appearance_table.h"
#include "engine/csg/disk_cache.h"
#include "engine/csg/result_cache.h"

namespace csgrun {

/// Keys say what a result is a result of, by value, and which build of the kernel makes it: what
/// another build made is another entry. Where builds cannot be told apart there is no cache.
class DiskBoundaries {
 public:
  DiskBoundaries(const DiskCacheOptions& options, AppearanceTable& appearances);

  std::optional<StoredBoundary> read(const Key& key);
  /// Writes what took so long to evaluate, if that is long enough. Results in pieces alone, which
  /// the next operation changes, are not written.
  void write(const Key& key, const StoredBoundary& stored, double seconds);
  /// Why the folder that was asked for cannot be written to; nothing if it can, or none was.
  [[nodiscard]] std::string find_fault();

 private:
  [[nodiscard]] Key name_of(const Key& key) const;

  DiskCacheOptions options_;
  AppearanceTable& appearances_;
  std::span<const std::byte> build_;  ///< its id
  std::optional<DiskCache> disk_;
};

}  // namespace csgrun
