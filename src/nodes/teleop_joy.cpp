// Joystick control as a process of its own.
#include "grid_path_planner/ros/run_node.h"
#include "grid_path_planner/ros/teleop_joy_node.h"

int main(int argc, char** argv) {
  return grid_path_planner::runNode<grid_path_planner::TeleopJoyNode>(argc, argv, "teleop_joy");
}
