// What the filter assumes of sensors and motion, and when it distrusts a measurement.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "grid_path_planner/base/options.h"

namespace grid_path_planner::localization {

// Which fixes are too far from what was expected.
enum class Gate {
  CHI_SQUARED,  // beyond gate_probability of what the covariances allow
  EITHER,       // poses farther than gate_distance or gate_angle
  BOTH,         // poses farther than gate_distance and gate_angle
  NONE
};

const std::vector<std::pair<const char*, Gate>>& choicesOf(Gate);

struct FilterOptions {
  double gyro_noise = 3.394e-4;        // rad/s/sqrt(Hz)
  double gyro_walk = 3.879e-5;         // rad/s^2/sqrt(Hz)
  double gyro_bias = 0.0087;           // rad/s
  double accelerometer_noise = 0.004;  // m/s^2/sqrt(Hz)
  double accelerometer_walk = 0.006;   // m/s^3/sqrt(Hz)
  double accelerometer_bias = 0.196;   // m/s^2
  double gravity = 9.80665;            // m/s^2
  bool imu_averages = true;
  double imu_timeout = 0.1;             // s
  double imu_max_rate = 10.0;           // rad/s
  double imu_max_acceleration = 100.0;  // m/s^2
  double coast_acceleration = 0.3;      // m/s/sqrt(s)
  double coast_turn = 0.2;              // rad/sqrt(s)
  double start_velocity = 0.5;          // m/s
  double start_tilt = 0.02;             // rad
  double start_yaw = 0.02;              // rad
  double dvl_timeout = 1.0;             // s
  double command_deviation = 0.2;       // m/s
  double command_period = 1.0;          // s
  Gate gate = Gate::CHI_SQUARED;
  double gate_probability = 0.999;
  double gate_distance = 1.0;  // m
  double gate_angle = 12.0;    // deg
  int reset_after = 5;
  double history = 5.0;  // s
};

template <class Visitor>
void visitMotionOptions(FilterOptions& o, Visitor& visit) {
  using base::OptionInfo;
  visit("gyro_noise", o.gyro_noise,
        OptionInfo{"Noise density of the gyro, from its data sheet; larger: fixes turn the pose "
                   "sooner",
                   "rad/s/sqrt(Hz)", 0.0, 1.0}
            .under("The IMU"));
  visit("gyro_walk", o.gyro_walk,
        OptionInfo{"How fast the gyro's bias may change", "rad/s^2/sqrt(Hz)", 0.0, 1.0});
  visit("gyro_bias", o.gyro_bias,
        OptionInfo{"Standard deviation of the gyro's bias at the start", "rad/s", 0.0, 1.0});
  visit("accelerometer_noise", o.accelerometer_noise,
        OptionInfo{"Noise density of the accelerometer", "m/s^2/sqrt(Hz)", 0.0, 10.0});
  visit("accelerometer_walk", o.accelerometer_walk,
        OptionInfo{"How fast the accelerometer's bias may change", "m/s^3/sqrt(Hz)", 0.0, 10.0});
  visit("accelerometer_bias", o.accelerometer_bias,
        OptionInfo{"Standard deviation of the accelerometer's bias at the start", "m/s^2", 0.0,
                   10.0});
  visit("gravity", o.gravity,
        OptionInfo{"What the accelerometer measures at rest", "m/s^2", 9.0, 10.5});
  visit("imu_averages", o.imu_averages,
        OptionInfo{"A measurement of the IMU is the mean since the one before, as of a unit that "
                   "integrates inside; false: the value at its stamp. The wrong one of the two "
                   "errs by half a period of the turn",
                   ""});
  visit(
      "imu_timeout", o.imu_timeout,
      OptionInfo{"A measurement of the IMU holds for so long; then the vehicle is assumed to keep "
                 "its velocity and attitude",
                 "s", 0.001, 1.0});
  visit("imu_max_rate", o.imu_max_rate,
        OptionInfo{"A measurement of the IMU that turns faster about an axis is refused: one such "
                   "sample turns the heading, and nothing shows it; above what the vehicle can do",
                   "rad/s", 0.1, 100.0});
  visit("imu_max_acceleration", o.imu_max_acceleration,
        OptionInfo{"The same for the acceleration along an axis, gravity included", "m/s^2", 15.0,
                   1000.0});
  visit("coast_acceleration", o.coast_acceleration,
        OptionInfo{"How fast the velocity may change without an IMU", "m/s/sqrt(s)", 0.001, 100.0}
            .under("Without an IMU"));
  visit("coast_turn", o.coast_turn,
        OptionInfo{"How fast the attitude may change without an IMU", "rad/sqrt(s)", 0.001, 10.0});
  visit("start_velocity", o.start_velocity,
        OptionInfo{"Standard deviation of the velocity at the start, about 0", "m/s", 0.001, 100.0}
            .under("The start"));
  visit("start_tilt", o.start_tilt,
        OptionInfo{"Standard deviation of roll and pitch that the IMU gives at the start", "rad",
                   0.001, 1.0});
  visit("start_yaw", o.start_yaw,
        OptionInfo{"Standard deviation of the yaw that the IMU gives at the start; larger for a "
                   "compass beside motors",
                   "rad", 0.001, 3.2});
}

template <class Visitor>
void visitMeasurementOptions(FilterOptions& o, Visitor& visit) {
  using base::OptionInfo;
  visit("dvl_timeout", o.dvl_timeout,
        OptionInfo{"The DVL is lost when none of its velocities was used for so long; then cmd_vel "
                   "is",
                   "s", 0.1, 3600.0}
            .under("Velocity"));
  visit("command_deviation", o.command_deviation,
        OptionInfo{"Standard deviation of the velocity from cmd_vel: what current and drag make of "
                   "it",
                   "m/s", 0.001, 100.0});
  visit("command_period", o.command_period,
        OptionInfo{"cmd_vel is used once in so long, since its errors last", "s", 0.01, 3600.0});
  visit("gate", o.gate,
        OptionInfo{"Measurements that are rejected: chi_squared: farther than the covariances let "
                   "expect; either, both: poses beyond gate_distance or, and, gate_angle, nothing "
                   "else; none",
                   ""}
            .under("Measurements that cannot be true"));
  visit("gate_probability", o.gate_probability,
        OptionInfo{"Share of good measurements that pass the gate", "", 0.5, 0.999999});
  visit("gate_distance", o.gate_distance,
        OptionInfo{"Of the gates either and both", "m", 0.0, 1000.0});
  visit("gate_angle", o.gate_angle, OptionInfo{"Of the gates either and both", "deg", 0.0, 180.0});
  visit("reset_after", o.reset_after,
        OptionInfo{"So many rejected measurements in a row that agree with each other, while no "
                   "other fix is used, begin what they measure anew; the log says so",
                   "", 2, 1000});
  visit("history", o.history,
        OptionInfo{"Measurements that come later than this are refused; larger: more memory, some "
                   "0.5 MB/s",
                   "s", 0.1, 60.0});
}

template <class Visitor>
void visitOptions(FilterOptions& o, Visitor&& visit) {
  visitMotionOptions(o, visit);
  visitMeasurementOptions(o, visit);
}

}  // namespace grid_path_planner::localization
