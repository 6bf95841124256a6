// Why there is no path: the narrowest gap, unknown cells, the nearest place in reach.
#include "planning/explanation.h"

#include <gtest/gtest.h>

#include <random>

#include "grid_path_planner/base/option_text.h"
#include "support/ascii_map.h"
#include "support/error_text.h"
#include "support/random_map.h"

namespace grid_path_planner::planning {

using base::Status;
using base::StopToken;
using costmap::Outside;
using grid::GridGeometry;
using grid::OccupancyGrid;

namespace {

using test::AsciiMap;
using test::contains;

struct Question {
  OccupancyGrid map;
  PlannerOptions options;
  PoseRequest request;

  Plan plan(double radius) const {
    PlannerOptions smaller = options;
    smaller.costmap.radius = radius;
    PathPlanner planner(smaller);
    planner.setMap(std::make_shared<const OccupancyGrid>(map));
    return planner.plan(request);
  }
  Explanation explained(Status status) const {
    PathPlanner planner(options);
    planner.setMap(std::make_shared<const OccupancyGrid>(map));
    return explainFailure(planner, request, status, StopToken());
  }
};

PoseRequest between(const GridGeometry& geometry, grid::Cell start, grid::Cell goal) {
  PoseRequest request;
  request.start.position << geometry.centre(start), 0.0;
  request.goal.position << geometry.centre(goal), 0.0;
  return request;
}

Question questionOn(const AsciiMap& picture, double radius) {
  Question question{picture.map, {}, between(picture.map.geometry(), picture.start, picture.goal)};
  question.options.costmap.radius = radius;
  return question;
}

// A door of five cells of 0.1 m and one of two.
TEST(Explanation, NamesTheWiderOfTwoDoorsWithItsWidth) {
  const Question question = questionOn(AsciiMap({".....#.....",  //
                                                 ".....#.....",  //
                                                 "...........",  //
                                                 "...........",  //
                                                 ".S.......G.",  //
                                                 "...........",  //
                                                 "...........",  //
                                                 ".....#.....",  //
                                                 ".....#.....",  //
                                                 "...........",  //
                                                 "...........",  //
                                                 ".....#....."},
                                                0.1),
                                       0.4);
  ASSERT_EQ(question.plan(0.4).status, Status::UNREACHABLE);
  const Explanation why = question.explained(Status::UNREACHABLE);
  ASSERT_TRUE(why.gap);
  EXPECT_NEAR(why.gap->position.x(), 0.55, 1e-9);
  EXPECT_NEAR(why.gap->position.y(), 0.45, 0.011);
  EXPECT_NEAR(why.gap->width, 0.5, 0.011);
  EXPECT_NEAR(why.gap->largest_radius, 0.25, 1e-9);
  EXPECT_TRUE(contains(why.text, "wide; radius 0.4 m needs 0.8 m; 0.25 m would pass")) << why.text;
  EXPECT_EQ(question.plan(0.25).status, Status::FOUND);
}

// Its posts stand a cell apart along the wall: it was told as 1.9 m wide, since the line from one post through the
// middle of the narrowest cell misses the other.
TEST(Explanation, MeasuresADoorBetweenPostsThatDoNotFaceOneAnother) {
  const Question question = questionOn(AsciiMap({".......#......",  //
                                                 ".......#......",  //
                                                 ".......#......",  //
                                                 ".S..........G.",  //
                                                 "..............",  //
                                                 "..............",  //
                                                 "......#.......",  //
                                                 "......#.......",  //
                                                 "......#......."},
                                                0.1),
                                       0.2);
  ASSERT_EQ(question.plan(0.2).status, Status::UNREACHABLE);
  const Explanation why = question.explained(Status::UNREACHABLE);
  ASSERT_TRUE(why.gap);
  EXPECT_NEAR(why.gap->width, 0.3, 0.02) << why.text;
}

// A door as wide as the vehicle, whose middle is on the line between two cells: it said "is 0.4 m wide; radius 0.2 m
// needs 0.4 m".
TEST(Explanation, SaysThatNoCellsCentreLiesInTheMiddleOfTheGap) {
  const Question question = questionOn(AsciiMap({".....#.....",  //
                                                 ".S.......G.",  //
                                                 "...........",  //
                                                 "...........",  //
                                                 "...........",  //
                                                 ".....#....."},
                                                0.1),
                                       0.2);
  ASSERT_EQ(question.plan(0.2).status, Status::UNREACHABLE);
  const Explanation why = question.explained(Status::UNREACHABLE);
  EXPECT_TRUE(contains(why.text,
                       "is 0.4 m wide, but has no centre of a cell that is 0.2 m from "
                       "either side; 0.15 m would pass"))
      << why.text;
}

TEST(Explanation, SaysThatOnlyUnknownCellsLeadThere) {
  Question question = questionOn(AsciiMap({"S.#..",  //
                                           "..?.G",  //
                                           "..#.."}),
                                 0.0);
  question.options.costmap.unknown_is_passable = false;
  ASSERT_EQ(question.plan(0.0).status, Status::UNREACHABLE);
  const Explanation why = question.explained(Status::UNREACHABLE);
  EXPECT_TRUE(why.only_unknown);
  EXPECT_TRUE(contains(why.text, "only unknown cells lead there")) << why.text;
  ASSERT_TRUE(why.nearest);
  EXPECT_EQ(*why.nearest, Eigen::Vector2d(1.5, 1.5));
}

TEST(Explanation, SaysThatNoVehicleGetsThere) {
  const Explanation why =
      questionOn(AsciiMap({"S.#..", "..#.G", "..#.."}), 0.0).explained(Status::UNREACHABLE);
  EXPECT_FALSE(why.gap);
  EXPECT_FALSE(why.only_unknown);
  EXPECT_TRUE(contains(why.text, "for a vehicle of any size")) << why.text;
}

TEST(Explanation, NamesTheNearestPossibleGoal) {
  AsciiMap picture({"S....", ".....", "...##", "...#."});
  picture.goal = {4, 2};
  const Explanation why = questionOn(picture, 0.0).explained(Status::GOAL_OCCUPIED);
  ASSERT_TRUE(why.nearest);
  EXPECT_EQ(*why.nearest, Eigen::Vector2d(4.5, 1.5));
  EXPECT_TRUE(contains(why.text, "the nearest possible goal is (4.5, 1.5), 1 m from the goal"))
      << why.text;
}

TEST(Explanation, HasNothingToSayOfOtherFailures) {
  const Question question = questionOn(AsciiMap({"S.", ".G"}), 0.0);
  for (const Status status : {Status::FOUND, Status::START_OCCUPIED, Status::TIMEOUT})
    EXPECT_TRUE(question.explained(status).text.empty());
}

// Blocks with alleys between them, unknown cells in some, and a radius that is too large for them.
Question randomQuestion(std::mt19937& random) {
  const OccupancyGrid noise = test::randomOccupancy(random, 30, 0.02 + 0.004 * (random() % 20),
                                                    random() % 2 == 0 ? 0.02 : 0.0);
  const GridGeometry geometry(noise.width(), noise.height(), 0.1,
                              {-1.0, 2.0, random() % 2 == 0 ? 0.0 : 0.6});
  Question question{OccupancyGrid(geometry, noise.values()), {}, {}};
  costmap::CostmapOptions& costmap = question.options.costmap;
  costmap.radius = 0.05 + 0.01 * (random() % 30);
  costmap.unknown_is_passable = random() % 2 == 0;
  costmap.outside =
      std::vector<Outside>{Outside::FREE, Outside::UNKNOWN, Outside::OCCUPIED}[random() % 3];
  question.request =
      between(geometry, test::randomCell(random, geometry), test::randomCell(random, geometry));
  return question;
}

// Against plans with smaller and smaller radii: half an interval each.
double largestRadiusByPlans(const Question& question) {
  double passes = 0.0, fails = question.options.costmap.radius;
  while (fails - passes > 1e-5) {
    const double middle = 0.5 * (passes + fails);
    (question.plan(middle).found() ? passes : fails) = middle;
  }
  return passes;
}

TEST(ExplanationLaw, TheGapsRadiusIsTheLargestForWhichThereIsAPath) {
  std::mt19937 random(17);
  int gaps = 0, closed = 0;
  for (int i = 0; i < 4000 && (gaps < 150 || closed < 20); ++i) {
    const Question question = randomQuestion(random);
    if (question.plan(question.options.costmap.radius).status != Status::UNREACHABLE) continue;
    const Explanation why = question.explained(Status::UNREACHABLE);
    const bool passes_at_all = question.plan(0.0).found();
    ASSERT_EQ(why.gap.has_value(), passes_at_all)
        << "map " << i << ": " << why.text << '\n'
        << base::optionText(question.options.costmap) << question.plan(0.0).message;
    if (!why.gap) {
      ++closed;
      continue;
    }
    ++gaps;
    EXPECT_NEAR(why.gap->largest_radius, largestRadiusByPlans(question), 2e-5) << "map " << i;
    EXPECT_TRUE(question.plan(why.gap->largest_radius).found()) << "map " << i;
    EXPECT_FALSE(question.plan(why.gap->largest_radius * (1.0 + 1e-5)).found()) << "map " << i;
  }
  EXPECT_GE(gaps, 150);
  EXPECT_GE(closed, 20);
}

}  // namespace
}  // namespace grid_path_planner::planning
