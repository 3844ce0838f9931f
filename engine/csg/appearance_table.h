// Appearances by number: equal values have equal ids, in order of first occurrence.
#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

#include <csgrun/engine/polygon_mesh.h>

#include "engine/csg/key.h"

namespace csgrun {

/// Whether all that has a range is in it: colours, alpha, metallic and roughness are from 0 to 1.
bool is_in_range(const Appearance& appearance);

class AppearanceTable {
 public:
  /// The id of an appearance; a new one when no equal appearance was interned before.
  uint32_t intern(const Appearance& appearance);
  [[nodiscard]] const std::vector<Appearance>& values() const { return values_; }
  /// A hash of the value, which does not depend on ids.
  [[nodiscard]] const Key& key(uint32_t id) const { return keys_[id]; }

 private:
  std::vector<Appearance> values_;
  std::vector<Key> keys_;
  std::unordered_map<Key, uint32_t, KeyHash> ids_;
};

}  // namespace csgrun
