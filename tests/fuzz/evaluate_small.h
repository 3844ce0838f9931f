// Evaluation of whatever an input describes, so that small inputs end soon: in one thread, given up
// after a while by the flag that the engine polls. An engine that does not look at it for long is a
// hang, and found as one.
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <thread>
#include <vector>

#include <csgrun/engine/evaluate.h>

#include "tests/fuzz/checks.h"

namespace csgrun::fuzz {

/// A flag that is set after some time, unless it goes out of scope before.
class Alarm {
 public:
  explicit Alarm(std::chrono::milliseconds time)
      : thread_([this, time] {
          std::unique_lock lock(mutex_);
          if (!wake_.wait_for(lock, time, [this] { return done_; })) flag_ = true;
        }) {}
  ~Alarm() {
    {
      const std::lock_guard lock(mutex_);
      done_ = true;
    }
    wake_.notify_all();
    thread_.join();
  }
  Alarm(const Alarm&) = delete;
  Alarm& operator=(const Alarm&) = delete;
  [[nodiscard]] const std::atomic<bool>& flag() const { return flag_; }

 private:
  std::atomic<bool> flag_{false};
  bool done_ = false;  // guarded by mutex_
  std::mutex mutex_;
  std::condition_variable wake_;
  std::thread thread_;
};

/// Evaluates the trees and checks what comes of it.
inline void evaluate_small(const std::vector<NodePtr>& parts) {
  const Alarm alarm(std::chrono::seconds(2));
  EvaluateOptions options;
  options.threads = 1;
  options.cache_bytes = 16 << 20;
  options.cancel = &alarm.flag();
  Evaluator evaluator(options);
  const auto solids = evaluator.evaluate(parts);
  if (!solids) {
    expect_users_fault(solids.error());
    return;
  }
  for (const SolidPtr& solid : *solids) expect_closed(*solid);
}

}  // namespace csgrun::fuzz
