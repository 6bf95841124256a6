// projected_map as a process of its own.
//
//   projected_map [FILE]      FILE: an octree (.bt or .ot) to begin with, as octomap_server_node
//   has it
#include <ros/init.h>

#include <iostream>

#include "grid_path_planner/ros/projected_map_node.h"
#include "grid_path_planner/ros/run_node.h"

int main(int argc, char** argv) {
  ros::V_string arguments;
  ros::removeROSArgs(argc, argv, arguments);
  if (arguments.size() > 2) {
    std::cerr << "usage: projected_map [FILE.bt|FILE.ot]\n";
    return 2;
  }
  const std::string filename = arguments.size() == 2 ? arguments[1] : "";
  return grid_path_planner::runNode(
      argc, argv, "projected_map",
      [&](ros::NodeHandle& nh, ros::NodeHandle& private_nh) -> std::shared_ptr<void> {
        return std::make_shared<grid_path_planner::ProjectedMapNode>(nh, private_nh, filename);
      });
}
