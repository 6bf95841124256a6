// projected_map as a process of its own.
//
//   projected_map [FILE]      FILE: an octree (.bt or .ot) to load, as for octomap_server_node
#include "ros/mapping/mains.h"

int main(int argc, char** argv) {
  return grid_path_planner::nodes::projectedMapMain(argc, argv);
}
