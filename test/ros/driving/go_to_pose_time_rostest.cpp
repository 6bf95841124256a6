// A goal that comes before the node has looked at the clock.
#include <gtest/gtest.h>
#include <ros/callback_queue.h>
#include <ros/ros.h>
#include <ros/subscription_queue.h>

#include <atomic>

#include "ros/driving/go_to_pose_node.h"
#include "ros/support/latest.h"
#include "ros/support/wait.h"

namespace grid_path_planner::nodes {
namespace {

// A node's queue, of whose callbacks all but those of subscriptions can be kept back.
class MessagesFirst : public GuardedQueue {
 public:
  using GuardedQueue::GuardedQueue;

  void addCallback(const ros::CallbackInterfacePtr& callback, std::uint64_t owner) override {
    const bool is_message = dynamic_cast<ros::SubscriptionQueue*>(callback.get()) != nullptr;
    if (is_message || !messages_only) GuardedQueue::addCallback(callback, owner);
  }

  std::atomic<bool> messages_only{false};
};

// A goal of rviz's that came between /clock that went back and the node's next tick was refused as one from before its
// start: its callback alone did not ask whether time had gone back.
TEST(GoToPoseTime, AGoalThatIsTheFirstToMeetAJumpIsOfTheNewTime) {
  ros::Time::setNow(ros::Time(100.0));
  ros::CallbackQueue behind;
  MessagesFirst queue(behind);
  ros::NodeHandle nh, private_nh("~"), own;
  for (ros::NodeHandle* handle : {&nh, &private_nh}) handle->setCallbackQueue(&queue);
  GoToPoseNode node(nh, private_nh);
  const test::Latest<geometry_msgs::PoseStamped> taken(own, "move_base/current_goal");
  ros::Publisher goals = own.advertise<geometry_msgs::PoseStamped>("move_base_simple/goal", 1);
  ASSERT_TRUE(test::waitFor([&] {
    behind.callAvailable();
    return goals.getNumSubscribers() > 0 && taken.connected();
  }));
  queue.messages_only = true;
  behind.callAvailable();
  ros::Time::setNow(ros::Time(5.0));
  geometry_msgs::PoseStamped goal;
  goal.header.frame_id = "map";
  goal.header.stamp = ros::Time(5.0);
  goal.pose.orientation.w = 1.0;
  goals.publish(goal);
  EXPECT_TRUE(test::waitFor([&] {
    behind.callAvailable();
    return taken.count() > 0;
  })) << "refused";
}

}  // namespace
}  // namespace grid_path_planner::nodes
