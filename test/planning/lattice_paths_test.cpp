// Where distances are kept, the shortest paths at any angle are those of the centre lattice.
#include <gtest/gtest.h>

#include <random>

#include "grid_path_planner/costmap/line_of_sight.h"
#include "grid_path_planner/planners/planner_factory.h"
#include "support/ascii_map.h"
#include "support/cost_maps.h"
#include "support/random_map.h"
#include "support/visibility_graph.h"

namespace grid_path_planner::planning {

using base::Status;
using base::StopToken;
using costmap::CostGrid;
using costmap::CostmapOptions;
using costmap::lineOfSight;
using costmap::MotionModel;
using costmap::SegmentPoint;
using grid::Cell;
using grid::CellRect;
using grid::Grid;
using grid::GridGeometry;
using grid::Occupancy;
using grid::OccupancyGrid;
using planners::makePlanner;
using planners::Planner;
using planners::SearchRequest;
using planners::SearchResult;

namespace {

using Map = std::shared_ptr<const CostGrid>;

Map keeping(CostGrid map, std::uint64_t revision = 0) {
  map.setKeptDistances({0.5, -1.0, 0.0});
  map.setRevision(revision);
  return std::make_shared<const CostGrid>(std::move(map));
}

Map keeping(const test::AsciiMap& picture) {
  return keeping(*test::costsOf(picture.map));
}

class LatticePaths : public ::testing::TestWithParam<std::string> {
 protected:
  SearchResult planOn(const test::AsciiMap& picture) const {
    const auto planner = makePlanner(GetParam(), {});
    planner->prepare(keeping(picture), StopToken());
    return planner->search({picture.start, {picture.goal}, false}, StopToken());
  }
  std::vector<Cell> cellsOn(const test::AsciiMap& picture) const { return planOn(picture).cells; }
};

using Cells = std::vector<Cell>;

TEST_P(LatticePaths, TurnAtCentresOfCells) {
  EXPECT_EQ(cellsOn(test::AsciiMap({"S..#..G",  //
                                    "...#...",  //
                                    "......."})),
            (Cells{{0, 0}, {2, 2}, {4, 2}, {6, 0}}));
}

// No square lies along a passage of one cell.
TEST_P(LatticePaths, LeadThroughPassagesOfOneCell) {
  EXPECT_EQ(cellsOn(test::AsciiMap({"S..###...",  //
                                    "...###...",  //
                                    ".........",  //
                                    "...###..G"})),
            (Cells{{0, 0}, {2, 2}, {6, 2}, {8, 3}}));
  EXPECT_EQ(cellsOn(test::AsciiMap({"S##",  //
                                    ".##",  //
                                    "..G"})),
            (Cells{{0, 0}, {0, 2}, {2, 2}}));
}

// A passage that begins in the midst of a wall, where no interval ends.
TEST_P(LatticePaths, LeadThroughADoorInTheMidstOfAWall) {
  EXPECT_EQ(cellsOn(test::AsciiMap({"......",  //
                                    "S.....",  //
                                    "###.##",  //
                                    "###.##",  //
                                    "G....."})),
            (Cells{{0, 1}, {3, 1}, {3, 4}, {0, 4}}));
}

TEST_P(LatticePaths, LeadThroughTheCentreAtWhichTwoSquaresMeet) {
  EXPECT_EQ(cellsOn(test::AsciiMap({"S.#",  //
                                    "...",  //
                                    "#.G"})),
            (Cells{{0, 0}, {2, 2}}));
}

TEST_P(LatticePaths, AreNoneWhereOnlyACornerLeadsOn) {
  EXPECT_EQ(planOn(test::AsciiMap({"S#", "#G"})).status, Status::UNREACHABLE);
  EXPECT_EQ(planOn(test::AsciiMap({"S..#..G"})).status, Status::UNREACHABLE);
}

Map randomMap(std::mt19937& random, int largest_side, std::uint64_t revision = 0) {
  const auto below = [&random](int limit) { return static_cast<int>(random() % limit); };
  const GridGeometry geometry(1 + below(largest_side), 1 + below(largest_side), 1.0);
  Grid<CostGrid::Weight> weights(geometry, static_cast<CostGrid::Weight>(1 + below(2)));
  const int share = below(60);
  for (auto& weight : weights.values())
    if (below(100) < share) weight = CostGrid::kBlocked;
  for (int i = below(3); i > 0; --i) {  // passages through what is blocked
    const CostGrid::Weight free = weights.values()[0] == 0 ? 1 : weights.values()[0];
    const int row = below(geometry.height());
    for (int column = 0; column < geometry.width(); ++column) {
      CostGrid::Weight& weight = weights[Cell{column, row}];
      if (weight == CostGrid::kBlocked) weight = free;
    }
  }
  for (auto& weight : weights.values())
    if (weight != CostGrid::kBlocked) weight = 2;
  return keeping(CostGrid(weights, Grid<Occupancy>(geometry), MotionModel()), revision);
}

void expectShortestInLattice(Planner& planner, const Map& map, Cell start, Cell goal, int& found) {
  const SearchResult result = planner.search({start, {goal}, false}, StopToken());
  const auto shortest = test::shortestInLattice(*map, start, goal);
  ASSERT_EQ(result.status, shortest ? Status::FOUND : Status::UNREACHABLE);
  if (!shortest) return;
  ++found;
  const double cost = *shortest * map->minWeight() * map->kernel();
  ASSERT_NEAR(result.costValue(), cost, 1e-9 * cost);
  double length = 0.0;
  for (std::size_t i = 1; i < result.points.size(); ++i) {
    ASSERT_TRUE(lineOfSight(*map, result.points[i - 1], result.points[i]));
    length += lineCost(*map, result.points[i - 1], result.points[i]);
  }
  ASSERT_NEAR(length, cost, 1e-9 * cost);
}

TEST_P(LatticePaths, AreAsShortAsTheVisibilityGraphs) {
  std::mt19937 random(2016);
  int found = 0;
  const auto planner = makePlanner(GetParam(), {});
  for (int trial = 0; trial < 3000; ++trial) {
    SCOPED_TRACE("trial " + std::to_string(trial));
    const Map map = randomMap(random, 14);
    planner->prepare(map, StopToken());
    const Cell start = test::randomCell(random, map->geometry());
    const Cell goal = test::randomCell(random, map->geometry());
    if (map->passable(start) && map->passable(goal))
      expectShortestInLattice(*planner, map, start, goal, found);
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(found, 800);
}

// Words are 64 cells: what lies across their edges.
TEST_P(LatticePaths, AreAsShortAsTheVisibilityGraphsOnWideMaps) {
  std::mt19937 random(64);
  int found = 0;
  const auto planner = makePlanner(GetParam(), {});
  for (int trial = 0; trial < 20; ++trial) {
    SCOPED_TRACE("trial " + std::to_string(trial));
    OccupancyGrid picture(GridGeometry(75 + trial, 4, 1.0), 0);
    for (auto& value : picture.values()) value = random() % 10 == 0 ? 100 : 0;
    const Map map = keeping(*test::costsOf(picture));
    planner->prepare(map, StopToken());
    const Cell start{static_cast<int>(random() % 60), static_cast<int>(random() % 4)};
    const Cell goal{66 + static_cast<int>(random() % 9), static_cast<int>(random() % 4)};
    if (map->passable(start) && map->passable(goal))
      expectShortestInLattice(*planner, map, start, goal, found);
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(found, 3);
}

// In the last blocks of a kernel the points lie nearer together.
TEST_P(LatticePaths, AreAsShortAsTheVisibilityGraphsOverBlocks) {
  std::mt19937 random(3);
  int found = 0;
  const auto planner = makePlanner(GetParam(), {});
  for (int trial = 0; trial < 600; ++trial) {
    SCOPED_TRACE("trial " + std::to_string(trial));
    CostmapOptions options;
    options.kernel = 2 + trial % 4;
    options.radius = 0.4;
    const Map map = keeping(*test::costsOf(test::randomOccupancy(random, 36, 0.04, 0.0), options));
    planner->prepare(map, StopToken());
    const Cell start = test::randomCell(random, map->geometry());
    const Cell goal = test::randomCell(random, map->geometry());
    if (map->passable(start) && map->passable(goal))
      expectShortestInLattice(*planner, map, start, goal, found);
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(found, 150);
}

TEST_P(LatticePaths, AreThoseOfAFreshPlannerAfterUpdates) {
  std::mt19937 random(12);
  int found = 0;
  for (int trial = 0; trial < 60; ++trial) {
    SCOPED_TRACE("trial " + std::to_string(trial));
    Map map = randomMap(random, 40, 1);
    const auto planner = makePlanner(GetParam(), {});
    planner->prepare(map, StopToken());
    for (std::uint64_t edit = 2; edit < 10; ++edit) {
      const Cell low = test::randomCell(random, map->geometry());
      const CellRect changed =
          CellRect{low.column, low.row, 4, 3}.intersection(map->geometry().rect());
      Grid<CostGrid::Weight> weights = map->weights();
      for (int row = changed.row; row < changed.row + changed.height; ++row)
        for (int column = changed.column; column < changed.column + changed.width; ++column)
          weights[Cell{column, row}] = random() % 2 == 0 ? 2 : CostGrid::kBlocked;
      map = keeping(CostGrid(weights, map->classes(), map->motion()), edit);
      planner->update(map, {changed}, StopToken());
      const auto fresh = makePlanner(GetParam(), {});
      fresh->prepare(map, StopToken());
      const SearchRequest request{test::randomCell(random, map->geometry()),
                                  {test::randomCell(random, map->geometry())},
                                  false};
      const SearchResult result = planner->search(request, StopToken());
      ASSERT_EQ(result.cells, fresh->search(request, StopToken()).cells);
      found += result.status == Status::FOUND ? 1 : 0;
    }
  }
  EXPECT_GT(found, 60);
}

INSTANTIATE_TEST_SUITE_P(All, LatticePaths, ::testing::Values("anya", "polyanya"),
                         [](const auto& info) { return info.param; });

}  // namespace
}  // namespace grid_path_planner::planning
