#include "ros/messages/vehicle_parameters.h"

#include "ros/guard/parameters.h"

namespace grid_path_planner::nodes {

using base::InputError;
using vehicle::Description;

namespace {

const char* const kVehicle = "vehicle";

}  // namespace

std::optional<Description> loadVehicle(const ros::NodeHandle& private_nh) {
  if (!private_nh.hasParam(kVehicle)) return std::nullopt;
  const ros::NodeHandle block(private_nh, kVehicle);
  const std::vector<std::string> known = optionNames<Description>();
  const std::vector<std::string> unknown = unknownParameters(block, known);
  if (!unknown.empty())
    throw InputError(block.resolveName(unknown.front()) + " is no value of a vehicle" +
                     meantText(unknown.front(), "", known));
  Description vehicle;
  loadParameters(block, vehicle);
  checkDescription(block.getNamespace(), vehicle);
  return vehicle;
}

std::vector<std::string> withVehicleNames(std::vector<std::string> options) {
  for (const std::string& name : optionNames<Description>())
    options.push_back(std::string(kVehicle) + "/" + name);
  return options;
}

}  // namespace grid_path_planner::nodes
