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

/// A small model takes less of the heap.
constexpr size_t kSmallModel = size_t{384} << 10;

/// Lets the heap grow far, and has that be in large pages but for its beginning, where there is
/// room for a small model.
void take_large_pages(size_t most) {
  constexpr size_t kMost = size_t{2000} << 20, kShare = 4;  // below INT_MAX, where trimming begins
  constexpr size_t kLargePage = size_t{2} << 20;
  // More than what is left of the last step. (Where more was freed, it is used again first.)
  constexpr size_t kGrows = size_t{4} << 20;
  const auto memory =
      static_cast<size_t>(sysconf(_SC_PHYS_PAGES)) * static_cast<size_t>(sysconf(_SC_PAGESIZE));
  const size_t room = std::min({kMost, memory / kShare, most / kShare});
  mallopt(M_TOP_PAD, static_cast<int>(room));
  void* volatile grown = std::malloc(kGrows);  // volatile: or the compiler leaves it out
  std::free(grown);
  char* const end = static_cast<char*>(sbrk(0));
  const auto small_end = reinterpret_cast<uintptr_t>(end) - mallinfo2().keepcost + kSmallModel;
  const size_t to_large = kLargePage - small_end % kLargePage;
  char* const first_large = reinterpret_cast<char*>(small_end + to_large);
  if (first_large >= end) return;  // no heap that grows in one piece
  // The rest of the large page that the small part ends in is for nobody, which costs addresses
  // alone: otherwise it came next, in up to 512 small pages. What glibc writes before the first
  // free byte is not in a large page, either.
  constexpr size_t kHead = sizeof(size_t), kHeads = 4 * kHead;
  void* volatile small = std::malloc(kSmallModel - kHead);
  [[maybe_unused]] static void* volatile nobodys = nullptr;
  if (to_large > kHeads) nobodys = std::malloc(to_large - kHeads - kHead);
  std::free(small);
  mallopt(M_ARENA_MAX, 1);  // heaps of other threads would be in small pages
  madvise(first_large, static_cast<size_t>(end - first_large), MADV_HUGEPAGE);
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
  void* volatile block = std::malloc(kSmallModel);  // volatile: or the compiler leaves it out
  if (block != nullptr) {
    populate({static_cast<std::byte*>(block), kSmallModel}, MADV_POPULATE_WRITE);
  }
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
