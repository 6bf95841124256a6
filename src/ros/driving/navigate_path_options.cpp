#include "ros/driving/navigate_path_options.h"

#include "grid_path_planner/base/options.h"
#include "ros/guard/network_text.h"
#include "vehicle/footprint.h"

namespace grid_path_planner::nodes {

using base::checkOptionLimits;
using base::InputError;
using following::checkFollowerOptions;
using vehicle::Footprint;
using vehicle::unite;

void takeFromVehicle(NavigatePathOptions& options) {
  if (!options.vehicle) return;
  const vehicle::Description& vehicle = *options.vehicle;
  following::FollowerOptions& driven = options.follower;
  const following::FollowerOptions unset;
  unite("max_speed", driven.max_speed, unset.max_speed, vehicle.max_speed);
  unite("max_yaw_rate", driven.max_yaw_rate, unset.max_yaw_rate, vehicle.max_yaw_rate);
  unite("max_acceleration", driven.max_acceleration, unset.max_acceleration,
        vehicle.max_acceleration);
  unite("max_yaw_acceleration", driven.max_yaw_acceleration, unset.max_yaw_acceleration,
        vehicle.max_yaw_acceleration);
  if (vehicle.changesHeight())
    unite("max_vertical_speed", driven.max_vertical_speed, unset.max_vertical_speed,
          vehicle.max_vertical_speed);
  unite("hold_distance", driven.hold_distance, unset.hold_distance, vehicle.hold_distance);
  unite("hold_time", driven.hold_time, unset.hold_time, vehicle.hold_time);
  uniteOutline("check_footprint", options.check_footprint, vehicle);
  double& radius = options.limits.radius;
  checkKeptDistance("check_radius", radius, vehicle);
  const vehicle::Outline outline = outlineOf(vehicle);
  if (radius == 0.0 && outline.round()) radius = outline.inscribedRadius();
}

void checkNavigatePathOptions(const NavigatePathOptions& options) {
  checkOptionLimits(options);
  checkFollowerOptions(options.follower);
  checkNetworkText("map_frame", options.map_frame);
  checkNetworkText("base_frame", options.base_frame);
  Footprint::fromText("check_footprint", options.check_footprint);
  if (options.limits.thresholds.free_max >= options.limits.thresholds.occupied_min)
    throw InputError("free_max must be below occupied_min, got " +
                     std::to_string(options.limits.thresholds.free_max) + " and " +
                     std::to_string(options.limits.thresholds.occupied_min) + " %");
  if (options.map_frame.empty()) throw InputError("map_frame must not be empty");
  if (options.base_frame.empty()) throw InputError("base_frame must not be empty");
}

}  // namespace grid_path_planner::nodes
