// How a process that makes meshes uses the heap.
#pragma once

#if defined(__GLIBC__)
#include <malloc.h>
#endif

namespace csgrun {

/// For the start of a program: what is freed stays with the process, and arrays below 32 MB come
/// from the heap, where they take the place of others. Left to itself, glibc moves both limits with
/// the order in which arrays are freed: the peak of one model differed by 20 MB from that of
/// another of its size. Address space is asked for in pieces of 64 MB, which cost nothing until
/// they are written to; in the usual ones of 128 kB, a second thread changed its map of memory five
/// thousand times for one model, while the first had to wait, and gave back what it needed again.
/// Does nothing with another C library.
inline void keep_freed_memory() {
#if defined(__GLIBC__)
  mallopt(M_MMAP_THRESHOLD, 32 << 20);  // the most that glibc takes
  mallopt(M_TRIM_THRESHOLD, 1 << 30);
  mallopt(M_TOP_PAD, 64 << 20);
#endif
}

}  // namespace csgrun
