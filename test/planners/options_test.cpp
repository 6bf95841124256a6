#include <gtest/gtest.h>

#include "grid_path_planner/planners/map_planner.h"
#include "grid_path_planner/search/search_options.h"
#include "grid_path_planner/terrain/terrain_options.h"
#include "support/option_laws.h"

namespace grid_path_planner {
namespace {

TEST(PlannerOptions, AllHoldToTheLaws) {
  test::expectOptionLaws<TerrainOptions>();
  test::expectOptionLaws<SearchOptions>();
  test::expectOptionLaws<PlannerOptions>();
}

}  // namespace
}  // namespace grid_path_planner
