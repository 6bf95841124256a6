#include "ros/mapping/mains.h"

#include "ros/guard/run_node.h"
#include "ros/mapping/projected_map_node.h"

namespace grid_path_planner::nodes {

int projectedMapMain(int argc, char** argv) {
  return runNode<ProjectedMapNode>(argc, argv, "projected_map",
                                   {{"filename", "FILE.bt|FILE.ot", true, checkCanBeOpened},
                                    {"map_file", "FILE.yaml"},
                                    {"octree_file", "FILE.bt|FILE.ot"}});
}

}  // namespace grid_path_planner::nodes
