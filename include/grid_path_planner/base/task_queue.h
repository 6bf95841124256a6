// The one thread in which a node plans, so that its callbacks stay live.
//
//   TaskQueue worker;
//   worker.cancel("goal");  // the task that runs, and those that wait in the slot "goal"
//   worker.post([=](const StopSource& stop) { plan(stop); }, "goal", TaskQueue::Turn::NEXT);
//   auto task = worker.post([=](const StopSource& stop) { save(stop); });
//   task->wait();
//
// Tasks run one at a time. A task that was cancelled before its turn is run too, with a stop source
// that is cancelled already, so that every task comes to an end by itself and answers who asked.
#pragma once

#include <chrono>
#include <condition_variable>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <thread>

#include "grid_path_planner/base/stop_token.h"

namespace grid_path_planner::base {

class TaskQueue {
 public:
  using Work = std::function<void(const StopSource&)>;
  enum class Turn { NEXT, LAST };

  class Task {
   public:
    void cancel() { stop_.cancel(); }
    void wait() const;
    // Whether the task ended before `limit` passed (steady clock).
    bool waitFor(std::chrono::duration<double> limit) const;

   private:
    friend class TaskQueue;
    Work work_;
    std::string slot_;
    StopSource stop_;
    mutable std::mutex mutex_;
    mutable std::condition_variable changed_;
    bool ended_ = false;
  };

  TaskQueue();
  // Cancels everything and waits for its end.
  ~TaskQueue();

  // A task that still waits in the same slot (not "") is dropped in favour of this one.
  std::shared_ptr<Task> post(Work work, const std::string& slot = "", Turn turn = Turn::LAST);

  // Cancels the task that runs and those that wait in `slot`.
  void cancel(const std::string& slot);

  // As the destructor does; later posts are run at once with a cancelled stop source.
  void stop();

 private:
  void loop();
  static void run(Task& task);

  std::mutex mutex_;
  std::condition_variable posted_;
  std::deque<std::shared_ptr<Task>> waiting_;
  std::shared_ptr<Task> running_;
  bool stopping_ = false;
  std::thread thread_;
};

}  // namespace grid_path_planner::base
