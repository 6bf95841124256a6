// Whether an accelerometer measures gravity as it must: +9.8 m/s^2 upwards at rest.
//
//   check.add(stamp, imu, base);
//   if (check.fault(9.81) != GravityFault::NONE) warn(check.sentence(9.81));
//
// It is judged by means over some seconds, so that a vehicle may move as it can. A filter that is given g instead of
// m/s^2 would be kilometres off in a minute, and its covariance would not know.
#pragma once

#include <optional>
#include <string>

#include "localization/measurement.h"

namespace grid_path_planner::localization {

enum class GravityFault {
  NONE,
  IN_G,         // 1 instead of 9.8
  MISSING,      // the driver takes gravity off
  WRONG_SIGN,   // -9.8 upwards, by the orientation of the IMU itself
  ACROSS,       // not upwards by that orientation: two axes are swapped
  WRONG_SIZE,   // another number
  UPSIDE_DOWN,  // the vehicle is, by accelerometer and orientation: or the IMU is mounted so, and tf does not say it
};

class GravityCheck {
 public:
  // `base`: turns vectors of the vehicle into the body frame. One that is not newer than the last counts nothing.
  void add(Stamp stamp, const ImuMeasurement& imu, const Eigen::Quaterniond& base);

  // NONE before half a second has been heard.
  GravityFault fault(double gravity) const;
  // With the value that is measured; empty: there is no fault.
  std::string sentence(double gravity) const;

 private:
  struct Means {
    double size = 0.0, up = 0.0,
           above = 0.0;  // m/s^2: of all, along the up of the IMU and that of the vehicle
  };

  std::optional<Stamp> begun_, newest_;
  Means means_;
};

}  // namespace grid_path_planner::localization
