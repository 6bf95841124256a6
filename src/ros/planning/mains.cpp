#include "ros/planning/mains.h"

#include "ros/guard/run_node.h"
#include "ros/planning/map_publisher_node.h"
#include "ros/planning/path_planner_node.h"

namespace grid_path_planner::nodes {

int pathPlannerMain(int argc, char** argv) {
  return runNode<PathPlannerNode>(argc, argv, "path_planner", {{"waypoints_file", "FILE.yaml"}});
}

int mapPublisherMain(int argc, char** argv) {
  return runNode<MapPublisherNode>(argc, argv, "map_publisher",
                                   {{"filename", "MAP_FILE", true, checkCanBeOpened}});
}

}  // namespace grid_path_planner::nodes
