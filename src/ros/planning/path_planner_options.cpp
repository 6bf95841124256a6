#include "ros/planning/path_planner_options.h"

#include "grid_path_planner/base/options.h"

namespace grid_path_planner::nodes {

using base::checkOptionLimits;
using base::InputError;
using planning::checkPlannerOptions;
using vehicle::unite;

namespace {

constexpr double kTrackingMargin = 0.05;  // m, by which a vehicle may be off its path

}  // namespace

const std::vector<std::pair<const char*, GoalZ>>& choicesOf(GoalZ) {
  static const std::vector<std::pair<const char*, GoalZ>> choices = {{"message", GoalZ::MESSAGE},
                                                                     {"vehicle", GoalZ::VEHICLE}};
  return choices;
}

void takeFromVehicle(PathPlannerNodeOptions& options) {
  if (!options.vehicle) return;
  const vehicle::Description& vehicle = *options.vehicle;
  planning::PlannerOptions& planner = options.planner;
  uniteOutline("footprint", planner.footprint, vehicle);
  unite("min_turning_radius", planner.min_turning_radius, 0.0, vehicle.least_turning_radius);
  double& radius = planner.costmap.radius;
  if (radius == 0.0) radius = outlineOf(vehicle).inscribedRadius() + kTrackingMargin;
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
