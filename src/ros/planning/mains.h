// The main programs of path_planner and map_publisher: src/nodes/ calls them, and so needs no header of ROS.
#pragma once

namespace grid_path_planner::nodes {

int pathPlannerMain(int argc, char** argv);
int mapPublisherMain(int argc, char** argv);

}  // namespace grid_path_planner::nodes
