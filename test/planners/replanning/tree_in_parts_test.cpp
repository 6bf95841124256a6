// Trees of goals that are made and repaired in idle times too short for it: they go on where they were
// stopped, maps change meanwhile, and every cost is that of a search that shares no code with them.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <string>
#include <vector>

#include "planners/jump_point/weighted_jump_point.h"
#include "planners/replanning/backward_search_tree.h"
#include "planners/replanning/journey.h"
#include "planners/replanning/kept_search_tree.h"
#include "planners/replanning/outdated_cells.h"
#include "planners/replanning/slopes.h"
#include "support/cost_maps.h"

namespace grid_path_planner::planners {

using base::Status;
using base::Stopped;
using base::StopPoll;
using base::StopSource;
using base::StopToken;
using costmap::CostGrid;
using grid::Cell;
using grid::CellRect;
using test::costsOf;
using test::expectLeast;
using test::Journey;
using test::Map;
using test::Slopes;

namespace {

constexpr std::uint64_t kManyCells = 1 << 20;
const SearchRequest kOverSlopes{{5, 5}, {{294, 290}}, false};

// Of a task that was cancelled before it began: as much is done as is done before it is asked.
StopToken cancelled() {
  StopSource source;
  source.cancel();
  return source.token();
}

// Whether `work` came to its end.
template <class Work>
bool ends(const Work& work) {
  try {
    work();
  } catch (const Stopped&) {
    return false;
  }
  return true;
}

// A tree that a planner keeps, and what happened to it.
class Worker {
 public:
  explicit Worker(std::mt19937& random) : random_(random) {}

  void begin(const Journey& journey) {
    if (!made_) moves_.build(*journey.map(), StopToken());
    if (!made_) tree_.prepare(*journey.map(), moves_);
    made_ = true;
    tree_.begin(*journey.map(), journey.goal(), journey.start());
  }
  void follow(const CostGrid& before, const CostGrid& after, const CellRect& changed) {
    if (!made_) return;
    moves_.update(after, changed, StopToken());
    tree_.update(before, after, changed);
  }
  // In an idle time, or a part of one.
  void work(const Journey& journey) {
    const CostGrid& map = *journey.map();
    const StopToken stop = random_() % 3 == 0 ? StopToken() : cancelled();
    SearchResult none;
    const bool usable = made_ && tree_.usableFor(map, journey.goal());
    if (usable && !ends([&] { tree_.beginRepair(map, journey.start(), stop); })) return count(true);
    if (!made_ || !tree_.growing(map, journey.goal())) begin(journey);
    count(!ends([&] { tree_.grow(map, journey.start(), random_() % 3, false, none, stop); }));
  }
  // Whether the tree answered; it does not where keys cannot hold the cost.
  bool answers(const Journey& journey, SearchResult& result) {
    if (!made_ || !tree_.usableFor(*journey.map(), journey.goal())) return false;
    try {
      const Status status = tree_.plan(*journey.map(), journey.start(), false, result, StopToken());
      expectLeast(*journey.map(), journey.start(), journey.goal(), status == Status::FOUND, result);
    } catch (const TooExpensive&) {
      return false;
    }
    return true;
  }
  int stopped() const { return stopped_; }

 private:
  void count(bool stopped) { stopped_ += stopped ? 1 : 0; }

  std::mt19937& random_;
  MovePruning moves_;
  BackwardSearchTree tree_;
  bool made_ = false;
  int stopped_ = 0;
};

TEST(BackwardSearchTreeLaw, PlansCostTheLeastWhereItIsMadeAndRepairedInParts) {
  std::mt19937 random(2026);
  int answers = 0, stopped = 0;
  for (int trial = 0; trial < 60; ++trial) {
    SCOPED_TRACE("trial " + std::to_string(trial));
    Journey journey(random, trial % 2 == 0 ? 250 : 60);
    Worker worker(random);
    SearchResult result;
    for (int edit = 0; edit < 40; ++edit) {
      if (journey.possible()) {
        if (random() % 3 != 0) worker.work(journey);
        result = {};
        if (random() % 2 == 0) answers += worker.answers(journey, result) ? 1 : 0;
        if (HasFailure()) FAIL() << "edit " << edit;
      }
      const Map before = journey.map();
      const CellRect changed = journey.edit();
      worker.follow(*before, *journey.map(), changed);
      journey.move(result.cells);
    }
    stopped += worker.stopped();
  }
  EXPECT_GT(answers, 200);
  EXPECT_GT(stopped, 40);
}

// Of a corridor whose goal is its last cell.
void rootAtTheEnd(const CostGrid& map, MovePruning& moves, BackwardNodes& nodes) {
  moves.build(map, StopToken());
  nodes.prepare(map, moves);
  nodes.setMap(map);
  nodes.reset(static_cast<BackwardNodes::Index>(map.geometry().size() - 1));
}

// All its cells are closed.
void treeOfCorridor(const CostGrid& map, MovePruning& moves, BackwardNodes& nodes) {
  rootAtTheEnd(map, moves, nodes);
  for (BackwardNodes::Index index = nodes.root(); index-- > 0;)
    nodes.set(index, nodes.g(index + 1) + nodes.stepKey(index, index + 1, 0), 0,
              BackwardNodes::CLOSED);
}

// After a cost rose in the middle of a corridor, only the cells to the west of it are outdated.
TEST(OutdatedCells, AreThoseWhosePathsLeadOverAChange) {
  const CostGrid before = test::costMap({"........"}), after = test::costMap({"....?..."});
  MovePruning moves;
  BackwardNodes nodes;
  treeOfCorridor(before, moves, nodes);
  moves.update(after, {4, 0, 1, 1}, StopToken());
  nodes.setMap(after);
  OutdatedCells outdated;
  const StopToken stop;
  StopPoll poll(stop);
  outdated.add(nodes, {3, 0, 3, 1});
  outdated.find(nodes, poll);
  std::vector<BackwardNodes::Index> cells = outdated.cells();
  std::sort(cells.begin(), cells.end());
  EXPECT_EQ(cells, (std::vector<BackwardNodes::Index>{0, 1, 2, 3, 4}));
}

// Each change sorted some ten thousand cells that nobody ever asked for, in milliseconds, where nothing is repaired.
TEST(OutdatedCells, HoldAChangeThatComesAgainAndAgainOnce) {
  const CostGrid after = test::costMap({".?.."});
  MovePruning moves;
  BackwardNodes nodes;
  rootAtTheEnd(after, moves, nodes);
  for (const BackwardNodes::Index index : {2, 1, 0})
    nodes.set(index, (3 - index) * nodes.stepLength(0), 0, BackwardNodes::CLOSED);
  OutdatedCells outdated;
  for (int change = 0; change < 100000; ++change) outdated.add(nodes, {0, 0, 4, 1});
  EXPECT_LT(outdated.bytes(), 100U);
}

// A change that comes again while find() goes on is found again, and what restart() begins anew as well.
TEST(OutdatedCells, AreFoundAgainAfterAChangeBetweenTwoParts) {
  const CostGrid before = test::costMap({std::string(100, '.')});
  MovePruning moves;
  BackwardNodes nodes;
  treeOfCorridor(before, moves, nodes);
  const StopToken stop;
  StopPoll poll(stop);
  OutdatedCells outdated;
  outdated.add(nodes, {0, 0, 100, 1});
  outdated.find(nodes, poll);
  EXPECT_TRUE(outdated.cells().empty());
  std::string row(100, '.');
  row[50] = '?';
  const CostGrid after = test::costMap({row});
  moves.update(after, {50, 0, 1, 1}, StopToken());
  nodes.setMap(after);
  outdated.add(nodes, {49, 0, 3, 1});
  EXPECT_FALSE(outdated.noneAdded());
  outdated.find(nodes, poll);
  EXPECT_EQ(outdated.cells().size(), 51U);
  outdated.restart();
  EXPECT_FALSE(outdated.noneAdded());
  outdated.find(nodes, poll);
  EXPECT_EQ(outdated.cells().size(), 51U);
}

// A tree that is wanted for kOverSlopes, on the second of two maps.
struct Wanted {
  Wanted() {
    tree.searched(*slopes.map(), kOverSlopes, kManyCells);
    change({200, 100, 2, 2}, 50);
    tree.searched(*slopes.map(), kOverSlopes, kManyCells);
  }
  void change(const CellRect& rect, CostGrid::Weight weight) {
    const Map before = slopes.map();
    slopes.edit(rect, weight);
    tree.update(*before, *slopes.map(), {rect}, StopToken());
  }
  // How many idle times it takes until nothing is left to do, each cancelled before it begins, with an
  // edit after each.
  int idleTimes() {
    int times = 0;
    for (; times < 1000 && tree.wanted(*slopes.map()); ++times) {
      ends([&] { tree.make(*slopes.map(), cancelled()); });
      change({10 + times % 280, 150, 1, 1}, 40);
    }
    return times;
  }

  Slopes slopes;
  KeptSearchTree tree;
};

TEST(KeptSearchTree, IsMadeInIdleTimesThatAddUp) {
  Wanted wanted;
  const int times = wanted.idleTimes();
  EXPECT_GT(times, 10);
  EXPECT_LT(times, 200);
  SearchResult result;
  ASSERT_TRUE(wanted.tree.search(*wanted.slopes.map(), kOverSlopes, result, StopToken()));
  expectLeast(*wanted.slopes.map(), {5, 5}, {294, 290}, true, result);
}

// It is repaired, which ends in fewer parts than its making took.
TEST(KeptSearchTree, IsRepairedRatherThanMadeAgain) {
  Wanted wanted;
  const int to_make = wanted.idleTimes();
  SearchResult result;
  ASSERT_TRUE(wanted.tree.search(*wanted.slopes.map(), kOverSlopes, result, StopToken()));
  for (const double share : {0.3, 0.4, 0.2, 0.35}) {
    const Map before = wanted.slopes.map();
    const CellRect changed = wanted.slopes.editOn(result.cells, share);
    wanted.tree.update(*before, *wanted.slopes.map(), {changed}, StopToken());
    constexpr std::uint64_t few_cells = 64;  // so few that the tree is given up
    wanted.tree.searched(*wanted.slopes.map(), kOverSlopes, few_cells);
    SearchResult given_up;
    EXPECT_FALSE(wanted.tree.search(*wanted.slopes.map(), kOverSlopes, given_up, StopToken()));
    ASSERT_TRUE(wanted.tree.wanted(*wanted.slopes.map()));
    EXPECT_LT(wanted.idleTimes(), to_make);
    wanted.tree.searched(*wanted.slopes.map(), kOverSlopes, kManyCells);
    result = {};
    ASSERT_TRUE(wanted.tree.search(*wanted.slopes.map(), kOverSlopes, result, StopToken()));
    expectLeast(*wanted.slopes.map(), {5, 5}, {294, 290}, true, result);
  }
}

// As a node does while it is idle.
TEST(WeightedJumpPoint, RepairsItsTreeAfterEditsOnItsPath) {
  Slopes slopes;
  WeightedJumpPoint planner;
  planner.prepare(slopes.map(), StopToken());
  SearchResult result = planner.search(kOverSlopes, StopToken());
  planner.finishBackgroundWork(StopToken());
  for (const double share : {0.5, 0.3, 0.7}) {
    const CellRect changed = slopes.editOn(result.cells, share);
    planner.update(slopes.map(), {changed}, StopToken());
    result = planner.search(kOverSlopes, StopToken());
    planner.finishBackgroundWork(StopToken());
  }
  EXPECT_EQ(result.answered_by, "incremental_a_star");
  expectLeast(*slopes.map(), {5, 5}, {294, 290}, result.status == Status::FOUND, result);
}

}  // namespace
}  // namespace grid_path_planner::planners
