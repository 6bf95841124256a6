// The backward search tree, repaired while the map changes and the start moves: every cost is
// compared with a search that shares no code with it.
#include "planners/replanning/backward_search_tree.h"

#include <gtest/gtest.h>

#include <memory>
#include <optional>
#include <random>
#include <set>

#include "planners/astar/dijkstra.h"
#include "planners/replanning/incremental_a_star.h"
#include "planners/replanning/journey.h"
#include "support/cost_maps.h"

namespace grid_path_planner::planners {

using base::Status;
using base::Stopped;
using base::StopSource;
using base::StopToken;
using costmap::CostGrid;
using costmap::ExactCost;
using grid::Cell;
using grid::CellIndex;
using grid::CellRect;
using grid::Grid;
using grid::GridGeometry;
using test::costMap;
using test::expectLeast;
using test::Journey;
using test::Map;

namespace {

// The status that `search` returns; none where keys cannot hold the cost.
template <class Search>
std::optional<Status> unlessTooExpensive(const Search& search) {
  try {
    return search();
  } catch (const TooExpensive&) {
    return std::nullopt;
  }
}

TEST(BackwardSearchTreeLaw, EveryPlanCostsTheLeast) {
  std::mt19937 random(2002);
  int plans = 0;
  for (int trial = 0; trial < 600; ++trial) {
    SCOPED_TRACE("trial " + std::to_string(trial));
    Journey journey(random, trial % 8 == 0 ? 100 : 28);
    if (!journey.possible()) continue;
    MovePruning moves;
    moves.build(*journey.map(), StopToken());
    BackwardSearchTree tree;
    tree.prepare(*journey.map(), moves);
    SearchResult result;
    const auto built = unlessTooExpensive([&] {
      return tree.build(*journey.map(), journey.goal(), journey.start(), trial % 3, false, result,
                        StopToken());
    });
    if (!built) continue;
    expectLeast(*journey.map(), journey.start(), journey.goal(), built == Status::FOUND, result);
    for (int edit = 0; edit < 14; ++edit) {
      const Map before = journey.map();
      const CellRect changed = journey.edit();
      moves.update(*journey.map(), changed, StopToken());
      tree.update(*before, *journey.map(), changed);
      journey.move(result.cells);
      if (!journey.possible() || random() % 4 == 0) continue;
      if (!tree.usableFor(*journey.map(), journey.goal())) break;  // a weight below the minimum
      result = {};
      const auto status = unlessTooExpensive(
          [&] { return tree.plan(*journey.map(), journey.start(), false, result, StopToken()); });
      if (!status) break;
      ++plans;
      expectLeast(*journey.map(), journey.start(), journey.goal(), status == Status::FOUND, result);
      if (HasFatalFailure()) return;
    }
  }
  EXPECT_GT(plans, 1000);
}

// A tree for `goal` after one plan.
struct Planned {
  Planned(const CostGrid& map, Cell goal, Cell start, double extra) {
    moves.build(map, StopToken());
    tree.prepare(map, moves);
    tree.build(map, goal, start, extra, false, result, StopToken());
  }
  void update(const CostGrid& before, const CostGrid& after, const CellRect& changed) {
    moves.update(after, changed, StopToken());
    tree.update(before, after, changed);
    result = {};
  }

  MovePruning moves;
  BackwardSearchTree tree;
  SearchResult result;
};

TEST(BackwardNodes, AreNewAgainWhenTheStampWrapsAround) {
  const CostGrid map = costMap({"..."});
  MovePruning moves;
  moves.build(map, StopToken());
  BackwardNodes nodes;
  nodes.prepare(map, moves);
  for (int tree = 0; tree < 70000; ++tree) {
    nodes.reset(0);
    ASSERT_EQ(nodes.state(0), BackwardNodes::OPEN);
    ASSERT_EQ(nodes.state(1), BackwardNodes::NEW) << "tree " << tree;
    if (tree == 0) nodes.set(1, 5, 2, BackwardNodes::CLOSED);
  }
}

TEST(BackwardSearchTree, NothingIsDoneForAChangeThatDoesNotMatter) {
  const Grid<CostGrid::Weight> weights(GridGeometry(40, 40, 1.0), 1);
  const CostGrid before = costMap(weights);
  Grid<CostGrid::Weight> changed = weights;
  changed[Cell{2, 37}] = CostGrid::kBlocked;
  const CostGrid after = costMap(changed);
  Planned planned(before, {35, 3}, {3, 3}, 3);
  const std::vector<Cell> path = planned.result.cells;
  planned.update(before, after, {2, 37, 1, 1});
  EXPECT_EQ(planned.tree.plan(after, {3, 3}, false, planned.result, StopToken()), Status::FOUND);
  EXPECT_EQ(planned.result.statistics.expanded, 0U);
  EXPECT_EQ(planned.result.cells, path);
}

// The goal's g-value is 0, which once stood for "none yet" where g-values are compared.
TEST(BackwardSearchTree, FindsACostDecreaseBesideTheGoal) {
  const CostGrid before = costMap({"2322",  //
                                   "2322",  //
                                   "2322"});
  const CostGrid after = costMap({"2322",  //
                                  "2222",  //
                                  "2322"});
  Planned planned(before, {0, 0}, {3, 1}, 3);
  planned.update(before, after, {1, 1, 1, 1});
  const Status status = planned.tree.plan(after, {3, 1}, false, planned.result, StopToken());
  expectLeast(after, {3, 1}, {0, 0}, status == Status::FOUND, planned.result);
}

TEST(BackwardSearchTree, AStoppedPlanContinues) {
  Grid<CostGrid::Weight> weights(GridGeometry(150, 150, 1.0), 1);
  const CostGrid before = costMap(weights);
  const CellRect wall{75, 5, 1, 140};
  for (int row = wall.row; row < wall.row + wall.height; ++row)
    weights[Cell{75, row}] = CostGrid::kBlocked;
  const CostGrid after = costMap(weights);
  Planned planned(before, {140, 75}, {10, 75}, 0);
  planned.update(before, after, wall);
  StopSource source;
  source.cancel();
  EXPECT_THROW(planned.tree.plan(after, {10, 75}, false, planned.result, source.token()), Stopped);
  planned.result = {};
  const Status status = planned.tree.plan(after, {10, 75}, false, planned.result, StopToken());
  expectLeast(after, {10, 75}, {140, 75}, status == Status::FOUND, planned.result);
}

TEST(IncrementalAStarLaw, PlansWhileDrivingCostTheLeast) {
  std::mt19937 random(1968);
  for (int trial = 0; trial < 1000; ++trial) {
    SCOPED_TRACE("trial " + std::to_string(trial));
    Journey journey(random, trial % 8 == 0 ? 100 : 28);
    IncrementalAStar planner;
    planner.prepare(journey.map(), StopToken());
    SearchResult result;
    for (int edit = 0; edit < 12; ++edit) {
      if (journey.possible()) {
        result = planner.search({journey.start(), {journey.goal()}, false}, StopToken());
        expectLeast(*journey.map(), journey.start(), journey.goal(), result.status == Status::FOUND,
                    result);
        if (HasFatalFailure()) return;
      }
      const CellRect changed = journey.edit();
      planner.update(journey.map(), {changed}, StopToken());
      journey.move(result.cells);
    }
  }
}

// A large map with a post here and there, across which every plan leads.
class Crossing {
 public:
  Crossing() : weights_(GridGeometry(400, 400, 1.0), 1) {
    for (int i = 0; i < 400 * 400; i += 97) weights_[CellIndex(i)] = 30;
    planner_.prepare(map(), StopToken());
  }

  void change(const CellRect& rect, CostGrid::Weight weight) {
    for (int row = rect.row; row < rect.row + rect.height; ++row)
      for (int column = rect.column; column < rect.column + rect.width; ++column)
        weights_[Cell{column, row}] = weight;
    ++revision_;
    planner_.update(map(), {rect}, StopToken());
  }
  // The cells that a plan took, which costs the least.
  std::uint64_t expanded() {
    const SearchRequest request{{20, 20}, {{390, 200}}, false};
    Dijkstra dijkstra;
    dijkstra.prepare(map(), StopToken());
    const SearchResult result = planner_.search(request, StopToken());
    EXPECT_EQ(result.cost, dijkstra.search(request, StopToken()).cost);
    return result.statistics.expanded;
  }

 private:
  Map map() const { return test::costsOf(weights_, {}, revision_); }

  Grid<CostGrid::Weight> weights_;
  std::uint64_t revision_ = 0;
  IncrementalAStar planner_;
};

// The search grows with the change, not with the map or the length of the path.
TEST(IncrementalAStar, ExpandsAroundAChangeOnly) {
  Crossing crossing;
  const std::uint64_t first = crossing.expanded();
  const CellRect block{25, 15, 3, 12};
  crossing.change(block, CostGrid::kBlocked);
  EXPECT_LT(crossing.expanded(), first / 20);
  crossing.change(block, 1);
  EXPECT_LT(crossing.expanded(), first / 20);
  crossing.change({200, 0, 2, 215}, CostGrid::kBlocked);
  EXPECT_GT(crossing.expanded(), 100U);
  crossing.change({2, 390, 3, 3}, CostGrid::kBlocked);
  EXPECT_EQ(crossing.expanded(), 0U);
}

// A door that stays closed: a tree without the paths around it is replaced in time.
TEST(IncrementalAStar, ReplacesATreeThatNoLongerPays) {
  Crossing crossing;
  const std::uint64_t first = crossing.expanded();
  crossing.change({385, 0, 2, 399}, CostGrid::kBlocked);  // but for one row
  std::uint64_t repairs = 0;
  for (int plan = 0; plan < 40; ++plan) {
    crossing.change({398, 2, 1, 1}, plan % 2 == 0 ? 2 : 1);  // so that the last path is not kept
    repairs += crossing.expanded();
  }
  EXPECT_GT(repairs, 2 * first);
  EXPECT_LT(repairs, 6 * first);
  EXPECT_EQ(crossing.expanded(), 0U);
}

TEST(HeapOnTopQueue, PopsTheLeastKeyInAnyOrderOfCalls) {
  std::mt19937 random(17);
  for (int trial = 0; trial < 50; ++trial) {
    HeapOnTopQueue queue;
    queue.reset(random() % 1000, 1 + random() % 50);
    std::multiset<SearchKey> reference;
    const auto renew = [](HeapOnTopQueue::Entry&) { return true; };
    for (int call = 0; call < 2000; ++call) {
      if (random() % 3 != 0) {
        const SearchKey key = random() % (trial % 2 == 0 ? 3000 : 3000000);
        queue.push({key, 0, 0});
        reference.insert(key);
        continue;
      }
      const SearchKey bound = random() % 4000;
      const HeapOnTopQueue::Entry* first = queue.first(bound, renew);
      ASSERT_EQ(first != nullptr, !reference.empty() && *reference.begin() <= bound);
      if (first == nullptr) continue;
      ASSERT_EQ(first->key, *reference.begin());
      queue.pop();
      reference.erase(reference.begin());
      ASSERT_EQ(queue.size(), reference.size());
    }
  }
}

// The tree's keys end at 3.2 million cells x weight.
TEST(IncrementalAStar, FindsPathsThatTheTreesKeysCannotHold) {
  Grid<CostGrid::Weight> weights(GridGeometry(60, 60, 1.0), 65535);
  IncrementalAStar planner;
  planner.prepare(test::costsOf(weights), StopToken());
  const auto planned = [&](Cell goal) {
    return planner.search({{0, 0}, {goal}, false}, StopToken());
  };
  EXPECT_EQ(planned({20, 0}).cost, (ExactCost{20 * 65535, 0}));
  EXPECT_EQ(planned({59, 59}).cost, (ExactCost{0, 59 * 65535}));

  const CellRect wall{30, 0, 1, 59};
  for (int row = 0; row < 59; ++row) weights[Cell{30, row}] = CostGrid::kBlocked;
  const Map changed = test::costsOf(weights, {}, 1);
  planner.update(changed, {wall}, StopToken());
  const SearchResult around = planned({59, 0});
  expectLeast(*changed, {0, 0}, {59, 0}, around.status == Status::FOUND, around);
}

// A map came in the place of another one. The frontiers of its trees stayed in the tiles that had had memory on the
// first, in the place of those of later trees: a goal over open ground was said to be unreachable.
TEST(IncrementalAStar, FindsPathsOnTheMapAfterTheFirst) {
  const auto open = [] {
    return test::costsOf(Grid<CostGrid::Weight>(GridGeometry(200, 200, 1.0), 1));
  };
  IncrementalAStar planner;
  for (int map = 0; map < 2; ++map) {
    planner.prepare(open(), StopToken());
    for (const int column : {20, 23, 26})
      EXPECT_EQ(planner.search({{10, 10}, {{column, 10}}, false}, StopToken()).cost,
                (ExactCost{column - 10, 0}));
  }
  EXPECT_EQ(planner.search({{190, 10}, {{26, 10}}, false}, StopToken()).cost, (ExactCost{164, 0}));
}

}  // namespace
}  // namespace grid_path_planner::planners
