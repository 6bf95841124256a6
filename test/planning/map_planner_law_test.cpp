// Laws of whole plans over seeded random maps, judged by a checker that shares no code with them.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <random>

#include "grid_path_planner/planners/planner_factory.h"
#include "grid_path_planner/planning/path_planner.h"
#include "support/path_checker.h"
#include "support/random_map.h"

namespace grid_path_planner::planning {

using base::Status;
using costmap::Connectivity;
using costmap::KernelRule;
using grid::Cell;
using grid::GridGeometry;
using grid::OccupancyGrid;
using grid::Origin;
using path::Pose;
using planners::makePlanner;
using planners::plannerNames;
using planners::PlannerTraits;

namespace {

Pose randomPose(std::mt19937& random, const GridGeometry& geometry, double margin = 0.0) {
  std::uniform_real_distribution<double> x(-margin, geometry.width() + margin);
  std::uniform_real_distribution<double> y(-margin, geometry.height() + margin);
  std::uniform_real_distribution<double> angle(-3.1, 3.1);
  Pose pose;
  const double column = x(random);
  pose.position << geometry.worldFromGrid({column, y(random)}), angle(random);
  pose.yaw = angle(random);
  return pose;
}

PlannerOptions randomOptions(std::mt19937& random) {
  PlannerOptions options;
  options.costmap.kernel = 1 + static_cast<int>(random() % 8);
  options.costmap.unknown_is_passable = random() % 2 == 0;
  options.costmap.radius = static_cast<double>(random() % 3) * 0.04;
  options.costmap.decay = static_cast<double>(random() % 2) * 5.0;
  options.costmap.motion.cut_corners = random() % 5 == 0;
  options.costmap.motion.connectivity =
      random() % 4 == 0 ? Connectivity::FOUR : Connectivity::EIGHT;
  options.retry_finer = random() % 3 != 0;
  options.planner = plannerNames()[random() % plannerNames().size()];
  const PlannerTraits traits = makePlanner(options.planner)->traits();
  if (!traits.four_connected) options.costmap.motion.connectivity = Connectivity::EIGHT;
  options.smooth = random() % 3 == 0 && options.costmap.motion.connectivity == Connectivity::EIGHT;
  if (!traits.cut_corners) options.costmap.motion.cut_corners = false;
  if (!traits.weights) {
    options.costmap.unknown_weight = options.costmap.free_weight;
    options.costmap.decay = 0.0;
  }
  return options;
}

OccupancyGrid placed(const OccupancyGrid& map, double resolution, const Origin& origin) {
  return OccupancyGrid(GridGeometry(map.width(), map.height(), resolution, origin), map.values());
}

// navigation2#5863: any-angle path crosses lethal cells. #2686: ends at factors 1-8. PX4 PR#384.
TEST(MapPlannerLaw, PathsAreLegalAtFullResolutionAndEndWhereTheyWereAsked) {
  std::mt19937 random(5863);
  int found = 0;
  for (int trial = 0; trial < 1500; ++trial) {
    const double occupied = trial % 3 == 0 ? 0.02 : 0.1;
    const OccupancyGrid map = placed(test::randomOccupancy(random, 36, occupied, 0.05), 0.05,
                                     {-1.3, 0.7, trial % 2 == 0 ? 0.0 : 0.6});
    const OccupancyGrid before = map;
    const PlannerOptions options = randomOptions(random);
    PathPlanner planner(options);
    const auto shared = std::make_shared<const OccupancyGrid>(map);
    planner.setMap(shared);
    const PoseRequest request{randomPose(random, map.geometry()),
                              randomPose(random, map.geometry()), false};
    Plan report = planner.plan(request);
    ASSERT_EQ(*shared, before);
    ASSERT_FALSE(report.message.empty());
    ASSERT_EQ(report.path.empty(), report.status != Status::FOUND);
    if (report.status != Status::FOUND) continue;
    ++found;
    test::PathRules rules;
    rules.radius = options.costmap.radius;
    rules.unknown_is_passable = options.costmap.unknown_is_passable;
    rules.cut_corners = options.costmap.motion.cut_corners;
    // The first segment out of a cell whose centre is too near is judged by distances (radius_law_test.cpp).
    const auto cell = map.geometry().cellAt(request.start.position.head<2>());
    const bool leaves = !planner.fullResolutionCosts(base::StopToken())->passable(*cell);
    if (leaves && report.path.poses.size() > 1) report.path.poses.erase(report.path.poses.begin());
    const Pose start = leaves ? report.path.poses.front() : request.start;
    ASSERT_EQ(test::pathViolations(report.path, start, request.goal, map, rules),
              test::kNoViolations)
        << "trial " << trial << " kernel " << options.costmap.kernel << ' ' << options.planner
        << " cut_corners " << options.costmap.motion.cut_corners << " map " << map.width() << 'x'
        << map.height();
  }
  EXPECT_GT(found, 500);
}

// With retry_finer a kernel never loses a path that full resolution has.
TEST(MapPlannerLaw, AKernelLosesNoPath) {
  std::mt19937 random(5884);
  for (int trial = 0; trial < 300; ++trial) {
    const OccupancyGrid map = test::randomOccupancy(random, 30, 0.15, 0.0);
    const PoseRequest request{randomPose(random, map.geometry()),
                              randomPose(random, map.geometry()), false};
    const auto statusAt = [&](int kernel) {
      PlannerOptions options;
      options.costmap.kernel = kernel;
      PathPlanner planner(options);
      planner.setMap(std::make_shared<const OccupancyGrid>(map));
      return planner.plan(request).status;
    };
    const Status status = statusAt(1);
    for (const int kernel : {2, 3, 5, 7}) ASSERT_EQ(statusAt(kernel), status) << "trial " << trial;
  }
}

// navigation#166, #661, navigation2#1511: the map's yaw ignored.
TEST(MapPlannerLaw, ATurnedMapGivesTheTurnedPath) {
  std::mt19937 random(166);
  for (int trial = 0; trial < 100; ++trial) {
    const OccupancyGrid map = placed(test::randomOccupancy(random, 24, 0.15, 0.1), 0.1, {});
    const Origin origin{-3.0, 2.0, 0.1 * trial - 3.0};
    const OccupancyGrid turned = placed(map, 0.1, origin);
    const PoseRequest request{randomPose(random, map.geometry()),
                              randomPose(random, map.geometry()), false};
    const auto turn = [&](Pose pose) {
      const Eigen::Vector2d cells = map.geometry().gridFromWorld(pose.position.head<2>());
      pose.position.head<2>() = turned.geometry().worldFromGrid(cells);
      pose.yaw += origin.yaw;
      return pose;
    };
    PathPlanner straight_planner;
    straight_planner.setMap(std::make_shared<const OccupancyGrid>(map));
    PathPlanner turned_planner;
    turned_planner.setMap(std::make_shared<const OccupancyGrid>(turned));
    const Plan a = straight_planner.plan(request);
    const Plan b = turned_planner.plan({turn(request.start), turn(request.goal), false});
    ASSERT_EQ(a.status, b.status);
    ASSERT_EQ(a.cost, b.cost);
    ASSERT_EQ(a.path.poses.size(), b.path.poses.size());
    for (std::size_t i = 0; i < a.path.poses.size(); ++i) {
      const Pose expected = turn(a.path.poses[i]);
      ASSERT_NEAR((expected.position - b.path.poses[i].position).norm(), 0.0, 1e-9);
      ASSERT_NEAR(std::remainder(expected.yaw - b.path.poses[i].yaw, 2.0 * M_PI), 0.0, 1e-9);
    }
  }
}

TEST(MapPlannerLaw, AnUpdatedMapIsPlannedLikeAFreshOne) {
  std::mt19937 random(12);
  for (int trial = 0; trial < 60; ++trial) {
    OccupancyGrid map = test::randomOccupancy(random, 40, 0.1, 0.1);
    PlannerOptions options;
    options.costmap.kernel = 1 + trial % 3;
    options.costmap.radius = trial % 2 * 0.6;
    options.costmap.decay = trial % 4 * 0.5;
    PathPlanner updated(options);
    updated.setMap(std::make_shared<const OccupancyGrid>(map));
    for (int edit = 0; edit < 6; ++edit) {
      const PoseRequest request{randomPose(random, map.geometry()),
                                randomPose(random, map.geometry()), false};
      const Cell cell = test::randomCell(random, map.geometry());
      map[cell] = static_cast<std::int8_t>(map[cell] == 100 ? 0 : 100);
      const auto now = std::make_shared<const OccupancyGrid>(map);
      updated.updateMap(now, {{cell.column, cell.row, 1, 1}});
      PathPlanner fresh(options);
      fresh.setMap(now);
      const Plan a = updated.plan(request);
      const Plan b = fresh.plan(request);
      ASSERT_EQ(a.status, b.status);
      ASSERT_EQ(a.message, b.message);
      ASSERT_EQ(a.cost, b.cost);
      ASSERT_EQ(a.path.poses.size(), b.path.poses.size());
    }
  }
}

// navigation2#4694, #2698: crash outside the map.
TEST(MapPlannerLaw, NoRequestCrashesAndWhatIsFoundLeadsFromEndToEnd) {
  std::mt19937 random(4694);
  int found = 0;
  for (int trial = 0; trial < 1000; ++trial) {
    const OccupancyGrid map = test::randomOccupancy(random, 12, 0.2, 0.2);
    PlannerOptions options = randomOptions(random);
    options.costmap.kernel_rule = random() % 2 ? KernelRule::FILTER2D : KernelRule::CONSERVATIVE;
    options.tolerance = static_cast<double>(random() % 3);
    options.start_escape_radius = static_cast<double>(random() % 2);
    PathPlanner planner(options);
    planner.setMap(std::make_shared<const OccupancyGrid>(map));
    PoseRequest request{randomPose(random, map.geometry(), 3.0),
                        randomPose(random, map.geometry(), 3.0), true};
    if (trial % 50 == 0) request.goal.position.x() = 1e300;
    if (trial % 50 == 1) request.start.position.y() = -1e18;
    const Plan report = planner.plan(request);
    EXPECT_FALSE(report.message.empty());
    EXPECT_EQ(report.path.empty(), report.status != Status::FOUND);
    if (trial % 50 < 2) {
      EXPECT_NE(report.status, Status::FOUND) << "of a pose beyond everything";
    }
    if (report.status != Status::FOUND) continue;
    ++found;
    const auto apart = [](const Pose& a, const Pose& b) {
      return (a.position - b.position).head<2>().norm();
    };
    EXPECT_EQ(apart(report.path.poses.front(), request.start), 0.0) << trial;
    EXPECT_LE(apart(report.path.poses.back(), request.goal), options.tolerance + 1e-9) << trial;
  }
  EXPECT_GT(found, 40);
}

}  // namespace
}  // namespace grid_path_planner::planning
