#include <cstdlib>  // says which C library it is

#include <csgrun/engine/heap.h>

#if defined(__GLIBC__)

#include <algorithm>
#include <chrono>
#include <climits>
#include <cstddef>
#include <cstdint>
#include <span>

#include <link.h>
#include <malloc.h>
#include <sys/mman.h>
#include <unistd.h>

namespace csgrun {
namespace {

/// The shortest time in which the system gives a page to who writes to it, of a few.
std::chrono::nanoseconds time_of_page() {
  using Clock = std::chrono::steady_clock;
  constexpr size_t kFew = 3;
  const auto page = static_cast<size_t>(sysconf(_SC_PAGESIZE));
  void* const pages =
      mmap(nullptr, kFew * page, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (pages == MAP_FAILED) return {};
  auto shortest = Clock::duration::max();
  for (size_t i = 0; i < kFew; ++i) {
    const auto before = Clock::now();
    static_cast<volatile char*>(pages)[i * page] = 1;
    shortest = std::min(shortest, Clock::now() - before);
  }
  munmap(pages, kFew * page);
  return shortest;
}

/// Measured once.
bool are_pages_slow() {
  // A page takes 1 to 2 microseconds on most machines, and 11 on a virtual one whose host keeps the
  // tables of pages itself.
  constexpr std::chrono::microseconds kLong(4);
  static const bool are_slow = time_of_page() > kLong;
  return are_slow;
}

/// Lets the heap grow far, and has that be in large pages but for its beginning: a small model
/// needs no more.
void take_large_pages(size_t most) {
  constexpr size_t kMost = size_t{2000} << 20, kShare = 4;  // below INT_MAX, where trimming begins
  constexpr size_t kSmallPart = size_t{2} << 20, kLargePage = size_t{2} << 20;
  // More than what is left of the last step. (Where more was freed, it is used again first.)
  constexpr size_t kGrows = size_t{4} << 20;
  const auto memory =
      static_cast<size_t>(sysconf(_SC_PHYS_PAGES)) * static_cast<size_t>(sysconf(_SC_PAGESIZE));
  const size_t room = std::min({kMost, memory / kShare, most / kShare});
  mallopt(M_TOP_PAD, static_cast<int>(room));
  char* const begin = static_cast<char*>(sbrk(0));
  void* volatile grown = std::malloc(kGrows);  // volatile: or the compiler leaves it out
  char* const end = static_cast<char*>(sbrk(0));
  const size_t before_large =
      kSmallPart + kLargePage - reinterpret_cast<uintptr_t>(begin) % kLargePage;
  if (begin + before_large < end) {
    mallopt(M_ARENA_MAX, 1);  // heaps of other threads would be in small pages
    madvise(begin + before_large, static_cast<size_t>(end - begin) - before_large, MADV_HUGEPAGE);
  }
  std::free(grown);
}

/// Finds the bytes of the program's code, not of its libraries'.
int find_code(dl_phdr_info* info, size_t, void* found) {
  const std::span headers(info->dlpi_phdr, info->dlpi_phnum);
  const auto is_code = [](const auto& h) { return h.p_type == PT_LOAD && (h.p_flags & PF_X) != 0; };
  const auto code = std::find_if(headers.begin(), headers.end(), is_code);
  if (code != headers.end()) {
    *static_cast<std::span<std::byte>*>(found) = {
        reinterpret_cast<std::byte*>(info->dlpi_addr + code->p_vaddr), code->p_memsz};
  }
  return 1;  // the program is the first, and no other one is asked for
}

/// Has the system map all pages that hold some bytes. (If it cannot, they come one by one.)
void populate(std::span<std::byte> bytes, int advice) {
  const auto page = static_cast<uintptr_t>(sysconf(_SC_PAGESIZE));
  const auto at = reinterpret_cast<uintptr_t>(bytes.data()), first = at / page * page;
  madvise(reinterpret_cast<void*>(first), at + bytes.size() - first, advice);
}

}  // namespace

void map_program(bool always) {
#if defined(MADV_POPULATE_READ) && defined(MADV_POPULATE_WRITE)
  if (!always && !are_pages_slow()) return;
  std::span<std::byte> code;
  dl_iterate_phdr(find_code, &code);
  if (!code.empty()) populate(code, MADV_POPULATE_READ);
  constexpr size_t kHeap = size_t{384} << 10;  // a small model takes less
  void* volatile block = std::malloc(kHeap);   // volatile: or the compiler leaves it out
  if (block != nullptr) populate({static_cast<std::byte*>(block), kHeap}, MADV_POPULATE_WRITE);
  std::free(block);
#else
  (void)always;
#endif
}

void keep_freed_memory() {
  // Left to itself, glibc moves both limits with the order in which arrays are freed: the peak of
  // one model differed by 20 MB from that of another of its size.
  mallopt(M_MMAP_THRESHOLD, 32 << 20);  // the most that glibc takes
  mallopt(M_TRIM_THRESHOLD, INT_MAX);
  mallopt(M_TOP_PAD, 1 << 20);
}

void make_room_for_meshes(HeapPages pages, size_t most) {
  const bool are_large =
      pages == HeapPages::kMeasured ? are_pages_slow() : pages == HeapPages::kLarge;
  if (are_large) take_large_pages(most);
  // In steps of 128 kB, which are usual, a second thread changed its map of memory five thousand
  // times for one model, while the first had to wait.
  constexpr size_t kLeast = size_t{128} << 10, kUsual = size_t{64} << 20, kShare = 16;
  mallopt(M_TOP_PAD, static_cast<int>(std::clamp(most / kShare, kLeast, kUsual)));
}

}  // namespace csgrun

#else

namespace csgrun {

void map_program(bool) {}
void keep_freed_memory() {}
void make_room_for_meshes(HeapPages, size_t) {}

}  // namespace csgrun

#endif
