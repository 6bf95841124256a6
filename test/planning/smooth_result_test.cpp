#include "grid_path_planner/planning/smooth_result.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "grid_path_planner/base/errors.h"
#include "grid_path_planner/planners/planner_factory.h"
#include "grid_path_planner/planning/path_planner.h"
#include "support/cost_maps.h"
#include "support/random_map.h"

namespace grid_path_planner::planning {

using base::Status;
using base::StopToken;
using costmap::Connectivity;
using costmap::CostGrid;
using costmap::DiagonalCost;
using costmap::ExactCost;
using costmap::lineCost;
using costmap::lineOfSight;
using costmap::MotionModel;
using costmap::SegmentPoint;
using grid::Cell;
using grid::CellRect;
using grid::Grid;
using grid::GridGeometry;
using grid::OccupancyGrid;
using planners::makePlanner;
using planners::SearchResult;

namespace {

SearchResult planOn(const std::shared_ptr<const CostGrid>& map, const std::string& name, Cell start,
                    Cell goal) {
  const auto planner = makePlanner(name);
  planner->prepare(map, StopToken());
  return planner->search({start, {goal}, false}, StopToken());
}

double costOf(const CostGrid& map, const std::vector<SegmentPoint>& points) {
  double cost = 0.0;
  for (std::size_t i = 1; i < points.size(); ++i) {
    EXPECT_TRUE(lineOfSight(map, points[i - 1], points[i]));
    cost += lineCost(map, points[i - 1], points[i]);
  }
  return cost;
}

double lengthOf(const std::vector<SegmentPoint>& points) {
  double length = 0.0;
  for (std::size_t i = 1; i < points.size(); ++i)
    length += std::hypot(points[i].x - points[i - 1].x, points[i].y - points[i - 1].y);
  return length / SegmentPoint::kUnitsPerCell;
}

// In rad.
double turningOf(const std::vector<SegmentPoint>& points) {
  double turning = 0.0;
  for (std::size_t i = 2; i < points.size(); ++i) {
    const auto heading = [&](std::size_t to) {
      return std::atan2(points[to].y - points[to - 1].y, points[to].x - points[to - 1].x);
    };
    turning += std::abs(std::remainder(heading(i) - heading(i - 1), 2.0 * M_PI));
  }
  return turning;
}

// Zigzags (path/zigzags.h) may cost their length.
TEST(SmoothResultLaw, SegmentsAreLegalAndNoCostRisesByMoreThanRoundingHides) {
  std::mt19937 random(9);
  double before = 0.0, after = 0.0;
  int found = 0;
  for (int trial = 0; trial < 600; ++trial) {
    SCOPED_TRACE("trial " + std::to_string(trial));
    MotionModel motion;
    motion.cut_corners = trial % 5 == 0;
    const auto map = std::make_shared<const CostGrid>(test::randomCosts(random, 40, motion));
    const Cell start = test::randomCell(random, map->geometry());
    const Cell goal = test::randomCell(random, map->geometry());
    const bool any_angle = trial % 3 == 0;
    const SearchResult raw = planOn(map, any_angle ? "lazy_theta_star" : "a_star", start, goal);
    if (raw.status != Status::FOUND) continue;
    ++found;
    SearchResult smooth = raw;
    smoothResult(*map, smooth, StopToken());
    ASSERT_EQ(smooth.points.size(), smooth.cells.size());
    EXPECT_EQ(smooth.points.front(), SegmentPoint::centreOf(start));
    EXPECT_EQ(smooth.points.back(), SegmentPoint::centreOf(goal));
    EXPECT_EQ(smooth.cost, ExactCost());
    EXPECT_NEAR(smooth.costValue(), costOf(*map, smooth.points), 1e-9 * smooth.costValue());
    EXPECT_LE(smooth.costValue(), raw.costValue() * (1.0 + 1e-12) + lengthOf(smooth.points));
    before += raw.costValue();
    after += smooth.costValue();
  }
  EXPECT_GT(found, 200);
  EXPECT_LT(after, 0.99 * before);
}

// A corridor of 1.8 m, turned by `angle`, whose middle is the map's.
OccupancyGrid corridor(double angle) {
  OccupancyGrid map(GridGeometry(240, 240, 0.05), 0);
  const Eigen::Vector2d across(-std::sin(angle), std::cos(angle)), middle(6.0, 6.0);
  for (int row = 0; row < map.height(); ++row)
    for (int column = 0; column < map.width(); ++column) {
      const double from = across.dot(map.geometry().centre({column, row}) - middle);
      if (std::abs(from) > 0.9) map[Cell{column, row}] = 100;
    }
  return map;
}

// A newcomer's map had a yaw and the demo's weights: 51.8 rad of turning in a straight corridor, since the middle of
// least weight, 2 between 3, is a staircase of cells.
TEST(SmoothResult, ACorridorAtAnyAngleIsDrivenStraight) {
  costmap::CostmapOptions options;
  options.radius = 0.4;
  options.decay = 4.0;
  options.inflation_weight = 10;
  options.outside = costmap::Outside::FREE;
  for (int degrees = 0; degrees <= 45; degrees += 3) {
    const double angle = degrees * M_PI / 180.0;
    const auto map = test::costsOf(corridor(angle), options);
    const Eigen::Vector2d along = 4.0 * Eigen::Vector2d(std::cos(angle), std::sin(angle));
    const auto cell = [&](const Eigen::Vector2d& at) { return *map->geometry().cellAt(at); };
    SearchResult path = planOn(map, "a_star", cell(Eigen::Vector2d(6.0, 6.0) - along),
                               cell(Eigen::Vector2d(6.0, 6.0) + along));
    ASSERT_EQ(path.status, Status::FOUND);
    smoothResult(*map, path, StopToken());
    EXPECT_LT(turningOf(path.points), 1.0) << degrees << " degrees";
  }
}

// On maps of one weight nothing is shorter than anya, and none of the others far from it.
TEST(SmoothResultLaw, AnyaIsNoLongerThanTheOthers) {
  std::mt19937 random(10);
  double shortest = 0.0, smooth_ones = 0.0;
  int found = 0;
  for (int trial = 0; trial < 300; ++trial) {
    SCOPED_TRACE("trial " + std::to_string(trial));
    Grid<CostGrid::Weight> weights(GridGeometry(60, 60, 1.0), 1);
    for (int i = 0; i < 40; ++i) {
      const Cell low = test::randomCell(random, weights.geometry());
      const CellRect rect = CellRect{low.column, low.row, 1 + static_cast<int>(random() % 9),
                                     1 + static_cast<int>(random() % 9)}
                                .intersection(weights.geometry().rect());
      for (int row = rect.row; row < rect.row + rect.height; ++row)
        std::fill_n(weights.row(row) + rect.column, rect.width, CostGrid::kBlocked);
    }
    const auto map = test::costsOf(weights);
    const Cell start = test::randomCell(random, map->geometry());
    const Cell goal = test::randomCell(random, map->geometry());
    const SearchResult anya = planOn(map, "anya", start, goal);
    SearchResult smooth = planOn(map, "a_star", start, goal);
    ASSERT_EQ(anya.status, smooth.status);
    if (anya.status != Status::FOUND) continue;
    ++found;
    const double slack = 1e-9;
    EXPECT_GE(anya.costValue() + slack,
              std::hypot(start.column - goal.column, start.row - goal.row));
    smoothResult(*map, smooth, StopToken());
    EXPECT_LE(anya.costValue(), smooth.costValue() + slack);
    EXPECT_LE(anya.costValue(), planOn(map, "lazy_theta_star", start, goal).costValue() + slack);
    shortest += anya.costValue();
    smooth_ones += smooth.costValue();
  }
  EXPECT_GT(found, 100);
  EXPECT_LT(smooth_ones, 1.03 * shortest);
}

// A map of 20x10 cells of one metre.
PoseRequest across() {
  PoseRequest request;
  request.start.position << 0.5, 0.5, 0.0;
  request.goal.position << 18.5, 8.5, 0.0;
  return request;
}

TEST(SmoothOption, StraightensThePathWhereLinesCompareWithSteps) {
  OccupancyGrid map(GridGeometry(20, 10, 1.0), 0);
  PlannerOptions options;
  PathPlanner planner(options);
  planner.setMap(std::make_shared<const OccupancyGrid>(map));
  const Plan report = planner.plan(across());
  ASSERT_EQ(report.status, Status::FOUND);
  EXPECT_EQ(report.path.poses.size(), 2U);
  EXPECT_NEAR(report.length_m, std::hypot(18, 8), 1e-9);
  EXPECT_NEAR(report.costValue(), std::hypot(18, 8), 1e-9);
  options.costmap.motion.connectivity = Connectivity::FOUR;
  planner.setOptions(options);
  EXPECT_NEAR(planner.plan(across()).length_m, 18.0 + 8.0, 1e-9);
  options.costmap.motion = {};
  options.costmap.motion.diagonal_cost = DiagonalCost::UNIT;
  planner.setOptions(options);
  EXPECT_NEAR(planner.plan(across()).costValue(), 18.0, 1e-9);
}

TEST(SmoothOption, LeavesThePromiseOfPathsThatAreTautAlready) {
  OccupancyGrid map(GridGeometry(20, 10, 1.0), 0);
  map[{9, 4}] = 100;
  PlannerOptions options;
  options.planner = "polyanya";
  PathPlanner planner(options);
  planner.setMap(std::make_shared<const OccupancyGrid>(map));
  EXPECT_TRUE(planner.plan(across()).optimal);
}

}  // namespace
}  // namespace grid_path_planner::planning
