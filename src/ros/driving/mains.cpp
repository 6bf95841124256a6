#include "ros/driving/mains.h"

#include "grid_path_planner/path/waypoint_file.h"
#include "ros/driving/go_to_pose_node.h"
#include "ros/driving/navigate_path_node.h"
#include "ros/driving/teleop_joy_node.h"
#include "ros/guard/ending/shutdown_flag.h"
#include "ros/guard/run_node.h"

namespace grid_path_planner::nodes {

using path::readWaypointFile;

namespace {

void checkWaypointFile(const std::string& file) {
  const ShutdownFlag end;
  readWaypointFile(file, {{}, end.token()});
}

}  // namespace

int navigatePathMain(int argc, char** argv) {
  return runNode<NavigatePathNode>(
      argc, argv, "navigate_path",
      {{"config_filename", "WAYPOINTS.yaml", false, checkWaypointFile}});
}

int goToPoseMain(int argc, char** argv) {
  return runNode<GoToPoseNode>(argc, argv, "go_to_pose");
}

int teleopJoyMain(int argc, char** argv) {
  return runNode<TeleopJoyNode>(argc, argv, "teleop_joy");
}

}  // namespace grid_path_planner::nodes
