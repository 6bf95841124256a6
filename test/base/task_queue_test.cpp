#include "grid_path_planner/base/task_queue.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <future>
#include <new>
#include <stdexcept>
#include <string>
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
}

TEST(TaskQueue, NoTaskRunsInACallersThread) {
  TaskQueue worker;
  worker.stop();
  bool ran = false;
  worker.post([&](const StopSource&) { ran = true; })->wait();
  EXPECT_FALSE(ran);
}

TEST(TaskQueue, AnExceptionEndsItsTaskAndIsTold) {
  std::vector<std::string> told;
  TaskQueue worker([&](const std::string& error) { told.push_back(error); });
  worker.post([](const StopSource&) { throw std::runtime_error("the map is odd"); })->wait();
  worker.post([](const StopSource&) { throw std::bad_alloc(); })->wait();
  worker.post([](const StopSource&) { throw 7; })->wait();
  EXPECT_EQ(told, (std::vector<std::string>{"the map is odd", "there is not enough memory",
                                            "an error without a name"}));
}

// Each new map went behind the questions that waited, so it never had its turn.
TEST(TaskQueue, AReplacedTaskKeepsItsPlace) {
  std::vector<int> order;
  Hold hold;
  TaskQueue worker;
  worker.post(hold.work());
  hold.waitUntilHeld();
  const auto replaced = worker.post([](const StopSource&) {}, "map");
  const auto question = worker.post([&](const StopSource&) { order.push_back(2); });
  worker.post([&](const StopSource&) { order.push_back(1); }, "map");
  replaced->wait();
  hold.release();
  question->wait();
  EXPECT_EQ(order, (std::vector<int>{1, 2}));
}

// Three clients asked while a fourth one's answer was made: idle work from before it, which stood first in
// the queue, gave its place to that from after it, which no question interrupts that had come before, and
// all four waited for tables of 2.4 s.
TEST(TaskQueue, IdleWorkGoesBehindAllThatWaits) {
  std::vector<int> order;
  Hold first, second;
  TaskQueue worker;
  worker.post(first.work());
  first.waitUntilHeld();
  worker.postIdle([&](const StopSource&) { order.push_back(8); });
  worker.post(second.work());
  std::promise<void> idled;
  for (int i = 0; i < 3; ++i) worker.post([&, i](const StopSource&) { order.push_back(i); });
  worker.postIdle([&](const StopSource& stop) {
    order.push_back(stop.cancelled() ? -1 : 9);
    idled.set_value();
  });
  first.release();
  second.release();
  idled.get_future().wait();
  EXPECT_EQ(order, (std::vector<int>{0, 1, 2, 9}));
}

TEST(TaskQueue, IdleWorkIsInterruptedByWhatIsPosted) {
  Hold idle;
  TaskQueue worker;
  worker.postIdle(idle.work());
  idle.waitUntilHeld();
  bool cancelled = true;
  worker.post([&](const StopSource& stop) { cancelled = stop.cancelled(); })->wait();
  EXPECT_TRUE(idle.cancelled());
  EXPECT_FALSE(cancelled);
}

TEST(TaskQueue, IdleWorkEndsWithTheWorkerAndIsNotBegunAfterIt) {
  Hold idle;
  bool begun = false;
  TaskQueue worker;
  worker.postIdle(idle.work());
  idle.waitUntilHeld();
  worker.postIdle([&](const StopSource&) { begun = true; });
  worker.stop();
  worker.postIdle([&](const StopSource&) { begun = true; });
  EXPECT_TRUE(idle.cancelled());
  EXPECT_FALSE(begun);
}

// The owner makes itself anew where its memory ended: what it throws then would end the process.
TEST(TaskQueue, AnOwnerThatThrowsWhenToldEndsNothing) {
  std::atomic<int> told{0};
  TaskQueue worker([&](const std::string&) {
    ++told;
    throw std::bad_alloc();
  });
  worker.post([](const StopSource&) { throw std::runtime_error("first"); })->wait();
  worker.post([](const StopSource&) { throw std::bad_alloc(); })->wait();
  EXPECT_EQ(told, 2);
}

// Goals at 1 kHz would keep the map waiting for ever.
TEST(TaskQueue, ATaskIsOvertakenAFewTimesOnly) {
  std::vector<int> order;
  Hold hold;
  TaskQueue worker;
  worker.post(hold.work());
  hold.waitUntilHeld();
  worker.post([&](const StopSource&) { order.push_back(0); });
  for (int i = 1; i <= 5; ++i)
    worker.post([&, i](const StopSource&) { order.push_back(i); }, "", TaskQueue::Turn::NEXT);
  hold.release();
  worker.post([](const StopSource&) {})->wait();
  EXPECT_LE(std::find(order.begin(), order.end(), 0) - order.begin(), 3);
}

}  // namespace
}  // namespace grid_path_planner::base
