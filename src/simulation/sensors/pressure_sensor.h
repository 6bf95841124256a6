// A pressure sensor, and the height that its pressure says.
//
//   PressureSensor sensor(options);
//   if (const auto reading = sensor.measure(vehicle.state(), vehicle.timeNs()))  // after every step
//     std::cout << heightFromPressure(options, reading->pressure) << " m in the map\n";
//
// The pressure of standing water: 101325 Pa + density * 9.80665 m/s^2 * depth; above the surface that
// of the air. Guaranteed: the same calls give the same measurements, bit for bit. Not modelled: waves,
// tides, the sensor's own drift, the flow around it.
#pragma once

#include <cstdint>
#include <optional>

#include "grid_path_planner/simulation/vehicle.h"
#include "simulation/sensors/noise_stream.h"
#include "simulation/sensors/pressure_options.h"
#include "simulation/sensors/sample_clock.h"

namespace grid_path_planner::simulation {

struct PressureReading {
  std::int64_t time_ns = 0;
  double pressure = 0.0;  // Pa, absolute
  double variance = 0.0;  // Pa^2
};

// The height in the map (m) of a sensor with this pressure (Pa), and its variance (m^2).
double heightFromPressure(const PressureOptions& options, double pressure);
double heightVariance(const PressureOptions& options, double pressure_variance);

class PressureSensor {
 public:
  explicit PressureSensor(const PressureOptions& options);

  const PressureOptions& options() const { return options_; }

  // The vehicle is at `state` after a step. None unless a measurement is due.
  std::optional<PressureReading> measure(const VehicleState& state, std::int64_t time_ns);

 private:
  PressureOptions options_;
  SampleClock clock_;
  NoiseStream noise_;
};

}  // namespace grid_path_planner::simulation
