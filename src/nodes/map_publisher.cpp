// map_publisher as a process of its own.
//
//   map_publisher [FILE]      FILE: the map, as for map_server
#include "ros/common/run_node.h"
#include "ros/planning/map_publisher_node.h"

int main(int argc, char** argv) {
  return grid_path_planner::nodes::runNodeWithFile<grid_path_planner::nodes::MapPublisherNode>(
      argc, argv, "map_publisher", "MAP_FILE");
}
