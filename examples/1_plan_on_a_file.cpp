// From a map file to a file of waypoints.
//
//   plan_on_a_file maps/simple.yaml waypoints.yaml
//
// readMapFile() reads every map format: map_server's YAML, MovingAI, images, drawings. PathPlanner
// takes poses in metres and answers with a Plan. A request that has no path is a status with a
// sentence; a file or an option that cannot be used is an InputError.
#include <iostream>
#include <memory>

#include "grid_path_planner/base/errors.h"
#include "grid_path_planner/grid/map_file.h"
#include "grid_path_planner/path/metrics.h"
#include "grid_path_planner/path/waypoint_file.h"
#include "grid_path_planner/planning/path_planner.h"

using grid_path_planner::base::InputError;
using grid_path_planner::base::Status;
using grid_path_planner::grid::OccupancyGrid;
using grid_path_planner::planning::PathPlanner;
using grid_path_planner::planning::Plan;
using grid_path_planner::planning::PlannerOptions;

namespace {

int planOnFile(const std::string& map_file, const std::string& waypoint_file) {
  const auto map =
      std::make_shared<const OccupancyGrid>(grid_path_planner::grid::readMapFile(map_file));
  std::cout << "The map has " << map->width() << " x " << map->height() << " cells of "
            << map->geometry().resolution() << " m.\n";

  PlannerOptions options;
  options.planner = "weighted_jump_point";
  options.costmap.radius = 1.0;  // m, of the vehicle

  PathPlanner planner(options);
  planner.setMap(map);
  const Plan plan = planner.plan({{{4.0, 4.0, 0.0}, 0.0}, {{60.0, 60.0, 0.0}, 0.0}});
  std::cout << toString(plan.status) << ": " << plan.message << '\n';
  if (plan.status != Status::FOUND) return 1;

  std::cout << "The path is " << plan.length_m << " m long; its clearance is "
            << clearanceOf(plan.path, *map, options.costmap.thresholds) << " m.\n";
  grid_path_planner::path::writeWaypointFile(waypoint_file, plan.waypoints);
  std::cout << "Its " << plan.waypoints.poses.size() << " waypoints are in " << waypoint_file
            << ".\n";
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) {
    std::cerr << "usage: plan_on_a_file MAP WAYPOINTS\n";
    return 2;
  }
  try {
    return planOnFile(argv[1], argv[2]);
  } catch (const InputError& error) {
    std::cerr << error.what() << '\n';
    return 2;
  }
}
