#include "engine/csg/key.h"

#define XXH_INLINE_ALL
#include <xxhash.h>

namespace csgrun {

struct KeyBuilder::Stream {
  XXH3_state_t state;
};

KeyBuilder::KeyBuilder(std::string_view domain) { text(domain); }
KeyBuilder::~KeyBuilder() = default;

void KeyBuilder::hash(const void* data, size_t size) {
  if (!stream_) {
    stream_ = std::make_unique<Stream>();
    XXH3_128bits_reset(&stream_->state);
  }
  XXH3_128bits_update(&stream_->state, first_.data(), size_);
  size_ = 0;
  if (size > 0) XXH3_128bits_update(&stream_->state, data, size);
}

Key KeyBuilder::key() {
  XXH128_hash_t result;
  if (stream_) {
    hash(nullptr, 0);
    result = XXH3_128bits_digest(&stream_->state);
  } else {
    result = XXH3_128bits(first_.data(), size_);
  }
  return {result.low64, result.high64};
}

}  // namespace csgrun
