#include "simulation/sensors/imu.h"

#include <utility>

namespace grid_path_planner::simulation {
namespace {

// The rotation vector of a turn.
Eigen::Vector3d rotationVector(const Eigen::Matrix3d& turn) {
  const Eigen::AngleAxisd angle_axis(turn);
  return angle_axis.angle() * angle_axis.axis();
}

Eigen::AngleAxisd turnBy(const Eigen::Vector3d& rotation_vector) {
  const double angle = rotation_vector.norm();
  if (angle == 0.0) return Eigen::AngleAxisd::Identity();
  return Eigen::AngleAxisd(angle, rotation_vector / angle);
}

}  // namespace

Imu::Imu(const ImuOptions& options)
    : options_(options),
      base_from_imu_(options.mounting.pose()),
      clock_(options.rate),
      noise_(options.seed, SensorName::IMU),
      gyroscope_(options.gyroscope, noise_),
      accelerometer_(options.accelerometer, noise_),
      heading_error_(options.heading_error) {}

Imu::Motion Imu::motionOf(const VehicleState& state, std::int64_t time_ns) const {
  const Eigen::Isometry3d map_from_base = mapFromBase(state);
  const BodyTwist twist = bodyTwist(state);
  return {
      time_ns, map_from_base.linear() * base_from_imu_.linear(),
      map_from_base.linear() * (twist.linear + twist.angular.cross(base_from_imu_.translation()))};
}

std::optional<ImuReading> Imu::measure(const VehicleState& state, std::int64_t time_ns) {
  if (!clock_.take(time_ns)) return std::nullopt;
  const Motion now = motionOf(state, time_ns);
  const std::optional<Motion> before = std::exchange(before_, now);
  if (!before || now.time_ns <= before->time_ns) return std::nullopt;

  const double seconds = static_cast<double>(now.time_ns - before->time_ns) * 1e-9;
  const Eigen::Vector3d turn = rotationVector(before->map_from_imu.transpose() * now.map_from_imu);
  const Eigen::Matrix3d halfway = before->map_from_imu * turnBy(0.5 * turn);
  const Eigen::Vector3d gravity(0.0, 0.0, -kStandardGravity);

  const Eigen::Vector3d gyroscope_error = gyroscope_.next(seconds, noise_);
  age_ += seconds;
  heading_error_ += seconds * halfway.row(2).dot(gyroscope_error);

  ImuReading reading;
  reading.time_ns = time_ns;
  reading.orientation = orientation(now.map_from_imu);
  reading.tilt_variance = options_.tilt_noise * options_.tilt_noise;
  reading.heading_variance = gyroscope_.integralVariance(age_);
  reading.angular_velocity = turn / seconds + gyroscope_error;
  reading.angular_velocity_variance = gyroscope_.variance(seconds);
  reading.specific_force =
      halfway.transpose() * ((now.velocity - before->velocity) / seconds - gravity) +
      accelerometer_.next(seconds, noise_);
  reading.specific_force_variance = accelerometer_.variance(seconds);
  return reading;
}

// With its errors about the axes of the map.
Eigen::Quaterniond Imu::orientation(const Eigen::Matrix3d& map_from_imu) {
  Eigen::Vector3d tilt = options_.tilt_noise * noise_.normals();
  tilt.z() = 0.0;
  const Eigen::Quaterniond measured = Eigen::AngleAxisd(heading_error_, Eigen::Vector3d::UnitZ()) *
                                      turnBy(tilt) * Eigen::Quaterniond(map_from_imu);
  return measured.normalized();
}

}  // namespace grid_path_planner::simulation
