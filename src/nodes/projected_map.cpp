// projected_map as a process of its own.
//
//   projected_map [FILE]      FILE: an octree (.bt or .ot) to begin with, as octomap_server_node
//                             has it
#include "grid_path_planner/ros/projected_map_node.h"
#include "grid_path_planner/ros/run_node.h"

int main(int argc, char** argv) {
  return grid_path_planner::runNodeWithFile<grid_path_planner::ProjectedMapNode>(
      argc, argv, "projected_map", "FILE.bt|FILE.ot");
}
