#include "engine/bsp/point_index.h"

#include "engine/base/counting_order.h"
#include "engine/base/parallel.h"
#include "engine/base/raw_vector.h"
#include "engine/bsp/point_view.h"

namespace csgrun {
namespace {

constexpr size_t kPointsAhead = 12;  // so soon the memory of points is asked for

}  // namespace

void PointIndex::make_unique(std::span<const uint32_t> points) {
  if (points.size() > kFewForThreads && has_threads()) {
    make_unique_in_shards(points);
    return;
  }
  for (size_t i = 0; i < points.size(); ++i) {
    if (i + kPointsAhead < points.size()) {
      __builtin_prefetch(&slots_[hash(points[i + kPointsAhead]) & (slots_.size() - 1)]);
    }
    unique(points[i]);
  }
}

/// Each shard has a range of slots, and the points whose hashes lead there, equal ones among them.
void PointIndex::make_unique_in_shards(std::span<const uint32_t> points) {
  constexpr size_t kShards = 64;
  known_.resize(std::max(known_.size(), geometry_.point_count()), kNone);
  make_room(count_ + points.size());
  const size_t last = slots_.size() - 1, each = slots_.size() / kShards;
  RawVector<uint32_t> keys(points.size());
  for_each_range(points.size(), [&](size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) keys[i] = hash(points[i]);
  });
  CountingOrder by_shard;
  by_shard.sort(points.size(), kShards, [&](size_t i) { return (keys[i] & last) / each; });
  struct Shard {
    size_t count = 0;
    std::vector<uint32_t> beyond;  ///< points whose slots begin in the range and end outside
    SignCounters counters;
  };
  std::vector<Shard> shards(kShards);
  for_each_part(kShards, 1, [&](size_t s, size_t, size_t) {
    Shard own;
    PointView view(geometry_);
    const size_t end = (s + 1) * each;
    const std::span<const uint32_t> asked(by_shard.order.data() + by_shard.starts[s],
                                          by_shard.order.data() + by_shard.starts[s + 1]);
    for (size_t i = 0; i < asked.size(); ++i) {
      if (i + kPointsAhead < asked.size()) {
        const uint32_t soon = points[asked[i + kPointsAhead]];
        __builtin_prefetch(&known_[soon]);
        __builtin_prefetch(&geometry_.point(soon));
      }
      const uint32_t p = points[asked[i]];
      if (known_[p] != kNone) continue;
      const uint32_t key = keys[asked[i]];
      size_t at = key & last;
      while (at < end && slots_[at].point != kNone &&
             !(slots_[at].hash == key && equal(view, slots_[at].point, p))) {
        ++at;
      }
      if (at == end) {
        own.beyond.push_back(p);
        continue;
      }
      if (slots_[at].point == kNone) {
        slots_[at] = {key, p};
        ++own.count;
      }
      known_[p] = slots_[at].point;
    }
    own.counters = view.counters;
    shards[s] = std::move(own);
  });
  for (const Shard& shard : shards) {
    count_ += shard.count;
    geometry_.counters.add(shard.counters);
  }
  for (const Shard& shard : shards) {
    for (const uint32_t p : shard.beyond) unique(p);
  }
}

}  // namespace csgrun
