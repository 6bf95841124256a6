#include "simulation/sensors/sensor_faults.h"

#include "fuzz/fuzz_target.h"

namespace grid_path_planner::fuzz {
namespace {

std::vector<std::string> seedsOfSensorFaults() {
  return {
      "faults:\n  - {sensor: dvl, from: 60, to: 90, kind: cut}\n"
      "  - {sensor: usbl, from: 0.5, to: 1e3, kind: offset, by: [5, 0, -0.5]}\n",
      "faults:\n- sensor: imu\n  from: 1\n  to: 2\n  kind: outlier\n  by: [1, 2, 3, 4, 5, 6]\n"
      "- {sensor: pressure, from: 3, to: 4, kind: nan}\n"
      "- {sensor: imu, from: 0, to: 9, kind: frozen}\n"};
}

// Whatever was read can be done to measurements.
FUZZ_TARGET(sensor_faults, seedsOfSensorFaults) {
  mayRefuse([&] {
    const std::string file = fileOf("fuzz.yaml", input);
    for (const simulation::SensorFault& fault : simulation::readSensorFaults(file)) {
      mustHold(fault.from_ns >= 0 && fault.from_ns < fault.to_ns, "a fault lasts");
      mustHold(fault.by.empty() || fault.by.size() == simulation::countOfNumbers(fault.sensor),
               "a fault has its sensor's numbers");
    }
  });
}

}  // namespace
}  // namespace grid_path_planner::fuzz
