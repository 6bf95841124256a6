// A drive that is over is not begun again by a path that path_planner plans anew for its goal.
//
// What was seen before: path_planner keeps its goal. A vehicle that had arrived was driven elsewhere by
// somebody else, the map changed there, and it turned around and drove back to the goal of half an hour
// ago; after ~cancel the next obstacle on the path set it going again.
#include <actionlib_msgs/GoalID.h>
#include <std_msgs/Bool.h>
#include <std_srvs/Trigger.h>

#include <utility>

#include "grid_path_planner/NavigatePathActionGoal.h"
#include "grid_path_planner/NavigatePathActionResult.h"
#include "ros/support/still_fixture.h"

namespace grid_path_planner::nodes {
namespace {

using test::pathOf;
using test::StillWorld;

const char* const kNotDriven = "A path is not driven: its goal was reached or cancelled";

class GivenGoalsTest : public test::StillTest {
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

TEST_F(GivenGoalsTest, AGoalThatWasReachedIsNotDrivenToAgain) {
  start();
  const ros::Time goal = now();
  publishPathFor(goal, here_);
  ASSERT_TRUE(navigate_->says("ARRIVED"));
  expectNotDriven(goal);
  driveToNewGoal();
}

TEST_F(GivenGoalsTest, APathThatIsPlannedAgainMeanwhileIsDriven) {
  start();
  const ros::Time goal = driveToNewGoal();
  paths_.publish(pathToMessage(path::Path{"map", {}}, now()));
  EXPECT_TRUE(stops()) << "no path was found";
  publishPathFor(goal, far_);
  EXPECT_TRUE(isDriving());
}

// One without a stamp was dropped without a word.
TEST_F(GivenGoalsTest, AnEmptyPathWithoutAStampStopsTheVehicle) {
  start();
  driveToNewGoal();
  paths_.publish(pathToMessage(path::Path{"map", {}}, ros::Time()));
  EXPECT_TRUE(stops());
}

TEST_F(GivenGoalsTest, WhatSomebodyCancelledStaysCancelled) {
  start();
  const ros::Time goal = driveToNewGoal();
  const ros::Time not_found_yet = aWhileAgo();
  EXPECT_TRUE(ask("cancel"));
  expectNotDriven(goal);
  expectNotDriven(not_found_yet);
  driveToNewGoal();
}

TEST_F(GivenGoalsTest, AGoalOfTheActionThatIsRefusedEndsNothing) {
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
TEST_F(GivenGoalsTest, AGoalFromBeforeTheStartIsNotDriven) {
  const ros::Time before = aWhileAgo();
  start();
  expectNotDriven(before);
  driveToNewGoal();
}

// Whoever takes a vehicle that stands by a joystick does not find it driving off when he lets go.
TEST_F(GivenGoalsTest, AJoystickEndsWhatNothingIsDrivenFor) {
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
TEST_F(GivenGoalsTest, TheEndOfTheDriveBeforeIsNotThatOfANewGoal) {
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

TEST_F(GivenGoalsTest, AfterTimeHasGoneBackNewGoalsAreDriven) {
  start();
  driveToNewGoal();
  EXPECT_TRUE(ask("cancel"));
  world_.jumpTo(20.0);
  ASSERT_TRUE(navigate_->says("ROS time went back"));
  driveToNewGoal();
}

}  // namespace
}  // namespace grid_path_planner::nodes
