#include "ros/support/parameter_defaults.h"

#include "grid_path_planner/PathPlannerConfig.h"
#include "grid_path_planner/ros/path_planner_options.h"

namespace grid_path_planner {
namespace {

TEST(ParameterDefaults, PathPlanner) {
  test::expectSameDefaults<PathPlannerConfig, PathPlannerNodeOptions>("path_planner");
}

}  // namespace
}  // namespace grid_path_planner
