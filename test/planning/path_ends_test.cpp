// Ends that are nearer to obstacles than what is kept.
#include <gtest/gtest.h>

#include <memory>

#include "grid_path_planner/planning/path_planner.h"
#include "support/ascii_map.h"

namespace grid_path_planner::planning {

using base::Status;
using costmap::Outside;
using grid::OccupancyGrid;
using path::Pose;

namespace {

Pose poseAt(double x, double y) {
  Pose pose;
  pose.position << x, y, 0.0;
  return pose;
}

Plan planOn(const std::vector<std::string>& lines, const Pose& start, const Pose& goal,
            const PlannerOptions& options) {
  PathPlanner planner(options);
  planner.setMap(std::make_shared<const OccupancyGrid>(test::AsciiMap(lines).map));
  return planner.plan({start, goal, false});
}

PlannerOptions withRadius(double radius) {
  PlannerOptions options;
  options.costmap.radius = radius;
  return options;
}

const std::vector<std::string> kWall = {"#......",  //
                                        "#......",  //
                                        "#......"};

// The cell's centre is 0.5 m from the wall: only the pose is too near.
TEST(PathEnds, AGoalNearerThanTheRadiusIsOccupied) {
  const Plan plan = planOn(kWall, poseAt(6.5, 1.5), poseAt(1.3, 1.5), withRadius(0.5));
  EXPECT_EQ(plan.status, Status::GOAL_OCCUPIED);
  EXPECT_EQ(plan.message,
            "goal (1.3, 1.5) is 0.3 m from an occupied cell, nearer than the radius of 0.5 m");
  PlannerOptions tolerant = withRadius(0.5);
  tolerant.tolerance = 1.0;
  const Plan near = planOn(kWall, poseAt(6.5, 1.5), poseAt(1.3, 1.5), tolerant);
  ASSERT_EQ(near.status, Status::FOUND);
  EXPECT_EQ(near.path.poses.back().position.head<2>(), Eigen::Vector2d(1.5, 1.5));
}

TEST(PathEnds, AStartNearerThanTheRadiusIsLeftWithoutComingNearer) {
  const Plan plan = planOn(kWall, poseAt(1.3, 0.2), poseAt(6.5, 1.5), withRadius(0.5));
  ASSERT_EQ(plan.status, Status::FOUND) << plan.message;
  EXPECT_NE(plan.message.find("the start is 0.3 m from an occupied cell, nearer than the radius of "
                              "0.5 m"),
            std::string::npos)
      << plan.message;
}

// A segment to the goal that passes the wall at 0.35 m was taken, since the cells beside the wall
// are passable.
TEST(PathEnds, TheSegmentToAnEndKeepsTheRadius) {
  const std::vector<std::string> corner = {"......",  //
                                           "......",  //
                                           "..##..",  //
                                           "......"};
  const Plan plan = planOn(corner, poseAt(0.5, 1.5), poseAt(4.5, 2.5), withRadius(0.5));
  ASSERT_EQ(plan.status, Status::FOUND);
  EXPECT_GT(plan.path.poses.size(), 2U);
}

TEST(PathEnds, NoMoreIsKeptFromTheBorderThanAnEndHas) {
  PlannerOptions options = withRadius(1.5);
  options.costmap.outside = Outside::OCCUPIED;
  const std::vector<std::string> open(7, ".......");
  const Plan kept = planOn(open, poseAt(1.5, 1.5), poseAt(5.5, 5.5), options);
  ASSERT_EQ(kept.status, Status::FOUND);
  EXPECT_EQ(kept.message.find("keeps only"), std::string::npos) << kept.message;
  const Plan lowered = planOn(open, poseAt(1.5, 1.5), poseAt(6.5, 5.5), options);
  ASSERT_EQ(lowered.status, Status::FOUND);
  EXPECT_NE(
      lowered.message.find("it keeps only 0.5 m from the map's border, as near as its ends are"),
      std::string::npos)
      << lowered.message;
}

TEST(PathEnds, NoMoreIsKeptFromUnknownCellsThanAnEndHas) {
  PlannerOptions options = withRadius(1.0);
  options.costmap.unknown_is_passable = false;
  options.costmap.outside = Outside::FREE;
  const std::vector<std::string> frontier = {".....?", ".....?", ".....?"};
  const Plan plan = planOn(frontier, poseAt(0.5, 1.5), poseAt(4.75, 1.5), options);
  ASSERT_EQ(plan.status, Status::FOUND) << plan.message;
  EXPECT_NE(plan.message.find("it keeps only 0.25 m from unknown cells"), std::string::npos)
      << plan.message;
}

// A planner that kept less for one request keeps everything for the next, and follows the map.
TEST(PathEnds, WhatOneRequestKeepsIsNotKeptForTheNext) {
  PlannerOptions options = withRadius(1.5);
  options.costmap.outside = Outside::OCCUPIED;
  options.smooth = false;
  PathPlanner planner(options);
  const std::vector<std::string> open(7, ".......");
  auto map = std::make_shared<OccupancyGrid>(test::AsciiMap(open).map);
  planner.setMap(map);
  const PoseRequest at_border{poseAt(0.5, 3.5), poseAt(6.5, 3.5), false};
  EXPECT_EQ(planner.plan(at_border).path.poses.size(), 7U);
  auto walled = std::make_shared<OccupancyGrid>(*map);
  for (int row = 0; row < 7; ++row) (*walled)[grid::Cell{3, row}] = 100;
  planner.updateMap(walled, {{3, 0, 1, 7}});
  EXPECT_EQ(planner.plan(at_border).status, Status::UNREACHABLE);
  planner.updateMap(map, {{3, 0, 1, 7}});
  EXPECT_EQ(planner.plan(at_border).status, Status::FOUND);
  const Plan inside = planner.plan({poseAt(1.5, 1.5), poseAt(5.5, 1.5), false});
  ASSERT_EQ(inside.status, Status::FOUND);
  EXPECT_EQ(inside.message.find("keeps only"), std::string::npos) << inside.message;
}

}  // namespace
}  // namespace grid_path_planner::planning
