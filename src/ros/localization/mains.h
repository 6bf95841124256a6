// The main program of vehicle_localizer: src/nodes/ calls it, and so needs no header of ROS.
#pragma once

namespace grid_path_planner::nodes {

int vehicleLocalizerMain(int argc, char** argv);

}  // namespace grid_path_planner::nodes
