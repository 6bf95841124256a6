// What dynamic_reconfigure may ask of every node.
#include "fuzz/fuzz_target.h"
#include "fuzz/messages/fuzz_messages.h"
#include "grid_path_planner/mapping/projected_map_options.h"
#include "layers/map_layers_options.h"
#include "planning/cost_planner_options.h"
#include "ros/adapters/adapter_options.h"
#include "ros/avoidance/local_planner_options.h"
#include "ros/driving/go_to_pose_options.h"
#include "ros/driving/navigate_path_options.h"
#include "ros/driving/teleop_joy_options.h"
#include "ros/guard/parameters.h"
#include "ros/localization/marker_localizer_options.h"
#include "ros/localization/vehicle_localizer_options.h"
#include "ros/planning/map_publisher_options.h"
#include "ros/planning/path_planner_options.h"
#include "ros/simulation/simulator_options.h"

namespace grid_path_planner::fuzz {
namespace {

std::vector<std::string> seedsOfConfigs() {
  return {bytesOf(nodes::configMessage(nodes::PathPlannerNodeOptions())),
          bytesOf(nodes::configMessage(nodes::NavigatePathOptions())),
          bytesOf(nodes::configMessage(mapping::ProjectedMapOptions())),
          bytesOf(nodes::configMessage(nodes::SimulatorOptions())),
          bytesOf(nodes::configMessage(nodes::TeleopJoyOptions())),
          bytesOf(nodes::configMessage(nodes::MapPublisherOptions())),
          bytesOf(nodes::configMessage(layers::MapLayersOptions()))};
}

// Options that are taken are inside their limits, and as text they are the same again.
template <class Options, class Check>
void reconfigure(const dynamic_reconfigure::Config& message, const Check& check) {
  mayRefuse([&] {
    const Options options = nodes::withConfigMessage(Options(), message);
    check(options);
    base::checkOptionLimits(options);
    nodes::withConfigMessage(Options(), nodes::configMessage(options));
  });
}

FUZZ_TARGET(config_message, seedsOfConfigs) {
  const auto message = messageOf<dynamic_reconfigure::Config>(input);
  if (!message) return;
  reconfigure<nodes::PathPlannerNodeOptions>(*message, nodes::checkPathPlannerNodeOptions);
  reconfigure<nodes::NavigatePathOptions>(*message, nodes::checkNavigatePathOptions);
  reconfigure<mapping::ProjectedMapOptions>(*message, mapping::checkProjectedMapOptions);
  reconfigure<nodes::SimulatorOptions>(*message, nodes::checkSimulatorOptions);
  reconfigure<nodes::TeleopJoyOptions>(*message, nodes::checkTeleopJoyOptions);
  reconfigure<nodes::MapPublisherOptions>(*message, nodes::checkMapPublisherOptions);
  reconfigure<layers::MapLayersOptions>(*message,
                                        base::checkOptionLimits<layers::MapLayersOptions>);
}

std::vector<std::string> seedsOfVehicleConfigs() {
  nodes::MarkerLocalizerOptions markers;
  markers.layout = "panel.yaml";
  return {bytesOf(nodes::configMessage(nodes::LocalPlannerOptions())),
          bytesOf(nodes::configMessage(nodes::GoToPoseOptions())),
          bytesOf(nodes::configMessage(nodes::VehicleLocalizerOptions())),
          bytesOf(nodes::configMessage(markers)),
          bytesOf(nodes::configMessage(nodes::AdapterOptions()))};
}

FUZZ_TARGET(vehicle_config_message, seedsOfVehicleConfigs) {
  const auto message = messageOf<dynamic_reconfigure::Config>(input);
  if (!message) return;
  reconfigure<nodes::LocalPlannerOptions>(*message, nodes::checkLocalPlannerOptions);
  reconfigure<nodes::GoToPoseOptions>(*message, nodes::checkGoToPoseOptions);
  reconfigure<nodes::VehicleLocalizerOptions>(*message, nodes::checkVehicleLocalizerOptions);
  reconfigure<nodes::MarkerLocalizerOptions>(*message, nodes::checkMarkerLocalizerOptions);
  reconfigure<nodes::AdapterOptions>(*message, nodes::checkAdapterOptions);
}

}  // namespace
}  // namespace grid_path_planner::fuzz
