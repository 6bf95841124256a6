// Faults of navigation sensors and of the image camera: what is cut or spoiled, and when.
//
//   faults:
//     - {sensor: dvl, from: 60, to: 90, kind: cut}
//     - {sensor: usbl, from: 100, to: 130, kind: offset, by: [5, 0, 0]}
//
// Times are simulated seconds since the simulation began; from <= time < to. Of two faults at one time
// both happen, in the order of the file.
//
//   cut      nothing is measured
//   frozen   the last measurement before is repeated, with new stamps
//   offset   `by` is added to the numbers of the measurement
//   outlier  normal errors with the standard deviations `by` are added
//   nan      the numbers are none
//
// `by` has the sensor's numbers: imu 6 (angular velocity x, y, z in rad/s, specific force x, y, z in
// m/s^2), dvl 3 (m/s), pressure 1 (Pa), usbl 3 (m). Covariances stay as they were. An image has no such
// numbers: of the camera there are cut, frozen and nan, which is a black image.
#pragma once

#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "grid_path_planner/base/read_limits.h"
#include "simulation/sensors/noise_stream.h"
#include "simulation/sensors/sensor_name.h"

namespace grid_path_planner::simulation {

enum class FaultKind { CUT, FROZEN, OFFSET, OUTLIER, NOT_A_NUMBER };
const std::vector<std::pair<const char*, FaultKind>>& choicesOf(FaultKind);

struct SensorFault {
  SensorName sensor = SensorName::IMU;
  std::int64_t from_ns = 0;
  std::int64_t to_ns = 0;
  FaultKind kind = FaultKind::CUT;
  std::vector<double> by;  // only of offset and outlier

  bool holdsAt(std::int64_t time_ns) const { return from_ns <= time_ns && time_ns < to_ns; }
};

// Throws InputError naming file and line for what is no such file.
std::vector<SensorFault> readSensorFaults(const std::string& file,
                                          const base::ReadLimits& limits = {});

// What befalls an image of this time: cut rather than frozen, frozen rather than black (NOT_A_NUMBER).
std::optional<FaultKind> cameraFaultAt(const std::vector<SensorFault>& faults,
                                       std::int64_t time_ns);

// How many numbers a measurement of the sensor has.
std::size_t countOfNumbers(SensorName sensor);

// The faults of one sensor, done to its measurements. A Reading has a `time_ns`, and a function found by
// ADL says which of its numbers faults change:
//
//   std::vector<double*> numbersOf(Reading& reading);
template <class Reading>
class FaultySensor {
  static constexpr int kFaultSeed = -1;  // no sensor's own

 public:
  FaultySensor(const std::vector<SensorFault>& faults, SensorName sensor)
      : noise_(kFaultSeed, sensor) {
    for (const SensorFault& fault : faults)
      if (fault.sensor == sensor) faults_.push_back(fault);
  }

  // What is left of the measurement.
  std::optional<Reading> spoiled(Reading reading) {
    bool frozen = false;
    for (const SensorFault& fault : faults_) {
      if (!fault.holdsAt(reading.time_ns)) continue;
      if (fault.kind == FaultKind::CUT) return std::nullopt;
      if (fault.kind == FaultKind::FROZEN)
        frozen = true;
      else
        change(reading, fault);
    }
    if (frozen && before_) {
      before_->time_ns = reading.time_ns;
      return before_;
    }
    before_ = reading;
    return reading;
  }

 private:
  void change(Reading& reading, const SensorFault& fault) {
    const std::vector<double*> numbers = numbersOf(reading);
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      if (fault.kind == FaultKind::NOT_A_NUMBER) *numbers[i] = NAN;
      if (fault.kind == FaultKind::OFFSET) *numbers[i] += fault.by[i];
      if (fault.kind == FaultKind::OUTLIER) *numbers[i] += fault.by[i] * noise_.normal();
    }
  }

  std::vector<SensorFault> faults_;
  NoiseStream noise_;
  std::optional<Reading> before_;
};

}  // namespace grid_path_planner::simulation
