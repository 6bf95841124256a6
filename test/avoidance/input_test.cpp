// Clouds, poses and goals that cannot be used: the vehicle stands, and is told why.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "avoidance/drawn_world.h"
#include "avoidance/simulated_flight.h"
#include "grid_path_planner/base/errors.h"
#include "support/error_text.h"

namespace grid_path_planner::avoidance {
namespace {

using Eigen::Vector3d;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

FlightSetup fieldSetup() {
  FlightSetup setup;
  setup.world = worldOf(drawnMeshes({}, 1.0));
  setup.options = flyingOptions();
  setup.waypoints = {{20.0, 0.0, 1.5}};
  return setup;
}

PilotInput inputAt(double time, const Frame* frame) {
  PilotInput input;
  input.time = time;
  input.pose = VehiclePose{{0.0, 0.0, 1.5}, 0.0};
  input.frame = frame;
  return input;
}

Frame pictureOf(float value, double time) {
  Frame frame;
  frame.time = time;
  frame.width = 8;
  frame.height = 6;
  frame.points.assign(3 * frame.pixels(), value);
  frame.map_from_sensor.translation() = Vector3d(0.0, 0.0, 1.5);
  return frame;
}

// Of a sky, in which no pixel measures anything, ahead of a vehicle that looks along x.
Frame skyOf(double time) {
  Frame frame = pictureOf(kNan, time);
  frame.width = 80;
  frame.height = 60;
  frame.points.assign(3 * frame.pixels(), kNan);
  frame.pinhole = Pinhole{50.0, 50.0, 40.0, 30.0};
  frame.map_from_sensor.linear() << 0.0, 0.0, 1.0, -1.0, 0.0, 0.0, 0.0, -1.0, 0.0;
  return frame;
}

// Stands, with a status and words of its sentence.
void expectStands(const PilotAnswer& answer, PilotStatus status, const std::string& words) {
  EXPECT_TRUE(answer.velocity.isZero());
  EXPECT_EQ(answer.status, status) << answer.sentence;
  EXPECT_NE(answer.sentence.find(words), std::string::npos) << answer.sentence;
}

TEST(Input, WithoutACloudItStandsAndSaysSo) {
  Pilot pilot(flyingOptions());
  pilot.setRoute({{20.0, 0.0, 1.5}});
  expectStands(pilot.update(inputAt(1.0, nullptr)), PilotStatus::NO_CLOUD, "no cloud has come");
}

TEST(Input, AnUnorganisedCloudWithoutPointsIsALostSensor) {
  Pilot pilot(flyingOptions());
  pilot.setRoute({{20.0, 0.0, 1.5}});
  Frame frame;
  expectStands(pilot.update(inputAt(0.0, &frame)), PilotStatus::NO_CLOUD, "holds no point");
  frame = pictureOf(kNan, 0.1);
  frame.width = 48;
  frame.height = 1;
  expectStands(pilot.update(inputAt(0.1, &frame)), PilotStatus::NO_CLOUD, "holds no point");
}

TEST(Input, FramesThatLieAreRefused) {
  Pilot pilot(flyingOptions());
  pilot.setRoute({{20.0, 0.0, 1.5}});
  Frame frame = pictureOf(1.0F, 5.0);
  expectStands(pilot.update(inputAt(1.0, &frame)), PilotStatus::NO_CLOUD, "in the future");
  frame.time = 1.1;
  frame.width = 9;
  expectStands(pilot.update(inputAt(1.1, &frame)), PilotStatus::NO_CLOUD, "instead of 9 x 6");
  frame.width = 8;
  frame.map_from_sensor.translation().x() = std::nan("");
  expectStands(pilot.update(inputAt(1.2, &frame)), PilotStatus::NO_CLOUD, "no pose");
}

TEST(Input, InfinitiesAndHugeNumbersAreNoPoints) {
  Pilot pilot(flyingOptions());
  for (const float value : {std::numeric_limits<float>::infinity(), 1e30F, -1e30F}) {
    const Frame frame = pictureOf(value, 0.0);
    pilot.see(frame);
  }
  EXPECT_TRUE(pilot.rememberedPoints().empty());
}

// A camera with a focal length next to 0 sees next to nothing: a voxel's place in its row was infinite, and made an int, at
// 8.3e-309 and, where a row that begins at infinity was emptied by ending it one before, at 4.4e-308.
TEST(Input, NoCameraMakesACommandThatIsNotFinite) {
  const double parts[] = {8.3e-309, 4.4e-308, 1e-300, 4.2e-314, -1.0, 0.5, 2.0, 2.6e161, 1e308};
  for (const double fx : parts)
    for (const double fy : parts)
      for (const double centre : parts) {
        Pilot pilot(flyingOptions());
        pilot.setRoute({{20.0, 0.0, 1.5}});
        Frame frame = pictureOf(2.0F, 0.0);
        frame.pinhole = Pinhole{fx, fy, centre, 0.5};
        EXPECT_TRUE(pilot.update(inputAt(0.0, &frame)).velocity.isFinite())
            << fx << " " << fy << " " << centre;
      }
}

TEST(Input, APoseThatIsNotKnownStopsAtOnce) {
  FlightSetup setup = fieldSetup();
  Pilot pilot(setup.options);
  pilot.setRoute(setup.waypoints);
  PilotInput input = inputAt(0.0, nullptr);
  input.pose.reset();
  input.pose_problem = "tf knows no frame odom";
  expectStands(pilot.update(input), PilotStatus::TRANSFORM_ERROR, "no frame odom");
  input.pose = VehiclePose{{std::nan(""), 0.0, 0.0}, 0.0};
  input.pose_problem.clear();
  expectStands(pilot.update(input), PilotStatus::TRANSFORM_ERROR, "pose is not finite");
  input.pose = VehiclePose{{1e12, 0.0, 0.0}, 0.0};
  expectStands(pilot.update(input), PilotStatus::TRANSFORM_ERROR, "beyond 1e6 m");
  input.pose = VehiclePose{{0.0, 0.0, 1.5}, 0.0};
  input.velocity.surge = std::nan("");
  expectStands(pilot.update(input), PilotStatus::TRANSFORM_ERROR, "velocity is not finite");
  input.velocity.surge = 1e300;
  expectStands(pilot.update(input), PilotStatus::TRANSFORM_ERROR, "1000 m/s");
}

// Where each new path made the vehicle hover until the next frame, one that was planned anew ten times a second hovered
// half of the time, and said that no path was free.
TEST(Input, ARouteThatIsGivenInFlightIsFlownAtOnce) {
  Pilot pilot(flyingOptions());
  pilot.setRoute({{20.0, 0.0, 1.5}});
  for (const double time : {0.0, 0.1, 0.2}) {
    const Frame sky = skyOf(time);
    pilot.update(inputAt(time, &sky));
  }
  ASSERT_EQ(pilot.update(inputAt(0.25, nullptr)).status, PilotStatus::FLYING);
  for (const double time : {0.26, 0.27, 0.28}) {
    pilot.setRoute({{20.0, 1.0, 1.5}});
    const PilotAnswer answer = pilot.update(inputAt(time, nullptr));
    EXPECT_EQ(answer.status, PilotStatus::FLYING) << answer.sentence;
    EXPECT_GT(answer.velocity.surge, 0.1);
  }
}

// It stands for want of a sensor: that is no lack of progress, for which it looked around, or ended the flight.
TEST(Input, ACameraThatIsLostEndsNoFlight) {
  PilotOptions options = flyingOptions();
  options.recover = false;
  options.stuck_timeout = 2.0;
  Pilot pilot(options);
  pilot.setRoute({{20.0, 0.0, 1.5}});
  const Frame sky = skyOf(0.0);
  pilot.update(inputAt(0.0, &sky));
  for (double time = 0.1; time < 10.0; time += 0.1) {
    PilotInput input = inputAt(time, nullptr);
    input.cloud_problem = "nothing comes on points";
    expectStands(pilot.update(input), PilotStatus::NO_CLOUD, "nothing comes on points");
  }
  const Frame again = skyOf(10.0);
  EXPECT_EQ(pilot.update(inputAt(10.0, &again)).status, PilotStatus::FLYING);
}

// In flight the clouds cease: zero within half a second.
TEST(Input, ACameraThatIsCutStopsTheVehicle) {
  FlightSetup setup = fieldSetup();
  double last_frame = 0.0;
  setup.each = [&](const PilotInput& input, const PilotAnswer& answer, const auto&, const Pilot&) {
    if (input.frame != nullptr) last_frame = input.time;
    if (input.time - last_frame > 0.45) {
      EXPECT_TRUE(answer.velocity.isZero());
      EXPECT_EQ(answer.status, PilotStatus::NO_CLOUD);
    }
  };
  setup.last_frame = 4.0;
  setup.seconds = 8.0;
  EXPECT_LT(fly(setup).metres, 10.0);
}

TEST(Input, TimeThatGoesBackCancels) {
  Pilot pilot(flyingOptions());
  pilot.setRoute({{20.0, 0.0, 1.5}});
  pilot.update(inputAt(10.0, nullptr));
  expectStands(pilot.update(inputAt(9.0, nullptr)), PilotStatus::CANCELLED, "time went back");
  pilot.setRoute({{20.0, 0.0, 1.5}});
  expectStands(pilot.update(inputAt(9.1, nullptr)), PilotStatus::NO_CLOUD, "no cloud");
}

TEST(Input, WrongIntrinsicsAreNotBelieved) {
  FlightSetup setup = fieldSetup();
  setup.focal_error = 1.5;
  setup.seconds = 5.0;
  const FlightResult result = fly(setup);
  EXPECT_EQ(result.contacts, 0);
  EXPECT_LT(result.metres, 2.0);  // the sky clears nothing without intrinsics
}

TEST(Input, FalsePointsDoNotBendThePath) {
  FlightSetup setup = fieldSetup();
  setup.false_points = 20;
  const FlightResult result = fly(setup);
  EXPECT_EQ(result.status, PilotStatus::ARRIVED) << result.sentence;
  EXPECT_LE(result.metres, 1.05 * 20.0);
}

TEST(Input, GoalsThatCannotBeFlownAreRefusedByName) {
  Pilot pilot(flyingOptions());
  pilot.setRoute({{20.0, 0.0, 1.5}});
  const auto refused = [&](const std::vector<Vector3d>& route) {
    return test::errorText([&] { pilot.setRoute(route); });
  };
  EXPECT_NE(refused({}).find("at least one"), std::string::npos);
  EXPECT_NE(refused({{1.0, 0.0, 1.5}, {std::nan(""), 0.0, 1.5}}).find("waypoint 2"),
            std::string::npos);
  EXPECT_NE(refused({{1e180, 0.0, 1.5}}).find("1e6"), std::string::npos);
  EXPECT_NE(refused({{1.0, 0.0, 9.0}}).find("fence"), std::string::npos);
}

}  // namespace
}  // namespace grid_path_planner::avoidance
