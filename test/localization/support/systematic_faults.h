// Faults that last: a sensor that is mounted, wired or configured wrongly, and what a localizer says with it.
//
//   const VerdictRun run = runWithFault(systematicFaults()[3], Suite::MARKERS, seed, 120.0);
//   EXPECT_LE(run.longest, 3.0);
//
// A fix, a marker view or a depth *contradicts* the pose where it lies farther from the pose that was said at its stamp
// than the errors of the sensor and of a sound estimate explain: by raw numbers, not by what the filter thinks of it.
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "grid_path_planner/base/errors.h"
#include "localization/support/simulated_sensors.h"
#include "localization/vehicle_localizer.h"

namespace grid_path_planner::localization {

// What else there is beside IMU, DVL and depth.
enum class Suite {
  USBL,     // an acoustic fix each second
  MARKERS,  // and a marker pose each second
};

struct SystematicFault {
  const char* name;
  // Changes a measurement that was made at `t`, s; may move its stamp.
  std::function<void(Measurement& measurement, double t, SimulatedSensors& sensors)> spoil;
};

namespace faults {

constexpr double kBegins =
    20.0;  // s: faults of acoustic fixes; all others are there from the start

inline Eigen::Quaterniond about(const Eigen::Vector3d& axis, double degrees) {
  return Eigen::Quaterniond(Eigen::AngleAxisd(degrees * M_PI / 180.0, axis));
}

inline auto ofImu(const std::function<void(ImuMeasurement&)>& change) {
  return [change](Measurement& measurement, double, SimulatedSensors&) {
    if (auto* imu = std::get_if<ImuMeasurement>(&measurement.data)) change(*imu);
  };
}

inline auto ofDvl(const Eigen::Matrix3d& turn) {
  return [turn](Measurement& measurement, double, SimulatedSensors&) {
    if (auto* dvl = std::get_if<DvlVelocity>(&measurement.data))
      dvl->velocity = turn * dvl->velocity;
  };
}

inline auto ofUsbl(const std::function<void(PositionFix&, double, SimulatedSensors&)>& change) {
  return [change](Measurement& measurement, double t, SimulatedSensors& sensors) {
    auto* fix = std::get_if<PositionFix>(&measurement.data);
    if (fix && t >= kBegins) change(*fix, t, sensors);
  };
}

// The whole unit is turned, and tf does not say so.
inline auto turnedImu(const Eigen::Quaterniond& turn) {
  return ofImu([turn](ImuMeasurement& imu) {
    imu.inertial.rate = turn.conjugate() * imu.inertial.rate;
    imu.inertial.acceleration = turn.conjugate() * imu.inertial.acceleration;
    imu.attitude = *imu.attitude * turn;
  });
}

inline auto turnedCompass(double degrees) {
  return ofImu([degrees](ImuMeasurement& imu) {
    imu.attitude = about(Eigen::Vector3d::UnitZ(), degrees) * *imu.attitude;
  });
}

// Where the sensor was at `t`.
inline Eigen::Vector3d placeAt(double t, const PositionFix& fix, const SimulatedSensors& sensors) {
  const State state = sensors.trajectory.stateAt(t);
  return state.position + state.attitude * fix.sensor;
}

inline std::vector<SystematicFault> ofVelocities() {
  const Eigen::Vector3d z = Eigen::Vector3d::UnitZ();
  return {
      {"DVL in NED axes", ofDvl(Eigen::Vector3d(1.0, -1.0, -1.0).asDiagonal())},
      {"DVL turned by 90 deg", ofDvl(about(z, 90.0).toRotationMatrix())},
      {"DVL turned by 180 deg", ofDvl(about(z, 180.0).toRotationMatrix())},
  };
}

inline std::vector<SystematicFault> ofImus() {
  const Eigen::Vector3d x = Eigen::Vector3d::UnitX(), z = Eigen::Vector3d::UnitZ();
  return {
      {"IMU turned by 90 deg", turnedImu(about(z, 90.0))},
      {"IMU upside down", turnedImu(about(x, 180.0))},
      {"gyro z of the wrong sign",
       ofImu([](ImuMeasurement& imu) { imu.inertial.rate.z() *= -1.0; })},
      {"gyro 0", ofImu([](ImuMeasurement& imu) { imu.inertial.rate.setZero(); })},
      {"compass off by 90 deg", turnedCompass(90.0)},
      {"compass off by 20 deg", turnedCompass(20.0)},
      {"accelerometer in g",
       ofImu([](ImuMeasurement& imu) { imu.inertial.acceleration /= 9.80665; })},
      {"accelerometer of the wrong sign",
       ofImu([](ImuMeasurement& imu) { imu.inertial.acceleration *= -1.0; })},
      {"accelerometer without gravity", ofImu([](ImuMeasurement& imu) {
         imu.inertial.acceleration -=
             imu.attitude->conjugate() * Eigen::Vector3d(0.0, 0.0, 9.80665);
       })},
  };
}

inline std::vector<SystematicFault> ofFixes() {
  const auto errorOf = [](const PositionFix& fix, double t, const SimulatedSensors& sensors) {
    return Eigen::Vector3d(fix.position - placeAt(t, fix, sensors));
  };
  return {
      {"USBL, x and y swapped",
       [](Measurement& measurement, double, SimulatedSensors&) {
         if (auto* fix = std::get_if<PositionFix>(&measurement.data))
           std::swap(fix->position.x(), fix->position.y());
       }},
      {"USBL frozen, with new stamps",
       ofUsbl([=](PositionFix& fix, double t, SimulatedSensors& sensors) {
         fix.position +=
             placeAt(kBegins, fix, sensors) - placeAt(t, fix, sensors) - errorOf(fix, t, sensors);
       })},
      {"USBL drifting by 2 cm/s", ofUsbl([](PositionFix& fix, double t, SimulatedSensors&) {
         fix.position.x() += 0.02 * (t - kBegins);
       })},
      {"USBL late by 1 s", ofUsbl([](PositionFix& fix, double t, SimulatedSensors& sensors) {
         fix.position += placeAt(t - 1.0, fix, sensors) - placeAt(t, fix, sensors);
       })},
      {"USBL, half of the fixes 5 m off", ofUsbl([](PositionFix& fix, double t, SimulatedSensors&) {
         // Of one reflection, by the fourth bit of a number that looks random.
         if ((static_cast<unsigned>(std::lround(t)) * 2654435761u >> 28) & 1u)
           fix.position += Eigen::Vector3d(3.0, -4.0, 0.0);
       })},
  };
}

}  // namespace faults

inline std::vector<SystematicFault> systematicFaults() {
  std::vector<SystematicFault> all;
  for (const auto& some : {faults::ofVelocities(), faults::ofImus(), faults::ofFixes()})
    all.insert(all.end(), some.begin(), some.end());
  return all;
}

struct VerdictSecond {
  double t, metres, degrees;  // by how far the pose is off
  LocalizationReport report;
};

struct VerdictRun {
  std::vector<VerdictSecond> seconds = {};
  double off = 0.0;      // s, in which the pose is off by more than 1 m or 12 degrees
  double second = NAN;   // s, when it was contradicted for the second time while it was off
  double longest = 0.0;  // s, in which OK or DEGRADED was said while it was off, since then
  double lost = NAN;     // s, when LOST was said first
  int contradictions = 0;
};

// Follows what a localizer says of one run.
class VerdictJudge {
 public:
  // Before the localizer has the measurement.
  void contradict(const Measurement& measurement, const State& said) {
    const bool contradicts = contradictsPose(measurement, said);
    run_.contradictions += contradicts;
    if (contradicts && is_off_) ++while_off_;
  }

  // After it. `metres`, `degrees`: of the pose; 0 where there is none.
  void judge(double t, double metres, double degrees, const LocalizationReport& report) {
    run_.off += is_off_ ? t - last_ : 0.0;
    last_ = t;
    is_off_ = metres > 1.0 || degrees > 12.0;
    if (is_off_) off_last_ = t;
    if (t - off_last_ > 3.0)
      while_off_ = 0;  // it was right for a while: the next time is another one
    const bool drives =
        report.status == LocalizationStatus::OK || report.status == LocalizationStatus::DEGRADED;
    if (report.status == LocalizationStatus::LOST && std::isnan(run_.lost)) run_.lost = t;
    if (while_off_ >= 2 && std::isnan(run_.second)) run_.second = t;
    const bool is_wrong = is_off_ && while_off_ >= 2 && drives;
    if (!is_wrong) wrong_since_ = NAN;
    if (is_wrong && std::isnan(wrong_since_)) wrong_since_ = t;
    if (is_wrong) run_.longest = std::max(run_.longest, t - wrong_since_);
    if (run_.seconds.empty() || t - run_.seconds.back().t > 0.999)
      run_.seconds.push_back({t, metres, degrees, report});
  }

  const VerdictRun& run() const { return run_; }

 private:
  static bool contradictsPose(const Measurement& measurement, const State& said) {
    const auto off = [&](const Eigen::Vector3d& measured, const Eigen::Vector3d& sensor) {
      return Eigen::Vector3d(measured - said.position - said.attitude * sensor);
    };
    if (const auto* fix = std::get_if<PositionFix>(&measurement.data))
      return off(fix->position, fix->sensor).norm() > 0.5;
    if (const auto* depth = std::get_if<DepthFix>(&measurement.data))
      return std::abs(off({0.0, 0.0, depth->z}, depth->sensor).z()) > 0.2;
    if (const auto* view = std::get_if<PoseFix>(&measurement.data))
      return off(view->position, view->mounting.position).norm() > 0.2 ||
             view->attitude.angularDistance(said.attitude * view->mounting.rotation) > 0.1;
    return false;
  }

  VerdictRun run_;
  bool is_off_ = false;
  int while_off_ = 0;  // contradictions since the pose is off
  double last_ = 0.0, off_last_ = -1e9, wrong_since_ = NAN;
};

inline SimulatedSensors sensorsOf(Suite suite, unsigned seed) {
  SimulatedSensors sensors(seed);
  if (suite == Suite::MARKERS) sensors.rates.marker = 1.0;
  return sensors;
}

inline VerdictRun runWithFault(const SystematicFault& fault, SimulatedSensors sensors,
                               double seconds) {
  std::vector<Measurement> all = sensors.run(seconds);
  for (Measurement& measurement : all)
    fault.spoil(measurement, secondsBetween(kStart, measurement.stamp), sensors);
  VehicleLocalizer localizer{LocalizerOptions{}};
  localizer.setBase(sensors.base.rotation);
  VerdictJudge judge;
  for (const Measurement& measurement : all) {
    const bool is_judge = measurement.source >= Source::DEPTH;
    const auto before = is_judge ? localizer.mapAt(measurement.stamp) : std::nullopt;
    if (before) judge.contradict(measurement, before->estimate.state);
    try {
      localizer.add(measurement);
    } catch (const base::InputError&) {  // of a sensor farther off than one can be
    }
    if (!is_judge) continue;
    const double t = secondsBetween(kStart, measurement.stamp);
    const State truth = sensors.trajectory.stateAt(t);
    const auto after = localizer.mapAt(measurement.stamp);
    const State said = after ? after->estimate.state : truth;
    judge.judge(t, (said.position - truth.position).norm(),
                said.attitude.angularDistance(truth.attitude) * 180.0 / M_PI,
                localizer.report(measurement.stamp));
  }
  return judge.run();
}

}  // namespace grid_path_planner::localization
