#include "engine/csg/disk_boundaries.h"

#include <new>

#include "engine/base/build_id.h"
#include "engine/csg/boundary_bytes.h"
#include "engine/csg/leaf_store.h"

namespace csgrun {

DiskBoundaries::DiskBoundaries(const DiskCacheOptions& options, AppearanceTable& appearances)
    : options_(options), appearances_(appearances) {
  if (!options.folder.empty()) build_ = build_id();
  if (!options.folder.empty() && !build_.empty()) disk_.emplace(options.folder, options.bytes);
}

Key DiskBoundaries::name_of(const Key& key) const {
  KeyBuilder builder("result");
  builder.bare_list(build_).numbers(key);
  return builder.key();
}

std::optional<StoredBoundary> DiskBoundaries::read(const Key& key) {
  if (!disk_ || !disk_->has_entries()) return std::nullopt;
  try {
    const auto bytes = disk_->read(name_of(key));
    return bytes ? from_bytes(*bytes, key, appearances_) : std::nullopt;
  } catch (const std::bad_alloc&) {
    return std::nullopt;
  }
}

void DiskBoundaries::write(const Key& key, const StoredBoundary& stored, double seconds) {
  if (!disk_ || !stored.boundary || seconds < options_.least_seconds) return;
  if (memory_bytes(*stored.boundary) > disk_->most_bytes()) return;
  try {
    disk_->write(name_of(key), to_bytes(stored, appearances_));
  } catch (const std::bad_alloc&) {  // there is the result, and it is what matters
  }
}

std::string DiskBoundaries::find_fault() {
  if (options_.folder.empty()) return {};
  return disk_ ? disk_->find_fault() : "this build of the kernel has no build id";
}

}  // namespace csgrun
