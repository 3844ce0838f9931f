// How a process that makes meshes uses the heap.
#pragma once

#include <cstdint>

namespace csgrun {

/// In which pages the system gives a process its heap.
enum class HeapPages : uint8_t {
  kMeasured,  ///< large ones where small ones take long
  kSmall,
  kLarge,
};

/// For the start of a program, before it has threads. What is freed stays with the process, and
/// arrays below 32 MB come from the heap, where they take the place of others. With large pages all
/// threads have one heap, of which a gigabyte or a quarter of the machine's memory, the first two
/// megabytes excepted, is in pages of two megabytes, where the system has such; addresses alone
/// cost nothing. Takes less than a tenth of a millisecond. Does nothing with another C library than
/// glibc.
void prepare_heap(HeapPages pages = HeapPages::kMeasured);

}  // namespace csgrun
