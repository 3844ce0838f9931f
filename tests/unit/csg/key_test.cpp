// Keys are the hash of all that was put, however it was put.
#include "engine/csg/key.h"

#include <numeric>

#include <gtest/gtest.h>

#define XXH_INLINE_ALL
#include <xxhash.h>

namespace csgrun::key_test {
namespace {

TEST(KeyBuilder, IsTheHashOfTheBytes) {
  // Lists around the length from which they are hashed where they are, after lists and numbers.
  for (const size_t first : {0, 1, 100, 1023, 1024, 1025, 5000}) {
    for (const size_t second : {0, 3, 1023, 1024, 3000}) {
      std::vector<uint32_t> a(first), b(second);
      std::iota(a.begin(), a.end(), 7u);
      std::iota(b.begin(), b.end(), 1000u);
      std::string bytes;
      const auto put = [&](const void* data, size_t size) {
        bytes.append(static_cast<const char*>(data), size);
      };
      const auto put_number = [&](uint64_t x) { put(&x, sizeof(x)); };
      put_number(4);
      put("test", 4);
      put_number(first);
      put(a.data(), 4 * first);
      put_number(42);
      put(b.data(), 4 * second);
      put_number(43);
      const XXH128_hash_t expected = XXH3_128bits(bytes.data(), bytes.size());
      KeyBuilder builder("test");
      builder.list(a).number(uint64_t{42}).bare_list(std::span<const uint32_t>(b));
      builder.number(uint64_t{43});
      EXPECT_EQ(builder.key(), (Key{expected.low64, expected.high64})) << first << ", " << second;
    }
  }
}

}  // namespace
}  // namespace csgrun::key_test
