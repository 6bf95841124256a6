// Writes the files that repeat the options of the nodes (option_files.h).
//
//   option_files cfg FOLDER    <Node>.cfg of every node into FOLDER
//   option_files write ROOT    config/<node>.yaml and the tables in README.md and doc/*.md of ROOT, with that of the inputs
//   option_files check ROOT    returns 1 and names those that are out of date
//
// A file that is right already is left alone, so that what is built from it is not built anew.
#include <filesystem>
#include <iostream>
#include <map>

#include "grid_path_planner/base/files.h"
#include "grid_path_planner/mapping/projected_map_options.h"
#include "layers/map_layers_options.h"
#include "option_files/option_files.h"
#include "ros/adapters/adapter_options.h"
#include "ros/avoidance/local_planner_options.h"
#include "ros/driving/go_to_pose_options.h"
#include "ros/driving/navigate_path_options.h"
#include "ros/driving/teleop_joy_options.h"
#include "ros/input/input_rules.h"
#include "ros/localization/marker_localizer_options.h"
#include "ros/localization/vehicle_localizer_options.h"
#include "ros/planning/map_publisher_options.h"
#include "ros/planning/path_planner_options.h"
#include "ros/simulation/simulator_options.h"

namespace grid_path_planner::option_files {

using base::describeOptions;
using base::InputError;
using base::readWholeFile;
using base::writeFileAtomically;
using layers::MapLayersOptions;
using mapping::ProjectedMapOptions;
using nodes::AdapterOptions;
using nodes::GoToPoseOptions;
using nodes::inputTableText;
using nodes::LocalPlannerOptions;
using nodes::MapPublisherOptions;
using nodes::MarkerLocalizerOptions;
using nodes::NavigatePathOptions;
using nodes::PathPlannerNodeOptions;
using nodes::SimulatorOptions;
using nodes::TeleopJoyOptions;
using nodes::VehicleLocalizerOptions;

namespace {

namespace fs = std::filesystem;

using Files = std::map<std::string, std::string>;  // their content by name

constexpr std::size_t kLargestFile = 1 << 24;  // bytes

std::vector<NodeOptions> allNodes() {
  return {{"go_to_pose", "GoToPose", describeOptions(GoToPoseOptions())},
          {"local_planner", "LocalPlanner", describeOptions(LocalPlannerOptions())},
          {"map_layers", "MapLayers", describeOptions(MapLayersOptions())},
          {"map_publisher", "MapPublisher", describeOptions(MapPublisherOptions())},
          {"marker_localizer", "MarkerLocalizer", describeOptions(MarkerLocalizerOptions())},
          {"move_base_plugin", "MoveBasePlugin", describeOptions(AdapterOptions())},
          {"navigate_path", "NavigatePath", describeOptions(NavigatePathOptions())},
          {"path_planner", "PathPlanner", describeOptions(PathPlannerNodeOptions())},
          {"projected_map", "ProjectedMap", describeOptions(ProjectedMapOptions())},
          {"simulator", "Simulator", describeOptions(SimulatorOptions())},
          {"teleop_joy", "TeleopJoy", describeOptions(TeleopJoyOptions())},
          {"vehicle_localizer", "VehicleLocalizer", describeOptions(VehicleLocalizerOptions())}};
}

Files cfgFiles(const fs::path& folder) {
  Files files;
  for (const NodeOptions& node : allNodes()) files[folder / (node.config + ".cfg")] = cfgOf(node);
  return files;
}

// The pages of the documentation that may hold tables.
std::vector<std::string> pages(const fs::path& root) {
  std::vector<std::string> names = {root / "README.md"};
  for (const auto& entry : fs::directory_iterator(root / "doc"))
    if (entry.path().extension() == ".md") names.push_back(entry.path());
  return names;
}

Files committedFiles(const fs::path& root) {
  const std::vector<NodeOptions> nodes = allNodes();
  Files files;
  for (const NodeOptions& node : nodes)
    files[root / "config" / (node.node + ".yaml")] = yamlOf(node);
  for (const std::string& page : pages(root))
    files[page] = withText(withTables(readWholeFile(page, kLargestFile), nodes), "<!-- inputs -->",
                           inputTableText());
  return files;
}

bool isRight(const std::string& file, const std::string& content) {
  return fs::exists(file) && readWholeFile(file, kLargestFile) == content;
}

void write(const Files& files) {
  for (const auto& [file, content] : files)
    if (!isRight(file, content)) writeFileAtomically(file, content);
}

int check(const Files& files) {
  int wrong = 0;
  for (const auto& [file, content] : files) {
    if (isRight(file, content)) continue;
    std::cerr << file << " is out of date: build the target grid_path_planner_write_options\n";
    ++wrong;
  }
  return wrong == 0 ? 0 : 1;
}

int run(const std::string& command, const fs::path& folder) {
  if (command == "cfg") return write(cfgFiles(folder)), 0;
  if (command == "write") return write(committedFiles(folder)), 0;
  if (command == "check") return check(committedFiles(folder));
  throw InputError("cfg, write or check, not '" + command + "'");
}

}  // namespace
}  // namespace grid_path_planner::option_files

int main(int argc, char** argv) {
  if (argc != 3) {
    std::cerr << "usage: option_files cfg|write|check FOLDER\n";
    return 2;
  }
  try {
    return grid_path_planner::option_files::run(argv[1], argv[2]);
  } catch (const std::exception& error) {
    std::cerr << "option_files: " << error.what() << '\n';
    return 2;
  }
}
