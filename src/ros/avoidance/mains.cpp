#include "ros/avoidance/mains.h"

#include "ros/avoidance/local_planner_node.h"
#include "ros/guard/run_node.h"

namespace grid_path_planner::nodes {

int localPlannerMain(int argc, char** argv) {
  return runNode<LocalPlannerNode>(argc, argv, "local_planner",
                                   {{"config_filename", "WAYPOINTS.yaml"}, {"log", "LOG.flight"}});
}

}  // namespace grid_path_planner::nodes
