// navigate_path as a process of its own.
#include "ros/common/run_node.h"
#include "ros/driving/navigate_path_node.h"

int main(int argc, char** argv) {
  return grid_path_planner::nodes::runNode<grid_path_planner::nodes::NavigatePathNode>(
      argc, argv, "navigate_path");
}
