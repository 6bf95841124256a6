// Plans through via-points: pictures, and the best order against all orders of the legs.
#include "planning/via/via_plan.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <random>

#include "support/ascii_map.h"
#include "support/random_map.h"

namespace grid_path_planner::planning {

using base::Status;
using base::StopSource;
using grid::GridGeometry;
using grid::OccupancyGrid;
using path::Pose;

namespace {

using test::AsciiMap;

Pose viaPose(double x, double y, double yaw = 0.0) {
  Pose pose;
  pose.position << x, y, 0.0;
  pose.yaw = yaw;
  return pose;
}

ViaRequest through(const Pose& start, const std::vector<Pose>& via, const Pose& goal,
                   ViaOrder order = ViaOrder::GIVEN) {
  ViaRequest request;
  request.start = start;
  request.goal = goal;
  request.order = order;
  for (const Pose& pose : via) request.via.push_back(pose.position);
  return request;
}

PathPlanner plannerOn(const OccupancyGrid& map, const PlannerOptions& options = {}) {
  PathPlanner planner(options);
  planner.setMap(std::make_shared<const OccupancyGrid>(map));
  return planner;
}

bool passes(const Plan& plan, const Pose& pose) {
  return std::any_of(plan.path.poses.begin(), plan.path.poses.end(), [&](const Pose& each) {
    return (each.position - pose.position).norm() < 1e-9;
  });
}

bool viaSays(const Plan& plan, const std::string& words) {
  return plan.message.find(words) != std::string::npos;
}

const OccupancyGrid& hall() {
  static const OccupancyGrid map =
      AsciiMap({"..........", "..........", "....##....", "....##....", "..........", ".........."})
          .map;
  return map;
}

TEST(ViaPlan, PassesThePointsAsTheyAreGiven) {
  PathPlanner planner = plannerOn(hall());
  const std::vector<Pose> via = {viaPose(9.5, 0.5), viaPose(0.5, 5.5), viaPose(9.5, 5.5)};
  const ViaPlan found =
      planThrough(planner, through(viaPose(0.5, 0.5), via, viaPose(5.5, 0.5, 1.0)));
  ASSERT_TRUE(found.plan.found()) << found.plan.message;
  for (const Pose& pose : via) EXPECT_TRUE(passes(found.plan, pose));
  EXPECT_EQ(found.order, (std::vector<std::size_t>{0, 1, 2}));
  EXPECT_FALSE(found.order_exact);
  EXPECT_TRUE(viaSays(found.plan, "through 3 via-points")) << found.plan.message;
  EXPECT_EQ(found.plan.path.poses.back().yaw, 1.0);
  // It looks along the next leg at a via-point, which is there once.
  const auto at_first = std::find_if(
      found.plan.path.poses.begin(), found.plan.path.poses.end(),
      [&](const Pose& pose) { return (pose.position - via[0].position).norm() < 1e-9; });
  ASSERT_NE(at_first + 1, found.plan.path.poses.end());
  EXPECT_GT((at_first[1].position - at_first->position).norm(), 0.1);
  const Eigen::Vector3d step = at_first[1].position - at_first->position;
  EXPECT_NEAR(at_first->yaw, std::atan2(step.y(), step.x()), 1e-12);
}

TEST(ViaPlan, IsTheSumOfItsLegs) {
  PathPlanner planner = plannerOn(hall());
  const Pose start = viaPose(0.5, 0.5), via = viaPose(9.2, 3.3), goal = viaPose(0.7, 5.1);
  const ViaPlan found = planThrough(planner, through(start, {via}, goal));
  const Plan first = planner.plan({start, via, false}), second = planner.plan({via, goal, false});
  EXPECT_DOUBLE_EQ(found.plan.costValue(), first.costValue() + second.costValue());
  EXPECT_DOUBLE_EQ(found.plan.length_m, first.length_m + second.length_m);
  EXPECT_EQ(found.plan.cells, first.cells + second.cells - 1);
  EXPECT_EQ(found.plan.path.poses.size(), first.path.poses.size() + second.path.poses.size() - 1);
}

// navigation2#2494, #4792: repeated via-poses fail.
TEST(ViaPlan, TheSamePlaceAgainIsNoFailure) {
  PathPlanner planner = plannerOn(hall());
  const Pose here = viaPose(0.5, 0.5), there = viaPose(9.5, 0.5);
  for (const ViaOrder order : {ViaOrder::GIVEN, ViaOrder::BEST}) {
    const ViaPlan found =
        planThrough(planner, through(here, {here, there, there, here}, here, order));
    ASSERT_TRUE(found.plan.found()) << found.plan.message;
    EXPECT_DOUBLE_EQ(found.plan.length_m, 18.0);
  }
}

TEST(ViaPlan, NamesTheFirstPointThatNoPathLeadsTo) {
  const AsciiMap picture({"...#.", "...#.", "...#."});
  PathPlanner planner = plannerOn(picture.map);
  const ViaPlan found = planThrough(
      planner,
      through(viaPose(0.5, 0.5), {viaPose(2.5, 0.5), viaPose(4.5, 1.5)}, viaPose(2.5, 2.5)));
  EXPECT_EQ(found.plan.status, Status::UNREACHABLE);
  EXPECT_TRUE(viaSays(found.plan, "to via-point 2: no path")) << found.plan.message;
  EXPECT_EQ(found.unreachable, std::vector<std::size_t>{1});
  EXPECT_TRUE(found.plan.path.empty());
  EXPECT_TRUE(found.order.empty());
}

TEST(ViaPlan, NamesAllPointsThatNoPathLeadsToWhereItOrdersThem) {
  const AsciiMap picture({"...#.", "...#.", "...#."});
  PathPlanner planner = plannerOn(picture.map);
  const ViaPlan found = planThrough(
      planner, through(viaPose(0.5, 0.5), {viaPose(4.5, 0.5), viaPose(2.5, 0.5), viaPose(3.5, 1.5)},
                       viaPose(2.5, 2.5), ViaOrder::BEST));
  EXPECT_EQ(found.plan.status, Status::UNREACHABLE);
  EXPECT_EQ(found.unreachable, (std::vector<std::size_t>{0, 2}));
  EXPECT_TRUE(viaSays(found.plan, "to via-points 1 and 3: ")) << found.plan.message;
  EXPECT_EQ(found.last_leg.goal.position.x(), 4.5);
}

TEST(ViaPlan, AStartThatCannotBeUsedIsNoFaultOfThePoints) {
  const AsciiMap picture({"#...", "...."});
  PathPlanner planner = plannerOn(picture.map);
  const ViaPlan found = planThrough(
      planner, through(viaPose(0.5, 0.5), {viaPose(2.5, 0.5)}, viaPose(3.5, 1.5), ViaOrder::BEST));
  EXPECT_EQ(found.plan.status, Status::START_OCCUPIED);
  EXPECT_TRUE(found.unreachable.empty());
}

// The leg after a point that is reached within the tolerance begins where the vehicle stands.
TEST(ViaPlan, GoesOnFromWhereATolerantLegEnds) {
  const AsciiMap picture({"....#", ".....", "....."});
  PlannerOptions options;
  options.tolerance = 1.5;
  PathPlanner planner = plannerOn(picture.map, options);
  for (const ViaOrder order : {ViaOrder::GIVEN, ViaOrder::BEST}) {
    const ViaPlan found = planThrough(
        planner, through(viaPose(0.5, 0.5), {viaPose(4.5, 0.5)}, viaPose(0.5, 2.5), order));
    ASSERT_TRUE(found.plan.found()) << found.plan.message;
    EXPECT_TRUE(passes(found.plan, viaPose(3.5, 0.5)) || passes(found.plan, viaPose(4.5, 1.5)));
    EXPECT_TRUE(viaSays(found.plan, "to via-point 1: ")) << found.plan.message;
  }
}

double leastOfAllOrders(PathPlanner& planner, ViaRequest request) {
  request.order = ViaOrder::GIVEN;
  std::vector<std::size_t> order(request.via.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  const std::vector<Eigen::Vector3d> via = request.via;
  double least = std::numeric_limits<double>::infinity();
  do {
    for (std::size_t i = 0; i < order.size(); ++i) request.via[i] = via[order[i]];
    const ViaPlan found = planThrough(planner, request);
    if (found.plan.found()) least = std::min(least, found.plan.costValue());
  } while (std::next_permutation(order.begin(), order.end()));
  return least;
}

// Every order of four points, planned one after the other.
TEST(ViaPlan, NoOrderOfSeededPointsCostsLess) {
  std::mt19937 random(1714);
  int found_any = 0;
  for (int round = 0; round < 40; ++round) {
    const OccupancyGrid map = test::randomOccupancy(random, 20, 0.15, 0.1);
    const auto pose = [&] {
      const Eigen::Vector2d centre =
          map.geometry().centre(test::randomCell(random, map.geometry()));
      return viaPose(centre.x(), centre.y());
    };
    PlannerOptions options;
    options.smooth = round % 2 == 0;
    options.tolerance = round % 3 == 0 ? 2.0 * map.geometry().resolution() : 0.0;
    PathPlanner planner = plannerOn(map, options);
    const Pose start = pose();
    const ViaRequest request = through(start, {pose(), pose(), pose(), pose()},
                                       round % 4 == 0 ? start : pose(), ViaOrder::BEST);
    const ViaPlan found = planThrough(planner, request);
    const double least = leastOfAllOrders(planner, request);
    ASSERT_EQ(found.plan.found(), std::isfinite(least)) << "round " << round;
    if (!found.plan.found()) continue;
    ++found_any;
    EXPECT_TRUE(found.order_exact);
    EXPECT_NEAR(found.plan.costValue(), least, 1e-9 * (1.0 + least)) << "round " << round;
  }
  EXPECT_GE(found_any, 8);
}

TEST(ViaPlan, ManyPointsAreOrderedByAHeuristicThatSaysSo) {
  PathPlanner planner = plannerOn(hall());
  std::vector<Pose> via;
  for (int i = 0; i < 14; ++i) via.push_back(viaPose(0.5 + (i * 7) % 10, i % 2 == 0 ? 0.5 : 5.5));
  const ViaPlan found =
      planThrough(planner, through(viaPose(0.5, 0.5), via, viaPose(0.5, 5.5), ViaOrder::BEST));
  ASSERT_TRUE(found.plan.found()) << found.plan.message;
  EXPECT_FALSE(found.order_exact);
  EXPECT_FALSE(found.plan.optimal);
  EXPECT_TRUE(viaSays(found.plan, "found by a heuristic")) << found.plan.message;
  const ViaPlan given = planThrough(planner, through(viaPose(0.5, 0.5), via, viaPose(0.5, 5.5)));
  EXPECT_LT(found.plan.costValue(), given.plan.costValue() / 2);
}

TEST(ViaPlan, TooManyPointsAreRefusedWithTheirNumber) {
  PathPlanner planner = plannerOn(hall());
  const std::vector<Pose> via(kMostOrdered + 1, viaPose(1.5, 1.5));
  const ViaPlan found =
      planThrough(planner, through(viaPose(0.5, 0.5), via, viaPose(2.5, 0.5), ViaOrder::BEST));
  EXPECT_EQ(found.plan.status, Status::INVALID_REQUEST);
  EXPECT_TRUE(viaSays(found.plan, "51 via-points, and at most 50")) << found.plan.message;
}

TEST(ViaPlan, PointsThatAreNoNumbersAreNamed) {
  PathPlanner planner = plannerOn(hall());
  const Pose nan = viaPose(std::numeric_limits<double>::quiet_NaN(), 0.0);
  const ViaPlan found =
      planThrough(planner, through(viaPose(0.5, 0.5), {viaPose(1.5, 1.5), nan}, viaPose(2.5, 0.5)));
  EXPECT_EQ(found.plan.status, Status::INVALID_REQUEST);
  EXPECT_TRUE(viaSays(found.plan, "via-point 2 must be finite")) << found.plan.message;
}

TEST(ViaPlan, StopsWhenItIsCancelledOrItsTimeIsOver) {
  PlannerOptions options;
  options.timeout = 1e-7;
  PathPlanner planner = plannerOn(OccupancyGrid(GridGeometry(400, 400, 1.0)), options);
  const ViaRequest request = through(viaPose(0.5, 0.5), {viaPose(399.5, 0.5), viaPose(0.5, 399.5)},
                                     viaPose(399.5, 399.5), ViaOrder::BEST);
  StopSource stop;
  const ViaPlan late = planThrough(planner, request, stop);
  EXPECT_EQ(late.plan.status, Status::TIMEOUT);
  EXPECT_TRUE(viaSays(late.plan, "time limit")) << late.plan.message;
  EXPECT_TRUE(late.unreachable.empty());
  EXPECT_EQ(planner.options().timeout, 1e-7) << "the options are as before";
  stop.cancel();
  const ViaPlan cancelled = planThrough(planner, request, stop);
  EXPECT_EQ(cancelled.plan.status, Status::CANCELLED);
  EXPECT_TRUE(cancelled.plan.path.empty());
  EXPECT_TRUE(cancelled.unreachable.empty());
}

}  // namespace
}  // namespace grid_path_planner::planning
