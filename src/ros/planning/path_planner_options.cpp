#include "ros/planning/path_planner_options.h"

#include "grid_path_planner/base/options.h"
#include "planning/vehicle_options.h"

namespace grid_path_planner::nodes {

using base::checkOptionLimits;
using base::InputError;
using planning::checkPlannerOptions;

const std::vector<std::pair<const char*, GoalZ>>& choicesOf(GoalZ) {
  static const std::vector<std::pair<const char*, GoalZ>> choices = {{"message", GoalZ::MESSAGE},
                                                                     {"vehicle", GoalZ::VEHICLE}};
  return choices;
}

void takeFromVehicle(PathPlannerNodeOptions& options) {
  if (options.vehicle) planning::takeFromVehicle(options.planner, *options.vehicle);
}

void checkPathPlannerNodeOptions(const PathPlannerNodeOptions& options) {
  checkOptionLimits(options);
  if (options.vehicle)
    checkKeptDistance("radius", options.planner.costmap.radius, *options.vehicle);
  checkPlannerOptions(options.planner);
  if (options.map_frame.empty()) throw InputError("map_frame must name a frame, got ''");
  if (options.base_frame.empty()) throw InputError("base_frame must name a frame, got ''");
}

}  // namespace grid_path_planner::nodes
