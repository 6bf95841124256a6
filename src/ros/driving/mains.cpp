#include "ros/driving/mains.h"

#include "ros/common/run_node.h"
#include "ros/driving/navigate_path_node.h"
#include "ros/driving/teleop_joy_node.h"

namespace grid_path_planner::nodes {

int navigatePathMain(int argc, char** argv) {
  return runNode<NavigatePathNode>(argc, argv, "navigate_path",
                                   {{"config_filename", "WAYPOINTS.yaml"}});
}

int teleopJoyMain(int argc, char** argv) {
  return runNode<TeleopJoyNode>(argc, argv, "teleop_joy");
}

}  // namespace grid_path_planner::nodes
