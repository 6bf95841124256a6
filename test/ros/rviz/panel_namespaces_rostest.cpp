// The panel looks from the nodes of one namespace to those of another.
#include <actionlib_msgs/GoalID.h>
#include <geometry_msgs/PoseStamped.h>
#include <gtest/gtest.h>
#include <ros/ros.h>
#include <signal.h>
#include <sys/types.h>

#include <condition_variable>
#include <mutex>
#include <thread>

#include "grid_path_planner/NavigatePathAction.h"
#include "grid_path_planner/PlanPathAction.h"
#include "ros/guard/master/xmlrpc_call.h"
#include "ros/rviz/action_topics.h"
#include "ros/rviz/panel_window.h"

namespace grid_path_planner::nodes {
namespace {

using actionlib_msgs::GoalID;
using test::ActionServerTopics;
using test::PanelWindow;

pid_t processOfMaster() {
  auto pid = callXmlRpc(masterUri(), "getPid", {XmlRpc::XmlRpcValue("/test")}, 20.0);
  return pid && pid->getType() == XmlRpc::XmlRpcValue::TypeInt ? static_cast<int&>(*pid) : 0;
}

// The master of the test is stopped until the end of this, or for so long that who waits for it has done wrong.
class StoppedMaster {
 public:
  explicit StoppedMaster(pid_t process) : process_(process) {
    ::kill(process_, SIGSTOP);
    thread_ = std::thread([this] {
      std::unique_lock<std::mutex> lock(mutex_);
      ends_.wait_for(lock, test::kDeadline, [this] { return done_; });
      over_ = true;
      ::kill(process_, SIGCONT);
    });
  }
  ~StoppedMaster() {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      done_ = true;
    }
    ends_.notify_all();
    thread_.join();
  }
  StoppedMaster(const StoppedMaster&) = delete;
  StoppedMaster& operator=(const StoppedMaster&) = delete;

  bool isOver() {
    const std::lock_guard<std::mutex> lock(mutex_);
    return over_;
  }

 private:
  const pid_t process_;
  std::mutex mutex_;
  std::condition_variable ends_;
  bool done_ = false, over_ = false;
  std::thread thread_;
};

// roscpp asked the master for each topic again and again, and rviz's window stood until it was back.
TEST(PanelNamespaces, AreNotChangedWhileTheMasterIsSilent) {
  PanelWindow window;
  const pid_t master = processOfMaster();
  ASSERT_GT(master, 1);
  StoppedMaster stopped(master);
  window.lookAt("b");
  EXPECT_FALSE(stopped.isOver()) << "the panel has waited for the master";
  EXPECT_TRUE(window.waitFor([&] { return window.shows("The ROS master does not answer"); }));
}

// Who looked from one vehicle to another stopped the first, whoever drove it.
TEST(PanelNamespaces, LookingElsewhereEndsTheOwnPlanAndNoDrive) {
  const ActionServerTopics<PlanPathAction> planner("a/plan_path");
  const ActionServerTopics<NavigatePathAction> driver("a/navigate_path");
  ros::NodeHandle nh;
  const ros::Publisher points = nh.advertise<geometry_msgs::PoseStamped>("plan_panel/goal", 1);
  const ros::Publisher cancels = nh.advertise<GoalID>("a/navigate_path/cancel", 1);
  PanelWindow window;
  // Again, where the master of a busy machine was too slow.
  ASSERT_TRUE(window.waitFor([&] {
    window.lookAt("a");
    return planner.status.getNumSubscribers() > 0;
  }));
  ASSERT_TRUE(window.waitFor([&] { return points.getNumSubscribers() > 0; }));
  geometry_msgs::PoseStamped goal;
  goal.header.frame_id = "map";
  goal.pose.orientation.w = 1.0;
  points.publish(goal);
  ASSERT_TRUE(window.click("Plan"));
  ASSERT_TRUE(window.waitFor([&] { return planner.goals.count() > 0; }));
  GoalID driven;
  driven.id = "somebody's";
  NavigatePathFeedback feedback;
  feedback.state = "driving";
  driver.tell(driven, feedback);
  ASSERT_TRUE(window.waitFor([&] { return window.shows("driving, waypoint 0"); }));

  ASSERT_TRUE(window.waitFor([&] {
    window.lookAt("b");
    return planner.status.getNumSubscribers() == 0;
  }));
  ASSERT_TRUE(window.waitFor([&] { return planner.cancels.count() > 0; }));
  EXPECT_EQ(planner.cancels.all()[0].id, planner.goals.all()[0].goal_id.id);
  GoalID last;
  last.id = "after those of the panel";
  cancels.publish(last);
  ASSERT_TRUE(window.waitFor([&] { return driver.cancels.count() > 0; }));
  EXPECT_EQ(driver.cancels.all()[0].id, last.id);
  EXPECT_TRUE(window.waitFor([&] { return window.shows("no drive is reported"); }));
}

}  // namespace
}  // namespace grid_path_planner::nodes
