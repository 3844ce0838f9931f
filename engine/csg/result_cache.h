// Intermediate results in memory: bounded, the least recently used go first.
#pragma once

#include <cstdint>
#include <list>
#include <memory>
#include <unordered_map>
#include <utility>

#include <csgrun/engine/solid.h>

#include "engine/bsp/boundary_mesh.h"
#include "engine/bsp/result_pieces.h"
#include "engine/csg/key.h"
#include "engine/csg/scene.h"

namespace csgrun {

/// The value of a subtree, in the frame axes of the instance that was evaluated.
struct StoredBoundary {
  std::shared_ptr<const BoundaryMesh> boundary;  ///< null until asked for, if there are pieces
  PiecesPtr pieces;                              ///< or null
  Identity id;
};

/// Values by key. Get makes an entry the most recently used one.
template <class Value>
class ResultCache {
 public:
  explicit ResultCache(uint64_t limit) : limit_(limit) {}

  const Value* find(const Key& key) {
    const auto found = entries_.find(key);
    if (found == entries_.end()) return nullptr;
    order_.splice(order_.begin(), order_, found->second);
    return &found->second->value;
  }
  [[nodiscard]] bool contains(const Key& key) const { return entries_.contains(key); }

  /// In place of what was there. An entry larger than the limit is not kept.
  void put(const Key& key, Value value, uint64_t bytes) {
    if (const auto found = entries_.find(key); found != entries_.end()) {
      bytes_ -= found->second->bytes;
      order_.erase(found->second);
      entries_.erase(found);
    }
    if (bytes > limit_) return;
    order_.push_front({key, std::move(value), bytes});
    entries_.emplace(key, order_.begin());
    bytes_ += bytes;
    while (bytes_ > limit_) {
      bytes_ -= order_.back().bytes;
      entries_.erase(order_.back().key);
      order_.pop_back();
    }
  }
  [[nodiscard]] uint64_t bytes() const { return bytes_; }

 private:
  struct Entry {
    Key key;
    Value value;
    uint64_t bytes;
  };
  uint64_t limit_, bytes_ = 0;
  std::list<Entry> order_;
  std::unordered_map<Key, typename std::list<Entry>::iterator, KeyHash> entries_;
};

}  // namespace csgrun
