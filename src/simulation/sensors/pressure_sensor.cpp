#include "simulation/sensors/pressure_sensor.h"

#include <algorithm>

#include "simulation/sensors/imu.h"

namespace grid_path_planner::simulation {
namespace {

constexpr double kAirPressure = 101325.0;  // Pa

double pascalsPerMetre(const PressureOptions& options) {
  return options.water_density * kStandardGravity;
}

}  // namespace

double heightFromPressure(const PressureOptions& options, double pressure) {
  return options.surface_z - (pressure - kAirPressure) / pascalsPerMetre(options);
}

double heightVariance(const PressureOptions& options, double pressure_variance) {
  return pressure_variance / (pascalsPerMetre(options) * pascalsPerMetre(options));
}

PressureSensor::PressureSensor(const PressureOptions& options)
    : options_(options), clock_(options.rate), noise_(options.seed, SensorName::PRESSURE) {}

std::optional<PressureReading> PressureSensor::measure(const VehicleState& state,
                                                       std::int64_t time_ns) {
  if (!clock_.take(time_ns)) return std::nullopt;
  const double z = (mapFromBase(state) * options_.mounting.pose()).translation().z();
  const double depth = std::max(0.0, options_.surface_z - z);
  return PressureReading{
      time_ns, kAirPressure + pascalsPerMetre(options_) * depth + options_.noise * noise_.normal(),
      options_.noise * options_.noise};
}

}  // namespace grid_path_planner::simulation
