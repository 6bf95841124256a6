// navigate_path as a process of its own.
//
//   navigate_path [--config-filename FILE]      FILE: waypoints to drive instead of the topic path
#include "ros/driving/mains.h"

int main(int argc, char** argv) {
  return grid_path_planner::nodes::navigatePathMain(argc, argv);
}
