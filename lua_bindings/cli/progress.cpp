#include "lua_bindings/cli/progress.h"

#include <chrono>
#include <cstdio>
#include <memory>

#include <unistd.h>

namespace csgrun {
namespace {

constexpr auto kInterval = std::chrono::milliseconds(100);
/// Runs shorter than this show nothing.
constexpr auto kPatience = std::chrono::milliseconds(500);
bool shown = false;

}  // namespace

std::function<void(uint64_t, uint64_t)> make_progress(bool quiet) {
  if (quiet || isatty(STDERR_FILENO) == 0) return {};
  using Clock = std::chrono::steady_clock;
  const auto next = std::make_shared<Clock::time_point>(Clock::now() + kPatience);
  return [next](uint64_t done, uint64_t total) {
    if (total == 0 || Clock::now() < *next) return;
    *next = Clock::now() + kInterval;
    shown = true;
    std::fprintf(stderr, "\r%3d %% ", static_cast<int>(done * 100 / total));
    std::fflush(stderr);
  };
}

void clear_progress() {
  if (shown) std::fputs("\r      \r", stderr);
  shown = false;
}

}  // namespace csgrun
