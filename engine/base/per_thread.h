// Working memory of loops on several threads.
#pragma once

#include <memory>
#include <mutex>
#include <optional>
#include <utility>

#include <tbb/enumerable_thread_specific.h>

#include "engine/base/parallel.h"

namespace csgrun {

/// A thing for each thread that asks for one, made by make() then, and never moved. While a frame
/// goes on alone its thread has one that does not begin the threads' library.
template <class Make>
class PerThread {
 public:
  using Thing = decltype(std::declval<Make&>()());

  explicit PerThread(Make make) : make_(std::move(make)) {}

  /// That of this thread.
  Thing& local() {
    if (frame_ && ThreadsFrame::current() == frame_ && !frame_->has_begun()) {
      if (!alone_) alone_.reset(new Thing(make_()));
      return *alone_;
    }
    std::call_once(is_shared_, [&] { all_.emplace([this] { return make_(); }); });
    return all_->local();
  }

 private:
  Make make_;
  const ThreadsFrame* const frame_ = ThreadsFrame::current();
  std::unique_ptr<Thing> alone_;
  std::once_flag is_shared_;
  std::optional<tbb::enumerable_thread_specific<Thing>> all_;
};

}  // namespace csgrun
