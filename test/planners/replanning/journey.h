// A vehicle that drives to a goal over a world whose weights change, for planners that repair.
//
//   Journey journey(random, 28);
//   const Map before = journey.map();
//   planner.update(journey.map(), {journey.edit()}, stop);
//   journey.move(result.cells);
//   if (journey.possible()) result = planner.search(journey.request(), stop);
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <random>
#include <vector>

#include "grid_path_planner/costmap/cost_grid.h"
#include "grid_path_planner/costmap/exact_cost.h"
#include "grid_path_planner/planners/planner.h"
#include "support/random_map.h"
#include "support/reference_search.h"

namespace grid_path_planner::test {

using Map = std::shared_ptr<const costmap::CostGrid>;

// The result is a legal path of the least cost, or none where there is none, as a search says that shares
// no code with the planners.
inline void expectLeast(const costmap::CostGrid& map, grid::Cell start, grid::Cell goal, bool found,
                        const planners::SearchResult& result) {
  const auto least = referenceCosts(map, goal)[map.geometry().index(start).value()];
  ASSERT_EQ(found, least.has_value());
  if (!least) return;
  ASSERT_FALSE(result.cells.empty());
  EXPECT_EQ(result.cells.front(), start);
  EXPECT_EQ(result.cells.back(), goal);
  for (std::size_t i = 1; i < result.cells.size(); ++i)
    ASSERT_TRUE(costmap::stepAllowed(map, result.cells[i - 1], result.cells[i]));
  ASSERT_EQ(result.cost, *least);
  EXPECT_EQ(costmap::costOfSteps(map, result.cells), *least);
}

inline costmap::MotionModel motionOf(std::mt19937& random) {
  costmap::MotionModel motion;
  if (random() % 3 != 0) return motion;
  motion.connectivity =
      random() % 2 == 0 ? costmap::Connectivity::EIGHT : costmap::Connectivity::FOUR;
  motion.diagonal_cost =
      random() % 2 == 0 ? costmap::DiagonalCost::SQRT2 : costmap::DiagonalCost::UNIT;
  motion.cut_corners = random() % 2 == 0;
  return motion;
}

class Journey {
 public:
  Journey(std::mt19937& random, int largest_side);

  bool possible() const { return map_->passable(start_) && map_->passable(goal_); }
  const Map& map() const { return map_; }
  grid::Cell start() const { return start_; }
  grid::Cell goal() const { return goal_; }
  planners::SearchRequest request() const { return {start_, {goal_}, false}; }

  // New weights in a small square: blocked, open, as it was when the world began, or any. Returns where.
  grid::CellRect edit();
  // Blocks the cell.
  grid::CellRect close(grid::Cell cell);
  // As on an earlier map of the journey.
  void restore(const costmap::CostGrid& map);
  // Along the path, or to anywhere.
  void move(const std::vector<grid::Cell>& path);
  void moveGoal();

 private:
  void become(const grid::Grid<costmap::CostGrid::Weight>& weights);

  std::mt19937& random_;
  Map world_;
  Map map_;
  grid::Cell start_;
  grid::Cell goal_;
};

inline Journey::Journey(std::mt19937& random, int largest_side)
    : random_(random),
      world_(std::make_shared<const costmap::CostGrid>(
          randomCosts(random, largest_side, motionOf(random)))),
      map_(world_),
      start_(randomCell(random, map_->geometry())),
      goal_(randomCell(random, map_->geometry())) {}

inline grid::CellRect Journey::edit() {
  grid::Grid<costmap::CostGrid::Weight> weights = map_->weights();
  const grid::Cell low = randomCell(random_, map_->geometry());
  const int side = 1 + static_cast<int>(random_() % 7);
  const grid::CellRect changed =
      grid::CellRect{low.column, low.row, side, side}.intersection(map_->geometry().rect());
  const unsigned kind = random_() % 4;
  for (int row = changed.row; row < changed.row + changed.height; ++row)
    for (int column = changed.column; column < changed.column + changed.width; ++column) {
      const grid::Cell cell{column, row};
      const costmap::CostGrid::Weight choices[] = {
          costmap::CostGrid::kBlocked, map_->minWeight(), world_->weight(cell),
          static_cast<costmap::CostGrid::Weight>(random_() % 40)};
      weights[cell] = choices[kind];
    }
  become(weights);
  return changed;
}

inline grid::CellRect Journey::close(grid::Cell cell) {
  grid::Grid<costmap::CostGrid::Weight> weights = map_->weights();
  weights[cell] = costmap::CostGrid::kBlocked;
  become(weights);
  return {cell.column, cell.row, 1, 1};
}

inline void Journey::restore(const costmap::CostGrid& map) {
  become(map.weights());
}

inline void Journey::move(const std::vector<grid::Cell>& path) {
  if (random_() % 6 == 0 || path.empty())
    start_ = randomCell(random_, map_->geometry());
  else
    start_ = path[std::min<std::size_t>(path.size() - 1, random_() % 4)];
}

inline void Journey::moveGoal() {
  goal_ = randomCell(random_, map_->geometry());
}

inline void Journey::become(const grid::Grid<costmap::CostGrid::Weight>& weights) {
  auto map = std::make_shared<costmap::CostGrid>(weights, map_->classes(), map_->motion());
  map->setRevision(map_->revision() + 1);
  map_ = map;
}

}  // namespace grid_path_planner::test
