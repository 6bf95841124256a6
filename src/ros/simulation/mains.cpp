#include "ros/simulation/mains.h"

#include "ros/guard/run_node.h"
#include "ros/simulation/simulator_node.h"

namespace grid_path_planner::nodes {

int simulatorMain(int argc, char** argv) {
  return runNode<SimulatorNode>(argc, argv, "simulator",
                                {{"world", "WORLD.sdf", false, checkCanBeOpened},
                                 {"sensor_faults", "FAULTS.yaml", false, checkCanBeOpened}});
}

}  // namespace grid_path_planner::nodes
