#include "ros/support/parameter_defaults.h"

#include "grid_path_planner/GoToPoseConfig.h"
#include "grid_path_planner/MapLayersConfig.h"
#include "grid_path_planner/MapPublisherConfig.h"
#include "grid_path_planner/MarkerLocalizerConfig.h"
#include "grid_path_planner/NavigatePathConfig.h"
#include "grid_path_planner/PathPlannerConfig.h"
#include "grid_path_planner/ProjectedMapConfig.h"
#include "grid_path_planner/SimulatorConfig.h"
#include "grid_path_planner/TeleopJoyConfig.h"
#include "grid_path_planner/VehicleLocalizerConfig.h"
#include "grid_path_planner/mapping/projected_map_options.h"
#include "layers/map_layers_options.h"
#include "ros/driving/go_to_pose_options.h"
#include "ros/driving/navigate_path_options.h"
#include "ros/driving/teleop_joy_options.h"
#include "ros/localization/marker_localizer_options.h"
#include "ros/localization/vehicle_localizer_options.h"
#include "ros/planning/map_publisher_options.h"
#include "ros/planning/path_planner_options.h"
#include "ros/simulation/simulator_options.h"

namespace grid_path_planner::nodes {

using mapping::ProjectedMapOptions;

namespace {

TEST(ParameterDefaults, PathPlanner) {
  test::expectSameDefaults<PathPlannerConfig, PathPlannerNodeOptions>("path_planner");
}

TEST(ParameterDefaults, NavigatePath) {
  test::expectSameDefaults<NavigatePathConfig, NavigatePathOptions>("navigate_path");
}

TEST(ParameterDefaults, GoToPose) {
  test::expectSameDefaults<GoToPoseConfig, GoToPoseOptions>("go_to_pose");
}

TEST(ParameterDefaults, Simulator) {
  test::expectSameDefaults<SimulatorConfig, SimulatorOptions>("simulator");
}

TEST(ParameterDefaults, TeleopJoy) {
  test::expectSameDefaults<TeleopJoyConfig, TeleopJoyOptions>("teleop_joy");
}

TEST(ParameterDefaults, MarkerLocalizer) {
  test::expectSameDefaults<MarkerLocalizerConfig, MarkerLocalizerOptions>("marker_localizer");
}

TEST(ParameterDefaults, VehicleLocalizer) {
  test::expectSameDefaults<VehicleLocalizerConfig, VehicleLocalizerOptions>("vehicle_localizer");
}

TEST(ParameterDefaults, MapLayers) {
  test::expectSameDefaults<MapLayersConfig, layers::MapLayersOptions>("map_layers");
}

TEST(ParameterDefaults, MapPublisher) {
  test::expectSameDefaults<MapPublisherConfig, MapPublisherOptions>("map_publisher");
}

TEST(ParameterDefaults, ProjectedMap) {
  test::expectSameDefaults<ProjectedMapConfig, ProjectedMapOptions>("projected_map");
}

}  // namespace
}  // namespace grid_path_planner::nodes
