// The node that takes goals, as a process of its own.
#include "ros/driving/mains.h"

int main(int argc, char** argv) {
  return grid_path_planner::nodes::goToPoseMain(argc, argv);
}
