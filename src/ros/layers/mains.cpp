#include "ros/layers/mains.h"

#include "ros/guard/run_node.h"
#include "ros/layers/map_layers_node.h"

namespace grid_path_planner::nodes {

int mapLayersMain(int argc, char** argv) {
  return runNode<MapLayersNode>(argc, argv, "map_layers", {{"zones_file", "ZONES.yaml"}});
}

}  // namespace grid_path_planner::nodes
