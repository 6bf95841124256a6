#include "ros/localization/mains.h"

#include "ros/guard/run_node.h"
#include "ros/localization/marker_localizer_node.h"
#include "ros/localization/vehicle_localizer_node.h"

namespace grid_path_planner::nodes {

int markerLocalizerMain(int argc, char** argv) {
  return runNode<MarkerLocalizerNode>(argc, argv, "marker_localizer",
                                      {{"layout", "LAYOUT.yaml", true, checkCanBeOpened}});
}

int vehicleLocalizerMain(int argc, char** argv) {
  return runNode<VehicleLocalizerNode>(argc, argv, "vehicle_localizer",
                                       std::vector<FileArgument>());
}

}  // namespace grid_path_planner::nodes
