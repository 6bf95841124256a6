// marker_localizer as a process of its own.
#include "ros/localization/mains.h"

int main(int argc, char** argv) {
  return grid_path_planner::nodes::markerLocalizerMain(argc, argv);
}
