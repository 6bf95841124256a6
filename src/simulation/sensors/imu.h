// A strapdown inertial measurement unit with an attitude and heading reference of its own.
//
//   Imu imu(options);
//   const auto reading = imu.measure(vehicle.state(), vehicle.timeNs());   // after every step
//   if (reading) std::cout << reading->specific_force.z() << " m/s^2 upwards\n";
//
// A measurement is the mean since the one before, as of a unit that integrates inside: turns and
// velocities that are integrated from it without noise are those of the vehicle. The specific force
// is that at the unit's own place, lever arm included; at rest it is +9.80665 m/s^2 upwards
// (REP 145). The orientation errs by white noise of roll and pitch, and by a yaw that integrates the
// error of the gyroscopes about the vertical. Guaranteed: the same calls give the same measurements,
// bit for bit. Not modelled: scale errors, axes that are not at right angles, vibration, the turn of
// the earth.
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <optional>

#include "grid_path_planner/simulation/vehicle.h"
#include "simulation/sensors/drifting_triad.h"
#include "simulation/sensors/imu_options.h"
#include "simulation/sensors/sample_clock.h"

namespace grid_path_planner::simulation {

constexpr double kStandardGravity = 9.80665;  // m/s^2

// In the unit's own axes. Variances are of each axis.
struct ImuReading {
  std::int64_t time_ns = 0;
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();  // of the unit in the map
  double tilt_variance = 0.0;                                  // rad^2, about the map's x and y
  double heading_variance = 0.0;                               // rad^2, about the map's z
  Eigen::Vector3d angular_velocity = Eigen::Vector3d::Zero();  // rad/s
  double angular_velocity_variance = 0.0;
  Eigen::Vector3d specific_force = Eigen::Vector3d::Zero();  // m/s^2
  double specific_force_variance = 0.0;
};

class Imu {
 public:
  explicit Imu(const ImuOptions& options);

  const ImuOptions& options() const { return options_; }

  // The vehicle is at `state` after a step. None unless a measurement is due, nor the first time, since
  // there is nothing to take a mean of.
  std::optional<ImuReading> measure(const VehicleState& state, std::int64_t time_ns);

  // The truth, in the unit's own axes: rad/s, m/s^2.
  Eigen::Vector3d gyroscopeBias() const { return gyroscope_.bias(); }
  Eigen::Vector3d accelerometerBias() const { return accelerometer_.bias(); }

  // The vehicle was put elsewhere, which is no motion. Biases and the error of the heading stay.
  void jump() { before_.reset(); }

 private:
  struct Motion {
    std::int64_t time_ns;
    Eigen::Matrix3d map_from_imu;
    Eigen::Vector3d velocity;  // m/s, of the unit in the map
  };

  Motion motionOf(const VehicleState& state, std::int64_t time_ns) const;
  Eigen::Quaterniond orientation(const Eigen::Matrix3d& map_from_imu);

  ImuOptions options_;
  Eigen::Isometry3d base_from_imu_;
  SampleClock clock_;
  NoiseStream noise_;
  DriftingTriad gyroscope_;
  DriftingTriad accelerometer_;
  double heading_error_;  // rad
  double age_ = 0.0;      // s, of the heading's drift
  std::optional<Motion> before_;
};

}  // namespace grid_path_planner::simulation
