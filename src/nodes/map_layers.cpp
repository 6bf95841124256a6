// map_layers as a process of its own.
#include "ros/layers/mains.h"

int main(int argc, char** argv) {
  return grid_path_planner::nodes::mapLayersMain(argc, argv);
}
