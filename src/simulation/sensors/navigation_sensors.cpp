#include "simulation/sensors/navigation_sensors.h"

#include <utility>

#include "grid_path_planner/base/options.h"

namespace grid_path_planner::simulation {

using base::InputError, base::sameOptions;

namespace {

void append(std::vector<double*>& numbers, Eigen::Vector3d& vector) {
  for (int i = 0; i < 3; ++i) numbers.push_back(&vector[i]);  // Eigen 3.3 has no begin()
}

// What has changed, made anew.
template <class Sensor, class Options, class... Arguments>
void renew(std::optional<Sensor>& sensor, const Options& options, const Arguments&... arguments) {
  if (!options.enabled)
    sensor.reset();
  else if (!sensor || !sameOptions(sensor->options(), options))
    sensor.emplace(arguments..., options);
}

template <class Sensor, class Reading>
std::optional<Reading> measured(std::optional<Sensor>& sensor, FaultySensor<Reading>& faults,
                                const VehicleState& state, std::int64_t time_ns) {
  if (!sensor) return std::nullopt;
  auto reading = sensor->measure(state, time_ns);
  return reading ? faults.spoiled(*std::move(reading)) : std::nullopt;
}

}  // namespace

// What faults change of readings: found by ADL.
std::vector<double*> numbersOf(ImuReading& reading) {
  std::vector<double*> numbers;
  append(numbers, reading.angular_velocity);
  append(numbers, reading.specific_force);
  return numbers;
}

std::vector<double*> numbersOf(DvlReading& reading) {
  std::vector<double*> numbers;
  if (reading.velocity) append(numbers, reading.velocity->velocity);
  return numbers;
}

std::vector<double*> numbersOf(PressureReading& reading) {
  return {&reading.pressure};
}

std::vector<double*> numbersOf(UsblFix& fix) {
  std::vector<double*> numbers;
  append(numbers, fix.position);
  return numbers;
}

NavigationSensors::NavigationSensors(const NavigationSensorOptions& options,
                                     std::shared_ptr<const World> world,
                                     const std::vector<SensorFault>& faults)
    : world_(std::move(world)),
      imu_faults_(faults, SensorName::IMU),
      dvl_faults_(faults, SensorName::DVL),
      pressure_faults_(faults, SensorName::PRESSURE),
      usbl_faults_(faults, SensorName::USBL) {
  setOptions(options);
}

void NavigationSensors::setOptions(const NavigationSensorOptions& options) {
  if (options.dvl.enabled && !world_)
    throw InputError("dvl_enabled needs a world: without one there is no bottom");
  if (options.laser.enabled && !world_)
    throw InputError("laser_enabled needs a world: without one there is nothing to see");
  options_ = options;
  renew(imu_, options.imu);
  if (world_) renew(dvl_, options.dvl, *world_);
  renew(pressure_, options.pressure);
  renew(usbl_, options.usbl);
  if (world_) renew(laser_, options.laser, *world_);
}

SensorReadings NavigationSensors::advance(const VehicleState& state, std::int64_t time_ns) {
  SensorReadings readings;
  readings.imu = measured(imu_, imu_faults_, state, time_ns);
  readings.dvl = measured(dvl_, dvl_faults_, state, time_ns);
  readings.pressure = measured(pressure_, pressure_faults_, state, time_ns);
  if (usbl_)
    for (const UsblFix& fix : usbl_->measure(state, time_ns))
      if (const auto left = usbl_faults_.spoiled(fix)) {
        readings.usbl.push_back(*left);
        readings.usbl.back().arrives_ns = fix.arrives_ns;
      }
  if (laser_) readings.laser = laser_->measure(state, time_ns);
  return readings;
}

void NavigationSensors::jump() {
  if (imu_) imu_->jump();
}

}  // namespace grid_path_planner::simulation
