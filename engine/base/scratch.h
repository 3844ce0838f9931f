// Memory for the length of a function, for functions that are called for many small things: each
// thread has some of its own, used again and again. Where many threads ask the heap for memory,
// they wait for one another.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <type_traits>
#include <vector>

namespace csgrun {

/// Arrays that are there as long as it is. Those of a thread end in the opposite order of their
/// beginning, as local variables do: it cannot be copied, nor made by new.
class Scratch {
 public:
  Scratch() : start_(own().used) {}
  ~Scratch() { own().used = start_; }
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;
  static void* operator new(size_t) = delete;

  /// An array whose elements are to be set before they are read. REQUIRES: the last Scratch of the
  /// thread.
  template <class T>
  std::span<T> array(size_t count) {
    static_assert(std::is_trivially_copyable_v<T> && std::is_trivially_destructible_v<T> &&
                  alignof(T) <= kAlign);
    const size_t bytes = (count * sizeof(T) + kAlign - 1) / kAlign * kAlign;
    return {reinterpret_cast<T*>(take(bytes)), count};
  }
  template <class T>
  std::span<T> array(size_t count, const T& value) {
    const std::span<T> all = array<T>(count);
    std::fill(all.begin(), all.end(), value);
    return all;
  }

 private:
  static constexpr size_t kAlign = alignof(std::max_align_t);
  static constexpr size_t kBytes = size_t{64} << 10;
  struct Own {  ///< of a thread
    std::unique_ptr<std::byte[]> bytes;
    size_t used = 0;
  };
  static Own& own() {
    static thread_local Own own;
    return own;
  }

  std::byte* take(size_t bytes) {
    Own& mine = own();
    if (bytes > kBytes - mine.used) {
      large_.emplace_back(new std::byte[bytes]);
      return large_.back().get();
    }
    if (!mine.bytes) mine.bytes.reset(new std::byte[kBytes]);
    std::byte* const at = mine.bytes.get() + mine.used;
    mine.used += bytes;
    return at;
  }

  size_t start_;
  std::vector<std::unique_ptr<std::byte[]>> large_;  ///< what does not fit
};

}  // namespace csgrun
