// Plans on costs that are given, as a costmap_2d holds them.
#include "planning/cost_planner.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>

#include "grid_path_planner/costmap/line_of_sight.h"
#include "support/error_text.h"
#include "support/random_map.h"
#include "support/reference_search.h"

namespace grid_path_planner::planning {

using base::Status, base::StopSource;
using costmap::CostGrid, costmap::lineOfSight, costmap::SegmentPoint;
using grid::Cell, grid::CellIndex, grid::CellRect, grid::Grid, grid::GridGeometry;

namespace {

// '.' cost 0, '1' to '9' 28 times as much, 'i' inscribed, '#' lethal, '?' unknown, 'S' and 'G' the ends.
struct Picture {
  explicit Picture(const std::vector<std::string>& lines, double resolution = 1.0)
      : costs(GridGeometry(static_cast<int>(lines[0].size()), static_cast<int>(lines.size()),
                           resolution)) {
    for (int row = 0; row < costs.height(); ++row)
      for (int column = 0; column < costs.width(); ++column) {
        const char letter = lines[static_cast<std::size_t>(row)][static_cast<std::size_t>(column)];
        const Cell cell{column, row};
        costs[cell] = costOf(letter);
        if (letter == 'S') request.start.position.head<2>() = costs.geometry().centre(cell);
        if (letter == 'G') request.goal.position.head<2>() = costs.geometry().centre(cell);
      }
  }

  static Cost costOf(char letter) {
    if (letter == 'i') return kInscribedCost;
    if (letter == '#') return kLethalCost;
    if (letter == '?') return kUnknownCost;
    return letter >= '1' && letter <= '9' ? static_cast<Cost>(28 * (letter - '0')) : Cost{0};
  }

  Grid<Cost> costs;
  PoseRequest request;
};

Plan planOnPicture(const Picture& picture, const CostPlannerOptions& options = {}) {
  CostPlanner planner(options);
  planner.setCosts(picture.costs.geometry(), picture.costs.values().data(), 0.5);
  return planner.plan(picture.request, options.default_tolerance);
}

CostPlannerOptions unsmoothed() {
  CostPlannerOptions options;
  options.smooth = false;
  return options;
}

TEST(CostPlanner, TakesTheCheaperOfTwoPaths) {
  const Plan plan = planOnPicture(Picture({".....",  //
                                           "S999G",  //
                                           "....."}),
                                  unsmoothed());
  ASSERT_TRUE(plan.found()) << plan.message;
  EXPECT_DOUBLE_EQ(plan.costValue(), 2.0 + 2.0 * std::sqrt(2.0));
  EXPECT_EQ(planOnPicture(Picture({"#####",  //
                                   "S999G",  //
                                   "#####"}),
                          unsmoothed())
                .costValue(),
            4 * 40.0);
}

TEST(CostPlanner, EntersNothingInCollisionAndUnknownByWish) {
  const Picture closed({"S.i.G",  //
                        "..i..",  //
                        "..#.."});
  EXPECT_EQ(planOnPicture(closed).status, Status::UNREACHABLE);
  const Picture unknown({"S.?.G",  //
                         "..?.."});
  CostPlannerOptions options;
  const Plan through = planOnPicture(unknown, options);
  ASSERT_TRUE(through.found());
  EXPECT_TRUE(test::contains(through.message, "1 m of it through unknown cells"))
      << through.message;
  options.weights.allow_unknown = false;
  EXPECT_EQ(planOnPicture(unknown, options).status, Status::UNREACHABLE);
}

TEST(CostPlanner, NamesTheEndThatIsWrong) {
  Picture picture({"S.i",  //
                   "..#"});
  picture.request.goal.position.head<2>() << 2.5, 0.5;
  Plan plan = planOnPicture(picture);
  EXPECT_EQ(plan.status, Status::GOAL_OCCUPIED);
  EXPECT_EQ(plan.message, "goal (2.5, 0.5) is nearer than the radius of 0.5 m to an occupied cell");
  CostPlannerOptions tolerant;
  tolerant.default_tolerance = 1.0;
  plan = planOnPicture(picture, tolerant);
  ASSERT_TRUE(plan.found());
  EXPECT_EQ(plan.path.poses.back().position.x(), 1.5);

  std::swap(picture.request.start, picture.request.goal);
  plan = planOnPicture(picture);
  EXPECT_EQ(plan.status, Status::START_OCCUPIED) << "no passable centre is within 0.1 m";
  CostPlannerOptions escaping;
  escaping.start_escape_radius = 1.0;
  EXPECT_TRUE(planOnPicture(picture, escaping).found());

  picture.request.goal.position.x() = 7.0;
  EXPECT_EQ(planOnPicture(picture, escaping).status, Status::GOAL_OUTSIDE_MAP);
  picture.request.goal.position.x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(planOnPicture(picture, escaping).status, Status::INVALID_REQUEST);
  EXPECT_EQ(CostPlanner().plan({}, 0.0).status, Status::NO_MAP);
}

// Of the costs only 254 says where the obstacles are.
TEST(CostPlanner, AStartIsNotLeftThroughAnObstacle) {
  Picture picture({"..i#i..",  //
                   "G.S#i..",  //
                   "..i#i.."});
  const Cell start{2, 1};
  picture.costs[start] = kInscribedCost;
  CostPlannerOptions options;
  options.start_escape_radius = 3.0;
  const Plan away = planOnPicture(picture, options);
  ASSERT_TRUE(away.found()) << away.message;
  EXPECT_EQ(away.path.poses[1].position.head<2>(), Eigen::Vector2d(1.5, 1.5));
  picture.request.goal.position.head<2>() << 6.5, 1.5;
  EXPECT_EQ(planOnPicture(picture, options).status, Status::UNREACHABLE);
}

TEST(CostPlanner, CancelsAndPlansAgain) {
  const Picture picture({"S..G"});
  CostPlanner planner;
  planner.setCosts(picture.costs.geometry(), picture.costs.values().data(), 0.0);
  StopSource stop;
  stop.cancel();
  // A small map is done before anyone asks.
  Grid<Cost> large(GridGeometry(600, 600, 1.0), 7);
  planner.setCosts(large.geometry(), large.values().data(), 0.0);
  PoseRequest request = picture.request;
  request.goal.position.head<2>() << 599.5, 599.5;
  EXPECT_EQ(planner.plan(request, 0.0, stop).status, Status::CANCELLED);
  EXPECT_TRUE(planner.plan(request, 0.0).found());
}

TEST(CostPlanner, TheSameCostsAreNotTranslatedAgain) {
  Picture picture({"S....",  //
                   "..#..",  //
                   "....G"});
  CostPlanner planner;
  const auto set = [&] {
    planner.setCosts(picture.costs.geometry(), picture.costs.values().data(), 0.0);
  };
  set();
  EXPECT_EQ(planner.changedCells(), 15U);
  ASSERT_TRUE(planner.plan(picture.request, 0.0).found());
  const auto searched = planner.searched();
  set();
  EXPECT_EQ(planner.changedCells(), 0U);
  ASSERT_TRUE(planner.plan(picture.request, 0.0).found());
  EXPECT_EQ(planner.searched(), searched);

  picture.costs[Cell{3, 1}] = kLethalCost;
  set();
  EXPECT_EQ(planner.changedCells(), 1U);
  ASSERT_TRUE(planner.plan(picture.request, 0.0).found());
  EXPECT_EQ(planner.searched()->revision(), searched->revision() + 1);

  const GridGeometry moved(5, 3, 1.0, {1.0, 0.0, 0.0});  // a rolling window
  planner.setCosts(moved, picture.costs.values().data(), 0.0);
  EXPECT_EQ(planner.changedCells(), 15U);
  EXPECT_EQ(planner.plan(picture.request, 0.0).status, Status::START_OUTSIDE_MAP);
}

TEST(CostPlanner, TakesNewOptionsAndRefusesOthers) {
  const Picture picture({"S?G"});
  CostPlanner planner;
  planner.setCosts(picture.costs.geometry(), picture.costs.values().data(), 0.0);
  ASSERT_TRUE(planner.plan(picture.request, 0.0).found());
  CostPlannerOptions options;
  options.weights.allow_unknown = false;
  planner.setOptions(options);
  EXPECT_EQ(planner.plan(picture.request, 0.0).status, Status::UNREACHABLE);
  options.planner = "navfn";
  EXPECT_NE(test::errorText([&] { planner.setOptions(options); }), "");
  EXPECT_EQ(planner.options().planner, "weighted_jump_point");
}

TEST(CostPlanner, AMapThatIsTooLargeIsRefusedAndTheOldOneStays) {
  CostPlannerOptions options;
  options.search.memory_limit = 1;
  CostPlanner planner(options);
  const Picture picture({"S.G"});
  planner.setCosts(picture.costs.geometry(), picture.costs.values().data(), 0.0);
  const Grid<Cost> large(GridGeometry(1000, 1000, 1.0), 0);
  const std::string error =
      test::errorText([&] { planner.setCosts(large.geometry(), large.values().data(), 0.0); });
  EXPECT_TRUE(test::contains(error, "a costmap of 1000x1000 cells takes")) << error;
  EXPECT_TRUE(planner.plan(picture.request, 0.0).found());
}

// Costs as an inflated map's, noise, or a few values that tie.
void drawCosts(std::mt19937& random, const CellRect& rect, Grid<Cost>& costs) {
  const unsigned kind = random() % 3;
  const auto few = static_cast<Cost>(random() % 256);
  for (int row = rect.row; row < rect.row + rect.height; ++row)
    for (int column = rect.column; column < rect.column + rect.width; ++column)
      costs[Cell{column, row}] = kind == 0   ? static_cast<Cost>(random() % 256)
                                 : kind == 1 ? Cost{0}
                                             : few;
}

void expectLegal(const Plan& plan, const CostGrid& map) {
  for (std::size_t i = 1; i < plan.path.poses.size(); ++i) {
    const auto at = [&](std::size_t pose) {
      return SegmentPoint::nearest(
          map.geometry().gridFromWorld(plan.path.poses[pose].position.head<2>()));
    };
    EXPECT_TRUE(lineOfSight(map, at(i - 1), at(i))) << "segment " << i;
  }
}

// Whatever changes, the answer is the one of a planner that was given the costs only now, and as good
// as Boost.Graph's.
TEST(CostPlanner, LawOfChanges) {
  std::mt19937 random(20261);
  int found = 0;
  for (int trial = 0; trial < 20; ++trial) {
    const GridGeometry geometry(3 + static_cast<int>(random() % 35),
                                3 + static_cast<int>(random() % 35), 0.05, {-1.0, 2.0, 0.0});
    Grid<Cost> costs(geometry);
    CostPlannerOptions options;
    options.start_escape_radius = 0.0;
    options.smooth = trial % 2 == 0;
    options.weights.allow_unknown = trial % 3 != 0;
    if (trial % 4 == 0) options.weights.inflation_weight = 5000;
    CostPlanner kept(options);
    for (int change = 0; change < 6; ++change) {
      for (const CellRect& rect : test::randomRects(random, geometry, 20))
        drawCosts(random, rect.intersection(geometry.rect()), costs);
      const Grid<Cost> before = costs;
      const Cell start = test::randomCell(random, geometry),
                 goal = test::randomCell(random, geometry);
      PoseRequest request;
      request.start.position.head<2>() = geometry.centre(start);
      request.goal.position.head<2>() = geometry.centre(goal);
      kept.setCosts(geometry, costs.values().data(), 0.0);
      const Plan plan = kept.plan(request, 0.0);
      CostPlanner fresh(options);
      fresh.setCosts(geometry, costs.values().data(), 0.0);
      const Plan anew = fresh.plan(request, 0.0);
      ASSERT_EQ(plan.status, anew.status) << "trial " << trial << ": " << plan.message;
      EXPECT_EQ(costs, before);
      if (!plan.found()) continue;
      ++found;
      const CostGrid& map = *kept.searched();
      EXPECT_EQ(map.weights(), fresh.searched()->weights());
      expectLegal(plan, map);
      const auto best = test::referenceCosts(map, start)[map.geometry().index(goal).value()];
      ASSERT_TRUE(best);
      if (options.smooth)
        EXPECT_LE(plan.costValue(),
                  best->toDouble() * (1 + 1e-12) + plan.length_m / geometry.resolution());
      else
        EXPECT_EQ(plan.cost, *best) << "trial " << trial;
    }
  }
  EXPECT_GT(found, 60);
}

}  // namespace
}  // namespace grid_path_planner::planning
