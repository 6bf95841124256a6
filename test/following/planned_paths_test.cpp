// A file of a few corners is driven as well as a path with a pose for each cell: followers that cut
// across the room between the corners would not.
#include <gtest/gtest.h>

#include <memory>
#include <random>

#include "following/closed_loop.h"
#include "grid_path_planner/planning/path_planner.h"
#include "path/pose_spacing.h"
#include "support/kept_distance.h"

namespace grid_path_planner::following {

using grid::Cell;
using grid::GridGeometry;
using grid::OccupancyGrid;
using path::HeadingMode;
using path::Path;
using path::spacedPoses;
using planning::PathPlanner;
using planning::Plan;
using planning::PlannerOptions;

namespace {

using test::ClosedLoop;
using test::distanceTo;

constexpr double kCell = 0.25;  // m

// 16 m a side, with blocks as furniture is.
OccupancyGrid furnished(std::mt19937& random) {
  OccupancyGrid map(GridGeometry(64, 64, kCell));
  for (int block = 0; block < 12; ++block) {
    const Cell low{8 + static_cast<int>(random() % 42), 8 + static_cast<int>(random() % 42)};
    const int width = 2 + random() % 6, height = 2 + random() % 6;
    for (int row = low.row; row < low.row + height; ++row)
      for (int column = low.column; column < low.column + width; ++column) map[{column, row}] = 100;
  }
  return map;
}

struct Driven {
  double off_path = 0.0;   // m, at most
  double clearance = 9.0;  // m, of the vehicle's middle, at least
};

Driven drive(const Path& path, const OccupancyGrid& map) {
  ClosedLoop loop({}, path.poses.front().position, path.poses.front().yaw);
  std::vector<Eigen::Vector2d> trace;
  Driven driven;
  loop.each_step = [&] {
    driven.off_path = std::max(driven.off_path, distanceTo(path, loop.pose().position));
    trace.push_back(loop.pose().position.head<2>());
  };
  loop.follower.start(path, Join::FIRST);
  EXPECT_TRUE(loop.runUntilState(FollowState::ARRIVED));
  driven.clearance = test::leastDistance(trace, map, {}, driven.clearance);
  return driven;
}

TEST(PlannedPathsLaw, AFileOfCornersIsDrivenAsAPathOfPoses) {
  std::mt19937 random(20261122);
  int driven_paths = 0;
  for (int trial = 0; trial < 25; ++trial) {
    const OccupancyGrid map = furnished(random);
    PlannerOptions options;
    options.costmap.radius = 0.5;
    options.waypoint_tolerance = trial % 2 == 0 ? 0.0 : 0.1;
    PathPlanner planner(options);
    planner.setMap(std::make_shared<const OccupancyGrid>(map));
    const Plan plan = planner.plan({{{0.9, 1.1, 0.0}, 0.0}, {{14.8, 14.9, 0.0}, 1.0}});
    if (!plan.found()) continue;
    ++driven_paths;
    const Driven corners = drive(plan.waypoints, map);
    const Driven poses = drive(spacedPoses(plan.path, kCell, HeadingMode::FORWARD), map);
    SCOPED_TRACE(trial);
    EXPECT_LT(corners.off_path, poses.off_path + 0.05);
    EXPECT_LT(corners.off_path, 0.2);
    EXPECT_GE(corners.clearance, 0.5 - corners.off_path - 1e-6) << "the line keeps the radius";
  }
  EXPECT_GT(driven_paths, 15);
}

}  // namespace
}  // namespace grid_path_planner::following
