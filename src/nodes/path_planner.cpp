// path_planner as a process of its own.
#include "grid_path_planner/ros/path_planner_node.h"
#include "grid_path_planner/ros/run_node.h"

int main(int argc, char** argv) {
  return grid_path_planner::runNode<grid_path_planner::PathPlannerNode>(argc, argv, "path_planner");
}
