// Optimality is proven, not assumed: every planner that claims it, on 10,000 seeded random maps,
// against Boost.Graph's Dijkstra on exact pairs (A, B), without tolerance.
//
// Every fourth map is a gentle potential; the others are of one weight, of few values that tie, of
// plateaus, of rings, of noise and inflated. Sides are 1 to 200 cells, both above 40 on more than 30 % of the maps. Each map is asked from one
// start to two goals; every other is then changed in a rectangle and asked again, so that what
// planners repair is compared too. New planners and heuristics are found in the planner factory.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "grid_path_planner/planners/planner_factory.h"
#include "support/random_map.h"
#include "support/reference_search.h"

namespace grid_path_planner::planning {

using base::choiceName;
using base::Status;
using base::StopToken;
using costmap::Connectivity;
using costmap::CostGrid;
using costmap::costOfSteps;
using costmap::DiagonalCost;
using costmap::ExactCost;
using costmap::MotionModel;
using grid::Cell;
using grid::CellRect;
using grid::Grid;
using grid::GridGeometry;
using planners::Heuristic;
using planners::makePlanner;
using planners::Planner;
using planners::plannerNames;
using planners::PlannerTraits;
using planners::SearchOptions;
using planners::SearchResult;
using planners::TieBreak;

namespace {

constexpr int kMaps = 10000;
constexpr int kBlocks = 40;
constexpr int kMapsInBlock = kMaps / kBlocks;
constexpr std::size_t kMostBytes =
    6'000'000;  // of a planner: tables of all pairs only on small maps

struct Subject {
  std::string planner;
  SearchOptions options;

  std::string name(const PlannerTraits& traits) const {
    return traits.heuristic ? planner + ' ' + choiceName(options.heuristic) : planner;
  }
};

// Every planner with its defaults, and those that are guided with one more heuristic and tie-break:
// which, goes round with the maps.
std::vector<Subject> subjectsFor(int map) {
  const auto& heuristics = choicesOf(Heuristic{});
  const auto& tie_breaks = choicesOf(TieBreak{});
  const auto turn = static_cast<std::size_t>(map);
  SearchOptions turned;
  turned.heuristic = heuristics[turn % heuristics.size()].second;
  turned.tie_break = tie_breaks[turn / heuristics.size() % tie_breaks.size()].second;
  std::vector<Subject> subjects;
  for (const std::string& planner : plannerNames()) {
    subjects.push_back({planner, {}});
    if (makePlanner(planner)->traits().heuristic) subjects.push_back({planner, turned});
  }
  return subjects;
}

int between(std::mt19937& random, int low, int high) {
  return std::uniform_int_distribution<int>(low, high)(random);
}

// 36 of 100 maps have both sides above 40, more than a quarter of those up to 200.
GridGeometry sizeFor(int map, std::mt19937& random) {
  const int turn = map % 100;
  const int low = turn < 36 ? 41 : 1;
  const int high = turn < 10 ? 200 : turn < 36 ? 90 : 40;
  const int width = between(random, low, high);
  return GridGeometry(width, between(random, low, high), 1.0);
}

// The default on most maps, on the others all there are.
MotionModel motionFor(int map) {
  if (map % 3 != 0) return {};
  const int turn = map / 3;
  MotionModel motion;
  motion.connectivity = turn % 2 == 0 ? Connectivity::EIGHT : Connectivity::FOUR;
  motion.diagonal_cost = turn / 2 % 2 == 0 ? DiagonalCost::SQRT2 : DiagonalCost::UNIT;
  motion.cut_corners = turn / 4 % 2 == 0;
  return motion;
}

CostGrid mapFor(int map, std::mt19937& random) {
  const GridGeometry geometry = sizeFor(map, random);
  if (map % 4 == 1) return test::randomPotential(random, geometry, motionFor(map));
  return between(random, 0, 3) == 0 ? test::randomInflated(random, geometry, motionFor(map))
                                    : test::randomCosts(random, geometry, motionFor(map));
}

Cell passableCell(std::mt19937& random, const CostGrid& map) {
  Cell cell = test::randomCell(random, map.geometry());
  for (int tries = 0; tries < 50 && !map.passable(cell); ++tries)
    cell = test::randomCell(random, map.geometry());
  return cell;
}

// A map, what is asked of it, and the answers.
struct Question {
  std::shared_ptr<const CostGrid> map;
  Cell start;
  std::vector<Cell> goals;
  std::vector<std::optional<ExactCost>> least;

  const std::optional<ExactCost>& leastTo(Cell goal) const {
    return least[map->geometry().index(goal).value()];
  }
};

Question questionOn(std::shared_ptr<const CostGrid> map, Cell start, std::vector<Cell> goals) {
  Question question{std::move(map), start, std::move(goals), {}};
  question.least = question.map->passable(start)
                       ? test::referenceCosts(*question.map, start)
                       : std::vector<std::optional<ExactCost>>(question.map->geometry().size());
  return question;
}

// The next revision of the map: a rectangle of cells has other weights.
std::shared_ptr<const CostGrid> changed(const CostGrid& map, std::mt19937& random, CellRect& rect) {
  const Cell middle = test::randomCell(random, map.geometry());
  rect = CellRect{middle.column - 3, middle.row - 3, between(random, 1, 9), between(random, 1, 9)}
             .intersection(map.geometry().rect());
  if (rect.width <= 0 || rect.height <= 0) rect = {middle.column, middle.row, 1, 1};
  const CostGrid::Weight values[] = {CostGrid::kBlocked, map.minWeight(),
                                     static_cast<CostGrid::Weight>(between(random, 1, 60))};
  const bool one_value = between(random, 0, 1) == 0;
  const int value = between(random, 0, 2);
  Grid<CostGrid::Weight> weights = map.weights();
  for (int row = rect.row; row < rect.row + rect.height; ++row)
    for (int column = rect.column; column < rect.column + rect.width; ++column)
      weights[Cell{column, row}] = values[one_value ? value : between(random, 0, 2)];
  auto next = std::make_shared<CostGrid>(std::move(weights), map.classes(), map.motion());
  next->setRevision(map.revision() + 1);
  return next;
}

class Optimality : public ::testing::TestWithParam<int> {
 protected:
  // Compares each answer where optimality is claimed.
  void ask(Planner& planner, const std::string& name, const Question& question) {
    if (!planner.optimalFor(*question.map)) return;
    for (const Cell goal : question.goals) {
      const SearchResult result = planner.search({question.start, {goal}, false}, StopToken());
      if (result.status == Status::INVALID_REQUEST) continue;  // not a map for this planner
      SCOPED_TRACE(name + ": " + result.message);
      const std::optional<ExactCost>& least = question.leastTo(goal);
      if (!question.map->passable(question.start) || !question.map->passable(goal)) {
        EXPECT_NE(result.status, Status::FOUND);
        continue;
      }
      ASSERT_EQ(result.status, least ? Status::FOUND : Status::UNREACHABLE);
      if (!least) continue;
      EXPECT_EQ(result.cost, *least)
          << result.cost.straight << " + " << result.cost.diagonal << " sqrt 2 instead of "
          << least->straight << " + " << least->diagonal << " sqrt 2";
      EXPECT_EQ(result.cost, costOfSteps(*question.map, result.cells));
      ++compared_[name];
    }
  }

  std::map<std::string, int> compared_;
};

TEST_P(Optimality, CostsAreThoseOfBoostGraph) {
  for (int i = GetParam() * kMapsInBlock; i < (GetParam() + 1) * kMapsInBlock; ++i) {
    SCOPED_TRACE("map " + std::to_string(i));
    std::mt19937 random(20261121U + static_cast<unsigned>(i));
    const auto map = std::make_shared<const CostGrid>(mapFor(i, random));
    const Cell start = passableCell(random, *map);
    const std::vector<Cell> goals = {passableCell(random, *map), passableCell(random, *map)};
    std::vector<Question> questions = {questionOn(map, start, goals)};
    CellRect rect;
    if (i % 2 == 0) questions.push_back(questionOn(changed(*map, random, rect), start, goals));

    for (const Subject& subject : subjectsFor(i)) {
      const auto planner = makePlanner(subject.planner, subject.options);
      if (!planner->traits().optimal || planner->traits().any_angle) continue;
      if (planner->bytesFor(map->geometry()) > kMostBytes) continue;
      const std::string name = subject.name(planner->traits());
      planner->prepare(map, StopToken());
      planner->finishBackgroundWork(StopToken());
      ask(*planner, name, questions.front());
      if (questions.size() < 2) continue;
      planner->update(questions.back().map, {rect}, StopToken());
      planner->finishBackgroundWork(StopToken());
      ask(*planner, name + " updated", questions.back());
    }
    if (HasFailure()) return;
  }
  // A planner that refused every map would have proven nothing.
  for (const std::string& name : plannerNames()) {
    const auto planner = makePlanner(name);
    if (!planner->traits().optimal || planner->traits().any_angle) continue;
    const Subject subject{name, {}};
    EXPECT_GT(compared_[subject.name(planner->traits())], 20) << name;
  }
}

INSTANTIATE_TEST_SUITE_P(Maps, Optimality, ::testing::Range(0, kBlocks));

TEST(Maps, AreOfTheSizesThatAreClaimed) {
  int large = 0, largest = 0;
  for (int i = 0; i < kMaps; ++i) {
    std::mt19937 random(20261121U + static_cast<unsigned>(i));
    const GridGeometry size = sizeFor(i, random);
    large += std::min(size.width(), size.height()) > 40;
    largest = std::max(largest, std::max(size.width(), size.height()));
  }
  EXPECT_GE(large, kMaps * 3 / 10);
  EXPECT_EQ(largest, 200);
}

}  // namespace
}  // namespace grid_path_planner::planning
