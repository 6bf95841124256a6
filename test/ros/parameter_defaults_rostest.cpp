#include "ros/support/parameter_defaults.h"

#include "grid_path_planner/MapPublisherConfig.h"
#include "grid_path_planner/NavigatePathConfig.h"
#include "grid_path_planner/PathPlannerConfig.h"
#include "grid_path_planner/ProjectedMapConfig.h"
#include "grid_path_planner/SimulatorConfig.h"
#include "grid_path_planner/TeleopJoyConfig.h"
#include "grid_path_planner/ros/map_publisher_options.h"
#include "grid_path_planner/ros/navigate_path_options.h"
#include "grid_path_planner/ros/path_planner_options.h"
#include "grid_path_planner/ros/projected_map_options.h"
#include "grid_path_planner/ros/simulator_options.h"
#include "grid_path_planner/ros/teleop_joy_options.h"

namespace grid_path_planner {
namespace {

TEST(ParameterDefaults, PathPlanner) {
  test::expectSameDefaults<PathPlannerConfig, PathPlannerNodeOptions>("path_planner");
}

TEST(ParameterDefaults, NavigatePath) {
  test::expectSameDefaults<NavigatePathConfig, NavigatePathOptions>("navigate_path");
}

TEST(ParameterDefaults, Simulator) {
  test::expectSameDefaults<SimulatorConfig, SimulatorOptions>("simulator");
}

TEST(ParameterDefaults, TeleopJoy) {
  test::expectSameDefaults<TeleopJoyConfig, TeleopJoyOptions>("teleop_joy");
}

TEST(ParameterDefaults, MapPublisher) {
  test::expectSameDefaults<MapPublisherConfig, MapPublisherOptions>("map_publisher");
}

TEST(ParameterDefaults, ProjectedMap) {
  test::expectSameDefaults<ProjectedMapConfig, ProjectedMapOptions>("projected_map");
}

}  // namespace
}  // namespace grid_path_planner
