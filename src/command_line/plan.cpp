// grid_path plan: one path on one map file.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "command_line/arguments.h"
#include "command_line/commands.h"
#include "grid_path_planner/path/metrics.h"
#include "grid_path_planner/path/path_image.h"
#include "grid_path_planner/path/waypoint_file.h"
#include "grid_path_planner/planning/path_planner.h"
#include "grid_path_planner/ros/bag.h"
#include "path/motions.h"
#include "planning/explanation.h"
#include "planning/via/via_plan.h"

namespace grid_path_planner::command_line {

using base::choiceFromName, base::InputError, base::Status, base::StopToken;
using costmap::CostGrid;
using grid::Cell, grid::GridGeometry, grid::MapFileOptions, grid::OccupancyGrid;
using nodes::readAnyMapFile;
using path::clearanceOf, path::measuresText, path::Pose, path::turningOf, path::writePicture,
    path::writeWaypointFile;
using path::motionsAlong;
using planners::makePlanner, planners::traitsOf;
using planning::explainFailure, planning::Explanation, planning::PathPlanner, planning::Plan,
    planning::PlannerOptions, planning::planThrough, planning::PoseRequest, planning::ViaOrder,
    planning::ViaPlan, planning::ViaRequest;
using vehicle::Footprint, vehicle::Motion, vehicle::outlineAt;

namespace {

namespace po = boost::program_options;

constexpr int kFound = 0;
constexpr int kNoPath = 1;

po::options_description planOptions(bool round_trip) {
  po::options_description known("Options");
  auto* goal = po::value<std::string>();
  if (!round_trip) goal->required();
  describeMap(known);
  known.add_options()("start", po::value<std::string>()->required(),
                      "X,Y[,Z[,YAW]] in metres, YAW in radians")("goal", goal, "the same")(
      "via", po::value<std::vector<std::string>>()->multitoken()->composing(),
      "places to pass in between, X,Y[,Z] each: --via 1,2 3,4")(
      "order", po::value<std::string>(),
      "given: the via-points one after the other; best: as costs least, of up to 12 for certain, "
      "of "
      "more by a heuristic; default given")("closed", "a round trip: the goal is the start")(
      "cells", "start, goal and via-points are COLUMN,ROW of cells")(
      "resolution", po::value<std::string>(),
      "side of the map's cells instead of its own: the map grows or shrinks by it [m]")(
      "image", po::value<std::string>(),
      "write a picture of map, expanded cells and path, with a legend")(
      "waypoints", po::value<std::string>(), "write the path as a waypoint file")(
      "explain",
      "where there is no path, say why: the narrowest gap of the widest path and the largest "
      "radius "
      "that passes it, whether only unknown cells lead there, the place nearest the goal in reach")(
      "json", "print one JSON object instead of a sentence");
  describePlannerOptions(known);
  return known;
}

Pose poseOf(const std::string& name, const std::string& text, bool cells,
            const GridGeometry& geometry) {
  const std::vector<double> numbers = numbersOf(name, text, 2, cells ? 2 : name == "via" ? 3 : 4);
  Pose pose;
  if (cells) {
    if (numbers[0] != std::floor(numbers[0]) || numbers[1] != std::floor(numbers[1]))
      throw InputError("--" + name + " needs whole numbers with --cells, got '" + text + "'");
    pose.position << geometry.worldFromGrid({numbers[0] + 0.5, numbers[1] + 0.5}), 0.0;
    return pose;
  }
  pose.position.head<2>() = Eigen::Vector2d(numbers[0], numbers[1]);
  if (numbers.size() > 2) pose.position.z() = numbers[2];
  if (numbers.size() > 3) pose.yaw = numbers[3];
  return pose;
}

nlohmann::json jsonOf(const Plan& report, double preparation_ms) {
  const bool found = report.status == Status::FOUND;
  nlohmann::json poses = nlohmann::json::array();
  for (const Pose& pose : report.path.poses)
    poses.push_back({pose.position.x(), pose.position.y(), pose.position.z(), pose.yaw});
  nlohmann::json object = {
      {"status", std::string(toString(report.status))},
      {"message", report.message},
      {"answered_by", report.answered_by},
      {"cost", nullptr},
      {"optimal", report.optimal},
      {"length_m", nullptr},
      {"cells", report.cells},
      {"kernel", report.kernel},
      {"expanded", report.statistics.expanded},
      {"generated", report.statistics.generated},
      {"reopened", report.statistics.reopened},
      {"peak_open", report.statistics.peak_open},
      {"planning_time_ms", report.statistics.time_s * 1e3},
      {"preparation_time_ms", preparation_ms},
      {"search_bytes", report.statistics.search_bytes},
      {"path", poses},
  };
  if (found) object["cost"] = report.costValue();
  if (found) object["length_m"] = report.length_m;
  return object;
}

// The cells that a picture tints: those of the expanded blocks.
std::vector<Cell> cellsOf(const Plan& report, const GridGeometry& geometry) {
  std::vector<Cell> cells;
  for (const Eigen::Vector2d& centre : report.expanded) {
    const std::optional<Cell> middle = geometry.cellAt(centre);
    if (!middle) continue;
    const Cell block{middle->column / report.kernel, middle->row / report.kernel};
    for (int row = 0; row < report.kernel; ++row)
      for (int column = 0; column < report.kernel; ++column)
        cells.push_back({block.column * report.kernel + column, block.row * report.kernel + row});
  }
  return cells;
}

// Where the planner guarantees the least cost by default, but not with these options. What a path is
// smoothed from is meant.
void warnIfNotOptimal(const PlannerOptions& options, const CostGrid& costs) {
  if (options.costmap.kernel != 1 || !traitsOf(options.planner).optimal) return;
  if (makePlanner(options.planner, options.search)->optimalFor(costs)) return;
  std::cerr << "warning: the path may not be optimal: with this heuristic, heuristic_scale or "
               "epsilon "
            << options.planner << " does not promise it\n";
}

// Adds to the message of a failure why there is no path.
Explanation explain(PathPlanner& planner, const PoseRequest& request, Plan& report) {
  Explanation explanation = explainFailure(planner, request, report.status, StopToken());
  if (!explanation.text.empty()) report.message += "; " + explanation.text;
  return explanation;
}

nlohmann::json jsonOf(const ViaPlan& answer) {
  return {{"via_order", answer.order},
          {"via_order_exact", answer.order_exact},
          {"via_unreachable", answer.unreachable}};
}

nlohmann::json jsonOf(const Explanation& explanation) {
  nlohmann::json object = {{"only_unknown", explanation.only_unknown}};
  if (explanation.gap)
    object["gap"] = {{"x", explanation.gap->position.x()},
                     {"y", explanation.gap->position.y()},
                     {"width_m", explanation.gap->width},
                     {"largest_radius_m", explanation.gap->largest_radius}};
  if (explanation.nearest) object["nearest"] = {explanation.nearest->x(), explanation.nearest->y()};
  return object;
}

int exitCodeOf(Status status) {
  if (status == Status::INVALID_REQUEST) return kBadInput;
  return status == Status::FOUND ? kFound : kNoPath;
}

ViaRequest requestFrom(const po::variables_map& values, const GridGeometry& geometry) {
  const bool cells = values.count("cells") != 0;
  ViaRequest request;
  request.start = poseOf("start", values["start"].as<std::string>(), cells, geometry);
  request.goal = values.count("closed") != 0
                     ? request.start
                     : poseOf("goal", values["goal"].as<std::string>(), cells, geometry);
  if (values.count("via") != 0)
    for (const std::string& text : values["via"].as<std::vector<std::string>>())
      request.via.push_back(poseOf("via", text, cells, geometry).position);
  if (values.count("order") != 0)
    request.order = choiceFromName<ViaOrder>("--order", values["order"].as<std::string>());
  request.record_expanded = values.count("image") != 0;
  return request;
}

// Which changes what is required.
bool isRoundTrip(int argc, char** argv) {
  return std::any_of(argv + 1, argv + argc,
                     [](const char* argument) { return std::string(argument) == "--closed"; });
}

// What contradicts itself, and what changes nothing.
void checkViaOptions(const po::variables_map& values) {
  if (values.count("closed") != 0 && values.count("goal") != 0)
    throw InputError("--goal and --closed contradict each other: a round trip ends at its start");
  if (values.count("via") == 0 && values.count("closed") != 0)
    throw InputError("--closed needs --via: without a place in between the trip is none");
  if (values.count("via") == 0 && values.count("order") != 0)
    warnAboutUnusedOption("order", "no --via");
}

double preparationMs(PathPlanner& planner) {
  const auto begin = std::chrono::steady_clock::now();
  planner.finishPreparation(StopToken());
  const std::chrono::duration<double, std::milli> prepared =
      std::chrono::steady_clock::now() - begin;
  return prepared.count();
}

// Of a vehicle that is not round, along the path: a length apart, and in its turns.
std::vector<std::vector<Eigen::Vector2d>> outlinesOf(const Plan& report, double start_yaw,
                                                     const PlannerOptions& options) {
  constexpr double kTurn = 0.5;  // rad
  const Footprint footprint = Footprint::fromText("footprint", options.footprint);
  if (footprint.empty() || report.path.empty()) return {};
  std::vector<std::vector<Eigen::Vector2d>> outlines;
  for (const Motion& motion :
       motionsAlong(report.path, start_yaw, report.path.poses.back().yaw, options.heading)) {
    const double apart = (motion.to - motion.from).norm() / footprint.circumscribedRadius();
    const int parts = 1 + static_cast<int>(std::max(apart, std::abs(motion.turn) / kTurn));
    for (int part = 0; part <= parts; ++part)
      outlines.push_back(outlineAt(footprint, motion, static_cast<double>(part) / parts));
  }
  return outlines;
}

void writeFiles(const po::variables_map& values, const OccupancyGrid& map,
                const PlannerOptions& options, double start_yaw, const Plan& report) {
  if (values.count("image") != 0)
    writePicture(values["image"].as<std::string>(), map, options.costmap.thresholds,
                 {report.path,
                  cellsOf(report, map.geometry()),
                  {},
                  {},
                  outlinesOf(report, start_yaw, options)});
  if (values.count("waypoints") != 0 && report.status == Status::FOUND)
    writeWaypointFile(values["waypoints"].as<std::string>(), report.waypoints);
}

// Where the planner let another one answer.
std::string answeredBy(const Plan& report, const std::string& planner) {
  if (report.answered_by.empty() || report.answered_by == planner) return "";
  return "; answered by " + report.answered_by;
}

// What is printed beside the plan.
struct Measures {
  double clearance_m;
  double turning_rad;
  std::optional<Explanation> explanation;
  std::optional<nlohmann::json> via;  // where there are via-points
};

void print(const Plan& report, const Measures& measures, const std::string& planner,
           double preparation_ms, bool as_json) {
  const bool found = report.status == Status::FOUND;
  if (!as_json) {
    std::cout << toString(report.status) << ": " << report.message << answeredBy(report, planner);
    if (found) std::cout << "; " << measuresText(measures.clearance_m, measures.turning_rad);
    std::cout << '\n';
    return;
  }
  nlohmann::json object = jsonOf(report, preparation_ms);
  if (found && std::isfinite(measures.clearance_m)) object["clearance_m"] = measures.clearance_m;
  if (found) object["turning_rad"] = measures.turning_rad;
  if (measures.via) object.update(*measures.via);
  if (measures.explanation) object["explanation"] = jsonOf(*measures.explanation);
  std::cout << object.dump() << '\n';
}

}  // namespace

int runPlan(int argc, char** argv) {
  po::variables_map values;
  if (!parseArguments(argc, argv, planOptions(isRoundTrip(argc, argv)),
                      "grid_path plan --map FILE --start X,Y --goal X,Y [options]", values))
    return kFound;
  checkViaOptions(values);
  const PlannerOptions options = plannerOptionsFrom(values);
  warnAboutUnusedOptions(options);

  MapFileOptions reading = readingOptionsFrom(values);
  reading.images_need_resolution = true;
  const auto map = std::make_shared<const OccupancyGrid>(
      readAnyMapFile(values["map"].as<std::string>(), reading));

  const ViaRequest request = requestFrom(values, map->geometry());
  PathPlanner planner(options);
  planner.setMap(map);
  const double preparation_ms = preparationMs(planner);
  ViaPlan answer = planThrough(planner, request);
  Plan& report = answer.plan;
  if (report.status == Status::FOUND && !report.optimal)
    warnIfNotOptimal(options, *planner.fullResolutionCosts(StopToken()));
  writeFiles(values, *map, options, request.start.yaw, report);
  Measures measures = {clearanceOf(report.path, *map, options.costmap.thresholds),
                       turningOf(report.path), std::nullopt, std::nullopt};
  if (!request.via.empty()) measures.via = jsonOf(answer);
  if (values.count("explain") != 0 && report.status != Status::FOUND)
    measures.explanation = explain(planner, answer.last_leg, report);
  else if (report.status == Status::UNREACHABLE || report.status == Status::GOAL_OCCUPIED)
    std::cerr << "grid_path plan: --explain says more about why there is no path\n";
  print(report, measures, options.planner, preparation_ms, values.count("json") != 0);
  return exitCodeOf(report.status);
}

}  // namespace grid_path_planner::command_line
