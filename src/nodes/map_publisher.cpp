// map_publisher as a process of its own.
//
//   map_publisher [FILE]      FILE: the map, as for map_server
#include "ros/planning/mains.h"

int main(int argc, char** argv) {
  return grid_path_planner::nodes::mapPublisherMain(argc, argv);
}
