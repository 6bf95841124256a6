#include "ros/simulation/sensor_messages.h"

#include <cmath>

#include "ros/simulation/transform_message.h"

namespace grid_path_planner::nodes {

using simulation::DvlOptions;
using simulation::DvlReading;
using simulation::DvlVelocity;
using simulation::ImuReading;
using simulation::LaserOptions;
using simulation::LaserReading;
using simulation::NavigationSensorOptions;
using simulation::PressureOptions;
using simulation::PressureReading;
using simulation::UsblFix;

namespace {

// To geometry_msgs' Vector3 or Point.
template <class Message>
void copyTo(const Eigen::Vector3d& vector, Message& message) {
  message.x = vector.x();
  message.y = vector.y();
  message.z = vector.z();
}

void copyTo(const Eigen::Quaterniond& rotation, geometry_msgs::Quaternion& message) {
  message.x = rotation.x();
  message.y = rotation.y();
  message.z = rotation.z();
  message.w = rotation.w();
}

// Of the first three of six numbers; the others are not measured.
boost::array<double, 36> covarianceOf(const Eigen::Matrix3d& block) {
  boost::array<double, 36> covariance;
  covariance.fill(0.0);
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) covariance[6 * row + column] = block(row, column);
    covariance[7 * (row + 3)] = kNotMeasured;
  }
  return covariance;
}

boost::array<double, 9> diagonal(double x, double y, double z) {
  return {x, 0.0, 0.0, 0.0, y, 0.0, 0.0, 0.0, z};
}

}  // namespace

std::vector<geometry_msgs::TransformStamped> sensorTransforms(
    const NavigationSensorOptions& options, const std::string& base,
    const SensorFrameNames& frames) {
  std::vector<geometry_msgs::TransformStamped> transforms;
  const auto add = [&](const auto& sensor, const std::string& frame) {
    if (sensor.enabled) transforms.push_back(transformOf(base, frame, sensor.mounting.pose()));
  };
  add(options.imu, frames.imu);
  add(options.dvl, frames.dvl);
  if (options.dvl.enabled) {
    const Eigen::AngleAxisd down(0.5 * M_PI, Eigen::Vector3d::UnitY());
    transforms.push_back(transformOf(frames.dvl, frames.dvl_altitude, Eigen::Isometry3d(down)));
  }
  add(options.pressure, frames.pressure);
  add(options.usbl, frames.usbl);
  add(options.laser, frames.laser);
  return transforms;
}

sensor_msgs::LaserScan scanMessage(const LaserReading& reading, const LaserOptions& options) {
  sensor_msgs::LaserScan message;
  const double first = angleMin(options), step = angleIncrement(options);
  message.angle_min = static_cast<float>(first);
  message.angle_increment = static_cast<float>(step);
  message.angle_max = static_cast<float>(first + (options.rays - 1) * step);
  message.scan_time = static_cast<float>(1.0 / options.rate);
  message.range_min = static_cast<float>(options.range_min);
  message.range_max = static_cast<float>(options.range_max);
  message.ranges = reading.ranges;
  return message;
}

sensor_msgs::Imu imuMessage(const ImuReading& reading) {
  sensor_msgs::Imu message;
  const double tilt = reading.tilt_variance;
  const double turn = reading.angular_velocity_variance;
  const double force = reading.specific_force_variance;
  copyTo(reading.orientation, message.orientation);
  message.orientation_covariance = diagonal(tilt, tilt, reading.heading_variance);
  copyTo(reading.angular_velocity, message.angular_velocity);
  message.angular_velocity_covariance = diagonal(turn, turn, turn);
  copyTo(reading.specific_force, message.linear_acceleration);
  message.linear_acceleration_covariance = diagonal(force, force, force);
  return message;
}

geometry_msgs::TwistWithCovarianceStamped twistMessage(const DvlVelocity& velocity) {
  geometry_msgs::TwistWithCovarianceStamped message;
  copyTo(velocity.velocity, message.twist.twist.linear);
  message.twist.covariance = covarianceOf(velocity.covariance);
  return message;
}

sensor_msgs::Range altitudeMessage(const DvlReading& reading, const DvlOptions& options) {
  const double along_axis = std::cos(options.beam_angle);
  sensor_msgs::Range message;
  message.radiation_type = sensor_msgs::Range::ULTRASOUND;
  message.field_of_view = static_cast<float>(2.0 * options.beam_angle);
  message.min_range = static_cast<float>(options.range_min * along_axis);
  message.max_range = static_cast<float>(options.range_max * along_axis);
  message.range = static_cast<float>(reading.altitude);
  return message;
}

sensor_msgs::FluidPressure pressureMessage(const PressureReading& reading) {
  sensor_msgs::FluidPressure message;
  message.fluid_pressure = reading.pressure;
  message.variance = reading.variance;
  return message;
}

geometry_msgs::PoseWithCovarianceStamped depthMessage(const PressureReading& reading,
                                                      const PressureOptions& options) {
  geometry_msgs::PoseWithCovarianceStamped message;
  message.pose.pose.position.z = heightFromPressure(options, reading.pressure);
  message.pose.pose.orientation.w = 1.0;
  message.pose.covariance = covarianceOf(
      Eigen::Vector3d(kNotMeasured, kNotMeasured, heightVariance(options, reading.variance))
          .asDiagonal());
  return message;
}

geometry_msgs::PoseWithCovarianceStamped fixMessage(const UsblFix& fix) {
  geometry_msgs::PoseWithCovarianceStamped message;
  copyTo(fix.position, message.pose.pose.position);
  message.pose.pose.orientation.w = 1.0;
  message.pose.covariance = covarianceOf(fix.covariance);
  return message;
}

}  // namespace grid_path_planner::nodes
