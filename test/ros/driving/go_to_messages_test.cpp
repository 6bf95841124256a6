// What planner and driver answer, by any name of a status: nothing behind this compares strings.
#include "ros/driving/go_to_messages.h"

#include <gtest/gtest.h>

namespace grid_path_planner::nodes {
namespace {

using base::Status;
using following::DriveStatus;

TEST(GoToMessages, NamesBecomeStatuses) {
  PlanPathResult planned;
  planned.status = "GOAL_OCCUPIED";
  planned.message = "goal (1, 2) is in an occupied cell";
  EXPECT_EQ(navigatorPlanOf(planned, "map").status, Status::GOAL_OCCUPIED);
  EXPECT_EQ(navigatorPlanOf(planned, "map").message, planned.message);
  NavigatePathResult driven;
  driven.status = "MISSED_WAYPOINT";
  driven.message = "waypoint 2 of 5 was passed";
  EXPECT_EQ(driverAnswerOf(driven).status, DriveStatus::MISSED_WAYPOINT);
  EXPECT_EQ(driverAnswerOf(driven).message, driven.message);
}

TEST(GoToMessages, AnUnknownNameIsNoStatusAndIsTold) {
  PlanPathResult planned;
  planned.status = "SEARCHED";
  planned.message = "as a later version says";
  EXPECT_EQ(navigatorPlanOf(planned, "map").status, std::nullopt);
  EXPECT_EQ(navigatorPlanOf(planned, "map").message,
            "the status 'SEARCHED' is not known: as a later version says");
  NavigatePathResult driven;
  driven.status = "arrived\n";
  EXPECT_EQ(driverAnswerOf(driven).status, std::nullopt);
  EXPECT_EQ(driverAnswerOf(driven).message, "the status '' is not known: ");
}

TEST(GoToMessages, APathThatCannotBeDrivenIsNoAnswer) {
  PlanPathResult planned;
  planned.status = "FOUND";
  planned.path.header.frame_id = "odom";
  planned.path.poses.resize(1);
  planned.path.poses[0].pose.orientation.w = 1.0;
  EXPECT_EQ(navigatorPlanOf(planned, "map").status, std::nullopt);
  EXPECT_TRUE(navigatorPlanOf(planned, "map").path.empty());
  planned.path.header.frame_id = "map";
  EXPECT_EQ(navigatorPlanOf(planned, "map").status, Status::FOUND);
}

}  // namespace
}  // namespace grid_path_planner::nodes
