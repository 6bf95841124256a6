// Seeded faults of sensors, and whether a localizer says OK while it is off.
#pragma once

#include <limits>
#include <optional>
#include <random>
#include <variant>
#include <vector>

#include "grid_path_planner/base/errors.h"
#include "localization/support/simulated_sensors.h"
#include "localization/vehicle_localizer.h"

namespace grid_path_planner::localization {

// As the simulator's fault file has them (doc/sensors.md).
enum class FaultKind { CUT, FROZEN, OFFSET, OUTLIER, NOT_A_NUMBER };

struct SensorFault {
  Source source;
  FaultKind kind;
  double from, to;                       // s
  Eigen::Vector3d by;                    // rad/s, m/s or m
  Eigen::Vector3d by_force;              // m/s^2, of an IMU
  std::optional<Measurement> last = {};  // before it
};

class FaultySensors {
 public:
  explicit FaultySensors(unsigned seed) : sensors(seed), random_(1000 + seed) {
    sensors.rates.marker = uniform(0.0, 1.0) < 0.4 ? 5.0 : 0.0;
    sensors.rates.command = 1.0;
    sensors.usbl_outliers = 0.05;
    const int count = 1 + static_cast<int>(uniform(0.0, 2.999));
    for (int i = 0; i < count; ++i) faults_.push_back(drawFault());
  }

  SimulatedSensors sensors;

  // None where it is cut.
  std::optional<Measurement> spoilt(Measurement measurement) {
    const double t = secondsBetween(kStart, measurement.stamp);
    for (SensorFault& fault : faults_) {
      if (fault.source != measurement.source) continue;
      if (t < fault.from || t >= fault.to)
        fault.last = measurement;
      else if (fault.kind == FaultKind::CUT)
        return {};
      else
        spoil(measurement, fault);
    }
    return measurement;
  }

 private:
  double uniform(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }
  Eigen::Vector3d direction() {
    const double x = uniform(-1.0, 1.0), y = uniform(-1.0, 1.0), z = uniform(-1.0, 1.0);
    return Eigen::Vector3d(x, y, z).normalized();
  }

  SensorFault drawFault() {
    static constexpr std::array<Source, 5> kSpoilt = {Source::IMU, Source::DVL, Source::DEPTH,
                                                      Source::USBL, Source::MARKER};
    SensorFault fault;
    fault.source = kSpoilt[static_cast<std::size_t>(uniform(0.0, 4.999))];
    fault.kind = static_cast<FaultKind>(static_cast<int>(uniform(0.0, 4.999)));
    fault.from = uniform(10.0, 70.0);
    fault.to = fault.from + uniform(1.0, 40.0);
    const double size = fault.source == Source::IMU   ? uniform(0.01, 0.3)
                        : fault.source == Source::DVL ? uniform(0.05, 1.0)
                                                      : uniform(1.0, 10.0);
    fault.by = size * direction();
    fault.by_force = uniform(0.1, 3.0) * direction();
    return fault;
  }

  void spoil(Measurement& measurement, const SensorFault& fault) {
    if (fault.kind == FaultKind::FROZEN) {
      if (!fault.last) return;
      measurement.data = fault.last->data;
    } else if (auto* imu = std::get_if<ImuMeasurement>(&measurement.data)) {
      imu->inertial.rate += error(fault, fault.by);
      imu->inertial.acceleration += error(fault, fault.by_force);
    } else if (auto* dvl = std::get_if<DvlVelocity>(&measurement.data)) {
      dvl->velocity += error(fault, fault.by);
    } else if (auto* depth = std::get_if<DepthFix>(&measurement.data)) {
      depth->z += error(fault, fault.by).z();
    } else if (auto* fix = std::get_if<PositionFix>(&measurement.data)) {
      fix->position += error(fault, fault.by);
    } else if (auto* pose = std::get_if<PoseFix>(&measurement.data)) {
      pose->position += error(fault, fault.by);
    }
  }
  Eigen::Vector3d error(const SensorFault& fault, const Eigen::Vector3d& by) {
    if (fault.kind == FaultKind::OFFSET) return by;
    if (fault.kind == FaultKind::NOT_A_NUMBER)
      return Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());
    const double x = normal_(random_), y = normal_(random_), z = normal_(random_);
    return by.cwiseProduct(Eigen::Vector3d(x, y, z));
  }

  std::mt19937_64 random_;
  std::normal_distribution<double> normal_;
  std::vector<SensorFault> faults_;
};

struct FaultRun {
  double longest = 0.0;  // s, in which OK was said while off by 1 m or 12 degrees
  double ok = 0.0;       // share of the time
};

inline FaultRun runWithFaults(unsigned seed, double seconds, const LocalizerOptions& options = {}) {
  FaultySensors faulty(seed);
  VehicleLocalizer localizer(options);
  FaultRun run;
  double wrong_since = -1.0;  // s; negative: it is not
  int reports = 0, ok = 0;
  for (const Measurement& measurement : faulty.sensors.run(seconds)) {
    const std::optional<Measurement> spoilt = faulty.spoilt(measurement);
    try {
      if (spoilt) localizer.add(*spoilt);
    } catch (const base::InputError&) {  // as it should of what is no number
    }
    if (measurement.source != Source::DEPTH) continue;
    const double t = secondsBetween(kStart, measurement.stamp);
    ++reports;
    const bool says_ok = localizer.report(measurement.stamp).status == LocalizationStatus::OK;
    ok += says_ok;
    const auto snapshot = localizer.mapAt(measurement.stamp);
    const ErrorVector error =
        snapshot ? errorBetween<double>(snapshot->estimate.state, faulty.sensors.truthAt(t))
                 : ErrorVector(ErrorVector::Zero());
    const bool wrong = error.segment<3>(kPosition).norm() > 1.0 ||
                       error.segment<3>(kAttitude).norm() > 12.0 * M_PI / 180.0;
    if (!says_ok || !wrong)
      wrong_since = -1.0;
    else if (wrong_since < 0.0)
      wrong_since = t;
    if (wrong_since >= 0.0) run.longest = std::max(run.longest, t - wrong_since);
  }
  run.ok = static_cast<double>(ok) / std::max(reports, 1);
  return run;
}

}  // namespace grid_path_planner::localization
