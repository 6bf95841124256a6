// map_publisher as a process of its own.
#include "grid_path_planner/ros/map_publisher_node.h"
#include "grid_path_planner/ros/run_node.h"

int main(int argc, char** argv) {
  return grid_path_planner::runNode<grid_path_planner::MapPublisherNode>(argc, argv,
                                                                         "map_publisher");
}
