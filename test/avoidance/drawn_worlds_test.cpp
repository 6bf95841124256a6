// Flights in worlds that are drawn: nothing is ever touched. Few seeds each; as many as GPP_FLIGHT_SEEDS says
// where it is set (20 before a release).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <regex>
#include <string>
#include <vector>

#include "avoidance/drawn_world.h"
#include "avoidance/simulated_flight.h"

namespace grid_path_planner::avoidance {
namespace {

using Eigen::Vector3d;
using simulation::BodyShape;
using simulation::MovingBodies;
using simulation::MovingBody;

constexpr int kFewSeeds = 3;

int seeds() {
  const char* asked = std::getenv("GPP_FLIGHT_SEEDS");
  return asked != nullptr ? std::max(1, std::atoi(asked)) : kFewSeeds;
}

FlightSetup setupIn(std::shared_ptr<const World> world, const Vector3d& start,
                    const Vector3d& goal) {
  FlightSetup setup;
  setup.world = std::move(world);
  setup.options = flyingOptions();
  setup.start = start;
  setup.waypoints = {goal};
  return setup;
}

// Flies all seeds; `each` judges a result.
void flySeeds(FlightSetup setup, const std::function<void(const FlightResult&)>& each) {
  for (int seed = 1; seed <= seeds(); ++seed) {
    setup.seed = seed;
    const FlightResult result = fly(setup);
    SCOPED_TRACE("seed " + std::to_string(seed) + ", " + toString(result.status) + " after " +
                 std::to_string(result.seconds) + " s: " + result.sentence);
    EXPECT_EQ(result.contacts, 0) << result.touched;
    each(result);
  }
}

void expectArrived(const FlightResult& result) {
  EXPECT_EQ(result.status, PilotStatus::ARRIVED);
}

// Straight, without a turn.
TEST(DrawnWorlds, OpenFieldIsFlownStraight) {
  flySeeds(setupIn(worldOf(drawnMeshes({}, 1.0)), {0.0, 0.0, 1.5}, {25.0, 0.0, 1.5}),
           [](const FlightResult& result) {
             expectArrived(result);
             EXPECT_LE(result.metres, 1.02 * 25.0);
             EXPECT_LE(result.turned, 1.0);
           });
}

TEST(DrawnWorlds, OutOfATrapEightMetresDeep) {
  const std::vector<std::string> picture = {"##########",  //
                                            ".........#",  //
                                            ".........#",  //
                                            ".........#",  //
                                            ".........#",  //
                                            "##########"};
  flySeeds(setupIn(worldOf(drawnMeshes(picture, 1.0)), {-2.0, -3.0, 1.5}, {16.0, -3.0, 1.5}),
           expectArrived);
}

std::shared_ptr<const World> corridor(double width) {
  std::vector<simulation::TriangleMesh> meshes = drawnMeshes({}, 1.0);
  meshes.push_back(boxAt("left", {4.0, 0.5 * width, 0.0}, {12.0, 30.0, kDrawnHeight}));
  meshes.push_back(boxAt("right", {4.0, -30.0, 0.0}, {12.0, -0.5 * width, kDrawnHeight}));
  return worldOf(std::move(meshes));
}

TEST(DrawnWorlds, CorridorOfThreeBallsIsPassed) {
  flySeeds(setupIn(corridor(1.6), {0.0, 0.0, 1.5}, {16.0, 0.0, 1.5}), expectArrived);
}

TEST(DrawnWorlds, CorridorThatIsTooNarrowIsNotEntered) {
  FlightSetup setup = setupIn(corridor(1.1), {0.0, 0.0, 1.5}, {16.0, 0.0, 1.5});
  setup.seconds = 25.0;
  flySeeds(setup, [](const FlightResult& result) {
    EXPECT_NE(result.status, PilotStatus::ARRIVED);
    for (const Vector3d& place : result.track) EXPECT_LT(place.x(), 4.2);
  });
}

TEST(DrawnWorlds, ThroughAWindow) {
  std::vector<simulation::TriangleMesh> meshes = drawnMeshes({}, 1.0);
  meshes.push_back(boxAt("left", {6.0, 0.8, 0.0}, {6.3, 20.0, kDrawnHeight}));
  meshes.push_back(boxAt("right", {6.0, -20.0, 0.0}, {6.3, -0.8, kDrawnHeight}));
  meshes.push_back(boxAt("sill", {6.0, -0.8, 0.0}, {6.3, 0.8, 0.7}));
  meshes.push_back(boxAt("lintel", {6.0, -0.8, 2.3}, {6.3, 0.8, kDrawnHeight}));
  flySeeds(setupIn(worldOf(std::move(meshes)), {0.0, 0.0, 1.5}, {12.0, 0.0, 1.5}), expectArrived);
}

TEST(DrawnWorlds, ClosedRoomIsToldWithinAMinute) {
  const std::vector<std::string> picture = {"########",  //
                                            "#......#",  //
                                            "#......#",  //
                                            "#......#",  //
                                            "########"};
  FlightSetup setup =
      setupIn(worldOf(drawnMeshes(picture, 1.0)), {3.0, -2.5, 1.5}, {20.0, -2.5, 1.5});
  setup.seconds = 60.0;
  flySeeds(setup, [](const FlightResult& result) {
    EXPECT_EQ(result.status, PilotStatus::STUCK);
    EXPECT_NE(result.sentence.find("looked around"), std::string::npos);
  });
}

// The only door is a metre wide.
TEST(DrawnWorlds, ADoorThatIsTooNarrowIsToldWithItsWidth) {
  const std::vector<std::string> picture = {"########",  //
                                            "#......#",  //
                                            "#.......",  //
                                            "#......#",  //
                                            "########"};
  FlightSetup setup =
      setupIn(worldOf(drawnMeshes(picture, 1.0)), {3.0, -2.5, 1.5}, {20.0, -2.5, 1.5});
  setup.seconds = 90.0;
  const std::regex width("the passage at \\([^)]*\\) is (0.9|1.0|1.1) m wide, 1.3 m are needed");
  flySeeds(setup, [&](const FlightResult& result) {
    EXPECT_EQ(result.status, PilotStatus::STUCK);
    EXPECT_TRUE(std::regex_search(result.sentence, width));
  });
}

TEST(DrawnWorlds, GoalInAWallIsTold) {
  std::vector<simulation::TriangleMesh> meshes = drawnMeshes({}, 1.0);
  meshes.push_back(boxAt("wall", {9.9, -3.0, 0.0}, {10.1, 3.0, kDrawnHeight}));
  FlightSetup setup = setupIn(worldOf(std::move(meshes)), {0.0, 0.0, 1.5}, {10.0, 0.0, 1.5});
  setup.seconds = 20.0;
  flySeeds(setup, [](const FlightResult& result) {
    EXPECT_EQ(result.status, PilotStatus::GOAL_OCCUPIED);
  });
}

// 20 mm, in the path, seen by a picture of full size.
TEST(DrawnWorlds, ThinPole) {
  std::vector<simulation::TriangleMesh> meshes = drawnMeshes({}, 1.0);
  meshes.push_back(simulation::cylinderMesh("pole", 0.01, kDrawnHeight)
                       .moved(Eigen::Isometry3d(Eigen::Translation3d(5.0, 0.0, 2.5))));
  FlightSetup setup = setupIn(worldOf(std::move(meshes)), {0.0, 0.0, 1.5}, {9.0, 0.0, 1.5});
  setup.width = 320;
  setup.height = 240;
  flySeeds(setup, expectArrived);
}

// A body on `track` is touched only while the vehicle stands.
void flyAmong(const std::vector<simulation::TimedPosition>& track) {
  FlightSetup setup = setupIn(worldOf(drawnMeshes({}, 1.0)), {0.0, 0.0, 1.5}, {14.0, 0.0, 1.5});
  setup.bodies = std::make_shared<const MovingBodies>(
      std::vector<MovingBody>{{"walker", BodyShape::CYLINDER, Vector3d(0.3, 0.3, 1.5), track}});
  setup.seconds = 60.0;
  for (int seed = 1; seed <= seeds(); ++seed) {
    setup.seed = seed;
    const FlightResult result = fly(setup);
    EXPECT_EQ(result.contacts_moving, 0) << "seed " << seed;
    EXPECT_EQ(result.status, PilotStatus::ARRIVED) << "seed " << seed << ": " << result.sentence;
  }
}

TEST(DrawnWorlds, BodyThatCrossesIsTouchedByNoMotion) {
  flyAmong({{0.0, {6.0, -4.0, 1.5}}, {8.0, {6.0, 4.0, 1.5}}});
}

TEST(DrawnWorlds, BodyHeadOnIsTouchedByNoMotion) {
  flyAmong({{0.0, {12.0, 0.1, 1.5}}, {18.0, {-6.0, 0.1, 1.5}}});
}

}  // namespace
}  // namespace grid_path_planner::avoidance
