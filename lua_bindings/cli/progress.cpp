#include "lua_bindings/cli/progress.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <memory>
#include <string>

#include <fmt/format.h>
#include <unistd.h>

namespace csgrun {
namespace {

constexpr auto kInterval = std::chrono::milliseconds(100);
/// Runs shorter than this show nothing.
constexpr auto kPatience = std::chrono::milliseconds(500);
/// How wide the line is that stands there.
int shown = 0;

using Clock = std::chrono::steady_clock;

bool is_watched(bool quiet) { return !quiet && isatty(STDERR_FILENO) != 0; }

/// Shows a line, if it is time to, over the one before.
class Line {
 public:
  void show(const std::string& text) {
    if (Clock::now() < next_) return;
    next_ = Clock::now() + kInterval;
    const auto width = static_cast<int>(text.size());
    std::fprintf(stderr, "\r%s%*s", text.c_str(), std::max(0, shown - width), "");
    std::fflush(stderr);
    shown = std::max(shown, width);
  }

 private:
  Clock::time_point next_ = Clock::now() + kPatience;
};

}  // namespace

std::function<void(uint64_t, uint64_t)> make_progress(bool quiet) {
  if (!is_watched(quiet)) return {};
  return [line = std::make_shared<Line>()](uint64_t done, uint64_t total) {
    if (total > 0) line->show(fmt::format("{:3} % ", done * 100 / total));
  };
}

std::function<void(unsigned, size_t)> make_repair_progress(bool quiet) {
  if (!is_watched(quiet)) return {};
  return [line = std::make_shared<Line>()](unsigned round, size_t left) {
    line->show(fmt::format("repair, round {}: {} places left ", round, left));
  };
}

void clear_progress() {
  if (shown > 0) std::fprintf(stderr, "\r%*s\r", shown, "");
  shown = 0;
}

}  // namespace csgrun
