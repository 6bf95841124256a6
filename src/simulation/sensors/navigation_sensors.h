// The navigation sensors of a simulated vehicle: inertial unit, Doppler velocity log, pressure sensor,
// acoustic positioning and laser scanner, with the faults that a test does to them.
//
//   NavigationSensors sensors(options, world, readSensorFaults("faults.yaml"));
//   vehicle.step();
//   const SensorReadings readings = sensors.advance(vehicle.state(), vehicle.timeNs());
//   if (readings.dvl) std::cout << readings.dvl->altitude << " m above the bottom\n";
//
// Guaranteed: the same options, world, faults and states give the same readings, bit for bit; a sensor
// that is switched off, cut or changed changes none of another's. Frames are those of REP 103, units SI.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "grid_path_planner/simulation/vehicle.h"
#include "grid_path_planner/simulation/world.h"
#include "simulation/sensors/dvl.h"
#include "simulation/sensors/imu.h"
#include "simulation/sensors/laser_scanner.h"
#include "simulation/sensors/navigation_sensor_options.h"
#include "simulation/sensors/pressure_sensor.h"
#include "simulation/sensors/sensor_faults.h"
#include "simulation/sensors/usbl.h"

namespace grid_path_planner::simulation {

// What a step of the simulation brought.
struct SensorReadings {
  std::optional<ImuReading> imu;
  std::optional<DvlReading> dvl;
  std::optional<PressureReading> pressure;
  std::vector<UsblFix> usbl;
  std::optional<LaserReading> laser;

  bool empty() const { return !imu && !dvl && !pressure && usbl.empty() && !laser; }
};

class NavigationSensors {
 public:
  // `world` may be null. Throws InputError for a DVL or a laser that is enabled without one.
  NavigationSensors(const NavigationSensorOptions& options, std::shared_ptr<const World> world,
                    const std::vector<SensorFault>& faults = {});

  // A sensor of which an option changes begins anew, with its seed; the others go on. Throws InputError
  // as the constructor does, then nothing has changed.
  void setOptions(const NavigationSensorOptions& options);
  const NavigationSensorOptions& options() const { return options_; }

  // The vehicle is at `state` after a step, at a time that never decreases.
  SensorReadings advance(const VehicleState& state, std::int64_t time_ns);

  // The vehicle was put elsewhere, which is no motion.
  void jump();

 private:
  NavigationSensorOptions options_;
  std::shared_ptr<const World> world_;
  std::optional<Imu> imu_;
  std::optional<Dvl> dvl_;
  std::optional<PressureSensor> pressure_;
  std::optional<Usbl> usbl_;
  std::optional<LaserScanner> laser_;  // without faults
  FaultySensor<ImuReading> imu_faults_;
  FaultySensor<DvlReading> dvl_faults_;
  FaultySensor<PressureReading> pressure_faults_;
  FaultySensor<UsblFix> usbl_faults_;
};

}  // namespace grid_path_planner::simulation
