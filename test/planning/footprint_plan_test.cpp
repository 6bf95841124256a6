// Plans for a vehicle that is not round: what fits, what does not and how that is said.
#include <gtest/gtest.h>

#include "grid_path_planner/planning/path_planner.h"
#include "grid_path_planner/planning/unused_options.h"
#include "planning/explanation.h"
#include "planning/via/via_plan.h"
#include "support/ascii_map.h"
#include "support/error_text.h"
#include "support/footprint_reference.h"

namespace grid_path_planner::planning {

using base::Status;
using base::StopToken;
using costmap::Outside;
using grid::Cell;
using grid::GridGeometry;
using grid::OccupancyGrid;
using path::HeadingMode;
using test::AsciiMap;
using test::contains;
using test::errorText;
using test::largestOverlap;

namespace {

using Corners = std::vector<Eigen::Vector2d>;

std::string footprintText(const Corners& corners) {
  std::string text;
  for (const Eigen::Vector2d& corner : corners)
    text += (text.empty() ? "[[" : ", [") + std::to_string(corner.x()) + ", " +
            std::to_string(corner.y()) + "]";
  return text + "]";
}

Corners rectangularVehicle(double length, double width) {
  const double x = length / 2.0, y = width / 2.0;
  return {{x, y}, {-x, y}, {-x, -y}, {x, -y}};
}

struct FootprintQuestion {
  OccupancyGrid map;
  Corners corners;
  PoseRequest request;
  PlannerOptions options = {};

  FootprintQuestion(const AsciiMap& picture, const Corners& vehicle)
      : map(picture.map), corners(vehicle) {
    options.footprint = footprintText(corners);
    request.start.position << map.geometry().centre(picture.start), 0.0;
    request.goal.position << map.geometry().centre(picture.goal), 0.0;
  }
  Plan plan() const {
    PathPlanner planner(options);
    planner.setMap(std::make_shared<const OccupancyGrid>(map));
    return planner.plan(request);
  }
  double overlap(const Plan& plan) const {
    return largestOverlap(corners, plan.path, request.start.yaw, options.heading, 0.02, map);
  }
};

constexpr double kTouchedCells = 1e-6;  // cells

// The first leg and the second are 0.9 m wide.
AsciiMap corridorWithACorner() {
  std::vector<std::string> lines(11, "........................");
  lines.front() = lines.back() = "########################";
  lines[10].replace(15, 9, 9, '.');
  for (std::size_t i = 1; i < 10; ++i) lines[i] = "#......................#";
  lines[5][9] = 'S';
  for (int row = 0; row < 20; ++row) lines.push_back("###############.........");
  lines[26][19] = 'G';
  return AsciiMap(lines, 0.1);
}

TEST(FootprintPlan, aShortVehicleTurnsInTheCorridorALongOneDoesNot) {
  FootprintQuestion question(corridorWithACorner(), rectangularVehicle(0.8, 0.4));
  question.request.goal.yaw = M_PI / 2;
  const Plan shorter = question.plan();
  ASSERT_EQ(Status::FOUND, shorter.status) << shorter.message;
  EXPECT_LT(question.overlap(shorter), kTouchedCells);

  FootprintQuestion longer(corridorWithACorner(), rectangularVehicle(1.5, 0.4));
  longer.request.goal.yaw = M_PI / 2;
  const Plan none = longer.plan();
  EXPECT_EQ(Status::UNREACHABLE, none.status) << none.message;
  EXPECT_TRUE(contains(none.message, "the footprint meets the occupied cell at (")) << none.message;
  EXPECT_TRUE(contains(none.message, ", heading ")) << none.message;
  EXPECT_TRUE(contains(none.message, "the circumscribed radius of 0.7762 m")) << none.message;
  EXPECT_TRUE(none.path.empty());

  longer.request.goal.position = longer.request.start.position + Eigen::Vector3d(0.4, 0.0, 0.0);
  longer.request.goal.yaw = 0.0;
  EXPECT_EQ(Status::FOUND, longer.plan().status) << "straight on";
}

// 0.5 m wide: its inscribed radius of 0.2 m passes, its circumscribed one of 0.54 m does not.
AsciiMap doorOfHalfAMetre() {
  return AsciiMap({"................#...............",  //
                   "................#...............",  //
                   "................#...............",  //
                   "................#...............",  //
                   "................#...............",  //
                   "................#...............",  //
                   "................#...............",  //
                   "................#...............",  //
                   "................................",  //
                   "................................",  //
                   "................................",  //
                   "................................",  //
                   "................................",  //
                   "................#...............",  //
                   "................#...............",  //
                   "......S.........#.........G.....",  //
                   "................#...............",  //
                   "................#...............",  //
                   "................#...............",  //
                   "................#...............",  //
                   "................#..............."},
                  0.1);
}

TEST(FootprintPlan, drivesStraightThroughADoor) {
  const FootprintQuestion question(doorOfHalfAMetre(), rectangularVehicle(1.0, 0.4));
  const Plan plan = question.plan();
  ASSERT_EQ(Status::FOUND, plan.status) << plan.message;
  EXPECT_LT(question.overlap(plan), kTouchedCells) << plan.message;
  EXPECT_TRUE(contains(plan.message, "the footprint fits, at try ")) << plan.message;
  EXPECT_GT(plan.costValue(), 0.0);
  EXPECT_LT(plan.costValue(), 60.0) << "the price of the map, not of the tries";
  EXPECT_FALSE(plan.optimal);

  FootprintQuestion disc = question;
  disc.options.footprint.clear();
  disc.options.costmap.radius = 0.54;
  EXPECT_EQ(Status::UNREACHABLE, disc.plan().status);
}

TEST(FootprintPlan, everyHeadingModeAndSmoothingIsChecked) {
  for (const auto& mode : choicesOf(HeadingMode{}))
    for (const bool smooth : {false, true}) {
      FootprintQuestion question(doorOfHalfAMetre(), rectangularVehicle(0.6, 0.4));
      question.options.heading = mode.second;
      question.options.smooth = smooth;
      question.request.start.yaw = 2.0;
      question.request.goal.yaw = -1.0;
      const Plan plan = question.plan();
      const bool tangent = mode.second == HeadingMode::NONE;
      if (plan.found() && !tangent) {
        EXPECT_LT(question.overlap(plan), kTouchedCells) << mode.first << smooth << plan.message;
      }
      if (mode.second == HeadingMode::FORWARD) {
        EXPECT_TRUE(plan.found()) << plan.message;
      }
    }
}

TEST(FootprintPlan, theGoalCountsWithItsHeading) {
  FootprintQuestion question(AsciiMap({"................",  //
                                       "................",  //
                                       "..S.............",  //
                                       "................",  //
                                       "............G...",  //
                                       "................",  //
                                       "################"},
                                      0.2),
                             rectangularVehicle(0.9, 0.3));
  EXPECT_EQ(Status::FOUND, question.plan().status) << "along the wall";
  question.request.goal.yaw = M_PI / 2;
  const Plan across = question.plan();
  EXPECT_EQ(Status::GOAL_OCCUPIED, across.status);
  EXPECT_TRUE(contains(across.message,
                       "goal (2.5, 0.9) with heading 90 deg: the footprint meets "
                       "the occupied cell at (2.3, 1.3)"))
      << across.message;
  question.options.tolerance = 0.5;
  const Plan beside = question.plan();
  ASSERT_EQ(Status::FOUND, beside.status) << beside.message;
  EXPECT_LT(question.overlap(beside), kTouchedCells);
  EXPECT_DOUBLE_EQ(M_PI / 2, beside.path.poses.back().yaw);
}

TEST(FootprintPlan, aStartThatMeetsAnObstacleIsOccupied) {
  FootprintQuestion question(AsciiMap({"........",  //
                                       "...S..G.",  //
                                       "........"},
                                      0.5),
                             rectangularVehicle(1.8, 0.4));
  question.map[Cell{2, 1}] = 100;
  question.map[Cell{2, 0}] = 100;
  const Plan plan = question.plan();
  EXPECT_EQ(Status::START_OCCUPIED, plan.status);
  EXPECT_TRUE(contains(plan.message, "start (1.75, 0.75) with heading 0 deg: the footprint meets "))
      << plan.message;
}

// It stands free, and would swing its rear into a pillar to either side.
TEST(FootprintPlan, theFirstTurnIsSwept) {
  FootprintQuestion question(AsciiMap({".........",  //
                                       "..#......",  //
                                       "....S....",  //
                                       "..#......",  //
                                       ".........",  //
                                       ".........",  //
                                       "....G....",  //
                                       ".........",  //
                                       "........."},
                                      1.0),
                             {{0.4, 0.4}, {-2.4, 0.4}, {-2.4, -0.4}, {0.4, -0.4}});
  question.request.goal.yaw = M_PI / 2;
  const Plan plan = question.plan();
  if (plan.found()) {
    EXPECT_LT(question.overlap(plan), kTouchedCells) << plan.message;
    EXPECT_GT(plan.path.poses[1].position.x(), 4.5) << "first away from the pillars";
  }
  question.map[Cell{6, 2}] = 100;  // nor can it drive on
  const Plan none = question.plan();
  EXPECT_EQ(Status::UNREACHABLE, none.status) << none.message;
  EXPECT_TRUE(contains(none.message, "turning on the spot")) << none.message;
}

// A goal beside unknown cells is replaced; since the footprint would have reached into them there, it was let
// into them all along the path, also where it cannot turn without.
TEST(FootprintPlan, aGoalThatIsReplacedLetsTheFootprintIntoNoUnknownCells) {
  FootprintQuestion question(corridorWithACorner(), rectangularVehicle(1.5, 0.4));
  const OccupancyGrid walls = question.map;
  for (int row = 0; row < walls.height(); ++row)
    for (int column = 0; column < walls.width(); ++column)
      if (walls[Cell{column, row}] == 100) question.map[Cell{column, row}] = -1;
  question.options.costmap.unknown_is_passable = false;
  question.options.costmap.outside = Outside::FREE;
  question.options.tolerance = 0.5;
  question.request.goal.yaw = M_PI / 2;
  const Plan in_the_middle = question.plan();
  EXPECT_EQ(Status::UNREACHABLE, in_the_middle.status) << in_the_middle.message;
  question.request.goal.position.x() = 1.65;
  const Plan replaced = question.plan();
  EXPECT_EQ(Status::UNREACHABLE, replaced.status) << replaced.message;
  EXPECT_TRUE(contains(replaced.message, "the footprint meets the unknown cell"))
      << replaced.message;

  question.request.start.position << 1.95, 2.2, 0.0;
  question.request.start.yaw = M_PI / 2;
  const Plan straight = question.plan();
  ASSERT_EQ(Status::FOUND, straight.status) << straight.message;
  EXPECT_TRUE(contains(straight.message, "the path ends")) << straight.message;
  EXPECT_FALSE(contains(straight.message, "may reach into")) << straight.message;
}

TEST(FootprintPlan, unknownCellsAndTheBorderCountAsForARadius) {
  FootprintQuestion question(AsciiMap({"..........",  //
                                       "..S.......",  //
                                       "..........",  //
                                       "?????.????",  //
                                       "..........",  //
                                       "......G...",  //
                                       ".........."},
                                      0.5),
                             rectangularVehicle(1.2, 0.8));
  EXPECT_EQ(Status::FOUND, question.plan().status) << "unknown cells are passable";
  question.options.costmap.unknown_is_passable = false;
  question.options.costmap.unknown_weight = 1;
  const Plan none = question.plan();
  EXPECT_NE(Status::FOUND, none.status);
  question.options.costmap.unknown_is_passable = true;
  question.options.costmap.outside = Outside::OCCUPIED;
  question.request.start.position << 0.5, 0.5, 0.0;
  const Plan at_border = question.plan();
  EXPECT_EQ(Status::FOUND, at_border.status);
  EXPECT_TRUE(contains(at_border.message, "the footprint may reach into the outside of the map"))
      << at_border.message;
}

TEST(FootprintPlan, radiusCountsAboveTheInscribedOne) {
  FootprintQuestion question(doorOfHalfAMetre(), rectangularVehicle(0.42, 0.40));
  const auto clearance = [&] {
    PathPlanner planner(question.options);
    return planner.searchedOptions().costmap.radius;
  };
  EXPECT_DOUBLE_EQ(0.2, clearance());
  question.options.costmap.radius = 0.1;
  EXPECT_DOUBLE_EQ(0.2, clearance());
  ASSERT_EQ(1u, unusedOptions(question.options).size());
  EXPECT_EQ("radius", unusedOptions(question.options)[0].name);
  question.options.costmap.radius = 0.3;
  EXPECT_DOUBLE_EQ(0.3, clearance());
  EXPECT_TRUE(unusedOptions(question.options).empty());
  EXPECT_EQ(Status::UNREACHABLE, question.plan().status) << "0.6 m do not pass the door";
}

TEST(FootprintPlan, contradictionsAreRefused) {
  PlannerOptions options;
  options.footprint = "[[1, 1], [2, 2]]";
  EXPECT_EQ("footprint needs 3 to 1000 corners, got 2",
            errorText([&] { checkPlannerOptions(options); }));
  options.footprint = "[[1, 1], [-1, 1], [0, -1]]";
  options.costmap.occupied_is_passable = true;
  EXPECT_TRUE(contains(errorText([&] { checkPlannerOptions(options); }),
                       "occupied_is_passable needs an empty footprint"));
}

// The cause is in the message: the narrowest gap for a round vehicle would mislead.
TEST(FootprintPlan, whatOnlyTheFootprintHindersIsNotExplainedOtherwise) {
  FootprintQuestion question(corridorWithACorner(), rectangularVehicle(1.5, 0.4));
  question.request.goal.yaw = M_PI / 2;
  PathPlanner planner(question.options);
  planner.setMap(std::make_shared<const OccupancyGrid>(question.map));
  const Plan plan = planner.plan(question.request);
  ASSERT_EQ(Status::UNREACHABLE, plan.status);
  EXPECT_EQ("", explainFailure(planner, question.request, plan.status, StopToken()).text);
}

TEST(FootprintPlan, viaPointsArePassedWithTheHeadingOfThePath) {
  const FootprintQuestion question(doorOfHalfAMetre(), rectangularVehicle(1.0, 0.4));
  PathPlanner planner(question.options);
  planner.setMap(std::make_shared<const OccupancyGrid>(question.map));
  ViaRequest request;
  request.start = question.request.start;
  request.goal = question.request.goal;
  request.via = {{1.65, 1.05, 0.0}, {2.65, 0.65, 0.0}};  // in the door, behind it
  const Plan plan = planThrough(planner, request).plan;
  ASSERT_EQ(Status::FOUND, plan.status) << plan.message;
  EXPECT_LT(question.overlap(plan), kTouchedCells) << plan.message;
}

// A door that closes to 0.3 m is not seen at the path's cells, which keep the inscribed radius.
TEST(FootprintPlan, aNewObstacleBesideThePathIsTold) {
  FootprintQuestion question(doorOfHalfAMetre(), rectangularVehicle(1.0, 0.4));
  PathPlanner planner(question.options);
  planner.setMap(std::make_shared<const OccupancyGrid>(question.map));
  const Plan plan = planner.plan(question.request);
  ASSERT_TRUE(plan.found());
  EXPECT_EQ("", planner.footprintContact(plan.path, 0.0, StopToken()));
  question.map[Cell{23, 15}] = 100;
  question.map[Cell{8, 15}] = 100;
  planner.setMap(std::make_shared<const OccupancyGrid>(question.map));
  EXPECT_TRUE(contains(planner.footprintContact(plan.path, 0.0, StopToken()),
                       "the footprint meets the occupied cell at (0.85, 1.55)"));
}

}  // namespace
}  // namespace grid_path_planner::planning
