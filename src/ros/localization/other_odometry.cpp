#include "ros/localization/other_odometry.h"

#include <cmath>

#include "ros/guard/clock.h"
#include "ros/localization/sensor_messages.h"

namespace grid_path_planner::nodes {

using localization::Mounting;

namespace {

// Its stamp is that of the place; `stamp` where all of it is static.
std::optional<geometry_msgs::TransformStamped> placeInOdometry(const FrameLookup& transforms,
                                                               const OdometryFrames& frames,
                                                               const ros::Time& stamp) {
  if (transforms.commonFrame(frames.odometry, frames.base) != frames.odometry) return {};
  for (const ros::Time& at : {stamp, ros::Time(0)}) {
    try {
      auto place = transforms.transform(frames.odometry, frames.base, at);
      if (place.header.stamp.isZero()) place.header.stamp = stamp;
      if (std::abs(secondsBetween(place.header.stamp, stamp)) <= kOldestOdometry) return place;
    } catch (const TransformError&) {  // none of that time
    }
  }
  return {};
}

}  // namespace

std::optional<Mounting> mapToOtherOdometry(const FrameLookup& transforms,
                                           const OdometryFrames& frames,
                                           const localization::VehicleLocalizer& localizer,
                                           const Mounting& base, const ros::Time& stamp) {
  const auto place = placeInOdometry(transforms, frames, stamp);
  if (!place) return {};
  const auto snapshot = localizer.mapAt(stampOf(place->header.stamp));
  if (!snapshot) return {};
  const localization::State& state = snapshot->estimate.state;
  const auto& t = place->transform.translation;
  const auto& r = place->transform.rotation;
  const Mounting in_odometry{{t.x, t.y, t.z}, Eigen::Quaterniond(r.w, r.x, r.y, r.z).normalized()};
  return Mounting{state.position, state.attitude} * base * inverse(in_odometry);
}

}  // namespace grid_path_planner::nodes
