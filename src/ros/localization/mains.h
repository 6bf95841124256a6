// The main programs of marker_localizer and vehicle_localizer: src/nodes/ calls them, and so needs no header of ROS.
#pragma once

namespace grid_path_planner::nodes {

int markerLocalizerMain(int argc, char** argv);
int vehicleLocalizerMain(int argc, char** argv);

}  // namespace grid_path_planner::nodes
