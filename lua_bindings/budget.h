// Time and memory of one run, held against scripts that do not want to stop.
//
// Three layers. (1) A count hook looks at a flag every thousand instructions and raises an error;
// from then on it fires at every instruction, so that no pcall loop survives. (2) A watchdog thread
// sets the flag when the time is over, and the cancel flag that the engine polls. (3) If nothing
// came of it after a grace period, the script sits in a single C call that hooks do not reach
// (string.find, table.move): the watchdog interrupts the thread with a signal, whose handler writes
// the message with the line, removes temporary files and ends the process with 124.
#pragma once

#include <array>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include <lua.hpp>
#include <pthread.h>

namespace csgrun {

struct BudgetLimits {
  double script_seconds = 60;           ///< the script alone; evaluation does not count
  std::optional<double> total_seconds;  ///< --timeout: everything, and instead of the above
  size_t heap_bytes = size_t{1} << 30;  ///< the Lua heap, with the meshes that its values hold
  /// False: what does not stop by itself runs on, for callers whose process has more to do.
  bool end_process = true;
};

class Budget {
 public:
  using Clock = std::chrono::steady_clock;
  enum class Phase : uint8_t { kIdle, kScript, kEvaluation };

  /// `model` names the run in messages that know no line. The total time starts here.
  Budget(BudgetLimits limits, std::string model);
  ~Budget();
  Budget(const Budget&) = delete;
  Budget& operator=(const Budget&) = delete;

  /// The allocator of the Lua state; `user_data` is the Budget.
  static void* allocate(void* user_data, void* block, size_t old_size, size_t new_size);

  /// Installs the hook and watches the calling thread as the one that runs the script.
  void start_script(lua_State* main_state);
  void stop_script();
  /// The script's clock stands still in evaluation; nests.
  void enter_evaluation();
  void leave_evaluation();
  /// Time spent between enter_evaluation and leave_evaluation so far.
  [[nodiscard]] double evaluation_seconds() const;
  /// From now on no time ends the process. (Writing files is covered until then when there is a
  /// total time.)
  void stop();

  [[nodiscard]] bool out_of_time() const { return expired_.load(std::memory_order_relaxed); }
  [[nodiscard]] const std::atomic<bool>& cancel() const { return expired_; }
  /// "out of time (limit 60 s)".
  [[nodiscard]] std::string time_message() const;
  /// "not enough memory (script limit 1024 MB)".
  [[nodiscard]] std::string memory_message() const;
  /// Notes the running line as the one where memory ran out. Allocates nothing.
  void note_out_of_memory();
  /// "FILE:line" of the allocation that was refused last; empty if none was.
  [[nodiscard]] std::string memory_place() const;

  /// Counts bytes outside of the Lua heap that values of the script hold; may outlive the Budget.
  [[nodiscard]] const std::shared_ptr<std::atomic<size_t>>& held_bytes() const { return held_; }
  [[nodiscard]] bool within_heap() const { return used_ + held_->load() <= limits_.heap_bytes; }

 private:
  static void hook(lua_State* L, lua_Debug* event);
  static void interrupt(int signal);
  void watch();
  void phase_changed();
  void end_process(const char* place);
  [[nodiscard]] std::optional<Clock::time_point> deadline() const;

  const BudgetLimits limits_;
  const std::string model_;
  const Clock::time_point start_;

  // The heap. `used_` is touched by the script's thread only, `held_` by any that frees a mesh.
  size_t used_ = 0;
  std::shared_ptr<std::atomic<size_t>> held_ = std::make_shared<std::atomic<size_t>>(0);
  std::array<char, 1024> memory_place_{};  // no allocation when there is no memory
  lua_State* main_state_ = nullptr;

  std::atomic<bool> expired_{false};
  mutable std::mutex mutex_;
  std::condition_variable wake_;
  Phase phase_ = Phase::kIdle;     // guarded by mutex_, as all below
  Clock::duration script_used_{};  // up to the last change of phase
  Clock::duration evaluation_used_{};
  Clock::time_point evaluation_start_{};
  Clock::time_point phase_start_{};
  bool script_running_ = false;
  Clock::time_point looks_again_ = Clock::time_point::max();  // the watchdog, left to itself
  int evaluation_depth_ = 0;
  bool stopping_ = false;
  pthread_t script_thread_{};
  std::thread watchdog_;
};

/// Evaluation for the time of a scope.
class EvaluationScope {
 public:
  explicit EvaluationScope(Budget& budget) : budget_(budget) { budget_.enter_evaluation(); }
  ~EvaluationScope() { budget_.leave_evaluation(); }
  EvaluationScope(const EvaluationScope&) = delete;
  EvaluationScope& operator=(const EvaluationScope&) = delete;

 private:
  Budget& budget_;
};

/// Three quarters of the memory that this process can still get (the machine's, or its group's).
size_t default_process_memory();

/// Limits the private memory of the process from now on. Does nothing in sanitizer builds, whose
/// shadow memory would not fit.
void limit_process_memory(size_t bytes);

}  // namespace csgrun
