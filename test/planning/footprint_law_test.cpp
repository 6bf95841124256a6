// The promise of `footprint`: on no path that is found does it meet an occupied cell, whatever the planner, the kernel, the
// smoothing, the heading and the shape; nor on the line through its waypoints.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <random>

#include "grid_path_planner/planners/planner_factory.h"
#include "grid_path_planner/planning/path_planner.h"
#include "support/error_text.h"
#include "support/footprint_reference.h"
#include "support/random_footprints.h"

namespace grid_path_planner::planning {

using base::Status;
using grid::OccupancyGrid;
using path::HeadingMode;
using path::Path;
using path::Pose;
using planners::plannerNames;
using planners::traitsOf;
using test::largestOverlap;
using test::randomRooms;
using test::randomVehicle;

namespace {

using Corners = std::vector<Eigen::Vector2d>;

std::string textOfCorners(const Corners& corners) {
  std::ostringstream text;
  text.precision(17);
  for (std::size_t i = 0; i < corners.size(); ++i)
    text << (i == 0 ? "[[" : ", [") << corners[i].x() << ", " << corners[i].y() << "]";
  return text.str() + "]";
}

PlannerOptions randomFootprintOptions(std::mt19937& random) {
  constexpr HeadingMode kModes[] = {HeadingMode::FORWARD,  HeadingMode::FORWARD,
                                    HeadingMode::BACKWARD, HeadingMode::INTERPOLATE,
                                    HeadingMode::LEFTWARD, HeadingMode::FORWARD_THEN_INTERPOLATE};
  PlannerOptions options;
  options.planner = plannerNames()[random() % plannerNames().size()];
  options.costmap.kernel = random() % 3 == 0 ? 1 + random() % 4 : 1;
  options.costmap.decay = traitsOf(options.planner).weights && random() % 2 == 0 ? 5.0 : 0.0;
  options.smooth = random() % 3 != 0;
  options.heading = kModes[random() % 6];
  options.tolerance = random() % 3 == 0 ? 0.5 : 0.0;
  options.waypoint_tolerance = random() % 2 == 0 ? 0.1 : 0.0;
  return options;
}

Pose randomFootprintPose(std::mt19937& random, const OccupancyGrid& map) {
  std::uniform_real_distribution<double> place(3.0, map.width() - 3.0), yaw(-M_PI, M_PI);
  Pose pose;
  const double column = place(random);
  pose.position << map.geometry().worldFromGrid({column, place(random)}), 0.0;
  pose.yaw = yaw(random);
  return pose;
}

TEST(FootprintLaw, noPathMeetsAnObstacle) {
  constexpr double kTouch = 1e-5;  // cells
  const unsigned seed = 1713;
  SCOPED_TRACE(seed);
  std::mt19937 random(seed);
  int found = 0, at_first = 0, none = 0;
  for (int i = 0; i < 120; ++i) {
    const double yaw = random() % 2 == 0 ? 0.0 : 0.6;
    const auto map = std::make_shared<const OccupancyGrid>(randomRooms(random, yaw));
    const Corners vehicle = randomVehicle(random);
    PlannerOptions options = randomFootprintOptions(random);
    options.footprint = textOfCorners(vehicle);
    PathPlanner planner(options);
    planner.setMap(map);
    for (int question = 0; question < 3; ++question) {
      const PoseRequest request{randomFootprintPose(random, *map),
                                randomFootprintPose(random, *map)};
      const Plan plan = planner.plan(request);
      ASSERT_NE(Status::INVALID_REQUEST, plan.status) << plan.message;
      none += plan.status == Status::UNREACHABLE && test::contains(plan.message, "footprint");
      if (!plan.found()) continue;
      ++found;
      at_first += test::contains(plan.message, "the footprint fits;") ||
                  plan.message.substr(plan.message.size() - 4) == "fits";
      for (const Path* path : {&plan.path, &plan.waypoints})
        ASSERT_LT(largestOverlap(vehicle, *path, request.start.yaw, options.heading, 0.04, *map),
                  kTouch)
            << "case " << i << " " << options.planner << " " << options.footprint << " "
            << base::choiceName(options.heading) << (path == &plan.path ? "" : " waypoints") << ": "
            << plan.message;
    }
  }
  EXPECT_GT(found, 60);
  EXPECT_GT(at_first, 20);
  EXPECT_GT(found - at_first, 10) << "found by later tries";
  EXPECT_GT(none, 10);
  RecordProperty("found", found);
  std::printf("found %d, at the first try %d, none that fits %d\n", found, at_first, none);
}

// Walls that are not known. A path to the goal that was asked for may reach into them as the footprint does at an end.
TEST(FootprintLaw, noPathToAReplacedGoalMeetsWhatIsUnknown) {
  constexpr double kTouch = 1e-5;  // cells
  std::mt19937 random(49);
  int replaced = 0, would_reach = 0;
  for (int i = 0; i < 100; ++i) {
    const OccupancyGrid walls = randomRooms(random, random() % 2 == 0 ? 0.0 : 0.6);
    OccupancyGrid unknown = walls;
    for (int row = 0; row < walls.height(); ++row)
      for (int column = 0; column < walls.width(); ++column)
        if (walls.row(row)[column] >= 65) unknown.row(row)[column] = -1;
    const Corners vehicle = randomVehicle(random);
    PlannerOptions options = randomFootprintOptions(random);
    options.footprint = textOfCorners(vehicle);
    options.costmap.unknown_is_passable = false;
    options.costmap.outside = costmap::Outside::FREE;
    options.tolerance = 1.5;
    if (random() % 4 == 0) {
      options.heading = HeadingMode::FORWARD;
      options.min_turning_radius = 0.3;
    }
    PathPlanner planner(options);
    planner.setMap(std::make_shared<const OccupancyGrid>(unknown));
    const auto overlapAt = [&](const Pose& pose) {
      Path standing;
      standing.poses.push_back(pose);
      return largestOverlap(vehicle, standing, pose.yaw, options.heading, 0.04, walls);
    };
    for (int question = 0; question < 4; ++question) {
      const PoseRequest request{randomFootprintPose(random, walls),
                                randomFootprintPose(random, walls)};
      const Plan plan = planner.plan(request);
      if (!plan.found() || !test::contains(plan.message, "the path ends")) continue;
      if (overlapAt(request.start) > 0.0) continue;
      ++replaced;
      would_reach += overlapAt(request.goal) > 0.0;
      EXPECT_FALSE(test::contains(plan.message, "may reach into")) << plan.message;
      for (const Path* path : {&plan.path, &plan.waypoints})
        ASSERT_LT(largestOverlap(vehicle, *path, request.start.yaw, options.heading, 0.04, walls),
                  kTouch)
            << "case " << i << ": " << plan.message;
    }
  }
  EXPECT_GT(replaced, 30);
  EXPECT_GT(would_reach, 20);
  std::printf("%d goals replaced, at %d the footprint reaches into unknown cells\n", replaced,
              would_reach);
}

}  // namespace
}  // namespace grid_path_planner::planning
