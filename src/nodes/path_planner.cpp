// path_planner as a process of its own.
#include "ros/planning/mains.h"

int main(int argc, char** argv) {
  return grid_path_planner::nodes::pathPlannerMain(argc, argv);
}
