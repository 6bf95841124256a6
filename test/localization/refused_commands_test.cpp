// Commands that the vehicle does not obey, while there is no DVL, and what contradicted and is there no longer.
#include <gtest/gtest.h>

#include <cmath>
#include <optional>

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

// At 24 s, without a DVL until then.
LaggedFilter filterOfDisobeyed(unsigned seed, double to, std::optional<double> command_period) {
  SimulatedSensors sensors(seed);
  FilterOptions options = sensors.options;
  options.command_period = command_period.value_or(options.command_period);
  LaggedFilter filter(options, Start::AT_FIX);
  for (const Measurement& measurement : disobeyed(sensors, to, 30.0, 24.0)) filter.add(measurement);
  return filter;
}

// One that was gated did not count as tried: five in a tenth of a second "agreed", and the velocity began anew by them.
TEST(Commands, ThatAreGatedAreTriedOnceInAPeriodAndBeginNothingAnew) {
  const LaggedFilter filter = filterOfDisobeyed(24, 21.5, {});
  EXPECT_EQ(filter.counts(Source::COMMAND).gated, 1u);
  EXPECT_EQ(filter.counts(Source::COMMAND).resets, 0u);
}

TEST(Commands, BeginNothingAnewHoweverManyAgree) {
  const LaggedFilter filter = filterOfDisobeyed(25, 23.0, 0.1);
  EXPECT_GE(filter.counts(Source::COMMAND).gated, 6u);
  EXPECT_EQ(filter.counts(Source::COMMAND).resets, 0u);
}

// "Fixes that agree contradict the pose" was said for ever of commands that nobody used any more.
TEST(Commands, ThatWereGatedAreForgottenWhenTheDvlIsBack) {
  SimulatedSensors sensors(26);
  VehicleLocalizer localizer{LocalizerOptions{}};
  bool contradicted = false;
  for (const Measurement& measurement : disobeyed(sensors, 24.0, 27.0, 40.0)) {
    localizer.add(measurement);
    if (measurement.stamp > stampAt(23.0) && measurement.stamp < stampAt(26.0))
      contradicted =
          contradicted ||
          localizer.map().snapshot().rejections[static_cast<int>(Source::COMMAND)].count() >= 2;
  }
  EXPECT_TRUE(contradicted);
  const LocalizationReport report = localizer.report(stampAt(40.0));
  EXPECT_EQ(report.status, LocalizationStatus::OK) << report.sentence;
}

// As when use_heading is switched off.
TEST(Heading, ThatContradictedAndCeasedContradictsNoLonger) {
  SimulatedSensors sensors(27);
  VehicleLocalizer localizer{LocalizerOptions{}};
  for (const Measurement& measurement : sensors.run(30.0)) localizer.add(measurement);
  const double yaw = yawOf(sensors.truthAt(30.0).attitude) + 0.7;
  for (int i = 0; i < 3; ++i)
    EXPECT_EQ(localizer.add({stampAt(30.0) + i * 1'000'000, Source::HEADING,
                             HeadingFix{std::remainder(yaw, 2.0 * M_PI), 1e-4}}),
              Verdict::GATED);
  EXPECT_TRUE(test::contains(localizer.report(stampAt(30.0) + 2'000'000).sentence, "contradict"));
  for (const Measurement& measurement : sensors.run(10.0)) localizer.add(measurement);
  const LocalizationReport report = localizer.report(stampAt(40.0));
  EXPECT_EQ(report.status, LocalizationStatus::OK) << report.sentence;
}

}  // namespace
}  // namespace grid_path_planner::localization
