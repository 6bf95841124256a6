#include "ros/common/guarded_queue.h"

#include <gtest/gtest.h>
#include <ros/callback_queue.h>

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

}  // namespace
}  // namespace grid_path_planner::nodes
