// The tree of a vehicle's goal: every answer costs what a search costs that shares no code with it, after
// whatever changed, was stopped, given up or out of memory.
#include "planners/replanning/kept_search_tree.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <map>
#include <new>
#include <random>
#include <string>

#include "planners/jump_point/weighted_jump_point.h"
#include "planners/replanning/journey.h"
#include "planners/replanning/slopes.h"
#include "support/cost_maps.h"
#include "support/random_map.h"

namespace {

// Negative: none fails; else so many of this thread succeed before one fails.
thread_local long allocations_left = -1;

}  // namespace

void* operator new(std::size_t size) {
  if (allocations_left >= 0 && allocations_left-- == 0) throw std::bad_alloc();
  void* memory = std::malloc(size == 0 ? 1 : size);
  if (memory == nullptr) throw std::bad_alloc();
  return memory;
}
// As the standard library's own does; the address sanitizer's allocates by itself, and complains of free().
void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  try {
    return operator new(size);
  } catch (const std::bad_alloc&) {
    return nullptr;
  }
}
void operator delete(void* memory) noexcept {
  std::free(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
  std::free(memory);
}

namespace grid_path_planner::planners {

using base::Status;
using base::Stopped;
using base::StopSource;
using base::StopToken;
using costmap::CostGrid;
using grid::Cell;
using grid::CellRect;
using grid::Grid;
using grid::GridGeometry;
using test::expectLeast;
using test::Journey;
using test::Map;
using test::Slopes;

namespace {

constexpr std::uint64_t kAllCells = 1 << 20;

// What a planner does that keeps a tree beside its searches; these are left out.
class Replanner {
 public:
  // Whether the tree answered, at the least cost.
  bool answers(const Journey& journey, std::uint64_t cells_of_a_search) {
    result_ = {};
    const bool answered = tree_.search(*journey.map(), journey.request(), result_, StopToken());
    if (answered)
      expectLeast(*journey.map(), journey.start(), journey.goal(), result_.status == Status::FOUND,
                  result_);
    else
      tree_.searched(*journey.map(), journey.request(), cells_of_a_search);
    return answered;
  }
  void idle(const CostGrid& map) {
    if (tree_.wanted(map)) tree_.make(map, StopToken());
  }
  void follow(const CostGrid& before, const CostGrid& after, const CellRect& changed) {
    tree_.update(before, after, {changed}, StopToken());
  }

  KeptSearchTree& tree() { return tree_; }
  const std::vector<Cell>& path() const { return result_.cells; }

 private:
  KeptSearchTree tree_;
  SearchResult result_;
};

// One of what happens to a map: an edit; an edit and its contrary before the next question; an end closed.
void changeOnce(std::mt19937& random, Journey& journey, Replanner& replanner) {
  const Map before = journey.map();
  const unsigned kind = random() % 10;
  const CellRect changed = kind == 0   ? journey.close(journey.start())
                           : kind == 1 ? journey.close(journey.goal())
                                       : journey.edit();
  replanner.follow(*before, *journey.map(), changed);
  const bool ends_closed = kind < 2 && random() % 2 == 0;
  if (kind != 2 && !ends_closed) return;
  const Map between = journey.map();
  journey.restore(*before);
  replanner.follow(*between, *journey.map(), changed);
}

TEST(KeptSearchTreeLaw, TenThousandEditsOfATreeCostTheLeast) {
  std::mt19937 random(1956);
  int edits = 0, answers = 0, given_up = 0;
  for (int trial = 0; edits < 10000; ++trial) {
    SCOPED_TRACE("trial " + std::to_string(trial));
    Journey journey(random, trial % 16 == 0 ? 80 : 28);
    Replanner replanner;
    for (int edit = 0; edit < 25; ++edit) {
      if (random() % 20 == 0 || !journey.map()->passable(journey.goal())) journey.moveGoal();
      const bool held = replanner.tree().held();
      edits += held ? 1 : 0;
      if (journey.possible()) {
        const bool answered = replanner.answers(journey, random() % 4 != 0 ? kAllCells : 40);
        answers += answered ? 1 : 0;
        given_up += held && !answered ? 1 : 0;
      }
      if (HasFatalFailure()) FAIL() << "edit " << edit;
      if (random() % 3 != 0) replanner.idle(*journey.map());
      changeOnce(random, journey, replanner);
      journey.move(replanner.path());
    }
  }
  EXPECT_GT(answers, 3000);
  EXPECT_GT(given_up, 1000);
}

// Follows an edit, answers and makes a tree, in all of which any allocation may fail.
void failSomewhere(std::mt19937& random, Journey& journey, KeptSearchTree& tree) {
  const Map before = journey.map();
  const std::vector<CellRect> changed = {journey.edit()};
  const SearchRequest request = journey.request();
  SearchResult lost;
  allocations_left = static_cast<long>(random() % 12);
  tree.update(*before, *journey.map(), changed, StopToken());
  if (journey.possible()) tree.search(*journey.map(), request, lost, StopToken());
  if (tree.wanted(*journey.map())) tree.make(*journey.map(), StopToken());
  allocations_left = -1;
}

TEST(KeptSearchTreeLaw, AnswersCostTheLeastAfterMemoryRanOut) {
  std::mt19937 random(1984);
  int failures = 0, answers = 0;
  for (int trial = 0; trial < 500; ++trial) {
    SCOPED_TRACE("trial " + std::to_string(trial));
    Journey journey(random, 40);
    Replanner replanner;
    for (int edit = 0; edit < 24; ++edit) {
      if (!journey.map()->passable(journey.goal())) journey.moveGoal();
      if (journey.possible()) answers += replanner.answers(journey, kAllCells) ? 1 : 0;
      if (HasFatalFailure()) FAIL() << "edit " << edit;
      replanner.idle(*journey.map());
      const bool held = replanner.tree().held();
      if (held && random() % 3 == 0)
        failSomewhere(random, journey, replanner.tree());
      else
        changeOnce(random, journey, replanner);
      const bool failed = held && !replanner.tree().held();
      failures += failed ? 1 : 0;
      if (failed) replanner.tree().release();  // so that it may be made again
      journey.move(replanner.path());
    }
  }
  EXPECT_GT(failures, 300);
  EXPECT_GT(answers, 1000);
}

const SearchRequest kAcross{{5, 5}, {{294, 290}}, false};

void expectLeastAcross(const CostGrid& map, const SearchResult& result) {
  expectLeast(map, kAcross.start, kAcross.goals.front(), result.status == Status::FOUND, result);
}

// A planner that was asked twice and has its tree; and the map.
struct Driving {
  Driving() {
    planner.prepare(slopes.map(), StopToken());
    for (const double share : {0.5, 0.3}) {
      result = planner.search(kAcross, StopToken());
      planner.update(slopes.map(), {slopes.editOn(result.cells, share)}, StopToken());
      planner.finishBackgroundWork(StopToken());
    }
    result = planner.search(kAcross, StopToken());
    planner.finishBackgroundWork(StopToken());
  }
  void editOnPath(double share) {
    const CellRect changed = slopes.editOn(result.cells, share);
    planner.update(slopes.map(), {changed}, StopToken());
  }
  void ask() { result = planner.search(kAcross, StopToken()); }

  Slopes slopes;
  WeightedJumpPoint planner;
  SearchResult result;
};

TEST(WeightedJumpPoint, ItsTreeAnswersAfterEditsOfAMapThatItsVehicleDrivesOver) {
  Driving driving;
  std::map<std::string, int> answers;
  for (const double share : {0.1, 0.4, 0.6, 0.2}) {
    driving.editOnPath(share);
    driving.ask();
    ++answers[driving.result.answered_by];
    expectLeastAcross(*driving.slopes.map(), driving.result);
    driving.planner.finishBackgroundWork(StopToken());
    EXPECT_FALSE(driving.planner.backgroundWork().pending);
  }
  EXPECT_GE(answers["incremental_a_star"], 3);
}

TEST(WeightedJumpPoint, NothingIsSearchedAfterAnEditThatDoesNotMatter) {
  Driving driving;
  driving.planner.update(driving.slopes.edit({280, 10, 2, 2}, 60), {{280, 10, 2, 2}}, StopToken());
  driving.ask();
  EXPECT_EQ(driving.result.answered_by, "incremental_a_star");
  EXPECT_EQ(driving.result.statistics.expanded, 0U);
  expectLeastAcross(*driving.slopes.map(), driving.result);
}

TEST(KeptSearchTree, IsWantedForAGoalThatIsSearchedForOnTwoMaps) {
  const Slopes slopes;
  Slopes changed;
  changed.edit({200, 100, 2, 2}, 50);
  SearchRequest elsewhere = kAcross;
  elsewhere.goals = {{290, 5}};
  KeptSearchTree tree;
  tree.searched(*slopes.map(), kAcross, kAllCells);
  tree.searched(*slopes.map(), kAcross, kAllCells);
  EXPECT_FALSE(tree.wanted(*slopes.map()));
  tree.searched(*changed.map(), elsewhere, kAllCells);
  EXPECT_FALSE(tree.wanted(*changed.map()));
  tree.searched(*changed.map(), kAcross, kAllCells);
  tree.searched(*slopes.map(), kAcross, kAllCells);
  EXPECT_TRUE(tree.wanted(*slopes.map()));
}

TEST(KeptSearchTree, IsMadeEverMoreSeldomWhereItNeverAnswers) {
  Slopes slopes;
  KeptSearchTree tree;
  const CellRect much{0, 0, 200, 50};
  CostGrid::Weight weight = 50;
  const auto isWantedAfterChange = [&] {
    const Map before = slopes.map();
    slopes.edit(much, ++weight);
    tree.update(*before, *slopes.map(), {much}, StopToken());
    tree.searched(*slopes.map(), kAcross, kAllCells);
    return tree.wanted(*slopes.map());
  };
  StopSource stopped;
  stopped.cancel();
  int made = 0;
  for (int change = 0; change < 96; ++change) {
    if (!isWantedAfterChange()) continue;
    if (++made == 7)
      tree.make(*slopes.map(), StopToken());
    else
      EXPECT_THROW(tree.make(*slopes.map(), stopped.token()), Stopped);
  }
  EXPECT_EQ(made, 7);  // at changes 2, 4, 8, 16, 32, 64, 96
  SearchResult result;
  EXPECT_TRUE(tree.search(*slopes.map(), kAcross, result, StopToken()));
  EXPECT_TRUE(isWantedAfterChange()) << "it has answered";
}

TEST(KeptSearchTree, ACancelledMakingLeavesNone) {
  const Slopes slopes;
  Slopes changed;
  const CellRect rect{200, 100, 2, 2};
  changed.edit(rect, 50);
  KeptSearchTree tree;
  tree.searched(*slopes.map(), kAcross, kAllCells);
  EXPECT_FALSE(tree.wanted(*slopes.map()));
  tree.searched(*changed.map(), kAcross, kAllCells);
  StopSource source;
  source.cancel();
  ASSERT_TRUE(tree.wanted(*changed.map()));
  EXPECT_THROW(tree.make(*changed.map(), source.token()), Stopped);
  SearchResult result;
  EXPECT_FALSE(tree.search(*changed.map(), kAcross, result, StopToken()));
  ASSERT_TRUE(tree.wanted(*changed.map()));
  tree.make(*changed.map(), StopToken());
  ASSERT_TRUE(tree.search(*changed.map(), kAcross, result, StopToken()));
  expectLeastAcross(*changed.map(), result);
}

// Cancelled in a repair of more cells than a loop goes on without asking.
TEST(WeightedJumpPoint, ACancelledRepairLeavesItsTreeRight) {
  Driving driving;
  StopSource source;
  source.cancel();
  for (const double share : {0.9, 0.5, 0.1}) {
    driving.editOnPath(share);
    EXPECT_EQ(driving.planner.search(kAcross, source.token()).status, Status::CANCELLED);
    driving.ask();
    expectLeastAcross(*driving.slopes.map(), driving.result);
    driving.planner.finishBackgroundWork(StopToken());
  }
}

TEST(WeightedJumpPoint, WithoutMemoryForItsTreeItSearches) {
  Driving driving;
  const std::size_t with_tree = driving.planner.bytesFor(driving.slopes.map()->geometry());
  driving.planner.limitMemory(with_tree - 1);
  const std::size_t without = driving.planner.bytesFor(driving.slopes.map()->geometry());
  EXPECT_EQ(with_tree - without, KeptSearchTree::bytesFor(driving.slopes.map()->geometry()));
  for (const double share : {0.5, 0.3, 0.7}) {
    driving.editOnPath(share);
    driving.ask();
    EXPECT_NE(driving.result.answered_by, "incremental_a_star");
    expectLeastAcross(*driving.slopes.map(), driving.result);
    driving.planner.finishBackgroundWork(StopToken());
  }
}

// Another geometry, as of a map that grows and shifts its origin, has nothing of the tree.
TEST(WeightedJumpPoint, AMapOfAnotherSizeIsPlannedWithoutTheTree) {
  Driving driving;
  Grid<CostGrid::Weight> weights(GridGeometry(310, 300, 1.0), 2);
  for (int row = 0; row < 300; ++row)
    std::copy_n(driving.slopes.map()->weights().row(row), 300, weights.row(row) + 10);
  const Map grown = test::costsOf(weights, {}, driving.slopes.map()->revision() + 1);
  driving.planner.update(grown, {{0, 0, 310, 300}}, StopToken());
  driving.ask();
  EXPECT_NE(driving.result.answered_by, "incremental_a_star");
  expectLeastAcross(*grown, driving.result);
}

TEST(WeightedJumpPointLaw, CostsAreLeastWhileItsVehicleDrives) {
  std::mt19937 random(17);
  std::map<std::string, int> answers;
  for (int trial = 0; trial < 4; ++trial) {
    const GridGeometry geometry(200, 150 + trial, 1.0);
    const auto cellFrom = [&](int column) {
      return Cell{column + int(random() % 20), int(random() % 150)};
    };
    Grid<CostGrid::Weight> weights = test::randomPotential(random, geometry, {}).weights();
    Map map = test::costsOf(weights);
    WeightedJumpPoint planner;
    planner.prepare(map, StopToken());
    Cell start = cellFrom(0), goal = cellFrom(180);
    for (int edit = 0; edit < 40; ++edit) {
      SCOPED_TRACE("trial " + std::to_string(trial) + ", edit " + std::to_string(edit));
      if (map->passable(start) && map->passable(goal)) {
        const SearchResult result = planner.search({start, {goal}, false}, StopToken());
        ++answers[result.answered_by];
        expectLeast(*map, start, goal, result.status == Status::FOUND, result);
        if (HasFatalFailure()) return;
        if (result.cells.size() > 3) start = result.cells[random() % 3];
      } else {
        start = cellFrom(0);
      }
      if (edit % 20 == 19 || !map->passable(goal)) goal = cellFrom(180);
      if (random() % 4 != 0) planner.finishBackgroundWork(StopToken());
      const std::vector<CellRect> changed = test::randomRects(random, geometry, 6);
      for (const CellRect& each : changed) {
        const CellRect rect = each.intersection(geometry.rect());
        for (int row = rect.row; row < rect.row + rect.height; ++row)
          std::fill_n(weights.row(row) + rect.column, rect.width,
                      static_cast<CostGrid::Weight>(random() % 60));
      }
      map = test::costsOf(weights, {}, map->revision() + 1);
      planner.update(map, changed, StopToken());
    }
  }
  EXPECT_GT(answers["incremental_a_star"], 50);
  EXPECT_GT(answers["weighted_jump_point"] + answers["a_star"], 20);
}

}  // namespace
}  // namespace grid_path_planner::planners
