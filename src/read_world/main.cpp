// No node: reads a world for the simulator, in a process of its own with limits. Not to be started by
// hand.
#include "simulation/read_world_main.h"

int main(int argc, char** argv) {
  return grid_path_planner::simulation::readWorldMain(argc, argv);
}
