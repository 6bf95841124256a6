#include "grid_path_planner/base/task_queue.h"

#include <gtest/gtest.h>

#include <atomic>
#include <future>
#include <vector>

namespace grid_path_planner::base {
namespace {

// A task that holds the worker until it is let go or cancelled.
class Hold {
 public:
  TaskQueue::Work work() {
    return [this](const StopSource& stop) {
      held_.set_value();
      while (!released_ && !stop.cancelled()) std::this_thread::yield();
      cancelled_ = stop.cancelled();
    };
  }
  void waitUntilHeld() { held_.get_future().wait(); }
  void release() { released_ = true; }
  bool cancelled() const { return cancelled_; }

 private:
  std::promise<void> held_;
  std::atomic<bool> released_{false};
  std::atomic<bool> cancelled_{false};
};

TEST(TaskQueue, RunsInTurnAndNextGoesFirst) {
  std::vector<int> order;
  Hold hold;
  TaskQueue worker;
  worker.post(hold.work());
  hold.waitUntilHeld();
  worker.post([&](const StopSource&) { order.push_back(1); });
  const auto last = worker.post([&](const StopSource&) { order.push_back(2); });
  worker.post([&](const StopSource&) { order.push_back(0); }, "", TaskQueue::Turn::NEXT);
  hold.release();
  last->wait();
  EXPECT_EQ(order, (std::vector<int>{0, 1, 2}));
}

TEST(TaskQueue, AWaitingTaskOfTheSameSlotIsReplaced) {
  std::vector<int> order;
  Hold hold;
  TaskQueue worker;
  worker.post(hold.work());
  hold.waitUntilHeld();
  worker.post([&](const StopSource&) { order.push_back(1); }, "map");
  const auto last = worker.post([&](const StopSource&) { order.push_back(2); }, "map");
  hold.release();
  last->wait();
  EXPECT_EQ(order, (std::vector<int>{2}));
}

TEST(TaskQueue, CancelReachesItsSlotOnly) {
  Hold goal;
  TaskQueue worker;
  const auto task = worker.post(goal.work(), "goal");
  bool other_cancelled = true;
  const auto other =
      worker.post([&](const StopSource& stop) { other_cancelled = stop.cancelled(); });
  goal.waitUntilHeld();
  worker.cancel("map");
  EXPECT_FALSE(task->waitFor(std::chrono::milliseconds(1)));
  worker.cancel("goal");
  other->wait();
  EXPECT_TRUE(goal.cancelled());
  EXPECT_FALSE(other_cancelled);
}

TEST(TaskQueue, EveryTaskEndsWhenTheWorkerStops) {
  Hold hold;
  TaskQueue worker;
  worker.post(hold.work());
  hold.waitUntilHeld();
  bool cancelled = false;
  const auto waiting = worker.post([&](const StopSource& stop) { cancelled = stop.cancelled(); });
  worker.stop();
  waiting->wait();
  EXPECT_TRUE(hold.cancelled());
  EXPECT_TRUE(cancelled);
  bool late_cancelled = false;
  worker.post([&](const StopSource& stop) { late_cancelled = stop.cancelled(); })->wait();
  EXPECT_TRUE(late_cancelled);
}

}  // namespace
}  // namespace grid_path_planner::base
