// A drive that is over is not begun again by a path that path_planner plans anew for its goal.
//
// What was seen before: path_planner keeps its goal. A vehicle that had arrived was driven elsewhere by
// somebody else, the map changed there, and it turned around and drove back to the goal of half an hour
// ago; after ~cancel the next obstacle on the path set it going again.
#include <actionlib_msgs/GoalID.h>
#include <actionlib_msgs/GoalStatusArray.h>
#include <std_msgs/Bool.h>
#include <std_srvs/Trigger.h>

#include <utility>

#include "grid_path_planner/NavigatePathActionGoal.h"
#include "grid_path_planner/NavigatePathActionResult.h"
#include "grid_path_planner/path/waypoint_file.h"
#include "ros/support/still_fixture.h"
#include "support/temporary_folder.h"

namespace grid_path_planner::nodes {
namespace {

using test::pathOf;
using test::StillWorld;

const char* const kNotDriven = "A path is not driven: its goal was reached or cancelled";

class FinishedGoalsTest : public test::StillTest {
 protected:
  // Until goals of a while ago are from after it.
  void start() {
    startNavigate({"_no_progress_timeout:=0"});
    ASSERT_TRUE(test::waitFor([&, until = world_.time() + 6.0] { return world_.time() > until; }));
  }
  ros::Time now() const { return ros::Time(world_.time()); }
  // Of a goal for which there was no path.
  ros::Time aWhileAgo() const { return ros::Time(world_.time() - 5.0); }
  // As path_planner does.
  void publishPathFor(const ros::Time& goal, const path::Path& path) {
    nav_msgs::Path message = pathToMessage(path, now());
    message.poses.back().header.stamp = goal;
    paths_.publish(message);
  }
  int refusals() const {
    const std::string said = navigate_->output();
    int count = 0;
    for (std::size_t at = said.find(kNotDriven); at != std::string::npos;
         at = said.find(kNotDriven, at + 1))
      ++count;
    return count;
  }
  ros::Time driveToNewGoal() {
    const ros::Time goal = now();
    publishPathFor(goal, far_);
    EXPECT_TRUE(isDriving());
    return goal;
  }
  void expectNotDriven(const ros::Time& goal) {
    const int before = refusals();
    publishPathFor(goal, far_);
    EXPECT_TRUE(test::waitFor([&] { return refusals() > before; }));
    EXPECT_FALSE(drivesWithin(std::chrono::seconds(1)));
  }

  StillWorld world_{100.0};  // the vehicle stands at its origin
  const path::Path far_ = pathOf({{0, 0}, {50, 0}});
  const path::Path here_ = pathOf({{0, 0}, {0.01, 0}});
};

TEST_F(FinishedGoalsTest, AGoalThatWasReachedIsNotDrivenToAgain) {
  start();
  const ros::Time goal = now();
  publishPathFor(goal, here_);
  ASSERT_TRUE(navigate_->says("ARRIVED"));
  expectNotDriven(goal);
  driveToNewGoal();
}

TEST_F(FinishedGoalsTest, APathThatIsPlannedAgainMeanwhileIsDriven) {
  start();
  const ros::Time goal = driveToNewGoal();
  paths_.publish(pathToMessage(path::Path{"map", {}}, now()));
  EXPECT_TRUE(stops()) << "no path was found";
  publishPathFor(goal, far_);
  EXPECT_TRUE(isDriving());
}

// One without a stamp was dropped without a word.
TEST_F(FinishedGoalsTest, AnEmptyPathWithoutAStampStopsTheVehicle) {
  start();
  driveToNewGoal();
  paths_.publish(pathToMessage(path::Path{"map", {}}, ros::Time()));
  EXPECT_TRUE(stops());
}

TEST_F(FinishedGoalsTest, WhatSomebodyCancelledStaysCancelled) {
  start();
  const ros::Time goal = driveToNewGoal();
  const ros::Time not_found_yet = aWhileAgo();
  EXPECT_TRUE(ask("cancel"));
  expectNotDriven(goal);
  expectNotDriven(not_found_yet);
  driveToNewGoal();
}

// path_planner finds no path, and then one again: the vehicle that somebody had paused drove off.
TEST_F(FinishedGoalsTest, APauseOutlivesAnEmptyPath) {
  start();
  const ros::Time goal = driveToNewGoal();
  EXPECT_TRUE(ask("pause"));
  EXPECT_TRUE(stops());
  paths_.publish(pathToMessage(path::Path{"map", {}}, now()));
  ASSERT_TRUE(navigate_->says("the path is empty"));
  publishPathFor(goal, far_);
  ASSERT_TRUE(navigate_->says("once it is resumed"));
  EXPECT_FALSE(drivesWithin(std::chrono::seconds(1)));
  EXPECT_TRUE(ask("resume"));
  EXPECT_TRUE(isDriving());
}

// It was refused, and the path that came then was driven.
TEST_F(FinishedGoalsTest, APauseBeforeThePathComesHoldsForIt) {
  start();
  EXPECT_TRUE(ask("pause"));
  publishPathFor(now(), far_);
  ASSERT_TRUE(navigate_->says("once it is resumed"));
  EXPECT_FALSE(drivesWithin(std::chrono::seconds(1)));
  EXPECT_TRUE(ask("cancel"));
  driveToNewGoal();
}

TEST_F(FinishedGoalsTest, AGoalOfTheActionThatIsRefusedEndsNothing) {
  start();
  const ros::Time goal = driveToNewGoal();
  ros::Publisher action = nh_.advertise<NavigatePathActionGoal>("navigate_path/goal", 1);
  ASSERT_TRUE(test::waitFor([&] { return action.getNumSubscribers() > 0; }));
  action.publish(NavigatePathActionGoal());
  ASSERT_TRUE(navigate_->says("The goal is refused"));
  paths_.publish(pathToMessage(path::Path{"map", {}}, now()));
  EXPECT_TRUE(stops());
  publishPathFor(goal, far_);
  EXPECT_TRUE(isDriving());
}

// Its predecessor may have reached it, or been told to cancel it.
TEST_F(FinishedGoalsTest, AGoalFromBeforeTheStartIsNotDriven) {
  const ros::Time before = aWhileAgo();
  start();
  expectNotDriven(before);
  driveToNewGoal();
}

// Whoever takes a vehicle that stands by a joystick does not find it driving off when he lets go.
TEST_F(FinishedGoalsTest, AJoystickEndsWhatNothingIsDrivenFor) {
  start();
  const ros::Time not_found_yet = aWhileAgo();
  ros::Publisher manual = nh_.advertise<std_msgs::Bool>("manual_control", 1);
  ASSERT_TRUE(test::waitFor([&] { return manual.getNumSubscribers() > 0; }));
  ASSERT_TRUE(test::waitFor([&] {
    std_msgs::Bool on;
    on.data = true;
    manual.publish(on);
    std_srvs::Trigger resume;
    return ros::service::call("/navigate_path/resume", resume) &&
           resume.response.message.find("joystick") != std::string::npos;
  }));
  expectNotDriven(not_found_yet);
  manual.publish(std_msgs::Bool());
  EXPECT_FALSE(drivesWithin(std::chrono::seconds(1)));
  driveToNewGoal();
}

// Of 8 goals that came as /clock went back 7 were told that they were cancelled, and the vehicle drove on for them,
// beyond any cancel: the end of the drive before was taken for theirs.
TEST_F(FinishedGoalsTest, TheEndOfTheDriveBeforeIsNotThatOfANewGoal) {
  start();
  const test::Latest<NavigatePathActionResult> results(nh_, "navigate_path/result");
  ros::Publisher action = nh_.advertise<NavigatePathActionGoal>("navigate_path/goal", 1);
  ros::Publisher cancels = nh_.advertise<actionlib_msgs::GoalID>("navigate_path/cancel", 1);
  ASSERT_TRUE(test::waitFor([&] {
    return action.getNumSubscribers() > 0 && cancels.getNumSubscribers() > 0 && results.connected();
  }));
  for (int round = 0; round < 5; ++round) {
    driveToNewGoal();
    world_.jumpTo(world_.time() - 2.0);
    ros::WallDuration(0.003 * round).sleep();
    NavigatePathActionGoal goal;
    goal.goal_id.id = "round " + std::to_string(round);
    goal.goal.path = pathToMessage(far_, now());
    action.publish(goal);
    drivesWithin(std::chrono::seconds(1));
    cancels.publish(actionlib_msgs::GoalID());
    EXPECT_TRUE(results.waitFor(0, [&](const NavigatePathActionResult& result) {
      return result.status.goal_id.id == goal.goal_id.id;
    }));
    EXPECT_TRUE(test::waitFor([&] { return !drivesWithin(std::chrono::seconds(1)); }))
        << "the cancel reaches what is driven";
  }
}

// A bag that began anew set a vehicle going for a goal that had been cancelled.
TEST_F(FinishedGoalsTest, AfterTimeHasGoneBackNewGoalsAreDrivenAndThoseOfBeforeAreNot) {
  start();
  const ros::Time old = now(), driven = driveToNewGoal();
  EXPECT_TRUE(ask("cancel"));
  world_.jumpTo(20.0);
  ASSERT_TRUE(navigate_->says("ROS time went back"));
  for (const ros::Time& goal : {old, driven, ros::TIME_MIN}) expectNotDriven(goal);
  nav_msgs::Path latched = pathToMessage(far_, old);
  paths_.publish(latched);
  EXPECT_TRUE(navigate_->says("s ahead of the time here"));
  EXPECT_FALSE(drivesWithin(std::chrono::seconds(1)));
  driveToNewGoal();
}

// It was driven, once it had been read: by then it was a goal of another time.
TEST_F(FinishedGoalsTest, AGoalWhoseFileIsReadAsTimeGoesBackIsNotDriven) {
  const test::TemporaryFolder folder;
  path::Path route{"map", {}};
  for (int i = 0; i < 200000; ++i) route.poses.push_back({{40.0 + 0.001 * i, 0.0, 0.0}, 0.0});
  path::writeWaypointFile(folder.path("route.yaml"), route);
  startNavigate({"_no_progress_timeout:=0", "--load-folder", folder.path("")});
  const test::Latest<NavigatePathActionResult> results(nh_, "navigate_path/result");
  const test::Latest<actionlib_msgs::GoalStatusArray> statuses(nh_, "navigate_path/status");
  ros::Publisher action = nh_.advertise<NavigatePathActionGoal>("navigate_path/goal", 1);
  ASSERT_TRUE(test::waitFor([&] {
    return action.getNumSubscribers() > 0 && results.connected() && statuses.connected();
  }));
  NavigatePathActionGoal goal;
  goal.goal.filename = "route.yaml";
  action.publish(goal);
  ASSERT_TRUE(statuses.waitFor(
      0, [](const actionlib_msgs::GoalStatusArray& array) { return !array.status_list.empty(); }));
  world_.jumpTo(20.0);
  const auto result = results.waitForMoreThan(0);
  ASSERT_TRUE(result);
  EXPECT_EQ(result->result.status, "CANCELLED") << result->result.message;
  EXPECT_TRUE(test::waitFor([&] { return !drivesWithin(std::chrono::seconds(1)); }));
}

}  // namespace
}  // namespace grid_path_planner::nodes
