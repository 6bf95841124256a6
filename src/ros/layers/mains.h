// The main program of map_layers: src/nodes/ calls it, and so needs no header of ROS.
#pragma once

namespace grid_path_planner::nodes {

int mapLayersMain(int argc, char** argv);

}  // namespace grid_path_planner::nodes
