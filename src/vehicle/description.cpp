#include "vehicle/description.h"

#include <algorithm>
#include <cmath>

#include "grid_path_planner/base/decimal_text.h"
#include "grid_path_planner/base/option_text.h"
#include "grid_path_planner/base/yaml_file.h"

namespace grid_path_planner::vehicle {

using base::checkOptionLimits, base::decimalText, base::InputError, base::setOption, base::yamlAs,
    base::yamlError;

namespace {

constexpr double kSameLength = 1e-3;  // m
const char* const kBlock = "vehicle";

void refuse(const std::string& name, const std::string& what) {
  throw InputError(name + ": " + what);
}

void checkGiven(const std::string& name, const char* option, double value) {
  if (value == 0.0) refuse(name, std::string(option) + " is missing or 0; it has no default");
}

void checkOutline(const std::string& name, const Description& vehicle) {
  const Footprint polygon = Footprint::fromText(name + ": outline", vehicle.outline);
  if (polygon.empty() && vehicle.radius == 0.0)
    refuse(name, "an outline is missing: give radius, or outline with its corners");
  if (polygon.empty()) return;
  if (!isConvexAnticlockwise(polygon))
    refuse(name, "outline must be convex with its corners anticlockwise, seen from above");
  if (vehicle.radius > 0.0 &&
      std::abs(vehicle.radius - polygon.circumscribedRadius()) > kSameLength)
    refuse(name, "radius " + decimalText(vehicle.radius) +
                     " m and outline disagree, whose corners reach " +
                     decimalText(polygon.circumscribedRadius()) + " m: give one of them");
}

void checkDrive(const std::string& name, const Description& vehicle) {
  const double slowest = std::min(vehicle.max_backward_speed, vehicle.max_sideways_speed);
  if (vehicle.drive == Drive::OMNIDIRECTIONAL && slowest == 0.0)
    refuse(name,
           "an omnidirectional drive needs max_backward_speed and max_sideways_speed above 0");
  const bool car = vehicle.drive == Drive::CAR;
  if (car) checkGiven(name, "least_turning_radius", vehicle.least_turning_radius);
  if (!car && vehicle.least_turning_radius > 0.0)
    refuse(name, "least_turning_radius is of a car; this drive turns on the spot");
  if (vehicle.drive != Drive::OMNIDIRECTIONAL && vehicle.max_sideways_speed > 0.0)
    refuse(name, "max_sideways_speed is of an omnidirectional drive; this one cannot");
}

// The text that options are read from: a scalar, or corners as a list of lists.
std::string textOf(const YAML::Node& node, const std::string& name, const std::string& file) {
  if (node.IsScalar()) return yamlAs<std::string>(node, name, file, "a value");
  if (!node.IsSequence()) throw yamlError(node, file, name + " must be a value");
  std::string text = "[";
  for (const YAML::Node& corner : node) {
    if (!corner.IsSequence() || corner.size() != 2)
      throw yamlError(node, file, name + " must be corners, [[x, y], [x, y], ...]");
    const auto coordinate = [&](int axis) {
      return decimalText(yamlAs<double>(corner[axis], name, file, "metres"));
    };
    text += (text.size() > 1 ? ", [" : "[") + coordinate(0) + ", " + coordinate(1) + "]";
  }
  return text + "]";
}

}  // namespace

const std::vector<std::pair<const char*, Drive>>& choicesOf(Drive) {
  static const std::vector<std::pair<const char*, Drive>> choices = {
      {"omnidirectional", Drive::OMNIDIRECTIONAL},
      {"differential", Drive::DIFFERENTIAL},
      {"car", Drive::CAR}};
  return choices;
}

void checkDescription(const std::string& name, const Description& vehicle) {
  if (vehicle.drive == Drive::NOT_GIVEN)
    refuse(name, "drive is missing: omnidirectional, differential or car");
  checkOutline(name, vehicle);
  checkGiven(name, "max_speed", vehicle.max_speed);
  checkGiven(name, "max_yaw_rate", vehicle.max_yaw_rate);
  checkGiven(name, "max_acceleration", vehicle.max_acceleration);
  checkGiven(name, "max_yaw_acceleration", vehicle.max_yaw_acceleration);
  checkDrive(name, vehicle);
  try {
    checkOptionLimits(vehicle);
  } catch (const InputError& error) {
    refuse(name, error.what());
  }
}

Description readDescription(const std::string& file) {
  const YAML::Node root = base::loadYamlFile(file);
  const YAML::Node block = base::yamlNode(root, kBlock, file, "the description of a vehicle");
  Description vehicle;
  std::set<std::string> known;
  visitOptions(vehicle,
               [&](const char* name, auto&, const base::OptionInfo&) { known.insert(name); });
  base::checkKeys(block, kBlock, file, known);
  for (const auto& entry : block) {
    const auto name = entry.first.as<std::string>();
    const std::string text = textOf(entry.second, name, file);
    try {
      setOption(vehicle, name, text);
    } catch (const InputError& error) {
      throw yamlError(entry.second, file, error.what());
    }
  }
  checkDescription(file, vehicle);
  return vehicle;
}

Outline outlineOf(const Description& vehicle) {
  Footprint polygon = Footprint::fromText("outline", vehicle.outline);
  return polygon.empty() ? Outline(vehicle.radius) : Outline(std::move(polygon));
}

void unite(const char* name, double& value, double unset, double described) {
  if (value != unset && value != described)
    throw InputError(std::string(name) + " is " + decimalText(value) + " and the vehicle's " +
                     decimalText(described) + ": they must be equal, or " + name +
                     " be left out of the parameters");
  value = described;
}

void uniteOutline(const char* name, std::string& corners, const Description& vehicle) {
  const Footprint given = Footprint::fromText(name, corners);
  if (!given.empty() && given.corners() != outlineOf(vehicle).polygon().corners())
    throw InputError(std::string(name) + " and the vehicle's outline differ: leave " + name +
                     " out of the parameters");
  corners = vehicle.outline;
}

void checkKeptDistance(const char* name, double distance, const Description& vehicle) {
  const double least = outlineOf(vehicle).inscribedRadius();
  if (distance > 0.0 && distance < least)
    throw InputError(std::string(name) + " is " + decimalText(distance) + " m, less than the " +
                     decimalText(least) + " m of the vehicle's outline");
}

}  // namespace grid_path_planner::vehicle
