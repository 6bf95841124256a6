// local_planner as a process of its own.
//
//   local_planner [--config-filename FILE]      FILE: waypoints to fly at the start
#include "ros/avoidance/mains.h"

int main(int argc, char** argv) {
  return grid_path_planner::nodes::localPlannerMain(argc, argv);
}
