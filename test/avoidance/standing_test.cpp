// What happens while the vehicle must stand, or stands and looks.
//
// What was seen before: a pause counted as lack of progress, so that the vehicle looked around or was stuck
// when it went on; looking around had no end for one that does not turn, or ended by the noise of its pose;
// it turned while it braked, and its velocity with it; a radius of 0.1 m about a goal hung the control.
#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <random>
#include <string>
#include <type_traits>
#include <vector>

#include "avoidance/drawn_world.h"
#include "avoidance/recovery.h"
#include "avoidance/simulated_flight.h"
#include "support/error_text.h"

namespace grid_path_planner::avoidance {
namespace {

using Eigen::Vector3d;

FlightSetup fieldFlight() {
  FlightSetup setup;
  setup.world = worldOf(drawnMeshes({}, 1.0));
  setup.options = flyingOptions();
  setup.waypoints = {{12.0, 0.0, 1.5}};
  return setup;
}

TEST(Standing, AHoldIsNoLackOfProgress) {
  for (const bool recover : {true, false}) {
    FlightSetup setup = fieldFlight();
    setup.options.recover = recover;
    setup.alter = [](PilotInput& input) {
      if (input.time > 2.0 && input.time < 42.0) input.hold = "held by the test";
    };
    setup.each = [](const PilotInput& input, const PilotAnswer& answer, const auto&, const Pilot&) {
      if (input.hold.empty()) return;
      EXPECT_TRUE(answer.velocity.isZero());
      EXPECT_EQ(answer.status, PilotStatus::BLOCKED);
      EXPECT_EQ(answer.sentence, input.hold);
    };
    const FlightResult result = fly(setup);
    EXPECT_EQ(result.status, PilotStatus::ARRIVED) << result.sentence;
    EXPECT_LT(result.turned, 1.0) << "it did not look around";
  }
}

TEST(Standing, WithoutAPoseIsNoLackOfProgress) {
  FlightSetup setup = fieldFlight();
  setup.alter = [](PilotInput& input) {
    if (input.time > 2.0 && input.time < 42.0) input.pose.reset();
  };
  const FlightResult result = fly(setup);
  EXPECT_EQ(result.status, PilotStatus::ARRIVED) << result.sentence;
  EXPECT_LT(result.turned, 1.0) << "it did not look around";
}

// Seconds until a look ends, of a vehicle that turns so fast and whose yaw is noisy.
double secondsOfLooking(double yaw_rate, double noise, const PilotOptions& options) {
  std::mt19937 random(3);
  std::uniform_real_distribution<> off(-noise, noise);
  Recovery recovery;
  const Vector3d goal(10.0, 0.0, 0.0);
  recovery.restart(0.0, Vector3d::Zero(), goal);
  double began = -1.0, yaw = 0.0;
  for (double time = 0.0; time < 1000.0; time += 0.05) {
    const auto step =
        recovery.update({time, Vector3d::Zero(), yaw + off(random), goal, false}, options);
    if (step == RecoveryStep::LOOK && began < 0.0) began = time;
    if (step == RecoveryStep::LOOK) yaw += 0.05 * yaw_rate;
    if (step == RecoveryStep::FLY && began >= 0.0) return time - began;
  }
  return 1000.0;
}

TEST(Standing, ALookIsOneTurnWhateverTheNoise) {
  const PilotOptions options;
  const double turn = 2.0 * M_PI / options.max_yaw_rate;
  EXPECT_NEAR(secondsOfLooking(options.max_yaw_rate, 0.0, options), turn, 0.2);
  EXPECT_NEAR(secondsOfLooking(options.max_yaw_rate, 0.05, options), turn, 0.5);
}

TEST(Standing, ALookOfAVehicleThatDoesNotTurnEnds) {
  const PilotOptions options;
  EXPECT_NEAR(secondsOfLooking(0.0, 0.0, options), 4.0 * M_PI / options.max_yaw_rate, 0.2);
}

// In a closed box; told that it still moves, it does not begin to turn.
TEST(Standing, WhoStillBrakesDoesNotTurn) {
  FlightSetup setup;
  setup.world = worldOf(drawnMeshes({"#######", "#     #", "#     #", "#######"}, 2.0));
  setup.options = flyingOptions();
  setup.options.progress_timeout = 3.0;
  setup.start = {5.0, -4.0, 1.5};
  setup.waypoints = {{30.0, -4.0, 1.5}};
  setup.seconds = 60.0;
  setup.alter = [](PilotInput& input) { input.velocity.surge = 0.5; };
  int looks = 0;
  setup.each = [&](const PilotInput& input, const PilotAnswer& answer, const auto&, const Pilot&) {
    if (answer.sentence.find("looking around") == std::string::npos) return;
    ++looks;
    EXPECT_TRUE(answer.velocity.isZero()) << input.time;
  };
  fly(setup);
  EXPECT_GT(looks, 10);
}

TEST(Standing, TheSmallestRadiiOfGoalsAreJudged) {
  for (const double radius : {0.05, 0.08, 0.1, 0.1000001}) {
    FlightSetup setup = fieldFlight();
    setup.options.home_radius = setup.options.arrival_radius = radius;
    setup.waypoints = {{2.0, 0.0, 1.5}, {4.0, 0.0, 1.5}};
    setup.seconds = 4.0;
    setup.each = [](const PilotInput&, const PilotAnswer& answer, const auto&, const Pilot&) {
      EXPECT_NE(answer.status, PilotStatus::GOAL_OCCUPIED) << answer.sentence;
    };
    EXPECT_GT(fly(setup).metres, 1.0) << radius;
  }
}

// The options with one of them at a limit; none where that contradicts another one.
std::optional<PilotOptions> optionsWith(const std::string& changed, bool highest, Search search) {
  PilotOptions options = flyingOptions();
  options.search = search;
  visitOptions(options, [&](const char* name, auto& value, const base::OptionInfo& info) {
    using Value = std::decay_t<decltype(value)>;
    if (name != changed) return;
    if constexpr (std::is_same_v<Value, bool>)
      value = highest;
    else if constexpr (std::is_enum_v<Value>)
      value = highest ? choicesOf(Value{}).back().second : choicesOf(Value{}).front().second;
    else
      value = static_cast<Value>(highest ? info.maximum : info.minimum);
  });
  const bool refused = !test::errorText([&] { checkPilotOptions(options); }).empty();
  return refused ? std::nullopt : std::make_optional(options);
}

std::vector<std::string> namesOfOptions() {
  PilotOptions options;
  std::vector<std::string> names;
  visitOptions(options,
               [&](const char* name, auto&, const base::OptionInfo&) { names.emplace_back(name); });
  return names;
}

// Whatever one option is, the pilot answers, and not above its speed.
TEST(Standing, EveryOptionFliesAtItsLimits) {
  const auto world = worldOf(drawnMeshes({"   #", "    ", "   #"}, 2.0));
  for (const Search search : {Search::GRID, Search::TREE})
    for (const std::string& changed : namesOfOptions())
      for (const bool highest : {false, true}) {
        const auto options = optionsWith(changed, highest, search);
        if (!options) continue;
        FlightSetup setup;
        setup.world = world;
        setup.options = *options;
        setup.start = {1.0, -3.0, 1.5};
        setup.waypoints = {{12.0, -3.0, 1.5}};
        setup.seconds = 0.6;
        int answers = 0;
        setup.each = [&](const PilotInput&, const PilotAnswer& answer, const auto&, const Pilot&) {
          const base::BodyVelocity& v = answer.velocity;
          EXPECT_LE(Vector3d(v.surge, v.sway, v.heave).norm(), options->max_speed + 1e-9)
              << changed << " " << highest;
          ++answers;
        };
        const PilotStatus end = fly(setup).status;
        EXPECT_TRUE(answers >= 11 || end == PilotStatus::ARRIVED || end == PilotStatus::STUCK)
            << changed << " " << highest;
      }
}

}  // namespace
}  // namespace grid_path_planner::avoidance
