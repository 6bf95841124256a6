#include "localization/measurement_check.h"

#include <cmath>
#include <string>

#include "base/cholesky.h"
#include "grid_path_planner/base/decimal_text.h"
#include "grid_path_planner/base/errors.h"

namespace grid_path_planner::localization {

namespace {

using base::decimalText;
using base::InputError;

constexpr double kFarthest = 1e6;            // m
constexpr double kFastest = 100.0;           // m/s
constexpr double kFarthestMounted = 1000.0;  // m
constexpr double kOtherClock = 1e6;          // s
constexpr double kLeastVariance = 1e-12, kLargestVariance = 1e12;

void checkVector(const char* what, const Eigen::Vector3d& vector, double limit) {
  for (const double value : {vector.x(), vector.y(), vector.z()})
    if (!(std::abs(value) <= limit))
      throw InputError(std::string(what) + " must be within " + decimalText(limit) + ", got " +
                       decimalText(value));
}

void checkAttitude(const Eigen::Quaterniond& attitude) {
  const double norm = attitude.norm();
  if (!(std::abs(norm - 1.0) <= 0.01))
    throw InputError("the length of the orientation must be 1, got " + decimalText(norm));
}

void checkPlace(const Eigen::Vector3d& in_body) {
  checkVector("the sensor's place on the vehicle (m)", in_body, kFarthestMounted);
}

void checkVariance(double variance) {
  if (!std::isfinite(variance))
    throw InputError("a variance is not finite: " + decimalText(variance));
  if (variance < 0.0)
    throw InputError("a variance is " + decimalText(variance) + ": negative means no measurement");
  if (variance == 0.0) throw InputError("a variance is 0: no sensor is exact");
  if (variance < kLeastVariance || variance > kLargestVariance)
    throw InputError("a variance must be within 1e-12..1e12, got " + decimalText(variance));
}

void checkData(const ImuMeasurement& imu, const FilterOptions& options) {
  checkVector("the angular velocity (rad/s)", imu.inertial.rate, options.imu_max_rate);
  checkVector("the acceleration (m/s^2)", imu.inertial.acceleration, options.imu_max_acceleration);
  if (imu.attitude) checkAttitude(*imu.attitude);
}

void checkData(const DvlVelocity& dvl, const FilterOptions&) {
  checkVector("the velocity (m/s)", dvl.velocity, kFastest);
  checkCovariance(dvl.covariance);
  checkMounting(dvl.sensor);
}

void checkData(const CommandedVelocity& command, const FilterOptions&) {
  checkVector("the velocity (m/s)", command.velocity, kFastest);
  checkMounting(command.base);
}

void checkData(const DepthFix& depth, const FilterOptions&) {
  checkVector("z (m)", {0.0, 0.0, depth.z}, kFarthest);
  checkVariance(depth.variance);
  checkPlace(depth.sensor);
}

void checkData(const HeadingFix& heading, const FilterOptions&) {
  checkVector("the yaw (rad)", {0.0, 0.0, heading.yaw}, 7.0);
  checkVariance(heading.variance);
}

void checkData(const PositionFix& fix, const FilterOptions&) {
  checkVector("the position (m)", fix.position, kFarthest);
  checkCovariance(fix.covariance);
  checkPlace(fix.sensor);
}

void checkData(const PoseFix& fix, const FilterOptions&) {
  checkVector("the position (m)", fix.position, kFarthest);
  checkAttitude(fix.attitude);
  checkCovariance(fix.covariance);
  checkMounting(fix.mounting);
}

// What makes years between two stamps, as when a recording is played for nodes on the wall clock.
std::string clocksText(double between) {
  return std::abs(between) < kOtherClock
             ? ""
             : ": stamps and clock are not of one time; a bag that is played needs use_sim_time";
}

}  // namespace

void checkMounting(const Mounting& in_body) {
  checkPlace(in_body.position);
  checkAttitude(in_body.rotation);
}

void checkCovariance(const Eigen::MatrixXd& covariance) {
  for (Eigen::Index i = 0; i < covariance.rows(); ++i) checkVariance(covariance(i, i));
  if (!covariance.allFinite()) throw InputError("the covariance holds numbers that are not finite");
  const double largest = covariance.diagonal().maxCoeff();
  if ((covariance - covariance.transpose()).cwiseAbs().maxCoeff() > 1e-6 * largest)
    throw InputError("the covariance is not symmetric");
  if (!base::Cholesky<Eigen::Dynamic>(covariance).isPositiveDefinite())
    throw InputError("the covariance is not positive definite");
}

void checkMeasurement(const Measurement& measurement, const FilterOptions& options) {
  std::visit([&](const auto& data) { checkData(data, options); }, measurement.data);
}

void checkStamp(Stamp stamp, Stamp now, double history) {
  const double ahead = secondsBetween(now, stamp);
  if (ahead > kMostAhead)
    throw InputError("its stamp is " + decimalText(ahead) + " s in the future" + clocksText(ahead));
  if (-ahead > history)
    throw InputError("it is " + decimalText(-ahead) + " s old, more than the history of " +
                     decimalText(history) + " s" + clocksText(ahead));
}

}  // namespace grid_path_planner::localization
