// Joystick control as a process of its own.
#include "ros/common/run_node.h"
#include "ros/driving/teleop_joy_node.h"

int main(int argc, char** argv) {
  return grid_path_planner::nodes::runNode<grid_path_planner::nodes::TeleopJoyNode>(argc, argv,
                                                                                    "teleop_joy");
}
