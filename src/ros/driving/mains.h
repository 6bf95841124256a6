// The main programs of navigate_path, go_to_pose and teleop_joy: src/nodes/ calls them, and so needs no header of ROS.
#pragma once

namespace grid_path_planner::nodes {

int navigatePathMain(int argc, char** argv);
int goToPoseMain(int argc, char** argv);
int teleopJoyMain(int argc, char** argv);

}  // namespace grid_path_planner::nodes
