// Messages of navigation sensors as measurements of the filter.
//
//   SensorMessages messages(lookup, options);     // lookup: of tf
//   localizer.add(messages.imu(message));         // throws InputError, TransformError
//
// The filter's body frame is that of the first message of the IMU whose place on the vehicle tf knows;
// until then nothing else can be placed, and is refused. Where sensors are on the vehicle is asked of tf
// with every message.
#pragma once

#include <geometry_msgs/PoseWithCovarianceStamped.h>
#include <geometry_msgs/Transform.h>
#include <geometry_msgs/Twist.h>
#include <geometry_msgs/TwistWithCovarianceStamped.h>
#include <ros/time.h>
#include <sensor_msgs/FluidPressure.h>
#include <sensor_msgs/Imu.h>
#include <std_msgs/Header.h>

#include <functional>
#include <optional>
#include <string>

#include "localization/measurement.h"
#include "localization/mounted_pose.h"
#include "ros/localization/vehicle_localizer_options.h"

namespace grid_path_planner::nodes {

localization::Stamp stampOf(const ros::Time& time);
ros::Time timeOf(localization::Stamp stamp);

class SensorMessages {
 public:
  // The latest transform of what is in `source` into `target`; throws std::runtime_error where there is none.
  using Lookup =
      std::function<Eigen::Isometry3d(const std::string& target, const std::string& source)>;

  SensorMessages(Lookup lookup, const VehicleLocalizerOptions& options);

  void use(const VehicleLocalizerOptions& options) { options_ = options; }
  // The next message of an IMU that is kept names the body frame anew.
  void reset() { body_frame_.clear(); }

  localization::Measurement imu(const sensor_msgs::Imu& message) const;
  // Its measurement was used: its frame is the body frame from now on. One that is refused names none.
  void keep(const sensor_msgs::Imu& message);
  // None where the message has no orientation.
  std::optional<localization::Measurement> heading(const sensor_msgs::Imu& message) const;
  localization::Measurement dvl(const geometry_msgs::TwistWithCovarianceStamped& message) const;
  localization::Measurement depth(const geometry_msgs::PoseWithCovarianceStamped& message) const;
  localization::Measurement pressure(const sensor_msgs::FluidPressure& message) const;
  localization::Measurement usbl(const geometry_msgs::PoseWithCovarianceStamped& message) const;
  localization::Measurement marker(const geometry_msgs::PoseWithCovarianceStamped& message) const;
  // A stamp of 0 is `now`.
  localization::Measurement setPose(const geometry_msgs::PoseWithCovarianceStamped& message,
                                    const ros::Time& now) const;
  localization::Measurement command(const geometry_msgs::Twist& message,
                                    const ros::Time& now) const;

  // Of base_frame in the body frame.
  localization::Mounting base() const { return mountingOf(options_.base_frame); }

 private:
  localization::Mounting mountingOf(const std::string& frame) const;
  void checkMapFrame(const std_msgs::Header& header) const;

  Lookup lookup_;
  VehicleLocalizerOptions options_;
  std::string body_frame_;
};

}  // namespace grid_path_planner::nodes
