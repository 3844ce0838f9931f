// How a process that makes meshes uses the heap.
#pragma once

#if defined(__GLIBC__)
#include <malloc.h>
#endif

namespace csgrun {

/// For the start of a program: what is freed stays with the process, and arrays below 32 MB come
/// from the heap, where they take the place of others. Left to itself, glibc moves both limits with
/// the order in which arrays are freed: the peak of one model differed by 20 MB from that of
/// another of its size. Does nothing with another C library.
inline void keep_freed_memory() {
#if defined(__GLIBC__)
  mallopt(M_MMAP_THRESHOLD, 32 << 20);  // the most that glibc takes
  mallopt(M_TRIM_THRESHOLD, 1 << 30);
#endif
}

}  // namespace csgrun
