// Plans on given costs for a vehicle with a footprint: `use_footprint`.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "planning/cost_planner.h"
#include "support/ascii_map.h"
#include "support/error_text.h"
#include "support/footprint_reference.h"
#include "support/random_footprints.h"
#include "vehicle/footprint.h"

namespace grid_path_planner::planning {

using base::Status;
using grid::Cell, grid::Grid, grid::OccupancyGrid;
using path::Pose;
using test::AsciiMap, test::contains, test::largestOverlap;

namespace {

using Corners = std::vector<Eigen::Vector2d>;

constexpr double kTouchedByCosts = 1e-5;

// As costmap_2d's static and inflation layer make them: 253 where the centre is no farther than `inscribed` from that of a
// lethal cell, falling beyond.
Grid<Cost> costmapOf(const OccupancyGrid& map, double inscribed) {
  constexpr int kReach = 8;
  const double cell = map.geometry().resolution();
  Grid<Cost> costs(map.geometry());
  for (int row = 0; row < map.height(); ++row)
    for (int column = 0; column < map.width(); ++column) {
      double nearest = kReach;
      for (int y = std::max(0, row - kReach); y < std::min(map.height(), row + kReach + 1); ++y)
        for (int x = std::max(0, column - kReach); x < std::min(map.width(), column + kReach + 1);
             ++x)
          if (map[Cell{x, y}] == 100) nearest = std::min(nearest, std::hypot(x - column, y - row));
      const double distance = nearest * cell;
      costs[Cell{column, row}] =
          nearest == 0.0 ? kLethalCost
          : distance <= inscribed
              ? kInscribedCost
              : static_cast<Cost>(252.0 * std::exp(-5.0 * (distance - inscribed)));
    }
  return costs;
}

double inscribedRadius(const Corners& corners) {
  return vehicle::Footprint("footprint", corners).inscribedRadius();
}

struct CostQuestion {
  OccupancyGrid map;
  Corners corners;
  PoseRequest request;
  CostPlannerOptions options = {};

  CostQuestion(const OccupancyGrid& of, const Corners& vehicle) : map(of), corners(vehicle) {
    options.use_footprint = true;
  }
  Plan plan() const {
    CostPlanner planner(options);
    const double inscribed = inscribedRadius(corners);
    planner.setCosts(map.geometry(), costmapOf(map, inscribed).values().data(), inscribed);
    planner.setFootprint(corners);
    return planner.plan(request, options.default_tolerance);
  }
  double overlap(const Plan& plan) const {
    return largestOverlap(corners, plan.path, request.start.yaw, options.heading, 0.02, map);
  }
};

// A wall with a door of 0.6 m, straight ahead, and one of 1.6 m farther off.
CostQuestion twoDoors(const Corners& vehicle) {
  std::vector<std::string> lines(50, "..............................");
  for (std::size_t row = 0; row < lines.size(); ++row)
    if ((row < 10 || row >= 16) && (row < 30 || row >= 46)) lines[row][15] = '#';
  lines[12][3] = 'S';
  lines[12][27] = 'G';
  const AsciiMap picture(lines, 0.1);
  CostQuestion question(picture.map, vehicle);
  question.options.weights.inflation_weight = 1;  // the shortest path, whatever it costs
  question.request.start.position << picture.map.geometry().centre(picture.start), 0.0;
  question.request.goal.position << picture.map.geometry().centre(picture.goal), 0.0;
  return question;
}

// Driving sideways it is 1.2 m wide.
TEST(CostPlannerFootprint, AWideVehicleTakesTheWiderDoor) {
  CostQuestion question = twoDoors({{0.6, 0.2}, {-0.6, 0.2}, {-0.6, -0.2}, {0.6, -0.2}});
  question.options.heading = path::HeadingMode::LEFTWARD;
  question.request.start.yaw = question.request.goal.yaw = M_PI / 2.0;
  const Plan plan = question.plan();
  ASSERT_TRUE(plan.found()) << plan.message;
  EXPECT_TRUE(contains(plan.message, "the footprint fits, at try")) << plan.message;
  EXPECT_GT(plan.length_m, 3.5) << "through the door that is farther off";
  EXPECT_LT(question.overlap(plan), kTouchedByCosts);

  question.options.use_footprint = false;
  const Plan narrow = question.plan();
  ASSERT_TRUE(narrow.found());
  EXPECT_LT(narrow.length_m, 2.6);
  EXPECT_GT(question.overlap(narrow), 0.5);
}

TEST(CostPlannerFootprint, WhereNoneFitsTheSentenceSaysWhere) {
  CostQuestion question = twoDoors({{0.9, 0.2}, {-0.9, 0.2}, {-0.9, -0.2}, {0.9, -0.2}});
  question.options.heading = path::HeadingMode::LEFTWARD;
  question.request.start.yaw = question.request.goal.yaw = M_PI / 2.0;
  Plan plan = question.plan();
  EXPECT_EQ(plan.status, Status::UNREACHABLE);
  EXPECT_TRUE(contains(plan.message, "the footprint meets the occupied cell at (1.55,"))
      << plan.message;
  question.request.start.yaw = 0.0;
  question.request.start.position << 0.9, 2.25, 0.0;  // before the wall, looking at it
  plan = question.plan();
  EXPECT_EQ(plan.status, Status::START_OCCUPIED) << plan.message;
  EXPECT_TRUE(contains(plan.message, "heading 0 deg: the footprint meets")) << plan.message;
}

TEST(CostPlannerFootprint, AFootprintThatIsNoneIsAnAnswerAndCostsNothingWithoutTheOption) {
  CostQuestion question = twoDoors({{0.2, 0.2}, {-0.2, 0.2}, {-0.2, -0.2}, {0.2, -0.2}});
  CostPlanner planner(question.options);
  const Grid<Cost> costs = costmapOf(question.map, 0.2);
  planner.setCosts(costs.geometry(), costs.values().data(), 0.2);
  Plan plan = planner.plan(question.request, 0.0);
  EXPECT_EQ(plan.status, Status::INVALID_REQUEST);
  EXPECT_EQ(plan.message, "the costmap's footprint needs 3 to 1000 corners, got 0");
  planner.setFootprint(Corners(16, {0.0, 0.0}));  // costmap_2d's for robot_radius 0
  EXPECT_TRUE(contains(planner.plan(question.request, 0.0).message, "twice"));
  planner.setFootprint(question.corners);
  EXPECT_TRUE(planner.plan(question.request, 0.0).found());
  planner.setFootprint({});
  question.options.use_footprint = false;
  planner.setOptions(question.options);
  EXPECT_TRUE(planner.plan(question.request, 0.0).found());
}

TEST(CostPlannerFootprint, LawNoPathMeetsALethalCell) {
  const unsigned seed = 1702;
  SCOPED_TRACE(seed);
  std::mt19937 random(seed);
  int found = 0, later = 0, met_without = 0;
  for (int trial = 0; trial < 60; ++trial) {
    CostQuestion question(test::randomRooms(random, 0.0), test::randomVehicle(random));
    std::uniform_real_distribution<double> aside(-0.4, 0.4), yaw(-M_PI, M_PI);
    for (Pose* pose : {&question.request.start, &question.request.goal}) {
      const double x = 2.0 * (random() % 3) + 1.0 + aside(random);  // about the middle of a room
      const double y = 2.0 * (random() % 3) + 1.0 + aside(random);
      pose->position << x - 1.3, y + 0.7, 0.0;
      pose->yaw = yaw(random);
    }
    question.options.weights.allow_unknown = trial % 2 == 0;
    const Plan plan = question.plan();
    ASSERT_NE(plan.status, Status::INVALID_REQUEST) << plan.message;
    if (plan.found()) {
      ++found;
      later += contains(plan.message, "at try") || contains(plan.message, "circumscribed");
      ASSERT_LT(question.overlap(plan), kTouchedByCosts)
          << "trial " << trial << ": " << plan.message;
    }
    question.options.use_footprint = false;
    const Plan disc = question.plan();
    met_without += disc.found() && question.overlap(disc) > kTouchedByCosts;
  }
  EXPECT_GT(found, 15);
  EXPECT_GT(later, 3) << "found by later tries";
  EXPECT_GT(met_without, 15) << "of paths that only the inscribed radius was asked for";
  std::printf("found %d, by later tries %d, without the footprint %d meet something\n", found,
              later, met_without);
}

}  // namespace
}  // namespace grid_path_planner::planning
