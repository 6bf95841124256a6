#include "simulation/sensors/sensor_faults.h"

#include <algorithm>

#include "fuzz/fuzz_target.h"

namespace grid_path_planner::fuzz {
namespace {

using simulation::FaultKind, simulation::SensorFault, simulation::SensorName;

constexpr std::size_t kMostTimes = 64;
constexpr double kMeasured = 0.5;  // each number of each measurement

std::vector<std::string> seedsOfSensorFaults() {
  return {
      "faults:\n  - {sensor: dvl, from: 60, to: 90, kind: cut}\n"
      "  - {sensor: usbl, from: 0.5, to: 1e3, kind: offset, by: [5, 0, -0.5]}\n",
      "faults:\n- sensor: imu\n  from: 1\n  to: 2\n  kind: outlier\n  by: [1, 2, 3, 4, 5, 6]\n"
      "- {sensor: pressure, from: 3, to: 4, kind: nan}\n"
      "- {sensor: imu, from: 0, to: 9, kind: frozen}\n",
      "faults:\n- {sensor: imu, from: 1, to: 5, kind: nan}\n"
      "- {sensor: imu, from: 4, to: 6, kind: frozen}\n- {sensor: imu, from: 5, to: 7, kind: "
      "cut}\n"};
}

struct Measurement {
  std::int64_t time_ns = 0;
  std::vector<double> numbers;
};

std::vector<double*> numbersOf(Measurement& measurement) {
  std::vector<double*> numbers;
  for (double& number : measurement.numbers) numbers.push_back(&number);
  return numbers;
}

// Where faults begin and end, and the nanoseconds before.
std::vector<std::int64_t> timesAround(const std::vector<SensorFault>& faults) {
  std::vector<std::int64_t> times = {0};
  for (const SensorFault& fault : faults) {
    if (times.size() > kMostTimes) break;
    const std::int64_t before = std::max<std::int64_t>(0, fault.from_ns - 1);
    times.insert(times.end(), {before, fault.from_ns, fault.to_ns - 1, fault.to_ns});
  }
  std::sort(times.begin(), times.end());
  return times;
}

void doTo(SensorName sensor, const std::vector<SensorFault>& faults) {
  simulation::FaultySensor<Measurement> faulty(faults, sensor);
  const std::vector<double> measured(simulation::countOfNumbers(sensor), kMeasured);
  for (const std::int64_t time_ns : timesAround(faults)) {
    const auto holds = [&](const SensorFault& fault) {
      return fault.sensor == sensor && fault.holdsAt(time_ns);
    };
    const bool cut = std::any_of(faults.begin(), faults.end(), [&](const SensorFault& fault) {
      return holds(fault) && fault.kind == FaultKind::CUT;
    });
    const auto left = faulty.spoiled({time_ns, measured});
    mustHold(left.has_value() == !cut, "what is cut, and nothing else, is missing");
    if (!left) continue;
    mustHold(left->time_ns == time_ns, "a measurement keeps its time");
    mustHold(left->numbers.size() == measured.size(), "a measurement keeps its numbers' count");
    mustHold(left->numbers == measured || std::any_of(faults.begin(), faults.end(), holds),
             "a measurement that no fault holds for stays as it was");
  }
}

// Whatever was read can be done to measurements.
FUZZ_TARGET(sensor_faults, seedsOfSensorFaults) {
  mayRefuse([&] {
    const auto faults = simulation::readSensorFaults(fileOf("fuzz.yaml", input));
    for (const SensorFault& fault : faults) {
      mustHold(fault.from_ns >= 0 && fault.from_ns < fault.to_ns, "a fault lasts");
      mustHold(fault.by.empty() || fault.by.size() == simulation::countOfNumbers(fault.sensor),
               "a fault has its sensor's numbers");
    }
    for (const auto& [name, sensor] : choicesOf(SensorName{})) doTo(sensor, faults);
  });
}

}  // namespace
}  // namespace grid_path_planner::fuzz
