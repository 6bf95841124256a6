#include <gtest/gtest.h>

#include "grid_path_planner/planners/planner_factory.h"
#include "support/ascii_map.h"
#include "support/cost_maps.h"

namespace grid_path_planner::planning {

using base::Status;
using base::StopToken;
using planners::Heuristic;
using planners::makePlanner;
using planners::SearchOptions;
using planners::SearchResult;

// Where the table of heuristic exact was ready, its infinite bound was added to a cost: a goal that no
// path leads to was INVALID_REQUEST ("may cost more than ...") instead of UNREACHABLE, or not,
// depending on how long the table took.
TEST(ExactHeuristic, AnUnreachableGoalIsUnreachableOnceTheTableIsReady) {
  const test::AsciiMap picture({"S.#..",  //
                                "..#.G"});
  SearchOptions options;
  options.heuristic = Heuristic::EXACT;
  for (const char* name : {"a_star", "weighted_jump_point"}) {
    const auto planner = makePlanner(name, options);
    planner->prepare(test::costsOf(picture.map), StopToken());
    planner->finishBackgroundWork(StopToken());
    const SearchResult result =
        planner->search({picture.start, {picture.goal}, false}, StopToken());
    EXPECT_EQ(result.status, Status::UNREACHABLE) << name << ": " << result.message;
  }
}

}  // namespace grid_path_planner::planning
