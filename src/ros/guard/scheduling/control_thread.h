// A thread that commands a vehicle: it ticks at a rate by the wall clock, and serves a callback queue of its own.
//
//   ControlThread thread([&] { tick(); }, [&] { publish({}); });
//   nh.setCallbackQueue(&thread.queue());         // of the topics that must be obeyed whatever else the node does
//   thread.start(50.0, 1);                        // Hz, real-time priority
//   thread.ask([&] { thread.setRate(20.0); });    // in the thread, and waited for
//
// What the tick uses belongs to this thread alone: others hand it work. Guaranteed: work that comes is done at
// once, in its order; ticks that were missed are not made up for; it takes half of a processor at most, however
// long ticks and work are, since before a real-time thread no other comes. Not guaranteed: that the machine gives
// it a processor in time, which takes a real-time priority.
#pragma once

#include <ros/callback_queue.h>

#include <atomic>
#include <chrono>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <type_traits>
#include <utility>

#include "ros/guard/guarded_queue.h"

namespace grid_path_planner::nodes {

class ControlThread {
 public:
  // What the tick throws ends that tick: `on_failure` is called in its place, which sends a zero. Twice within 10 s for want of
  // memory ends the process (process/memory_failures.h). `on_jump_back` is told before the next tick and the next work.
  explicit ControlThread(
      std::function<void()> tick, std::function<void()> on_failure = [] {},
      NodeTime::Listener on_jump_back = [](double) {})
      : tick_(std::move(tick)),
        on_failure_(std::move(on_failure)),
        on_jump_back_(guarded_.time().onJumpBack(std::move(on_jump_back))) {}
  ~ControlThread() { stop(); }
  ControlThread(const ControlThread&) = delete;
  ControlThread& operator=(const ControlThread&) = delete;

  // Ticks at `rate` (Hz), with the real-time priority if it is granted (0: none). To be called once.
  void start(double rate, int priority);
  // Waits for its end. Work that is handed over after this is not done: none may be asked for.
  void stop();

  // Outlives the subscriptions that it serves.
  ros::CallbackQueueInterface& queue() { return guarded_; }

  // Hands `work` over.
  void post(std::function<void()> work);
  // The same with a tick after it, and waits for both. What `work` throws comes back, std::bad_alloc where there was no
  // memory to call it.
  template <class Work>
  auto ask(Work work) -> std::invoke_result_t<Work> {
    using Result = std::invoke_result_t<Work>;
    if constexpr (std::is_void_v<Result>) {
      doAndWait(work);
    } else {
      std::optional<Result> result;
      doAndWait([&] { result = work(); });
      return std::move(*result);
    }
  }

  // As ask(), for the last work of a node that ends: again and again for a second where it throws. Whether it was done.
  bool askAtLast(const std::function<void()>& work) noexcept;

  // These are called in the thread:
  void tick();
  // The next tick comes a whole period from now.
  void restartPeriod();
  void setRate(double rate) { rate_ = rate; }  // Hz
  void setPriority(int priority);

  // How the thread is scheduled, in words.
  std::string scheduling() const;

 private:
  using Clock = std::chrono::steady_clock;

  void doAndWait(const std::function<void()>& work);
  Clock::duration period() const;
  void giveUpTick() noexcept;
  void run();
  void workOrTick();
  void takePriority();

  const std::function<void()> tick_, on_failure_;
  double rate_ = 1.0;
  int priority_ = 0;
  Clock::time_point next_tick_;

  mutable std::mutex mutex_;  // of scheduling_
  std::string scheduling_;

  ros::CallbackQueue queue_;
  GuardedQueue guarded_{queue_};
  const std::shared_ptr<void> on_jump_back_;
  std::atomic<bool> done_{false};
  std::thread thread_;
};

}  // namespace grid_path_planner::nodes
