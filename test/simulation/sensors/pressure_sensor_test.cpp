#include "simulation/sensors/pressure_sensor.h"

#include <gtest/gtest.h>

#include <vector>

#include "support/option_laws.h"
#include "support/rocking_drive.h"

namespace grid_path_planner::simulation {
namespace {

VehicleState atHeight(double z) {
  VehicleState state;
  state.position.z() = z;
  return state;
}

PressureReading pressureAt(const PressureOptions& options, const VehicleState& state) {
  return PressureSensor(options).measure(state, 0).value();
}

TEST(PressureOptions, AllHoldToTheLaws) {
  test::expectOptionLaws<PressureOptions>();
}

// In Pa, where uuv_simulator's is in kPa: 4.5 m below the surface at z = 7.
TEST(PressureSensor, IsThatOfTheAirAndOfTheWaterAbove) {
  PressureOptions options;
  options.noise = 0.0;
  const double pressure = pressureAt(options, atHeight(2.5)).pressure;
  EXPECT_DOUBLE_EQ(pressure, 101325.0 + 1025.0 * 9.80665 * 4.5);
  EXPECT_NEAR(heightFromPressure(options, pressure), 2.5, 1e-12);
  EXPECT_EQ(pressureAt(options, atHeight(8.0)).pressure, 101325.0) << "in the air";
}

TEST(PressureSensor, ItsLeverArmIsTurnedWithTheVehicle) {
  PressureOptions options;
  options.noise = 0.0;
  options.mounting.x = 1.0;
  VehicleState state = atHeight(0.0);
  state.pitch = 0.1;  // bow down
  const double height = heightFromPressure(options, pressureAt(options, state).pressure);
  EXPECT_NEAR(height, -std::sin(0.1), 1e-12);
}

TEST(PressureSensor, ErrsByTheVarianceThatItTells) {
  const PressureOptions options;
  PressureSensor sensor(options);
  std::vector<double> pressures, heights;
  for (std::int64_t i = 0; i < 10000; ++i) {
    const auto reading = sensor.measure(atHeight(0.0), i * 100000000).value();
    EXPECT_EQ(reading.variance, 40000.0);
    pressures.push_back(reading.pressure);
    heights.push_back(heightFromPressure(options, reading.pressure));
  }
  EXPECT_NEAR(test::varianceOf(pressures) / 40000.0, 1.0, 0.06);
  EXPECT_NEAR(test::varianceOf(heights) / heightVariance(options, 40000.0), 1.0, 0.06);
  EXPECT_NEAR(test::meanOf(heights), 0.0, 1e-3);
}

}  // namespace
}  // namespace grid_path_planner::simulation
