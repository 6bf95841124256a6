// Measurements of a vehicle on a known trajectory, with the errors of usual underwater sensors.
//
//   SimulatedSensors sensors(seed);
//   for (const Measurement& measurement : sensors.run(60.0)) filter.add(measurement);
//   errorBetween(estimate, sensors.truthAt(60.0));
#pragma once

#include <functional>
#include <random>
#include <vector>

#include "localization/filter_options.h"
#include "localization/measurement.h"
#include "localization/mounted_pose.h"
#include "localization/support/trajectory.h"

namespace grid_path_planner::localization {

constexpr Stamp kStart = 1'000'000'000'000;  // ns
inline Stamp stampAt(double seconds) {
  return kStart + static_cast<Stamp>(std::llround(1e9 * seconds));
}

struct SensorRates {
  double imu = 100.0, dvl = 7.0, depth = 10.0, usbl = 1.0, marker = 0.0, command = 0.0;  // Hz
};

class SimulatedSensors {
 public:
  explicit SimulatedSensors(unsigned seed) : random_(seed) {
    gyro_bias_ = normal(options.gyro_bias);
    accelerometer_bias_ = normal(options.accelerometer_bias);
  }

  Trajectory trajectory;
  FilterOptions options;
  SensorRates rates;
  Mounting dvl{{-0.3, 0.1, -0.2},
               Eigen::Quaterniond(Eigen::AngleAxisd(0.5 * M_PI, Eigen::Vector3d::UnitZ()))};
  Eigen::Vector3d usbl{0.1, 0.0, 0.4}, pressure{0.2, -0.1, 0.0};
  Mounting base{{0.1, 0.05, -0.1},
                Eigen::Quaterniond(Eigen::AngleAxisd(0.2, Eigen::Vector3d::UnitY()))};
  double usbl_outliers = 0.0;  // share
  double marker_flips = 0.0;   // share
  std::function<bool(Source, double)> cut = [](Source, double) { return false; };

  // The IMU then measures the motion itself.
  void takeErrorsFromImu() {
    options.gyro_noise = options.gyro_walk = 0.0;
    options.accelerometer_noise = options.accelerometer_walk = 0.0;
    gyro_bias_.setZero();
    accelerometer_bias_.setZero();
  }

  // In the order of their stamps, from where the last call ended.
  std::vector<Measurement> run(double seconds) {
    std::vector<Measurement> all;
    const long end = static_cast<long>(std::lround(seconds * kTicks)) + begun_;
    for (; tick_ <= end; ++tick_) {
      const double t = static_cast<double>(tick_) / kTicks;
      for (const auto source : {Source::IMU, Source::DVL, Source::COMMAND, Source::DEPTH,
                                Source::USBL, Source::MARKER}) {
        if (!isDue(source, tick_)) continue;
        const Measurement measurement = measure(source, t);
        if (!cut(source, t)) all.push_back(measurement);
      }
    }
    begun_ = end;
    return all;
  }

  // With the biases of now: of the last measurement made.
  State truthAt(double t) const {
    State state = trajectory.stateAt(t);
    state.gyro_bias = gyro_bias_;
    state.accelerometer_bias = accelerometer_bias_;
    return state;
  }

 private:
  static constexpr int kTicks = 2100;  // a second: a multiple of the rates

  double rateOf(Source source) const {
    switch (source) {
      case Source::IMU:
        return rates.imu;
      case Source::DVL:
        return rates.dvl;
      case Source::COMMAND:
        return rates.command;
      case Source::DEPTH:
        return rates.depth;
      case Source::USBL:
        return rates.usbl;
      default:
        return rates.marker;
    }
  }
  bool isDue(Source source, long tick) const {
    const double rate = rateOf(source);
    return rate > 0.0 && tick % std::lround(kTicks / rate) == 0;
  }

  double draw(double deviation) { return deviation * normal_(random_); }
  Eigen::Vector3d normal(double deviation) {
    const double x = draw(deviation), y = draw(deviation), z = draw(deviation);
    return {x, y, z};
  }

  Measurement measure(Source source, double t) {
    const State state = trajectory.stateAt(t);
    const Eigen::Vector3d rate = trajectory.inertialAt(t, options.gravity).rate;
    const Stamp stamp = stampAt(t);
    switch (source) {
      case Source::IMU:
        return {stamp, source, imu(t)};
      case Source::DVL:
        return {stamp, source,
                DvlVelocity{velocityAt(state, rate, dvl) + normal(0.005),
                            0.005 * 0.005 * Eigen::Matrix3d::Identity(), dvl}};
      case Source::COMMAND:
        return {stamp, source,
                CommandedVelocity{velocityAt(state, rate, base) + normal(0.1), base}};
      case Source::DEPTH:
        return {stamp, source,
                DepthFix{(state.position + state.attitude * pressure).z() + draw(0.02), 0.02 * 0.02,
                         pressure}};
      case Source::USBL:
        return {stamp, source, fix(state)};
      default:
        return {stamp, source, pose(state)};
    }
  }

  ImuMeasurement imu(double t) {
    const double root = std::sqrt(rates.imu);
    gyro_bias_ += normal(options.gyro_walk / root);
    accelerometer_bias_ += normal(options.accelerometer_walk / root);
    ImuMeasurement imu;
    imu.inertial = options.imu_averages
                       ? trajectory.meanInertial(t - 1.0 / rates.imu, t, options.gravity)
                       : trajectory.inertialAt(t, options.gravity);
    imu.inertial.rate += gyro_bias_ + normal(options.gyro_noise * root);
    imu.inertial.acceleration += accelerometer_bias_ + normal(options.accelerometer_noise * root);
    const Eigen::Vector3d error(draw(options.start_tilt), draw(options.start_tilt),
                                draw(options.start_yaw));
    imu.attitude = expSO3<double>(error) * trajectory.stateAt(t).attitude;
    return imu;
  }

  PositionFix fix(const State& state) {
    PositionFix fix{state.position + state.attitude * usbl + normal(0.1),
                    0.01 * Eigen::Matrix3d::Identity(), usbl};
    if (uniform_(random_) < usbl_outliers)
      fix.position += (2.0 + 18.0 * uniform_(random_)) * normal(1.0).normalized();
    return fix;
  }

  PoseFix pose(const State& state) {
    PoseFix fix{state.position + state.attitude * base.position + normal(0.02),
                state.attitude * base.rotation * expSO3<double>(normal(0.01)),
                PoseCovariance::Identity(), base};
    fix.covariance.diagonal() << 4e-4, 4e-4, 4e-4, 1e-4, 1e-4, 1e-4;
    if (uniform_(random_) < marker_flips)
      fix.attitude =
          expSO3<double>(Eigen::Vector3d(0.0, 0.0, draw(1.0) > 0.0 ? 0.7 : -0.7)) * fix.attitude;
    return fix;
  }

  long tick_ = 0, begun_ = 0;
  std::mt19937_64 random_;
  std::normal_distribution<double> normal_;
  std::uniform_real_distribution<double> uniform_;
  Eigen::Vector3d gyro_bias_ = Eigen::Vector3d::Zero(), accelerometer_bias_ = gyro_bias_;
};

}  // namespace grid_path_planner::localization
