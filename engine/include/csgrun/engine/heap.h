// How a process that makes meshes uses the heap. Nothing here does anything with another C library
// than glibc; what it does lasts as long as the process.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>

namespace csgrun {

/// For the start of a program: what is freed stays with the process, and arrays below 32 MB come
/// from the heap, where they take the place of others.
void keep_freed_memory();

/// For the start of a program, after keep_freed_memory(): where the system takes long to give a
/// page (`always`: anywhere), has it give all pages of the program's code at once, and those of the
/// heap that a small model takes, not one after another as they are used. Takes half a millisecond,
/// and saves a hundred waits of about ten microseconds or more.
void map_program(bool always = false);

/// In which pages the system gives a process what its heap grows by.
enum class HeapPages : uint8_t {
  kMeasured,  ///< large ones where small ones take long
  kSmall,
  kLarge,
};

/// For before meshes are made, after keep_freed_memory(): has the heap grow in large steps. With
/// large pages all threads have one heap, and what it grows by next, but for what a small model
/// takes, is in pages of two megabytes where the system has such: up to two gigabytes, or a quarter
/// of the machine's memory or of `most` (docs/decisions/0111). `most`: the bytes that the process
/// may have (RLIMIT_DATA), which counts addresses. Takes a tenth of a millisecond.
void make_room_for_meshes(HeapPages pages = HeapPages::kMeasured,
                          size_t most = std::numeric_limits<size_t>::max());

}  // namespace csgrun
