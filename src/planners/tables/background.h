// One computation in a thread of its own, and its result once it is finished.
//
//   Background<Table> making;
//   making.start([map](const StopToken& stop) { return Table(*map, stop); });
//   if (std::shared_ptr<const Table> table = making.take()) use(*table);
//
// The thread has a low priority (nice 10, or that of the process where it is lower), so that searches go on beside it.
//
// A computation that is no longer needed is stopped by its token, so it should check it often. One
// that throws, stopped or for want of memory, gives no result.
//
// start(), take(), wait() and the destructor belong to one thread.
#pragma once

#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <new>
#include <system_error>
#include <thread>
#include <utility>

#include "grid_path_planner/base/stop_token.h"

namespace grid_path_planner::planners {

template <class Result>
class Background {
 public:
  Background() = default;
  ~Background() { stop(); }
  Background(const Background&) = delete;
  Background& operator=(const Background&) = delete;

  // Stops a running computation, drops its result and starts `compute(token)`, which returns a
  // Result.
  template <class Compute>
  void start(Compute compute) {
    stop();
    source_ = base::StopSource();
    auto work = [this, compute = std::move(compute), token = source_.token()]() mutable {
      // On Linux of this thread alone.
      setpriority(PRIO_PROCESS, 0, std::max(kNiceness, getpriority(PRIO_PROCESS, 0)));
      std::shared_ptr<const Result> result;
      try {
        result = std::make_shared<const Result>(compute(token));
      } catch (...) {  // stopped, or no memory: there is no result
      }
      const std::lock_guard<std::mutex> lock(mutex_);
      result_ = std::move(result);
      running_ = false;
      ended_.notify_all();
    };
    running_ = true;
    try {
      thread_ = std::thread(std::move(work));
    } catch (const std::system_error&) {  // no memory for its stack
      running_ = false;
    }
  }

  // Returns when the thread has ended: some thousand steps of its computation later.
  void stop() {
    source_.cancel();
    if (thread_.joinable()) thread_.join();
    result_.reset();
    running_ = false;
  }

  bool running() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return running_;
  }

  // The result, once; null while there is none.
  std::shared_ptr<const Result> take() {
    const std::lock_guard<std::mutex> lock(mutex_);
    return std::move(result_);
  }

  // Waits for the computation. Throws Stopped if `stop` comes first; the computation goes on then.
  void wait(const base::StopToken& stop) const {
    std::unique_lock<std::mutex> lock(mutex_);
    while (running_) {
      const base::StopReason reason = stop.reason();
      if (reason != base::StopReason::NONE) throw base::Stopped(reason);
      ended_.wait_for(lock, std::chrono::milliseconds(2));
    }
  }

 private:
  static constexpr int kNiceness = 10;

  mutable std::mutex mutex_;
  mutable std::condition_variable ended_;
  std::shared_ptr<const Result> result_;
  bool running_ = false;
  base::StopSource source_;
  std::thread thread_;
};

}  // namespace grid_path_planner::planners
