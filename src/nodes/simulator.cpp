// The simulated vehicle as a process of its own.
//
//   simulator [--world FILE]           FILE: the world that is seen and touched
//             [--sensor-faults FILE]   FILE: what is cut and spoiled of navigation sensors, and when
#include "ros/simulation/mains.h"

int main(int argc, char** argv) {
  return grid_path_planner::nodes::simulatorMain(argc, argv);
}
