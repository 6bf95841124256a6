// Commands of a pilot in flight are finite and within its limits, whatever poses, velocities, clocks and pictures say.
//
// What was seen before: one tf with x = 1e160 made 20 of 20 commands of the driver NaN; a vehicle that multiplies by
// them goes anywhere.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>

#include "avoidance/drawn_world.h"
#include "avoidance/simulated_flight.h"
#include "base/odd_numbers.h"

namespace grid_path_planner::avoidance {
namespace {

using Eigen::Vector3d;
using test::OddNumbers;

// GPP_LONG_STORM: a million.
int updatesAskedFor() {
  return std::getenv("GPP_LONG_STORM") != nullptr ? 1'000'000 : 5'000;
}

FlightSetup smallFlight(OddNumbers& numbers, int seed) {
  FlightSetup setup;
  setup.world =
      worldOf(drawnMeshes({"...........", ".....#.....", "...........", "........#.."}, 1.0));
  setup.options = flyingOptions();
  setup.options.search = static_cast<Search>(numbers.below(3));
  setup.options.recover = numbers.below(2) == 0;
  setup.start = {0.0, -1.5, 1.5};
  setup.waypoints = {{12.0, -1.5, 1.5}, {0.0, -1.5, 1.5}};
  setup.width = 24;
  setup.height = 18;
  setup.seconds = 15.0;
  setup.seed = seed;
  return setup;
}

// Changes what a pilot is told, now and then, to what nobody can mean.
class Liar {
 public:
  explicit Liar(OddNumbers& numbers) : numbers_(numbers), ends_(numbers.below(4) == 0) {}

  void alter(PilotInput& input) {
    if (numbers_.below(12) == 0) alterPose(*input.pose, input.velocity);
    if (input.frame != nullptr && numbers_.below(8) == 0) {
      frame_ = *input.frame;
      alterFrame();
      input.frame = &frame_;
    }
    // After a time that is ahead every other is before it, which ends a flight.
    if (ends_ && input.time > 10.0 && numbers_.below(20) == 0) input.time = numbers_.any();
  }

 private:
  void alterPose(VehiclePose& pose, base::BodyVelocity& velocity) {
    double* const parts[] = {&pose.position.x(), &pose.position.y(), &pose.position.z(),
                             &pose.yaw,          &velocity.surge,    &velocity.sway,
                             &velocity.heave,    &velocity.yaw_rate};
    *parts[numbers_.below(8)] = numbers_.odd();
  }

  void alterFrame() {
    switch (numbers_.below(4)) {
      case 0:
        frame_.time = numbers_.odd();
        break;
      case 1:
        frame_.map_from_sensor.matrix()(numbers_.below(3), numbers_.below(4)) = numbers_.odd();
        break;
      case 2:
        frame_.pinhole = Pinhole{numbers_.odd(), numbers_.odd(), numbers_.odd(), numbers_.odd()};
        break;
      default:
        for (float& coordinate : frame_.points)
          if (numbers_.below(4) == 0) coordinate = static_cast<float>(numbers_.odd());
    }
  }

  OddNumbers& numbers_;
  const bool ends_;
  Frame frame_;
};

bool isWithinLimits(const base::BodyVelocity& v, const PilotOptions& o) {
  return Vector3d(v.surge, v.sway, v.heave).norm() <= o.max_speed + 1e-9 &&
         std::abs(v.heave) <= o.max_climb + 1e-9 && std::abs(v.yaw_rate) <= o.max_yaw_rate + 1e-9;
}

bool isUsable(const PilotInput& input) {
  return input.velocity.isFinite() && input.pose->position.allFinite() &&
         std::isfinite(input.pose->yaw) && input.pose->position.cwiseAbs().maxCoeff() <= 1e6;
}

TEST(FiniteCommandsLaw, RandomPosesTimesAndPicturesInFlight) {
  OddNumbers numbers(1);
  int updates = 0, moving = 0, unusable = 0, wrong = 0, flights = 0;
  for (; updates < updatesAskedFor(); ++flights) {
    FlightSetup setup = smallFlight(numbers, flights + 1);
    Liar liar(numbers);
    setup.alter = [&](PilotInput& input) { liar.alter(input); };
    setup.each = [&](const PilotInput& input, const PilotAnswer& answer, const auto&,
                     const Pilot&) {
      ++updates;
      const bool usable = isUsable(input);
      unusable += usable ? 0 : 1;
      moving += answer.velocity.isZero() ? 0 : 1;
      const bool right = answer.velocity.isFinite() &&
                         isWithinLimits(answer.velocity, setup.options) &&
                         (usable || answer.velocity.isZero());
      wrong += right ? 0 : 1;
      if (!right)
        ADD_FAILURE() << "flight " << flights << ", time " << input.time << ": " << answer.sentence;
    };
    fly(setup);
    ASSERT_LT(wrong, 10);
  }
  EXPECT_GT(moving, updates / 4) << "the law is of commands, not of standing still; flights: "
                                 << flights;
  EXPECT_GT(unusable, updates / 200);
}

}  // namespace
}  // namespace grid_path_planner::avoidance
