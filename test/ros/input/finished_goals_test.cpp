#include "ros/input/finished_goals.h"

#include <gtest/gtest.h>

namespace grid_path_planner::nodes {
namespace {

// A path for the goal that was given at `seconds`.
nav_msgs::Path pathFor(double seconds) {
  nav_msgs::Path path;
  path.header.stamp = ros::Time(2000);
  path.poses.resize(3);
  for (auto& pose : path.poses) pose.header.stamp = path.header.stamp;
  path.poses.back().header.stamp = ros::Time(seconds);
  return path;
}

TEST(FinishedGoals, AGoalIsOverWithItsDriveAndOthersAreNot) {
  FinishedGoals goals;
  EXPECT_FALSE(goals.isOver(pathFor(1)));
  goals.drive(pathFor(5));
  EXPECT_FALSE(goals.isOver(pathFor(5))) << "planned again meanwhile";
  goals.end();
  EXPECT_TRUE(goals.isOver(pathFor(5)));
  EXPECT_FALSE(goals.isOver(pathFor(4))) << "given before, planned later: of another planner";
  EXPECT_FALSE(goals.isOver(pathFor(6)));
  goals.drive(pathFor(6));
  EXPECT_FALSE(goals.isOver(pathFor(6)));
  goals.end();
  goals.end();
  EXPECT_TRUE(goals.isOver(pathFor(6))) << "an end without a drive changes nothing";
}

// A goal that is given while /clock stands is a nanosecond after the one before; the path for it is stamped with the time.
TEST(FinishedGoals, AnInstantIsNoOldTime) {
  FinishedGoals goals;
  goals.timeWentBack();
  nav_msgs::Path path = pathFor(2000);
  path.poses.back().header.stamp.nsec += 1;
  EXPECT_FALSE(goals.isOver(path));
  EXPECT_TRUE(goals.isOver(pathFor(2001))) << "given before time went back";
}

TEST(FinishedGoals, WhatWasAskedForBeforeSomebodyCancelledIsOver) {
  FinishedGoals goals;
  goals.drive(pathFor(5));
  goals.endAllUntil(ros::Time(8));
  EXPECT_TRUE(goals.isOver(pathFor(5)));
  EXPECT_TRUE(goals.isOver(pathFor(7))) << "no path was found for it yet";
  EXPECT_FALSE(goals.isOver(pathFor(9)));
}

TEST(FinishedGoals, PathsOfOthersHaveNoTime) {
  FinishedGoals goals;
  goals.drive(pathFor(0));
  goals.end();
  goals.endAllUntil(ros::TIME_MAX);
  EXPECT_FALSE(goals.isOver(pathFor(0)));
  EXPECT_FALSE(goals.isOver(nav_msgs::Path())) << "an empty one stops the vehicle";
}

// Somebody republishes what was recorded, or times from the beginning of a trajectory.
TEST(FinishedGoals, TimesOfATrajectoryAreNoGoals) {
  FinishedGoals goals;
  nav_msgs::Path trajectory = pathFor(9);
  trajectory.poses.front().header.stamp = ros::Time(8);
  nav_msgs::Path ahead = pathFor(3000);
  for (const nav_msgs::Path& path : {trajectory, ahead}) {
    goals.drive(path);
    goals.end();
    goals.endAllUntil(ros::Time(4000));
    EXPECT_FALSE(goals.isOver(path));
  }
}

// A test gave a goal right after ~cancel, and the planner's /clock was a step behind the driver's.
TEST(FinishedGoals, AGoalOfTheMomentOfACancelIsANewOne) {
  FinishedGoals goals;
  goals.drive(pathFor(7.9));
  goals.endAllUntil(ros::Time(8));
  EXPECT_FALSE(goals.isOver(pathFor(7.95))) << "clocks differ";
  EXPECT_TRUE(goals.isOver(pathFor(7.9))) << "it was driven";
  FinishedGoals at_the_beginning;
  at_the_beginning.endAllUntil(ros::Time(0.1));
  EXPECT_FALSE(at_the_beginning.isOver(pathFor(0.05)));
}

// A bag that began anew revived goals that were over: the vehicle set off for a goal that it had reached.
// A time of /clock may have more than 999,999,999 ns, and then be beyond the last that there is: roscpp throws.
TEST(FinishedGoals, ACancelAtATimeBeyondTheLastCounts) {
  FinishedGoals goals;
  goals.drive(pathFor(5));
  ros::Time now;
  now.sec = now.nsec = ~0U;
  goals.endAllUntil(now);
  EXPECT_TRUE(goals.isOver(pathFor(5)));
  EXPECT_TRUE(goals.isOver(pathFor(7)));
}

TEST(FinishedGoals, WhatIsFromBeforeTimeWentBackIsOver) {
  FinishedGoals goals;
  goals.drive(pathFor(5));
  goals.timeWentBack();
  EXPECT_TRUE(goals.isOver(pathFor(5))) << "its drive ended";
  EXPECT_TRUE(goals.isOver(pathFor(3000))) << "the planner has not noticed yet";
  EXPECT_TRUE(goals.isOver(pathFor(1e-9))) << "it has";
  EXPECT_FALSE(goals.isOver(pathFor(2))) << "given since";
  nav_msgs::Path trajectory = pathFor(3000);
  trajectory.poses[1].header.stamp = ros::Time(2500);
  EXPECT_FALSE(goals.isOver(trajectory)) << "of others, that plan ahead";
}

}  // namespace
}  // namespace grid_path_planner::nodes
