// projected_map as a process of its own.
//
//   projected_map [FILE]      FILE: an octree (.bt or .ot) to load, as for octomap_server_node
#include "ros/common/run_node.h"
#include "ros/mapping/projected_map_node.h"

int main(int argc, char** argv) {
  return grid_path_planner::nodes::runNodeWithFile<grid_path_planner::nodes::ProjectedMapNode>(
      argc, argv, "projected_map", "FILE.bt|FILE.ot");
}
