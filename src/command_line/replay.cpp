// grid_path replay: the plans of a recording, planned again.
#include <filesystem>
#include <iostream>
#include <string>
#include <vector>

#include "command_line/arguments.h"
#include "command_line/commands.h"
#include "grid_path_planner/PlanRecord.h"
#include "grid_path_planner/path/path_image.h"
#include "grid_path_planner/path/waypoint_file.h"
#include "ros/planning/record/recorded_plans.h"

namespace grid_path_planner::command_line {

using base::InputError;
using nodes::PlanReplay, nodes::readRecording, nodes::Recording, nodes::ReplayedPlan;
using path::writePicture, path::writeWaypointFile;

namespace {

namespace po = boost::program_options;

constexpr int kAllIdentical = 0;
constexpr int kNotAll = 1;

po::options_description replayOptions() {
  po::options_description known("Options");
  known.add_options()("bag", po::value<std::string>()->required(),
                      "what record:= of a launch file has written")(
      "plan", po::value<std::string>(), "only this one, counted from 1")(
      "out", po::value<std::string>(),
      "a folder: for each path found again a picture plan_N.png and a waypoint file plan_N.yaml");
  return known;
}

void writeFiles(const std::filesystem::path& folder, std::size_t number, const ReplayedPlan& again,
                const nodes::PlanQuestion& question, const grid::OccupancyGrid& map) {
  const std::string name = (folder / ("plan_" + std::to_string(number))).string();
  writePicture(name + ".png", map, question.options.costmap.thresholds,
               {again.plan.path, {}, {}, {}});
  writeWaypointFile(name + ".yaml", again.plan.waypoints);
}

// Which of `count` plans; all of them unless --plan names one.
std::vector<std::size_t> chosenPlans(const po::variables_map& values, std::size_t count) {
  std::vector<std::size_t> chosen;
  if (values.count("plan") == 0) {
    for (std::size_t i = 0; i < count; ++i) chosen.push_back(i);
    return chosen;
  }
  const auto number = static_cast<std::size_t>(countFrom(values, "plan"));
  if (number > count)
    throw InputError("--plan " + std::to_string(number) + ": the bag has " + std::to_string(count) +
                     " plans");
  return {number - 1};
}

std::filesystem::path folderFrom(const po::variables_map& values) {
  if (values.count("out") == 0) return {};
  const std::filesystem::path folder = values["out"].as<std::string>();
  if (!std::filesystem::is_directory(folder))
    throw InputError("--out needs a folder that exists, got '" + folder.string() + "'");
  return folder;
}

}  // namespace

int runReplay(int argc, char** argv) {
  po::variables_map values;
  std::vector<char*> arguments(argv, argv + argc);
  char bag[] = "--bag";
  if (argc > 1 && argv[1][0] != '-') arguments.insert(arguments.begin() + 1, bag);
  if (!parseArguments(static_cast<int>(arguments.size()), arguments.data(), replayOptions(),
                      "grid_path replay BAG [options]", values))
    return kAllIdentical;
  const std::filesystem::path folder = folderFrom(values);
  const Recording recording = readRecording(values["bag"].as<std::string>());
  for (const std::string& refusal : recording.refusals) std::cerr << "warning: " << refusal << '\n';
  const std::vector<std::size_t> chosen = chosenPlans(values, recording.plans.size());
  PlanReplay replay(recording.plans, recording.maps);
  std::size_t identical = 0;
  for (const std::size_t index : chosen) {
    const PlanRecord& record = recording.plans[index];
    const ReplayedPlan again = replay.again(index);
    std::cout << "plan " << index + 1 << ": " << again.text << std::endl;
    if (again.identical) ++identical;
    if (!folder.empty() && again.plan.found())
      writeFiles(folder, index + 1, again, nodes::questionOf(record),
                 *recording.maps.at(record.map_checksum));
  }
  std::cout << identical << " of " << chosen.size() << " plans are identical\n";
  return identical == chosen.size() ? kAllIdentical : kNotAll;
}

}  // namespace grid_path_planner::command_line
