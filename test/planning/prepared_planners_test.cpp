// What planners prepared of a map outlives questions to others.
#include <gtest/gtest.h>

#include <limits>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "grid_path_planner/planning/path_planner.h"

namespace grid_path_planner::planning {

using base::Status;
using base::StopToken;
using grid::Cell;
using grid::CellRect;
using grid::GridGeometry;
using grid::OccupancyGrid;
using planners::Planner;
using planners::PlannerTraits;
using planners::SearchOptions;
using planners::SearchRequest;
using planners::SearchResult;

namespace {

constexpr std::size_t kBytes = 10'000'000;    // of each planner
constexpr std::size_t kOptional = 5'000'000;  // more, once its background work is done

struct Counts {
  int prepared = 0;
  int updated = 0;
  bool optional = false;  // memory is held
};

// Finds no path, and counts what it prepares.
class Counting : public Planner {
 public:
  Counting(const std::string& name, bool repairs, Counts& counts)
      : Planner(traitsOf(name, repairs)), counts_(counts) {}
  std::size_t bytesFor(const GridGeometry&) const override {
    return kBytes + (counts_.optional ? kOptional : 0);
  }
  void releaseOptionalMemory() override { counts_.optional = false; }

 private:
  static PlannerTraits traitsOf(const std::string& name, bool repairs) {
    PlannerTraits traits{name};
    traits.repairs = repairs;
    return traits;
  }
  void doPrepare(const StopToken&) override { ++counts_.prepared; }
  void doUpdate(const std::vector<CellRect>&, const StopToken&) override { ++counts_.updated; }
  void doFinishBackgroundWork(const StopToken&) override { counts_.optional = true; }
  SearchResult doSearch(const SearchRequest&, const StopToken&) override {
    SearchResult result;
    result.status = Status::UNREACHABLE;
    return result;
  }

  Counts& counts_;
};

class PreparedState : public ::testing::Test {
 protected:
  PreparedState() { planner_.setMap(map_); }

  // One that prepares anew for every change, and others that repair.
  Plan ask(const std::string& name, int landmarks = 16) {
    PlannerOptions options;
    options.planner = name;
    options.search.landmarks = landmarks;
    return ask(options);
  }
  Plan ask(const PlannerOptions& options) {
    planner_.setOptions(options);
    return planner_.plan({poseAt({1, 1}), poseAt({30, 30}), false});
  }
  // Whether planner "a" keeps its optional memory while a plan is made within so many times what is held.
  bool keepsOptionalMemory(PlannerOptions options, double times) {
    options.planner = "a";
    planner_.limitMemory(std::numeric_limits<std::size_t>::max());
    ask(options);
    planner_.finishPreparation(StopToken());
    EXPECT_TRUE(counts_["a"].optional);
    planner_.limitMemory(static_cast<std::size_t>(times * static_cast<double>(planner_.bytes())));
    const Plan plan = ask(options);
    EXPECT_EQ(plan.status, Status::UNREACHABLE) << "and is not refused: " << plan.message;
    return counts_["a"].optional;
  }
  void change(const CellRect& rect) {
    auto next = std::make_shared<OccupancyGrid>(*map_);
    for (int row = rect.row; row < rect.row + rect.height; ++row)
      for (int column = rect.column; column < rect.column + rect.width; ++column)
        (*next)[Cell{column, row}] = 100;
    map_ = next;
    planner_.updateMap(map_, {rect});
  }
  path::Pose poseAt(Cell cell) const {
    path::Pose pose;
    pose.position.head<2>() = map_->geometry().centre(cell);
    return pose;
  }

  std::map<std::string, Counts> counts_;
  std::shared_ptr<const OccupancyGrid> map_ =
      std::make_shared<const OccupancyGrid>(GridGeometry(64, 64, 1.0), 0);
  PathPlanner planner_{{}, [this](const std::string& name, const SearchOptions&) {
                         return std::make_unique<Counting>(name, name != "forgets", counts_[name]);
                       }};
};

TEST_F(PreparedState, OutlivesQuestionsToOtherPlanners) {
  for (int round = 0; round < 3; ++round)
    for (const char* name : {"a", "b", "forgets"}) EXPECT_EQ(ask(name).answered_by, name);
  for (const char* name : {"a", "b", "forgets"}) EXPECT_EQ(counts_[name].prepared, 1) << name;
  ask("a", 8);
  EXPECT_EQ(counts_["a"].prepared, 2) << "other options prepare something else";
  ask("a", 16);
  EXPECT_EQ(counts_["a"].prepared, 2);
}

TEST_F(PreparedState, FollowsSmallChangesWhereItCanBeRepaired) {
  for (const char* name : {"a", "forgets", "b"}) ask(name);
  change({40, 40, 3, 3});
  for (const char* name : {"b", "a", "forgets"}) ask(name);
  EXPECT_EQ(counts_["a"].prepared, 1);
  EXPECT_EQ(counts_["a"].updated, 1);
  EXPECT_EQ(counts_["b"].prepared, 1);
  EXPECT_EQ(counts_["forgets"].prepared, 2);
}

TEST_F(PreparedState, IsGivenUpForAnotherMapAndOtherCosts) {
  ask("a");
  ask("b");
  planner_.setMap(std::make_shared<const OccupancyGrid>(*map_));
  ask("b");
  ask("a");
  EXPECT_EQ(counts_["a"].prepared, 2);
  PlannerOptions options;
  options.planner = "a";
  options.costmap.occupied_is_passable = true;
  planner_.setOptions(options);
  planner_.plan({poseAt({1, 1}), poseAt({30, 30}), false});
  EXPECT_EQ(counts_["a"].prepared, 3);
}

TEST_F(PreparedState, ThatWasAskedForLongestAgoGoesFirst) {
  ask("a");
  planner_.limitMemory(planner_.bytes() + kBytes);  // two of them
  ask("b");
  ask("a");
  ask("c");  // b goes
  ask("a");
  EXPECT_EQ(counts_["a"].prepared, 1);
  ask("b");
  EXPECT_EQ(counts_["b"].prepared, 2);
  EXPECT_EQ(ask("b").status, Status::UNREACHABLE) << "and is not refused";
}

TEST_F(PreparedState, GivesItsOptionalMemoryBeforeAnythingThatIsPrepared) {
  ask("a");
  planner_.finishPreparation(StopToken());
  planner_.limitMemory(planner_.bytes() - kOptional + kBytes);
  ask("b");
  EXPECT_FALSE(counts_["a"].optional);
  ask("a");
  EXPECT_EQ(counts_["a"].prepared, 1);
}

// What a footprint's further tries take is not known beforehand.
TEST_F(PreparedState, GivesItsOptionalMemoryToFootprints) {
  PlannerOptions footprint;
  footprint.footprint = "[[1, 1], [1, -1], [-1, -1], [-1, 1]]";
  EXPECT_TRUE(keepsOptionalMemory(footprint, 3.0));
  EXPECT_FALSE(keepsOptionalMemory(footprint, 1.9));
  EXPECT_TRUE(keepsOptionalMemory({}, 1.9));
}

}  // namespace
}  // namespace grid_path_planner::planning
