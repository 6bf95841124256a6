// Errors, rate and mounting of the simulated inertial measurement unit.
#pragma once

#include "grid_path_planner/base/options.h"
#include "simulation/sensors/mounting.h"

namespace grid_path_planner::simulation {

// Of each of three gyroscopes or accelerometers; in u, which is rad/s or m/s^2.
struct TriadErrors {
  double noise = 0.0;             // u/sqrt(Hz)
  double walk = 0.0;              // u/s/sqrt(Hz)
  double correlation_time = 1.0;  // s, tau
  double turn_on = 0.0;           // u
};

// Gyroscopes and accelerometers as those of uuv_simulator.
struct ImuOptions {
  bool enabled = false;
  double rate = 100.0;                                           // Hz
  TriadErrors gyroscope = {3.394e-4, 3.879e-5, 1000.0, 0.0087};  // of rad/s
  TriadErrors accelerometer = {0.004, 0.006, 300.0, 0.196};      // of m/s^2
  double tilt_noise = 0.01;                                      // rad
  double heading_error = 0.0;                                    // rad
  Mounting mounting;
  int seed = 1;
};

template <class Visitor>
void visitOptions(ImuOptions& o, Visitor&& visit) {
  visit("enabled", o.enabled,
        base::OptionInfo{"Whether there is an inertial measurement unit", ""}.under(
            "The inertial measurement unit (IMU)"));
  visit("rate", o.rate,
        base::OptionInfo{"Measurements in a simulated second, each the mean since the one before; "
                         "at most one a time_step",
                         "Hz", 1.0, 10000.0});
  visit("gyroscope_noise", o.gyroscope.noise,
        base::OptionInfo{"Density of the white noise of each axis", "rad/s/sqrt(Hz)", 0.0, 1.0});
  visit("gyroscope_walk", o.gyroscope.walk,
        base::OptionInfo{"How fast each bias drifts (Gauss-Markov)", "rad/s^2/sqrt(Hz)", 0.0, 1.0});
  visit("gyroscope_correlation_time", o.gyroscope.correlation_time,
        base::OptionInfo{"Time after which the drift is forgotten", "s", 0.1, 1e6});
  visit(
      "gyroscope_turn_on", o.gyroscope.turn_on,
      base::OptionInfo{"Standard deviation of the constant bias of each axis", "rad/s", 0.0, 1.0});
  visit("accelerometer_noise", o.accelerometer.noise,
        base::OptionInfo{"Density of the white noise of each axis", "m/s^2/sqrt(Hz)", 0.0, 10.0});
  visit("accelerometer_walk", o.accelerometer.walk,
        base::OptionInfo{"How fast each bias drifts (Gauss-Markov)", "m/s^3/sqrt(Hz)", 0.0, 10.0});
  visit("accelerometer_correlation_time", o.accelerometer.correlation_time,
        base::OptionInfo{"Time after which the drift is forgotten", "s", 0.1, 1e6});
  visit(
      "accelerometer_turn_on", o.accelerometer.turn_on,
      base::OptionInfo{"Standard deviation of the constant bias of each axis", "m/s^2", 0.0, 10.0});
  visit("tilt_noise", o.tilt_noise,
        base::OptionInfo{"Standard deviation of roll and pitch of the orientation; its yaw drifts "
                         "with the gyroscopes",
                         "rad", 0.0, 1.0});
  visit("heading_error", o.heading_error,
        base::OptionInfo{"What the orientation's yaw is off by at the start, which no covariance "
                         "tells",
                         "rad", -3.2, 3.2});
  visitOptions(o.mounting, visit);
  visit("seed", o.seed, base::OptionInfo{"Another seed, other errors", "", 0, 1e9});
}

}  // namespace grid_path_planner::simulation
