// path_planner under simulated time: no time yet, time that jumps back, a bag that loops.
#include <rosgraph_msgs/Clock.h>

#include "grid_path_planner/PlanPathActionGoal.h"
#include "grid_path_planner/PlanPathActionResult.h"
#include "ros/support/planner_fixture.h"

namespace grid_path_planner::nodes {
namespace {

using test::AsciiMap;
using test::poseAt;

class ClockTest : public test::PlannerTest {
 protected:
  void setTime(double seconds) {
    rosgraph_msgs::Clock clock;
    clock.clock.fromSec(seconds);
    clock_.publish(clock);
  }
  void beginAt(double seconds) {
    ASSERT_TRUE(test::waitFor([&] {
      setTime(seconds);
      return ros::Time::now() == ros::Time(seconds);
    }));
  }
  // Until the planner has heard it too, which shows in the stamp of an answer.
  void setTimeAndWait(double seconds) {
    ASSERT_TRUE(test::waitFor([&] {
      setTime(seconds);
      makePlan(poseAt(0.5, 0.5), poseAt(0.5, 0.5));
      return path_.header.stamp == ros::Time(seconds);
    }));
  }
  void move(const std::string& parent, const std::string& child, double x, double stamp) {
    geometry_msgs::TransformStamped transform;
    transform.header.frame_id = parent;
    transform.header.stamp.fromSec(stamp);
    transform.child_frame_id = child;
    transform.transform.translation.x = x;
    transform.transform.translation.y = 0.5;
    transform.transform.rotation.w = 1.0;
    moving_.sendTransform(transform);
  }
  bool logged(const std::string& text) {
    return log_
        .waitFor(0,
                 [&](const rosgraph_msgs::Log& line) {
                   return line.msg.find(text) != std::string::npos;
                 })
        .has_value();
  }

  ros::Publisher clock_ = nh_.advertise<rosgraph_msgs::Clock>("/clock", 10);
  tf2_ros::TransformBroadcaster moving_;
};

// It must be the first test: later the process of the test has a time itself.
TEST_F(ClockTest, NoClockYetIsWaitedForWithAMessageNotAZeroStamp) {
  startPlanner();
  maps_.publish(occupancyToMessage(AsciiMap({"...."}).map, "map", ros::Time(1.0)));
  placeVehicle(0.5, 0.5);
  goals_.publish(poseAt(3.5, 0.5));
  ASSERT_TRUE(logged("no /clock has come yet: waiting for it"));
  EXPECT_FALSE(test::waitFor([&] { return paths_.count() + planning_maps_.count() > 0; },
                             std::chrono::milliseconds(300)));
  ASSERT_TRUE(test::waitFor([&] {
    setTime(100.0);
    return paths_.count() > 0;
  }));
  EXPECT_EQ(paths_.all()[0].header.stamp, ros::Time(100.0));
  EXPECT_EQ(paths_.all()[0].poses.size(), 4u);
  for (const auto& map : planning_maps_.all()) EXPECT_FALSE(map.header.stamp.isZero());
}

TEST_F(ClockTest, TimeThatJumpsBackClearsTransforms) {
  startPlanner({"_tf_timeout:=0.05", "_base_frame:=rover"});
  beginAt(200.0);
  maps_.publish(occupancyToMessage(AsciiMap({"...."}).map, "map", ros::Time(200.0)));
  setTimeAndWait(200.0);
  const auto place = [&](double x, double stamp) { move("map", "rover", x, stamp); };
  ASSERT_TRUE(test::waitFor([&] {
    place(0.5, 200.0);
    makePlan({}, poseAt(3.5, 0.5));
    return answer_.status == "FOUND";
  }));
  setTimeAndWait(10.0);
  ASSERT_TRUE(logged("ROS time went back"));
  makePlan({}, poseAt(3.5, 0.5));
  EXPECT_EQ(answer_.status, "TRANSFORM_ERROR") << "a transform of the future";
  ASSERT_TRUE(test::waitFor([&] {
    place(1.5, 10.0);
    makePlan({}, poseAt(3.5, 0.5));
    return answer_.status == "FOUND" && endsAt(path_.poses.front(), 1.5, 0.5);
  }));
}

// tf2 spoke of extrapolation into the past, and nobody knew which node had ceased.
TEST_F(ClockTest, ATransformThatHasCeasedIsNamedWithItsAge) {
  startPlanner({"_tf_timeout:=0.05", "_base_frame:=glider"});
  beginAt(300.0);
  maps_.publish(occupancyToMessage(AsciiMap({"...."}).map, "map", ros::Time(300.0)));
  setTimeAndWait(300.0);
  ASSERT_TRUE(test::waitFor([&] {
    move("earth", "map", 0.0, 289.0);  // older, and of no matter
    move("map", "odom", 0.0, 290.5);
    move("odom", "glider", 0.5, 300.0);
    makePlan({}, poseAt(3.5, 0.5));
    return answer_.message.find("the newest from odom to map is 9.5 s old") != std::string::npos;
  })) << answer_.message;
  EXPECT_EQ(answer_.status, "TRANSFORM_ERROR");
}

// What was seen: the dock had not been seen for 40 s, and there was a path to it, FOUND without a word.
TEST_F(ClockTest, AGoalInAFrameThatHasCeasedIsRefusedWithTheAge) {
  startPlanner({"_tf_timeout:=0.05"});
  beginAt(300.0);
  maps_.publish(occupancyToMessage(AsciiMap({"...."}).map, "map", ros::Time(300.0)));
  setTimeAndWait(300.0);
  const auto answers = [&](double stamp, const std::string& status) {
    return test::waitFor([&] {
      move("map", "dock", 1.0, stamp);
      makePlan(poseAt(0.5, 0.5), poseAt(1.5, 0.0, 0.0, "dock"));
      return answer_.status == status &&
             (status == "FOUND" || answer_.message.find("nothing on /tf") == std::string::npos);
    });
  };
  ASSERT_TRUE(answers(260.0, "TRANSFORM_ERROR")) << answer_.message;
  EXPECT_EQ(answer_.message, "the transform from dock to map is 40.0 s old");
  ASSERT_TRUE(answers(300.0, "FOUND")) << answer_.message;
  EXPECT_TRUE(endsAt(path_.poses.back(), 2.5, 0.5));
}

// GetPlan's clients leave frames and stamps empty, or have a clock of their own.
TEST_F(ClockTest, EmptyFramesAndStampsOfAnotherTimeAreTakenInTheMap) {
  startPlanner({"_tf_timeout:=0.05", "_base_frame:=rover"});
  beginAt(7200.0);
  maps_.publish(occupancyToMessage(AsciiMap({"...."}).map, "map", ros::Time(7200.0)));
  setTimeAndWait(7200.0);
  ASSERT_TRUE(test::waitFor([&] {
    move("map", "rover", 0.5, 7200.0);
    makePlan({}, poseAt(3.5, 0.5, 0.0, ""));
    return answer_.status == "FOUND";
  })) << answer_.message;
  for (const double stamp : {0.0, 3600.0, 7200.0 + 6 * 3600.0}) {
    auto goal = poseAt(3.5, 0.5);
    goal.header.stamp = ros::Time(stamp);
    makePlan({}, goal);
    EXPECT_EQ(answer_.status, "FOUND") << stamp << ": " << answer_.message;
    goal.header.frame_id = "rover";
    goal.pose.position.x = 2.0;
    goal.pose.position.y = 0.0;
    makePlan({}, goal);
    EXPECT_EQ(answer_.status, stamp == 0.0 ? "FOUND" : "TRANSFORM_ERROR")
        << "where the vehicle was then: " << answer_.message;
  }
}

// A map from outside the bag keeps its stamp when the bag begins again: its updates count all the
// same.
TEST_F(ClockTest, UpdatesAreTakenAfterTimeJumpedBack) {
  startPlanner();
  beginAt(200.0);
  publishMap(AsciiMap({"...."}).map, "map", ros::Time(200.0));
  setTimeAndWait(200.0);
  setTimeAndWait(10.0);
  ASSERT_TRUE(logged("ROS time went back"));
  map_msgs::OccupancyGridUpdate update;
  update.header.frame_id = "map";
  update.header.stamp = ros::Time(10.0);
  update.x = 2;
  update.width = update.height = 1;
  update.data = {100};
  updates_.publish(update);
  EXPECT_TRUE(test::waitFor([&] {
    makePlan(poseAt(0.5, 0.5), poseAt(3.5, 0.5));
    return answer_.status == "UNREACHABLE";
  })) << answer_.status;
}

// The recording of test/data, played for ever: its map is planned on in the second round too.
TEST_F(ClockTest, ABagThatLoopsIsPlannedOn) {
  startPlanner();
  const auto plan_in_bag = [&] {
    makePlan(poseAt(-1.5, -1.0), poseAt(-0.2, -0.2));
    return answer_.status == "FOUND";
  };
  test::Process player({"rosbag", "play", "--clock", "--loop", "--quiet", "--rate=4",
                        GPP_TEST_DATA "/projected_map.bag"});
  ASSERT_TRUE(planning_maps_.waitForMoreThan(0));
  EXPECT_TRUE(test::waitFor(plan_in_bag)) << answer_.status << ": " << answer_.message;
  ASSERT_TRUE(logged("ROS time went back"));
  const std::size_t seen = planning_maps_.count();
  ASSERT_TRUE(planning_maps_.waitForMoreThan(seen));
  EXPECT_TRUE(test::waitFor(plan_in_bag)) << answer_.status << ": " << answer_.message;
  EXPECT_TRUE(planner_->running());
}

// actionlib adds five seconds to the time at which a goal ended, beyond what a time can hold: roscpp threw in the thread of
// the action server, and path_planner ended. Before that status, and every later goal, had been silent for good.
TEST_F(ClockTest, GoalsOfTheActionAreRejectedAtTheEndOfTimeAndTakenAfterIt) {
  startPlanner();
  beginAt(400.0);
  publishMap(AsciiMap({"...."}).map, "map", ros::Time(400.0));
  setTimeAndWait(400.0);
  const ros::Publisher goals = nh_.advertise<PlanPathActionGoal>("plan_path/goal", 10);
  const test::Latest<PlanPathActionResult> results(nh_, "plan_path/result");
  ASSERT_TRUE(test::waitFor([&] { return goals.getNumSubscribers() > 0 && results.connected(); }));
  const auto statusOf = [&](const std::string& id) {
    PlanPathActionGoal goal;
    goal.goal_id.id = id;
    goal.goal.start = poseAt(0.5, 0.5);
    goal.goal.goal = poseAt(3.5, 0.5);
    goals.publish(goal);
    const auto result = results.waitFor(
        0, [&](const PlanPathActionResult& other) { return other.status.goal_id.id == id; });
    return result ? int(result->status.status) : -1;
  };
  using actionlib_msgs::GoalStatus;
  EXPECT_EQ(statusOf("before"), int(GoalStatus::SUCCEEDED));
  setTimeAndWait(4294967295.0);
  EXPECT_EQ(statusOf("at the end"), int(GoalStatus::REJECTED));
  setTimeAndWait(500.0);
  EXPECT_EQ(statusOf("after"), int(GoalStatus::SUCCEEDED));
}

}  // namespace
}  // namespace grid_path_planner::nodes
