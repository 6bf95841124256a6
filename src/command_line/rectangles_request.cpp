#include "command_line/rectangles_request.h"

#include <cmath>

#include "command_line/arguments.h"

namespace grid_path_planner::command_line {

using base::choiceFromName, base::InputError;
using planners::DecompositionLimits, planners::RectangleWeight, planners::Touching;

namespace {

namespace po = boost::program_options;

bool asksForMergedRuns(const po::variables_map& values) {
  if (values.count("partition") == 0) return false;
  const std::string& name = values["partition"].as<std::string>();
  if (name != "largest_first" && name != "merged_runs")
    throw InputError("--partition must be largest_first or merged_runs, got '" + name + "'");
  return name == "merged_runs";
}

DecompositionLimits limitsFrom(const po::variables_map& values, bool merged_runs) {
  DecompositionLimits limits;
  if (values.count("limit") != 0 && values.count("min-area") != 0)
    throw InputError("--limit and --min-area do not go together");
  if (merged_runs && values.count("limit") + values.count("min-area") != 0)
    throw InputError("--limit and --min-area are for --partition largest_first");
  if (values.count("limit") != 0)
    limits.count = static_cast<std::size_t>(countFrom(values, "limit"));
  if (values.count("min-area") != 0) limits.smallest_area = countFrom(values, "min-area");
  return limits;
}

}  // namespace

po::options_description describeRectangles() {
  po::options_description known("Options");
  describeMap(known);
  known.add_options()(
      "resolution", po::value<std::string>(),
      "side of the map's cells instead of its own; of a drawing, how finely it is read [m]")(
      "unknown-is-free", "cut unknown cells into rectangles too")(
      "partition", po::value<std::string>(),
      "largest_first: the published R-map; merged_runs: quicker, in no such order; default "
      "largest_first")("limit", po::value<std::string>(), "no more rectangles than these")(
      "min-area", po::value<std::string>(), "no rectangle smaller than this [cells]")(
      "weight", po::value<std::string>(),
      "tell what a step over each connection weighs, of many the first few, with --json all "
      "(area, border, distance, connections, or length: through the middle of the border)")(
      "corners", "rectangles that touch at a corner only are connected too")(
      "image", po::value<std::string>(),
      "write a picture with a legend: rectangles with their numbers from 1, connections with "
      "--weight")("output", po::value<std::string>(), "write the rectangles as a compact file")(
      "memory-limit", po::value<std::string>(),
      "refuse a map that may need more, before it is cut [MB]; default: half of what is available")(
      "json", "print one JSON object instead of sentences");
  describeReading(known);
  return known;
}

RectanglesRequest rectanglesRequestFrom(const po::variables_map& values) {
  RectanglesRequest request;
  request.map = values["map"].as<std::string>();
  request.reading = readingOptionsFrom(values);
  request.unknown_is_free = values.count("unknown-is-free") != 0;
  request.merged_runs = asksForMergedRuns(values);
  request.limits = limitsFrom(values, request.merged_runs);
  if (values.count("weight") != 0)
    request.weight =
        choiceFromName<RectangleWeight>("--weight", values["weight"].as<std::string>());
  if (values.count("memory-limit") != 0) request.memory_limit = countFrom(values, "memory-limit");
  if (values.count("corners") != 0) request.touching = Touching::BORDERS_AND_CORNERS;
  return request;
}

}  // namespace grid_path_planner::command_line
