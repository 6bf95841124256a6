// The simulated vehicle as a process of its own.
#include "ros/common/run_node.h"
#include "ros/simulation/simulator_node.h"

int main(int argc, char** argv) {
  return grid_path_planner::nodes::runNode<grid_path_planner::nodes::SimulatorNode>(argc, argv,
                                                                                    "simulator");
}
