#include "lua_bindings/budget.h"

#include <algorithm>
#include <charconv>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <string_view>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include <csgrun/export/write.h>

#include "lua_bindings/call_site.h"
#include "lua_bindings/guard.h"
#include "lua_bindings/session.h"

namespace csgrun {
namespace {

/// Instructions between two looks at the flag: a few microseconds, at a cost that cannot be
/// measured.
constexpr int kHookInterval = 1000;
/// How long a script may go on after its time: long enough to unwind, also on a busy machine.
constexpr auto kScriptGrace = std::chrono::milliseconds(500);
/// How long the engine, which polls between cells, may go on.
constexpr auto kEvaluationGrace = std::chrono::milliseconds(800);
/// How long the signal handler may take: on a busy machine its thread may not run at once.
constexpr auto kHandlerGrace = std::chrono::seconds(2);
constexpr int kTimeoutExit = 124;
constexpr size_t kMegabyte = size_t{1} << 20;

// For the signal handler, which has no other way to get at them.
std::atomic<lua_State*> interrupted_state{nullptr};
char interrupted_message[256];
char interrupted_model[1024];

void write_all(const char* text) {
  size_t left = std::strlen(text);
  while (left > 0) {
    const ssize_t done = ::write(STDERR_FILENO, text, left);
    if (done <= 0) return;
    text += done;
    left -= static_cast<size_t>(done);
  }
}

}  // namespace

Budget::Budget(BudgetLimits limits, std::string model)
    : limits_(limits), model_(std::move(model)), start_(Clock::now()) {
  std::snprintf(interrupted_model, sizeof interrupted_model, "%s", model_.c_str());
  watchdog_ = std::thread([this] { watch(); });
}

Budget::~Budget() {
  stop();
  wake_.notify_all();
  watchdog_.join();
}

void* Budget::allocate(void* user_data, void* block, size_t old_size, size_t new_size) {
  Budget& self = *static_cast<Budget*>(user_data);
  if (block == nullptr) old_size = 0;  // then it is a type tag, not a size
  if (new_size == 0) {
    self.used_ -= old_size;
    std::free(block);
    return nullptr;
  }
  const size_t held = self.held_->load(std::memory_order_relaxed);
  void* grown = nullptr;
  if (new_size <= old_size || self.used_ - old_size + new_size + held <= self.limits_.heap_bytes) {
    grown = std::realloc(block, new_size);
  }
  if (grown == nullptr) {
    // Lua reports this without a place. The stack is whole while it allocates, so look now.
    self.note_out_of_memory();
    return nullptr;
  }
  self.used_ += new_size - old_size;
  return grown;
}

void Budget::hook(lua_State* L, lua_Debug*) {
  Budget& self = session_of(L).budget();
  if (!self.out_of_time()) return;
  lua_sethook(L, &Budget::hook, LUA_MASKCOUNT, 1);
  {
    const std::string message = self.time_message();
    push_error(L, message.c_str());
  }
  raise_pushed_error(L);
}

void Budget::start_script(lua_State* main_state) {
  lua_sethook(main_state, &Budget::hook, LUA_MASKCOUNT, kHookInterval);
  const std::lock_guard lock(mutex_);
  main_state_ = main_state;
  script_thread_ = pthread_self();
  phase_ = Phase::kScript;
  script_running_ = true;
  phase_start_ = Clock::now();
  phase_changed();
}

void Budget::stop_script() {
  const std::lock_guard lock(mutex_);
  script_used_ += Clock::now() - phase_start_;
  phase_ = Phase::kIdle;
  script_running_ = false;
  main_state_ = nullptr;
  phase_changed();
}

void Budget::enter_evaluation() {
  const std::lock_guard lock(mutex_);
  if (evaluation_depth_++ > 0) return;
  if (phase_ == Phase::kScript) script_used_ += Clock::now() - phase_start_;
  phase_ = Phase::kEvaluation;
  evaluation_start_ = Clock::now();
  phase_changed();
}

void Budget::leave_evaluation() {
  const std::lock_guard lock(mutex_);
  if (--evaluation_depth_ > 0) return;
  evaluation_used_ += Clock::now() - evaluation_start_;
  phase_ = script_running_ ? Phase::kScript : Phase::kIdle;
  phase_start_ = Clock::now();
  phase_changed();
}

/// Wakes the watchdog if it has to look sooner than it would: that takes longer than many a
/// measure of a script.
void Budget::phase_changed() {
  const auto until = deadline();
  if (expired_ || (until && *until < looks_again_)) wake_.notify_all();
}

double Budget::evaluation_seconds() const {
  const std::lock_guard lock(mutex_);
  return std::chrono::duration<double>(evaluation_used_).count();
}

// The watchdog sees it when it wakes. To wait for its end may take a third of a millisecond.
void Budget::stop() {
  const std::lock_guard lock(mutex_);
  stopping_ = true;
}

std::string Budget::time_message() const {
  return fmt::format("out of time ({} {:g} s)",
                     limits_.total_seconds ? "limit" : "limit for the script",
                     limits_.total_seconds.value_or(limits_.script_seconds));
}

void Budget::note_out_of_memory() {
  lua_Debug frame{};
  if (main_state_ == nullptr || !innermost_lua_frame(main_state_, frame)) return;
  std::snprintf(memory_place_.data(), memory_place_.size(), "%s:%d", chunk_file(frame),
                frame.currentline);
}

std::string Budget::memory_place() const { return memory_place_.data(); }

std::string Budget::memory_message() const {
  return fmt::format("not enough memory (script limit {} MB)", limits_.heap_bytes / kMegabyte);
}

std::optional<Budget::Clock::time_point> Budget::deadline() const {
  const auto seconds = [](double s) {
    return std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(s));
  };
  if (limits_.total_seconds) return start_ + seconds(*limits_.total_seconds);
  if (phase_ != Phase::kScript) return std::nullopt;
  return phase_start_ + seconds(limits_.script_seconds) - script_used_;
}

void Budget::watch() {
  std::unique_lock lock(mutex_);
  while (true) {  // until the time is over
    if (stopping_) return;
    const auto until = deadline();
    if (until && Clock::now() >= *until) break;
    looks_again_ = until.value_or(Clock::time_point::max());
    if (until) {
      wake_.wait_until(lock, *until);
    } else {
      wake_.wait(lock);
    }
  }
  expired_ = true;
  if (!limits_.end_process) return;
  auto over = Clock::now();
  Phase last = phase_;
  while (true) {  // until it has stopped, or the grace is over
    if (stopping_) return;
    if (phase_ != last) {
      last = phase_;
      over = Clock::now();
    }
    const auto until = over + (last == Phase::kScript ? Clock::duration(kScriptGrace)
                                                      : Clock::duration(kEvaluationGrace));
    if (Clock::now() >= until) break;
    wake_.wait_until(lock, until);
  }
  if (phase_ == Phase::kScript) {
    std::snprintf(interrupted_message, sizeof interrupted_message, "%s", time_message().c_str());
    interrupted_state = main_state_;
    struct sigaction action {};
    action.sa_handler = &Budget::interrupt;
    sigaction(SIGUSR1, &action, nullptr);
    pthread_kill(script_thread_, SIGUSR1);
    wake_.wait_for(lock, kHandlerGrace, [this] { return stopping_; });
    if (stopping_) return;
  }
  end_process(interrupted_model);
}

// Runs on the script's thread, inside of whatever it was doing. Half a second without a hook means
// that this is one long C call, so the call stack stands still and may be read.
void Budget::interrupt(int) {
  lua_Debug frame{};
  lua_State* const L = interrupted_state.load();
  if (L != nullptr && innermost_lua_frame(L, frame)) {
    char digits[16];
    char* digit = digits + sizeof digits - 1;
    *digit = '\0';
    for (int line = frame.currentline; line > 0; line /= 10)
      *--digit = static_cast<char>('0' + line % 10);
    write_all(chunk_file(frame));
    write_all(":");
    write_all(digit);
  } else {
    write_all(interrupted_model);
  }
  write_all(": ");
  write_all(interrupted_message);
  write_all("\n");
  remove_temporary_files();
  _exit(kTimeoutExit);
}

void Budget::end_process(const char* place) {
  write_all(place);
  write_all(": ");
  write_all(time_message().c_str());
  write_all("\n");
  remove_temporary_files();
  _exit(kTimeoutExit);
}

namespace {

constexpr size_t kNoLimit = std::numeric_limits<size_t>::max();

/// The beginning of a small file, or nothing. (A stream would take longer than all the rest here.)
class FileStart {
 public:
  explicit FileStart(const char* path) {
    const int file = open(path, O_RDONLY | O_CLOEXEC);
    if (file < 0) return;
    const ssize_t size = read(file, text_.data(), text_.size());
    size_ = size > 0 ? static_cast<size_t>(size) : 0;
    close(file);
  }
  [[nodiscard]] std::string_view text() const { return {text_.data(), size_}; }

 private:
  std::array<char, 512> text_;
  size_t size_ = 0;
};

/// The number at the beginning of a text, perhaps after blanks ("max", or none, is no limit).
size_t leading_number(std::string_view text) {
  text.remove_prefix(std::min(text.find_first_not_of(' '), text.size()));
  size_t value = 0;
  const auto end = std::from_chars(text.data(), text.data() + text.size(), value);
  return end.ec == std::errc() ? value : kNoLimit;
}

}  // namespace

size_t default_process_memory() {
  size_t available = kNoLimit;
  constexpr std::string_view kKey = "MemAvailable:";
  const FileStart info("/proc/meminfo");
  const size_t key = info.text().find(kKey);
  if (key != std::string_view::npos) {
    const size_t kilobytes = leading_number(info.text().substr(key + kKey.size()));
    if (kilobytes != kNoLimit) available = kilobytes * 1024;
  }
  for (const char* path :
       {"/sys/fs/cgroup/memory.max", "/sys/fs/cgroup/memory/memory.limit_in_bytes"}) {
    available = std::min(available, leading_number(FileStart(path).text()));
  }
  return available == kNoLimit ? available : available / 4 * 3;
}

void limit_process_memory(size_t bytes) {
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
  // RLIMIT_DATA counts private writable memory: what is used, not what is merely reserved.
  rlimit limit{};
  if (getrlimit(RLIMIT_DATA, &limit) != 0) return;
  limit.rlim_cur =
      limit.rlim_max == RLIM_INFINITY ? bytes : std::min<rlim_t>(bytes, limit.rlim_max);
  setrlimit(RLIMIT_DATA, &limit);
#else
  (void)bytes;
#endif
}

}  // namespace csgrun
