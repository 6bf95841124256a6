// navigate_path as a process of its own.
#include "grid_path_planner/ros/navigate_path_node.h"
#include "grid_path_planner/ros/run_node.h"

int main(int argc, char** argv) {
  return grid_path_planner::runNode<grid_path_planner::NavigatePathNode>(argc, argv,
                                                                         "navigate_path");
}
