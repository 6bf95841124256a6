#include "ros/localization/other_odometry.h"

#include "ros/localization/sensor_messages.h"

namespace grid_path_planner::nodes {

using localization::Mounting;

namespace {

// Its stamp is that of the place; `stamp` where all of it is static.
std::optional<Placed> placeInOdometry(const FrameLookup& transforms, const OdometryFrames& frames,
                                      const ros::Time& stamp) {
  if (transforms.commonFrame(frames.odometry, frames.base) != frames.odometry) return {};
  std_msgs::Header base;
  base.frame_id = frames.base;
  base.stamp = stamp;
  try {
    Placed place = transforms.place(base, {frames.odometry, kOldestOdometry, Moving::AT_STAMP});
    if (place.stamp.isZero()) place.stamp = stamp;
    return place;
  } catch (const TransformError&) {  // none of that time
    return {};
  }
}

}  // namespace

std::optional<Mounting> mapToOtherOdometry(const FrameLookup& transforms,
                                           const OdometryFrames& frames,
                                           const localization::VehicleLocalizer& localizer,
                                           const Mounting& base, const ros::Time& stamp) {
  const auto place = placeInOdometry(transforms, frames, stamp);
  if (!place) return {};
  const auto snapshot = localizer.mapAt(stampOf(place->stamp));
  if (!snapshot) return {};
  const localization::State& state = snapshot->estimate.state;
  const Mounting in_odometry{place->pose.translation(), Eigen::Quaterniond(place->pose.linear())};
  return Mounting{state.position, state.attitude} * base * inverse(in_odometry);
}

}  // namespace grid_path_planner::nodes
