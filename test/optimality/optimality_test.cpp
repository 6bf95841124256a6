// Optimality is proven, not assumed: every planner that claims it, on 10,000 seeded random maps,
// against Boost.Graph's Dijkstra on exact pairs (A, B), without tolerance.
//
// Every fourth map is a gentle potential; the others are of one weight, of few values that tie, of
// plateaus, of rings, of noise and inflated. Sides are 1 to 200 cells, both above 40 on more than 30 % of the maps. Each map is asked from one
// start to two goals; every other is then changed in a rectangle and asked again, so that what
// planners repair is compared too. New planners and heuristics are found in the planner factory.
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "optimality/questions.h"

namespace grid_path_planner::planning {

using base::StopToken;
using costmap::Connectivity;
using costmap::CostGrid;
using costmap::DiagonalCost;
using costmap::MotionModel;
using grid::Cell;
using grid::CellRect;
using grid::GridGeometry;
using planners::Heuristic;
using planners::plannerNames;
using planners::SearchOptions;
using planners::TieBreak;
using test::between;
using test::passableCell;
using test::Question;
using test::questionOn;
using test::Subject;

namespace {

constexpr int kMaps = 10000;
constexpr int kBlocks = 40;
constexpr int kMapsInBlock = kMaps / kBlocks;
constexpr std::size_t kMostBytes =
    6'000'000;                   // of a planner: tables of all pairs only on small maps
constexpr int kMostWeight = 60;  // of what changes

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
    if (!test::isJudged(planner)) continue;
    subjects.push_back({planner, {}});
    if (planners::traitsOf(planner).heuristic) subjects.push_back({planner, turned});
  }
  return subjects;
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

using Optimality = test::Comparison;

TEST_P(Optimality, CostsAreThoseOfBoostGraph) {
  for (int i = GetParam() * kMapsInBlock; i < (GetParam() + 1) * kMapsInBlock; ++i) {
    SCOPED_TRACE("map " + std::to_string(i));
    std::mt19937 random(20261121U + static_cast<unsigned>(i));
    const auto map = std::make_shared<const CostGrid>(mapFor(i, random));
    const Cell start = passableCell(random, *map);
    const std::vector<Cell> goals = {passableCell(random, *map), passableCell(random, *map)};
    std::vector<Question> questions = {questionOn(map, start, goals)};
    CellRect rect;
    if (i % 2 == 0)
      questions.push_back(questionOn(test::changed(*map, random, rect, kMostWeight), start, goals));

    for (const Subject& subject : subjectsFor(i)) {
      const auto planner = subject.make();
      if (planner->bytesFor(map->geometry()) > kMostBytes) continue;
      const std::string name = subject.name();
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
  for (const std::string& planner : plannerNames()) {
    if (!test::isJudged(planner)) continue;
    const Subject subject{planner, {}};
    EXPECT_GT(compared_[subject.name()], 20) << planner;
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
