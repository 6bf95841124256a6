// The main program of projected_map: src/nodes/ calls it, and so needs no header of ROS.
#pragma once

namespace grid_path_planner::nodes {

int projectedMapMain(int argc, char** argv);

}  // namespace grid_path_planner::nodes
