// Commands that the vehicle does not obey, while there is no DVL.
#include <gtest/gtest.h>

#include "localization/support/simulated_sensors.h"
#include "localization/vehicle_localizer.h"
#include "support/error_text.h"

namespace grid_path_planner::localization {
namespace {

// Without a DVL from 20 s to `dvl_back`, with commands that are 1.5 m/s off from 21 s to `to`.
std::vector<Measurement> disobeyed(SimulatedSensors& sensors, double to, double dvl_back,
                                   double seconds) {
  sensors.rates.command = 50.0;
  sensors.cut = [=](Source source, double t) {
    return (source == Source::DVL && t > 20.0 && t < dvl_back) ||
           (source == Source::COMMAND && (t < 21.0 || t > to));
  };
  std::vector<Measurement> all = sensors.run(seconds);
  for (Measurement& measurement : all)
    if (auto* command = std::get_if<CommandedVelocity>(&measurement.data))
      command->velocity.x() += 1.5;
  return all;
}

// One that was gated did not count as tried: five in a tenth of a second "agreed", and the velocity began anew by them.
TEST(Commands, ThatAreGatedAreTriedOnceInAPeriodAndBeginNothingAnew) {
  SimulatedSensors sensors(24);
  LaggedFilter filter(sensors.options, Start::AT_FIX);
  for (const Measurement& measurement : disobeyed(sensors, 21.5, 30.0, 24.0))
    filter.add(measurement);
  EXPECT_EQ(filter.counts(Source::COMMAND).gated, 1u);
  EXPECT_EQ(filter.counts(Source::COMMAND).resets, 0u);
}

TEST(Commands, BeginNothingAnewHoweverManyAgree) {
  SimulatedSensors sensors(25);
  FilterOptions options = sensors.options;
  options.command_period = 0.1;
  LaggedFilter filter(options, Start::AT_FIX);
  for (const Measurement& measurement : disobeyed(sensors, 23.0, 30.0, 24.0))
    filter.add(measurement);
  EXPECT_GE(filter.counts(Source::COMMAND).gated, 6u);
  EXPECT_EQ(filter.counts(Source::COMMAND).resets, 0u);
}

}  // namespace
}  // namespace grid_path_planner::localization
