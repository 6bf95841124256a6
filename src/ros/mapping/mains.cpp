#include "ros/mapping/mains.h"

#include "ros/common/run_node.h"
#include "ros/mapping/projected_map_node.h"

namespace grid_path_planner::nodes {

int projectedMapMain(int argc, char** argv) {
  return runNodeWithFile<ProjectedMapNode>(argc, argv, "projected_map", "FILE.bt|FILE.ot");
}

}  // namespace grid_path_planner::nodes
