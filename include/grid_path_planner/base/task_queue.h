// The one thread in which a node plans, so that its callbacks stay live.
//
//   TaskQueue worker;
//   worker.cancel("goal");  // the task that runs, and those that wait in the slot "goal"
//   worker.post([=](const StopSource& stop) { plan(stop); }, "goal", TaskQueue::Turn::NEXT);
//   auto task = worker.post([=](const StopSource& stop) { save(stop); });
//   task->wait();
//   worker.postIdle([=](const StopSource& stop) { plan(stop); });  // once nothing else waits
//
// Tasks run one at a time. A task that was cancelled before its turn is run too, with a stop source
// that is cancelled already, so that every task comes to an end by itself and answers who asked. No
// task runs in a caller's thread: one that is posted after stop() is not run at all, and has ended.
// An exception ends its task and no other; the queue's owner is told of it, and what the owner throws
// then is dropped.
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
  // NEXT goes before what waits; what was overtaken a few times is not overtaken again.
  enum class Turn { NEXT, LAST };
  // Gets the sentence of a task's exception, in the worker's thread.
  using OnError = std::function<void(const std::string& error)>;

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
    int overtaken_ = 0;  // how often
    mutable std::mutex mutex_;
    mutable std::condition_variable changed_;
    bool ended_ = false;
  };

  explicit TaskQueue(OnError on_error = {});
  // Cancels everything and waits for its end.
  ~TaskQueue();

  // A task that still waits in the same slot (not "") is dropped in favour of this one, which with
  // LAST takes its place.
  std::shared_ptr<Task> post(Work work, const std::string& slot = "", Turn turn = Turn::LAST);

  // For when nothing else waits: every post(), before or after this, goes before it, and cancels it where
  // it runs. Dropped in favour of the next one, and where the queue stops.
  void postIdle(Work work);

  // Cancels the task that runs and those that wait in `slot`.
  void cancel(const std::string& slot);

  // As the destructor does.
  void stop();

 private:
  using Waiting = std::deque<std::shared_ptr<Task>>;

  void loop();
  std::shared_ptr<Task> next();
  void run(Task& task);
  void tellError() const noexcept;
  static void end(Task& task);
  void insert(const std::shared_ptr<Task>& task, Turn turn);
  Waiting::iterator overtake();

  const OnError on_error_;
  std::mutex mutex_;
  std::condition_variable posted_;
  Waiting waiting_;
  std::shared_ptr<Task> idle_;  // waits
  std::shared_ptr<Task> running_;
  bool idles_ = false;  // running_ was idle_
  bool stopping_ = false;
  std::thread thread_;
};

}  // namespace grid_path_planner::base
