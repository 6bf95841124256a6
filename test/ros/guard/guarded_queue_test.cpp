#include "ros/guard/guarded_queue.h"

#include <gtest/gtest.h>
#include <ros/callback_queue.h>

#include <chrono>
#include <cstdint>
#include <future>
#include <thread>
#include <vector>

namespace grid_path_planner::nodes {
namespace {

// A nodelet's constructor runs in the thread that loads it, its callbacks in another: a request to reconfigure
// teleop_joy that came between its offering of the service and its end changed the rate while the constructor
// read it. The thread sanitizer saw it in every_node.
TEST(GuardedQueue, CallsNothingWhileItHoldsAndAllInOrderAfterwards) {
  ros::CallbackQueue behind;
  GuardedQueue queue(behind);
  std::vector<int> called;
  const auto add = [&](int number, std::uint64_t owner) {
    queue.addCallback(callbackOf([&called, number] { called.push_back(number); }), owner);
  };
  queue.hold();
  add(1, 7);
  add(2, 8);
  add(3, 7);
  behind.callAvailable();
  EXPECT_TRUE(called.empty());
  queue.removeByID(8);  // as by a subscription that ends
  queue.release();
  add(4, 9);
  behind.callAvailable();
  EXPECT_EQ(called, (std::vector<int>{1, 3, 4}));
}

// roscpp's queue at its worst moment: a thread has taken a callback out of it, and does not know that it is removed.
class TakenOut : public ros::CallbackQueueInterface {
 public:
  void addCallback(const ros::CallbackInterfacePtr& callback, std::uint64_t) override {
    taken_ = callback;
  }
  void removeByID(std::uint64_t) override {}
  void call() const { taken_->call(); }

 private:
  ros::CallbackInterfacePtr taken_;
};

// The thread sanitizer saw it in map_receiver: a subscriber's end was told to a topic of maps that was gone.
TEST(GuardedQueue, CallsNothingOfAnOwnerThatWasRemoved) {
  TakenOut behind;
  GuardedQueue queue(behind);
  int called = 0;
  const auto count = callbackOf([&] { ++called; });
  queue.addCallback(count, 7);
  queue.removeByID(8);
  behind.call();
  EXPECT_EQ(called, 1);
  queue.removeByID(7);
  behind.call();
  EXPECT_EQ(called, 1);
  queue.addCallback(count, 7);  // another one at the same address
  behind.call();
  EXPECT_EQ(called, 2);
}

TEST(GuardedQueue, RemovalWaitsForACallbackThatRuns) {
  TakenOut behind;
  GuardedQueue queue(behind);
  std::promise<void> begins, may_end;
  bool is_over = false;
  queue.addCallback(callbackOf([&] {
                      begins.set_value();
                      may_end.get_future().wait();
                      is_over = true;
                    }),
                    7);
  std::thread calls([&] { behind.call(); });
  begins.get_future().wait();
  std::future<bool> over_when_removed = std::async(std::launch::async, [&] {
    queue.removeByID(7);
    return is_over;
  });
  EXPECT_EQ(over_when_removed.wait_for(std::chrono::milliseconds(50)), std::future_status::timeout);
  may_end.set_value();
  EXPECT_TRUE(over_when_removed.get());
  calls.join();
}

TEST(GuardedQueue, ACallbackMayRemoveItsOwner) {
  ros::CallbackQueue behind;
  GuardedQueue queue(behind);
  int called = 0;
  const auto remove = callbackOf([&] {
    ++called;
    queue.removeByID(7);
  });
  queue.addCallback(remove, 7);
  queue.addCallback(remove, 7);
  behind.callAvailable();
  EXPECT_EQ(called, 1);
}

}  // namespace
}  // namespace grid_path_planner::nodes
