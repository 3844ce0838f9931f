// The heap of a process of its own: what is set for it lasts as long as the process.
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <functional>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csgrun/engine/heap.h>

namespace csgrun::heap_test {
namespace {

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool kHasOwnHeap = true;
#else
constexpr bool kHasOwnHeap = false;
#endif

/// What `ask` answers in a child process.
int in_child(const std::function<int()>& ask) {
  const pid_t child = fork();
  if (child == 0) _exit(ask());
  int status = -1;
  waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

/// Whether the system may have memory in large pages where an address is ("hg" of VmFlags,
/// proc(5)).
bool may_be_large(const void* address) {
  const auto at = reinterpret_cast<uintptr_t>(address);
  std::ifstream maps("/proc/self/smaps");
  bool is_there = false;
  for (std::string line; std::getline(maps, line);) {
    uintptr_t begin = 0, end = 0;
    if (std::sscanf(line.c_str(), "%lx-%lx ", &begin, &end) == 2) {
      is_there = begin <= at && at < end;
    }
    if (is_there && line.rfind("VmFlags:", 0) == 0) {
      return (line + " ").find(" hg ") != std::string::npos;
    }
  }
  return false;
}

bool has_large_pages() { return access("/sys/kernel/mm/transparent_hugepage/enabled", R_OK) == 0; }

constexpr size_t kMegabyte = size_t{1} << 20;
constexpr int kYes = 10, kNo = 11;

/// Whether an array of so many megabytes is in large pages to its end.
int is_large(HeapPages pages, size_t megabytes) {
  keep_freed_memory();
  make_room_for_meshes(pages);
  std::vector<char> all(megabytes * kMegabyte, 1);
  return may_be_large(&all.back()) ? kYes : kNo;
}

TEST(Heap, LargePagesAreForWhatIsLarge) {
  if (kHasOwnHeap) GTEST_SKIP() << "sanitizers have a heap of their own";
  if (!has_large_pages()) GTEST_SKIP() << "this system has no large pages";
  EXPECT_EQ(in_child([] { return is_large(HeapPages::kLarge, 8); }), kYes);
  EXPECT_EQ(in_child([] { return is_large(HeapPages::kLarge, 1); }), kYes);
  EXPECT_EQ(in_child([] { return is_large(HeapPages::kSmall, 8); }), kNo);
  // What a small model needs is before them.
  EXPECT_EQ(in_child([] {
              keep_freed_memory();
              make_room_for_meshes(HeapPages::kLarge);
              const std::vector<char> few(kMegabyte / 4, 1);
              return may_be_large(&few.back()) ? kYes : kNo;
            }),
            kNo);
}

/// How often the system had to give a page so far.
long page_faults() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return usage.ru_minflt;
}

/// Whether the system can be asked for pages before they are used (Linux 5.14).
bool can_map_ahead() {
#if defined(MADV_POPULATE_WRITE)
  const auto size = static_cast<size_t>(sysconf(_SC_PAGESIZE));
  void* const page =
      mmap(nullptr, size, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  const bool can = madvise(page, size, MADV_POPULATE_WRITE) == 0;
  munmap(page, size);
  return can;
#else
  return false;
#endif
}

TEST(Heap, PagesOfASmallModelAreThereBefore) {
  if (kHasOwnHeap) GTEST_SKIP() << "sanitizers have a heap of their own";
  if (!can_map_ahead()) GTEST_SKIP() << "this system gives pages as they are used";
  const auto faults_of_heap = [](bool is_mapped) {
    keep_freed_memory();
    if (is_mapped) map_program(true);
    const long before = page_faults();
    const std::vector<char> few(kMegabyte / 4, 1);
    return static_cast<int>(page_faults() - before) + few.back() - 1;
  };
  const int pages = static_cast<int>(kMegabyte / 4 / static_cast<size_t>(sysconf(_SC_PAGESIZE)));
  EXPECT_GE(in_child([&] { return faults_of_heap(false); }), pages / 2);
  EXPECT_LE(in_child([&] { return faults_of_heap(true); }), pages / 8);
}

TEST(Heap, ThereIsMemoryWhereThereAreFewAddresses) {
  if (kHasOwnHeap) GTEST_SKIP() << "sanitizers have a heap of their own";
  const auto allocate = [] {
    keep_freed_memory();
    make_room_for_meshes(HeapPages::kLarge);
    std::vector<std::vector<char>> many;
    for (int i = 0; i < 20; ++i) many.emplace_back(kMegabyte, static_cast<char>(i));
    for (int i = 0; i < 20; ++i) {
      if (many[static_cast<size_t>(i)].back() != i) return kNo;
    }
    return kYes;
  };
  EXPECT_EQ(in_child([&] {
              rlimit limit{};
              getrlimit(RLIMIT_AS, &limit);
              limit.rlim_cur = 512 * kMegabyte;  // less than is asked for first
              setrlimit(RLIMIT_AS, &limit);
              return allocate();
            }),
            kYes);
}

}  // namespace
}  // namespace csgrun::heap_test
