// path_planner as a process of its own.
//
//   path_planner [--waypoints-file FILE]      FILE: where every found plan is written
#include "ros/planning/mains.h"

int main(int argc, char** argv) {
  return grid_path_planner::nodes::pathPlannerMain(argc, argv);
}
