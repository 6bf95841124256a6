#include <gtest/gtest.h>

#include "grid_path_planner/costmap/costmap_options.h"
#include "grid_path_planner/planners/search_options.h"
#include "grid_path_planner/planning/path_planner.h"
#include "support/option_laws.h"

namespace grid_path_planner::planning {

using costmap::CostmapOptions;
using planners::SearchOptions;

namespace {

TEST(PlannerOptions, AllHoldToTheLaws) {
  test::expectOptionLaws<CostmapOptions>();
  test::expectOptionLaws<SearchOptions>();
  test::expectOptionLaws<PlannerOptions>();
}

}  // namespace
}  // namespace grid_path_planner::planning
