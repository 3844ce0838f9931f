// Vectors that grow without filling: for arrays of numbers that are written once, on several
// threads.
#pragma once

#include <memory>
#include <utility>
#include <vector>

namespace csgrun {

/// Leaves new elements as the memory is, unless they are made of something.
template <class T>
struct RawAllocator : std::allocator<T> {
  template <class U>
  struct rebind {
    using other = RawAllocator<U>;
  };
  template <class U>
  void construct(U*) {}
  template <class U, class First, class... Rest>
  void construct(U* at, First&& first, Rest&&... rest) {
    std::construct_at(at, std::forward<First>(first), std::forward<Rest>(rest)...);
  }
};

/// resize() leaves what is new unset: it is to be assigned before it is read.
template <class T>
using RawVector = std::vector<T, RawAllocator<T>>;

}  // namespace csgrun
