// The main program of simulator: src/nodes/ calls it, and so needs no header of ROS.
#pragma once

namespace grid_path_planner::nodes {

int simulatorMain(int argc, char** argv);

}  // namespace grid_path_planner::nodes
