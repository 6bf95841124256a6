// incremental_a_star with diagonal_cost unit found paths that cost up to 4 % too much on maps of heavy
// weights: beyond 3.2 million cell lengths x weight it asked an A* whose heuristic was no bound there. Its
// own promise was tested, that of the planner inside it was not.
//
// So every planner that may promise the least cost is asked here, and with it every one that may answer in
// its place: on maps of 5 to 74 cells a side with weights of all magnitudes up to 65,535, with every motion
// model and heuristic, from a start that moves to a goal that stays while the map changes, after all
// background work. How often which planner answered for which is counted.
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "optimality/questions.h"
#include "planners/replanning/kept_search_tree.h"

namespace grid_path_planner::planning {

using base::StopToken;
using costmap::Connectivity;
using costmap::CostGrid;
using costmap::DiagonalCost;
using costmap::MotionModel;
using grid::Cell;
using grid::CellRect;
using grid::Grid;
using grid::GridGeometry;
using grid::Occupancy;
using planners::Heuristic;
using planners::plannerNames;
using planners::TieBreak;
using test::between;
using test::passableCell;
using test::Question;
using test::questionOn;
using test::Subject;

namespace {

constexpr int kBlocks = 4;
constexpr int kMapsInBlock = 60;
constexpr int kChanges = 3;
constexpr int kMostWeight = 65535;
constexpr std::size_t kMostBytes = 6'000'000;  // tables of all pairs only on small maps

MotionModel motionFor(int map) {
  MotionModel motion;
  motion.connectivity = map % 3 == 2 ? Connectivity::FOUR : Connectivity::EIGHT;
  motion.diagonal_cost = map % 3 == 0 ? DiagonalCost::UNIT : DiagonalCost::SQRT2;
  motion.cut_corners = map % 5 == 0;
  return motion;
}

// Of one weight, slight differences, any, or as many of each magnitude.
CostGrid::Weight weightOf(int kind, int least, std::mt19937& random) {
  switch (kind) {
    case 0:
      return CostGrid::Weight(least);
    case 1:
      return CostGrid::Weight(between(random, least, std::min(kMostWeight, least + least / 8)));
    case 2:
      return CostGrid::Weight(between(random, least, kMostWeight));
    default:
      return CostGrid::Weight(
          std::min(kMostWeight, between(random, 1, 2) << between(random, 0, 15)));
  }
}

// Walls from side to side with a gap at either end in turn: paths of several times the map's side.
void addWalls(std::mt19937& random, Grid<CostGrid::Weight>& weights) {
  const int height = weights.height();
  bool at_top = false;
  for (int column = between(random, 4, 9); column < weights.width() - 2;
       column += between(random, 5, 10), at_top = !at_top)
    for (int row = at_top ? 0 : 2; row < (at_top ? height - 2 : height); ++row)
      weights[Cell{column, row}] = CostGrid::kBlocked;
}

// Every other one is large. Some of those are nearly open and of one weight; half of them are heavy and have
// walls, so that their paths cost more than the 3.2 million that the keys of a kept tree hold.
CostGrid mapFor(int map, std::mt19937& random) {
  const bool large = map % 2 == 1, costly = map % 4 == 3, open = map % 12 == 1;
  const int low = large ? 55 : 5;
  const GridGeometry geometry(between(random, low, 74), between(random, low, 74), 1.0);
  const int kind = open ? 0 : between(random, costly ? 1 : 0, costly ? 2 : 3);
  const int least = costly                       ? between(random, 30000, 60000)
                    : between(random, 0, 2) == 0 ? 1
                                                 : between(random, 1, kMostWeight);
  const int most_blocked = open ? 2 : costly ? 5 : 35;
  std::bernoulli_distribution blocked(std::max(0, between(random, -20, most_blocked)) / 100.0);
  Grid<CostGrid::Weight> weights(geometry, 1);
  for (auto& weight : weights.values())
    weight = blocked(random) ? CostGrid::kBlocked : weightOf(kind, least, random);
  if (costly) addWalls(random, weights);
  return CostGrid(std::move(weights), Grid<Occupancy>(geometry, Occupancy::FREE), motionFor(map));
}

// Those that have one with some heuristics and a tie-break, whose turn it is.
std::vector<Subject> subjectsFor(int map) {
  const auto& heuristics = choicesOf(Heuristic{});
  const auto& tie_breaks = choicesOf(TieBreak{});
  const auto turns = std::size_t(map);
  std::vector<Subject> subjects;
  for (const std::string& planner : plannerNames()) {
    if (!test::isJudged(planner)) continue;
    subjects.push_back({planner, {}});
    const auto options = planners::optionsUsedBy(planner);
    if (std::count(options.begin(), options.end(), "heuristic") == 0) continue;
    for (const std::size_t turn : {3 * turns, 3 * turns + 1, 3 * turns + 2}) {
      Subject subject{planner, {}};
      subject.options.heuristic = heuristics[turn % heuristics.size()].second;
      subject.options.tie_break = tie_breaks[turns % tie_breaks.size()].second;
      subjects.push_back(subject);
    }
  }
  return subjects;
}

// One after the other: each map is the one before, changed in one rectangle.
struct Journey {
  std::vector<Question> questions;
  std::vector<CellRect> changes;  // [i]: from the map of questions[i] to the next one
};

Journey journeyOn(const CostGrid& first, std::mt19937& random) {
  Journey journey;
  auto map = std::make_shared<const CostGrid>(first);
  const Cell goal = passableCell(random, *map);
  journey.questions.push_back(questionOn(map, passableCell(random, *map), {goal}));
  for (int i = 0; i < kChanges; ++i) {
    CellRect rect;
    map = test::changed(*map, random, rect, kMostWeight);
    journey.changes.push_back(rect);
    journey.questions.push_back(questionOn(map, passableCell(random, *map), {goal}));
  }
  return journey;
}

class InnerPlanners : public test::Comparison {
 protected:
  void drive(const Subject& subject, const Journey& journey) {
    const auto planner = subject.make();
    if (planner->bytesFor(journey.questions.front().map->geometry()) > kMostBytes) return;
    for (std::size_t i = 0; i < journey.questions.size(); ++i) {
      const Question& question = journey.questions[i];
      if (i == 0)
        planner->prepare(question.map, StopToken());
      else
        planner->update(question.map, {journey.changes[i - 1]}, StopToken());
      ask(*planner, subject.name(), question);  // before what is done in idle time, and after it
      planner->finishBackgroundWork(StopToken());
      ask(*planner, subject.name(), question);
    }
  }
};

TEST_P(InnerPlanners, AnswerAtTheLeastCostForTheOneThatPromisesIt) {
  for (int i = GetParam() * kMapsInBlock; i < (GetParam() + 1) * kMapsInBlock; ++i) {
    SCOPED_TRACE("map " + std::to_string(i));
    std::mt19937 random(20260601U + static_cast<unsigned>(i));
    const CostGrid map = mapFor(i, random);
    const Journey journey = journeyOn(map, random);
    for (const Subject& subject : subjectsFor(i)) drive(subject, journey);
    if (HasFailure()) return;
  }
  for (const char* each :
       {"incremental_a_star by incremental_a_star", "incremental_a_star by a_star",
        "weighted_jump_point by weighted_jump_point", "weighted_jump_point by a_star",
        "weighted_jump_point by jump_point"})
    EXPECT_GT(answered_[each], 0) << each;
}

// That of weighted_jump_point: maps of this size are too small for one there.
TEST_P(InnerPlanners, TheTreeOfAGoalThatStaysAnswersAtTheLeastCost) {
  constexpr std::uint64_t kCostlySearch = 1 << 20;  // cells
  int answered = 0;
  for (int i = GetParam() * kMapsInBlock; i < (GetParam() + 1) * kMapsInBlock; ++i) {
    SCOPED_TRACE("map " + std::to_string(i));
    std::mt19937 random(20260601U + static_cast<unsigned>(i));
    const Journey journey = journeyOn(mapFor(i, random), random);
    planners::KeptSearchTree tree;
    for (std::size_t j = 0; j < journey.questions.size(); ++j) {
      const Question& question = journey.questions[j];
      const CostGrid& map = *question.map;
      const Cell goal = question.goals.front();
      const planners::SearchRequest request{question.start, {goal}, false};
      if (j > 0)
        tree.update(*journey.questions[j - 1].map, map, {journey.changes[j - 1]}, StopToken());
      if (!map.passable(question.start) || !map.passable(goal)) continue;
      tree.searched(map, request, kCostlySearch);
      if (tree.wanted(map)) tree.make(map, StopToken());
      planners::SearchResult result;
      if (!tree.search(map, request, result, StopToken())) continue;
      ++answered;
      const auto& least = question.leastTo(goal);
      ASSERT_EQ(result.status, least ? base::Status::FOUND : base::Status::UNREACHABLE);
      if (least) ASSERT_EQ(result.cost, *least);
    }
  }
  EXPECT_GT(answered, kMapsInBlock / 2);
}

INSTANTIATE_TEST_SUITE_P(Maps, InnerPlanners, ::testing::Range(0, kBlocks));

}  // namespace
}  // namespace grid_path_planner::planning
