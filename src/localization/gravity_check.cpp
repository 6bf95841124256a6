#include "localization/gravity_check.h"

#include <algorithm>
#include <cmath>

#include "grid_path_planner/base/decimal_text.h"

namespace grid_path_planner::localization {

namespace {

constexpr double kMemory = 1.0;      // s, of the means
constexpr double kLeast = 0.5;       // s, that are heard before anything is said
constexpr double kLongestGap = 1.0;  // s, between two measurements; after more all begins anew

std::string inMetres(double value) {
  return base::decimalText(std::round(10.0 * value) / 10.0) + " m/s^2";
}

}  // namespace

void GravityCheck::add(Stamp stamp, const ImuMeasurement& imu, const Eigen::Quaterniond& base) {
  if (newest_ && stamp <= *newest_) return;
  const Eigen::Vector3d& force = imu.inertial.acceleration;
  const Eigen::Vector3d z = Eigen::Vector3d::UnitZ();
  const double above = force.dot(base * z);
  const double up = imu.attitude ? force.dot(imu.attitude->conjugate() * z) : above;
  const double seconds = newest_ ? secondsBetween(*newest_, stamp) : kLongestGap;
  const bool begins = seconds >= kLongestGap;
  if (begins) begun_ = stamp;
  // A mean of all at first, since one sample says little.
  const double share = begins ? 1.0
                              : std::max(1.0 - std::exp(-seconds / kMemory),
                                         seconds / secondsBetween(*begun_, stamp));
  newest_ = stamp;
  means_.size += share * (force.norm() - means_.size);
  means_.up += share * (up - means_.up);
  means_.above += share * (above - means_.above);
}

GravityFault GravityCheck::fault(double gravity) const {
  if (!begun_ || secondsBetween(*begun_, *newest_) < kLeast) return GravityFault::NONE;
  const double size = means_.size / gravity, up = means_.up / gravity;
  const double in_g = std::abs(means_.up);
  if (size < 0.5 && std::abs(up) < 0.05) return GravityFault::MISSING;
  if (size < 0.25 && in_g > 0.7 && in_g < 1.3) return GravityFault::IN_G;
  if (size < 0.5 || size > 2.0) return GravityFault::WRONG_SIZE;
  if (up < -0.5) return GravityFault::WRONG_SIGN;
  if (up < 0.5) return GravityFault::ACROSS;
  return means_.above < -0.5 * gravity ? GravityFault::UPSIDE_DOWN : GravityFault::NONE;
}

std::string GravityCheck::sentence(double gravity) const {
  const std::string measured = "the accelerometer measures " + inMetres(means_.up) + " upwards";
  switch (fault(gravity)) {
    case GravityFault::NONE:
      return {};
    case GravityFault::IN_G:
      return measured + ": it is in g, and must be in m/s^2";
    case GravityFault::MISSING:
      return measured + ": its driver takes gravity off, which must stay in";
    case GravityFault::WRONG_SIGN:
      return measured + " by the IMU's own orientation: its sign is wrong, or it is upside down";
    case GravityFault::ACROSS:
      return measured + " by the IMU's own orientation, of " + inMetres(means_.size) +
             ": its axes are not those of the orientation";
    case GravityFault::WRONG_SIZE:
      return "the accelerometer measures " + inMetres(means_.size) + ", and gravity is " +
             inMetres(gravity);
    case GravityFault::UPSIDE_DOWN:
      break;
  }
  return "by its accelerometer the vehicle is upside down, or the IMU is and tf does not say so";
}

}  // namespace grid_path_planner::localization
