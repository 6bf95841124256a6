#include "ros/planning/active_goal.h"

#include <gtest/gtest.h>

#include <set>

namespace grid_path_planner::nodes {
namespace {

ros::Time givenAt(ActiveGoal& goal, const ros::Time& now) {
  goal.setGoal({}, now);
  return goal.goal()->given;
}

TEST(ActiveGoal, EachGoalIsGivenAtATimeOfItsOwnWhileTimeStands) {
  ActiveGoal goal;
  std::set<ros::Time> given;
  for (int i = 0; i < 1000; ++i) given.insert(givenAt(goal, ros::Time(100, 999999990)));
  EXPECT_EQ(given.size(), 1000U);
  EXPECT_EQ(*given.begin(), ros::Time(100, 999999990));
  EXPECT_EQ(givenAt(goal, ros::Time(101, 5000000)), ros::Time(101, 5000000)) << "time goes on";
  EXPECT_EQ(givenAt(goal, ros::Time(3, 0)), ros::Time(3, 0)) << "time has gone back";
}

// Whoever drives knows by it that the goal is not of this time.
TEST(ActiveGoal, AGoalFromBeforeTimeWentBackIsTheOldestOfAll) {
  ActiveGoal goal;
  goal.timeWentBack();
  EXPECT_FALSE(goal.goal());
  EXPECT_EQ(givenAt(goal, ros::Time(90)), ros::Time(90));
  goal.timeWentBack();
  EXPECT_EQ(goal.goal()->given, ros::TIME_MIN);
  EXPECT_EQ(givenAt(goal, ros::Time(0, 1)), ros::Time(0, 2)) << "another goal";
}

// By the code: a plan for which memory failed left a goal without an answer, and none was tried again.
TEST(ActiveGoal, IsPlannedForAgainWhereAPlanFailed) {
  ActiveGoal goal;
  const auto placed = [](const GoalState&) { return false; };
  const auto now = std::chrono::steady_clock::now(), later = now + std::chrono::seconds(10);
  goal.setGoal({}, ros::Time(5.0));
  const auto begun = goal.beginPlanning(now);
  EXPECT_FALSE(goal.retryIsDue(later, placed)) << "it is being planned for";
  goal.failed(begun->id);
  EXPECT_TRUE(goal.retryIsDue(later, placed));
  goal.setGoal({}, ros::Time(6.0));
  goal.failed(begun->id);
  EXPECT_FALSE(goal.retryIsDue(later, placed)) << "another goal";
}

TEST(ActiveGoal, NoTimeOfDayEndsIt) {
  for (const ros::Time& now : {ros::Time(), ros::TIME_MIN, ros::TIME_MAX}) {
    ActiveGoal goal;
    EXPECT_EQ(givenAt(goal, now), now);
    EXPECT_EQ(givenAt(goal, ros::TIME_MAX), ros::TIME_MAX);
    EXPECT_EQ(givenAt(goal, ros::TIME_MIN), ros::TIME_MIN);
    EXPECT_EQ(givenAt(goal, ros::Time()), ros::Time()) << "there is no clock";
  }
}

}  // namespace
}  // namespace grid_path_planner::nodes
