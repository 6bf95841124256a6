// A map, what is asked of it, the least costs by Boost.Graph, and the comparison of a planner's answers
// with them, without tolerance.
#pragma once

#include <gtest/gtest.h>

#include <map>
#include <memory>
#include <optional>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "grid_path_planner/costmap/exact_cost.h"
#include "grid_path_planner/planners/planner_factory.h"
#include "support/random_map.h"
#include "support/reference_search.h"

namespace grid_path_planner::test {

inline int between(std::mt19937& random, int low, int high) {
  return std::uniform_int_distribution<int>(low, high)(random);
}

struct Subject {
  std::string planner;
  planners::SearchOptions options;

  std::unique_ptr<planners::Planner> make() const { return makePlanner(planner, options); }
  std::string name() const {
    if (!planners::traitsOf(planner).heuristic) return planner;
    return planner + ' ' + base::choiceName(options.heuristic);
  }
};

// Planners that may promise the least cost over cells.
inline bool isJudged(const std::string& planner) {
  const planners::PlannerTraits traits = planners::traitsOf(planner);
  return traits.optimal && !traits.any_angle;
}

inline grid::Cell passableCell(std::mt19937& random, const costmap::CostGrid& map) {
  grid::Cell cell = randomCell(random, map.geometry());
  for (int tries = 0; tries < 50 && !map.passable(cell); ++tries)
    cell = randomCell(random, map.geometry());
  return cell;
}

struct Question {
  std::shared_ptr<const costmap::CostGrid> map;
  grid::Cell start;
  std::vector<grid::Cell> goals;
  std::vector<std::optional<costmap::ExactCost>> least;

  const std::optional<costmap::ExactCost>& leastTo(grid::Cell goal) const {
    return least[map->geometry().index(goal).value()];
  }
};

inline Question questionOn(std::shared_ptr<const costmap::CostGrid> map, grid::Cell start,
                           std::vector<grid::Cell> goals) {
  Question question{std::move(map), start, std::move(goals), {}};
  question.least =
      question.map->passable(start)
          ? referenceCosts(*question.map, start)
          : std::vector<std::optional<costmap::ExactCost>>(question.map->geometry().size());
  return question;
}

// The next revision of the map: a rectangle of cells is blocked, of the minimum weight, or of weights
// up to `most`.
inline std::shared_ptr<const costmap::CostGrid> changed(const costmap::CostGrid& map,
                                                        std::mt19937& random, grid::CellRect& rect,
                                                        int most) {
  using Weight = costmap::CostGrid::Weight;
  const grid::Cell middle = randomCell(random, map.geometry());
  rect = grid::CellRect{middle.column - 3, middle.row - 3, between(random, 1, 9),
                        between(random, 1, 9)}
             .intersection(map.geometry().rect());
  if (rect.width <= 0 || rect.height <= 0) rect = {middle.column, middle.row, 1, 1};
  const Weight values[] = {costmap::CostGrid::kBlocked, map.minWeight(),
                           static_cast<Weight>(between(random, 1, most))};
  const bool one_value = between(random, 0, 1) == 0;
  const int value = between(random, 0, 2);
  grid::Grid<Weight> weights = map.weights();
  for (int row = rect.row; row < rect.row + rect.height; ++row)
    for (int column = rect.column; column < rect.column + rect.width; ++column)
      weights[grid::Cell{column, row}] = values[one_value ? value : between(random, 0, 2)];
  auto next = std::make_shared<costmap::CostGrid>(std::move(weights), map.classes(), map.motion());
  next->setRevision(map.revision() + 1);
  return next;
}

// Counts by subject and by who answered.
class Comparison : public ::testing::TestWithParam<int> {
 protected:
  // Compares each answer where optimality is claimed.
  void ask(planners::Planner& planner, const std::string& name, const Question& question) {
    if (!planner.optimalFor(*question.map)) return;
    for (const grid::Cell goal : question.goals) {
      const planners::SearchResult result =
          planner.search({question.start, {goal}, false}, base::StopToken());
      if (result.status == base::Status::INVALID_REQUEST) continue;  // not a map for this planner
      SCOPED_TRACE(name + " by " + result.answered_by + ": " + result.message);
      const std::optional<costmap::ExactCost>& least = question.leastTo(goal);
      if (!question.map->passable(question.start) || !question.map->passable(goal)) {
        EXPECT_NE(result.status, base::Status::FOUND);
        continue;
      }
      ASSERT_EQ(result.status, least ? base::Status::FOUND : base::Status::UNREACHABLE);
      if (!least) continue;
      EXPECT_EQ(result.cost, *least)
          << result.cost.straight << " + " << result.cost.diagonal << " sqrt 2 instead of "
          << least->straight << " + " << least->diagonal << " sqrt 2";
      EXPECT_EQ(result.cost, costOfSteps(*question.map, result.cells));
      ++compared_[name];
      ++answered_[planner.traits().name + " by " + result.answered_by];
    }
  }

  std::map<std::string, int> compared_;
  std::map<std::string, int> answered_;
};

}  // namespace grid_path_planner::test
