// map_publisher as a process of its own.
//
//   map_publisher [FILE]      FILE: the map, as map_server has it
#include "grid_path_planner/ros/map_publisher_node.h"
#include "grid_path_planner/ros/run_node.h"

int main(int argc, char** argv) {
  return grid_path_planner::runNodeWithFile<grid_path_planner::MapPublisherNode>(
      argc, argv, "map_publisher", "MAP_FILE");
}
