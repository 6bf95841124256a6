// The return to the path is looked at like the path.
//
// What was seen before: the check began at the point of the path nearest to the vehicle. A vehicle
// pushed aside, with a wall between it and its path, drove straight through the wall.
#include <gtest/gtest.h>

#include "following/closed_loop.h"
#include "grid_path_planner/following/path_clearance_check.h"
#include "support/ascii_map.h"

namespace grid_path_planner::following {
namespace {

using test::ClosedLoop;
using test::pathOf;

const grid::OccupancyGrid& wallMap() {
  static const test::AsciiMap picture({"..????..",  // y 0 to 1
                                       "........",  //
                                       "..####..",  // y 2 to 3
                                       "........",  //
                                       "........"});
  return picture.map;
}

// The vehicle at `x`, `y`, driving along y = 4.5 from x = 0.5 to 7.5 m, in the map whose first row is y = 0 to 1.
ClosedLoop pushedTo(double x, double y) {
  FollowerOptions options;
  options.lookahead = 5.0;
  return ClosedLoop(options, {x, y, 0.0});
}

std::string blockedBy(const std::vector<Eigen::Vector3d>& ahead, const ClearanceLimits& limits) {
  return firstObstruction(wallMap(), limits, ahead) ? "obstructed" : "";
}

TEST(ReturnToPath, AWallBetweenTheVehicleAndItsPathStopsIt) {
  ClosedLoop loop = pushedTo(3.5, 4.5);
  loop.check = [](const auto& ahead) { return blockedBy(ahead, {}); };
  loop.follower.start(pathOf({{0.5, 4.5}, {7.5, 4.5}}), Join::NEAREST);
  loop.run(0.2);
  ASSERT_EQ(loop.follower.state(), FollowState::DRIVING);
  loop.putAt({3.5, 1.5, 0.0});
  loop.run(5.0);
  EXPECT_EQ(loop.follower.state(), FollowState::BLOCKED);
  EXPECT_EQ(loop.speed(), 0.0);
  EXPECT_NEAR(loop.pose().position.y(), 1.5, 1e-9);
}

// It was not asked for the pose that is held after the arrival: pushed behind a wall, the vehicle came back through
// it, and a pause did not stop it.
TEST(ReturnToPath, AWallBetweenTheVehicleAndThePoseThatItHoldsStopsIt) {
  ClosedLoop loop = pushedTo(3.5, 4.5);
  loop.check = [](const auto& ahead) { return blockedBy(ahead, {}); };
  loop.follower.start(pathOf({{3.5, 4.5}}), Join::FIRST);
  ASSERT_TRUE(loop.runUntilState(FollowState::ARRIVED));
  loop.putAt({3.5, 1.5, 0.0});
  loop.run(5.0);
  EXPECT_NEAR(loop.pose().position.y(), 1.5, 0.01) << "the wall is between";
  loop.putAt({3.5, 4.2, 0.0});
  EXPECT_TRUE(loop.runUntil([&] { return loop.pose().position.y() > 4.4; }, 20.0)) << "nothing is";
}

TEST(ReturnToPath, APauseGivesUpThePoseThatIsHeld) {
  ClosedLoop loop = pushedTo(3.5, 4.5);
  loop.follower.start(pathOf({{3.5, 4.5}}), Join::FIRST);
  ASSERT_TRUE(loop.runUntilState(FollowState::ARRIVED));
  loop.putAt({3.5, 1.5, 0.0});
  loop.run(0.2);
  EXPECT_TRUE(loop.follower.pause().done);
  loop.run(5.0);
  EXPECT_LT(loop.pose().position.y(), 2.5);
  EXPECT_EQ(loop.speed(), 0.0);
}

// A vehicle abreast of the path's first waypoint came to rest beside it, for want of progress: the
// corner there was followed by a segment without length, to which it never came nearer.
TEST(ReturnToPath, AFreeOneIsDriven) {
  ClosedLoop loop = pushedTo(0.5, 1.5);
  loop.check = [](const auto& ahead) { return blockedBy(ahead, {}); };
  loop.follower.start(pathOf({{0.5, 4.5}, {7.5, 4.5}}), Join::NEAREST);
  EXPECT_TRUE(loop.runUntilState(FollowState::ARRIVED)) << loop.follower.message();
}

TEST(ReturnToPath, IsCheckedAsFarAsTheVehicleLooks) {
  std::vector<Eigen::Vector3d> seen;
  FollowerOptions options;
  options.lookahead = 2.0;
  ClosedLoop loop(options, {0.0, 10.0, 0.0});
  loop.check = [&](const std::vector<Eigen::Vector3d>& ahead) {
    seen = ahead;
    return std::string("held");
  };
  loop.follower.start(pathOf({{0, 0}, {9, 0}}), Join::NEAREST);
  loop.step();
  ASSERT_EQ(seen.size(), 3u) << "a route that begins at the vehicle leads back to the path";
  EXPECT_NEAR((seen.front() - Eigen::Vector3d(0, 10, 0)).norm(), 0.0, 1e-9);
  EXPECT_NEAR((seen.back() - Eigen::Vector3d(0, 8, 0)).norm(), 0.0, 1e-9);
  loop.putAt({-3.0, 10.0, 0.0});
  loop.step();
  ASSERT_EQ(seen.size(), 2u) << "pushed farther aside than it looks";
  EXPECT_NEAR((seen.back() - Eigen::Vector3d(-1, 10, 0)).norm(), 0.0, 1e-9);
}

std::optional<Obstruction> found(const std::vector<Eigen::Vector3d>& ahead,
                                 const ClearanceLimits& limits) {
  return firstObstruction(wallMap(), limits, ahead);
}

TEST(Obstruction, OccupiedCellsOfTheReturnToPathAndOfThePath) {
  const auto back = found({{3.5, 1.5, 0}, {3.5, 4.5, 0}, {7.5, 4.5, 0}}, {});
  ASSERT_TRUE(back);
  EXPECT_EQ(back->kind, Obstruction::Kind::OCCUPIED);
  EXPECT_EQ(back->at, Eigen::Vector2d(3.5, 2.5));
  EXPECT_TRUE(found({{0.5, 2.5, 0}, {0.5, 2.5, 0}, {7.5, 2.5, 0}}, {}));
  EXPECT_FALSE(found({{0.5, 1.5, 0}, {0.5, 4.5, 0}, {7.5, 4.5, 0}}, {}));
  EXPECT_FALSE(found({}, {}));
}

// A vehicle that was pushed into the radius would never come out of it again.
TEST(Obstruction, TheReturnToPathMayLeadOutOfTheRadiusAndNotFartherIn) {
  const ClearanceLimits limits{{}, 1.0, false};
  EXPECT_FALSE(found({{3.5, 3.2, 0}, {3.5, 4.5, 0}}, limits));
  EXPECT_TRUE(found({{3.5, 3.2, 0}, {3.5, 3.1, 0}}, limits));
  EXPECT_TRUE(found({{3.5, 3.2, 0}, {3.5, 3.5, 0}, {4.5, 3.5, 0}}, limits)) << "the path itself";
  EXPECT_TRUE(found({{3.5, 2.5, 0}, {3.5, 4.5, 0}}, limits)) << "inside an occupied cell";
}

TEST(Obstruction, UnknownCellsAndTheOutsideWhereThatIsAskedFor) {
  const std::vector<Eigen::Vector3d> unknown = {{0.5, 0.5, 0}, {0.5, 0.5, 0}, {7.5, 0.5, 0}};
  const std::vector<Eigen::Vector3d> outside = {{0.5, 1.5, 0}, {0.5, 1.5, 0}, {9.5, 1.5, 0}};
  const std::vector<Eigen::Vector3d> back = {{3.5, 0.5, 0}, {3.5, 1.5, 0}, {4.5, 1.5, 0}};
  const std::vector<Eigen::Vector3d> out = {{-1.0, 1.5, 0}, {0.5, 1.5, 0}, {4.5, 1.5, 0}};
  for (const auto& points : {unknown, outside, back, out}) {
    EXPECT_FALSE(found(points, {}));
    EXPECT_TRUE(found(points, {{}, 0.0, true}));
  }
  EXPECT_EQ(found(unknown, {{}, 0.0, true})->kind, Obstruction::Kind::UNKNOWN);
  EXPECT_EQ(found(unknown, {{}, 0.0, true})->at, Eigen::Vector2d(2.5, 0.5));
  EXPECT_EQ(found(outside, {{}, 0.0, true})->kind, Obstruction::Kind::OUTSIDE);
  EXPECT_EQ(found(back, {{}, 0.0, true})->kind, Obstruction::Kind::UNKNOWN);
  EXPECT_EQ(found(out, {{}, 0.0, true})->kind, Obstruction::Kind::OUTSIDE);
  EXPECT_FALSE(found({{0.5, 1.5, 0}, {0.5, 4.5, 0}}, {{}, 0.0, true}));
}

}  // namespace
}  // namespace grid_path_planner::following
