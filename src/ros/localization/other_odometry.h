// map -> odom where another node publishes odom -> base_link: by that one's origin, which is not this node's.
//
// The vehicle's place in the odometry is asked of tf, and not waited for: at the stamp, else the newest that is at most
// kOldestOdometry from it. The pose in the map is that of the same time, so that a driver that is late makes no error.
#pragma once

#include <ros/time.h>

#include <optional>
#include <string>

#include "localization/vehicle_localizer.h"
#include "ros/input/frame_lookup.h"

namespace grid_path_planner::nodes {

constexpr double kOldestOdometry = 0.5;  // s

struct OdometryFrames {
  std::string odometry, base;
};

// `base`: of the base frame in the body frame. None where tf has no such place below the odometry's frame, and before
// the filter has started.
std::optional<localization::Mounting> mapToOtherOdometry(
    const FrameLookup& transforms, const OdometryFrames& frames,
    const localization::VehicleLocalizer& localizer, const localization::Mounting& base,
    const ros::Time& stamp);

}  // namespace grid_path_planner::nodes
