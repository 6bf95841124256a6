// The main program of local_planner: src/nodes/ calls it, and so needs no header of ROS.
#pragma once

namespace grid_path_planner::nodes {

int localPlannerMain(int argc, char** argv);

}  // namespace grid_path_planner::nodes
