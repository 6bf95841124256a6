#include "planning/vehicle_options.h"

namespace grid_path_planner::planning {

using vehicle::unite;

namespace {

constexpr double kTrackingMargin = 0.05;  // m, by which a vehicle may be off its path

}  // namespace

void takeFromVehicle(PlannerOptions& options, const vehicle::Description& vehicle) {
  uniteOutline("footprint", options.footprint, vehicle);
  unite("min_turning_radius", options.min_turning_radius, 0.0, vehicle.least_turning_radius);
  double& radius = options.costmap.radius;
  if (radius == 0.0) radius = outlineOf(vehicle).inscribedRadius() + kTrackingMargin;
  checkKeptDistance("radius", radius, vehicle);
}

}  // namespace grid_path_planner::planning
