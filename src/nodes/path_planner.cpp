// path_planner as a process of its own.
#include "ros/common/run_node.h"
#include "ros/planning/path_planner_node.h"

int main(int argc, char** argv) {
  return grid_path_planner::nodes::runNode<grid_path_planner::nodes::PathPlannerNode>(
      argc, argv, "path_planner");
}
