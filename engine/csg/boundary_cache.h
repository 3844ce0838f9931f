// Intermediate results by key, in memory and on disk.
#pragma once

#include <cstdint>
#include <optional>
#include <unordered_set>

#include "engine/csg/disk_boundaries.h"
#include "engine/csg/result_cache.h"

namespace csgrun {

class BoundaryCache {
 public:
  BoundaryCache(uint64_t limit, DiskBoundaries& disk) : memory_(limit), disk_(disk) {}

  /// From the disk it comes into memory, if it fits.
  const StoredBoundary* find(const Key& key) {
    if (const StoredBoundary* const known = memory_.find(key)) return known;
    std::optional<StoredBoundary> stored = disk_.read(key);
    if (!stored) return nullptr;
    const size_t bytes = memory_bytes(*stored->boundary);
    put(key, *std::move(stored), bytes);
    read_.insert(key);
    return memory_.find(key);
  }
  [[nodiscard]] bool contains(const Key& key) { return find(key) != nullptr; }
  /// In memory.
  void put(const Key& key, StoredBoundary stored, uint64_t bytes) {
    memory_.put(key, std::move(stored), bytes);
  }
  /// On disk, if that took so long that it is worth it.
  void write(const Key& key, const StoredBoundary& stored, double seconds) {
    disk_.write(key, stored, seconds);
  }
  /// Whether it was read from the disk since this was asked last.
  bool take_was_read(const Key& key) { return read_.erase(key) > 0; }

 private:
  ResultCache<StoredBoundary> memory_;
  DiskBoundaries& disk_;
  std::unordered_set<Key, KeyHash> read_;
};

}  // namespace csgrun
