// grid_path convert: a map file from one format to another.
#include <cmath>
#include <iostream>
#include <memory>
#include <string>

#include "command_line/arguments.h"
#include "command_line/commands.h"
#include "command_line/report_map.h"
#include "grid_path_planner/base/files.h"
#include "grid_path_planner/costmap/costmap_builder.h"
#include "grid_path_planner/grid/map_file.h"
#include "grid_path_planner/ros/bag.h"

namespace grid_path_planner::command_line {

using base::choiceFromName, base::extensionOf, base::InputError, base::StopToken;
using costmap::checkCostmapOptions, costmap::CostmapBuilder, costmap::CostmapOptions,
    costmap::KernelRule;
using grid::MapFileOptions, grid::MapMode, grid::Occupancy, grid::OccupancyGrid, grid::Origin,
    grid::writeImageFile, grid::writeMapServerFile, grid::writeMovingAiFile;
using nodes::readAnyMapFile;

namespace {

namespace po = boost::program_options;

po::options_description convertOptions() {
  po::options_description known("Options");
  describeMap(known);
  known.add_options()("output", po::value<std::string>()->required(),
                      "OUT.yaml (with OUT-….pgm beside it), OUT.map, OUT.png or OUT.pgm")(
      "mode", po::value<std::string>(),
      "trinary: free, unknown and occupied survive; raw: every value does; default trinary")(
      "resolution", po::value<std::string>(), "side of a cell instead of the map's own [m]")(
      "origin", po::value<std::string>(),
      "X,Y,YAW of the corner of cell (0, 0) instead of the map's own [m, rad]")(
      "kernel", po::value<std::string>(),
      "side of the blocks that become one cell [cells]; default 1")(
      "kernel-rule", po::value<std::string>(),
      "conservative: occupied if any cell is, else unknown if any is; filter2d: as the original "
      "study; default conservative");
  describeReading(known);
  return known;
}

MapFileOptions optionsWithOrigin(const po::variables_map& values) {
  MapFileOptions options = readingOptionsFrom(values);
  if (values.count("origin") != 0) {
    const auto numbers = numbersOf("origin", values["origin"].as<std::string>(), 3, 3);
    options.origin = Origin{numbers[0], numbers[1], numbers[2]};
  }
  // Of the files that are written, only this one says how wide a cell is.
  const std::string extension = extensionOf(values["output"].as<std::string>());
  options.images_need_resolution = extension == "yaml" || extension == "yml";
  return options;
}

// Where to write and how; checked before the map is read.
struct Target {
  std::string file;
  std::string extension;
  MapMode mode = MapMode::TRINARY;
};

Target targetOf(const po::variables_map& values) {
  Target target;
  target.file = values["output"].as<std::string>();
  target.extension = extensionOf(target.file);
  const std::string& extension = target.extension;
  if (extension != "yaml" && extension != "yml" && extension != "map" && extension != "png" &&
      extension != "pgm")
    throw InputError("--output must end in .yaml, .map, .png or .pgm, got '" + target.file + "'");
  if (values.count("mode") == 0) return target;
  const std::string mode = values["mode"].as<std::string>();
  if (extension == "map") throw InputError("--mode does not apply to a .map");
  if (mode != "trinary" && mode != "raw")
    throw InputError("--mode must be trinary or raw, got '" + mode + "'");
  target.mode = choiceFromName<MapMode>("--mode", mode);
  return target;
}

CostmapOptions kernelOptions(const po::variables_map& values) {
  CostmapOptions options;
  if (values.count("kernel") != 0) {
    const std::string& text = values["kernel"].as<std::string>();
    const double kernel = numbersOf("kernel", text, 1, 1)[0];
    if (kernel != std::floor(kernel) || std::abs(kernel) > 1e6)
      throw InputError("--kernel must be a whole number of cells, got '" + text + "'");
    options.kernel = static_cast<int>(kernel);
  }
  if (values.count("kernel-rule") != 0)
    options.kernel_rule =
        choiceFromName<KernelRule>("--kernel-rule", values["kernel-rule"].as<std::string>());
  checkCostmapOptions(options);
  return options;
}

std::int8_t valueOf(Occupancy occupancy) {
  switch (occupancy) {
    case Occupancy::FREE:
      return 0;
    case Occupancy::OCCUPIED:
      return 100;
    case Occupancy::UNKNOWN:
      break;
  }
  return -1;
}

// The classes of the blocks; the map itself for kernel 1.
OccupancyGrid withKernel(const OccupancyGrid& map, const CostmapOptions& options) {
  if (options.kernel == 1) return map;
  CostmapBuilder builder(options);
  builder.setMap(std::make_shared<OccupancyGrid>(map));
  const auto blocks = builder.downsampled(StopToken());
  OccupancyGrid result(blocks->geometry());
  for (int row = 0; row < result.height(); ++row)
    for (int column = 0; column < result.width(); ++column)
      result[{column, row}] = valueOf(blocks->occupancy({column, row}));
  return result;
}

void write(const Target& target, const OccupancyGrid& map) {
  if (target.extension == "map")
    writeMovingAiFile(target.file, map);
  else if (target.extension == "png" || target.extension == "pgm")
    writeImageFile(target.file, map, target.mode);
  else
    writeMapServerFile(target.file, map, target.mode);
}

}  // namespace

int runConvert(int argc, char** argv) {
  po::variables_map values;
  if (!parseArguments(argc, argv, convertOptions(),
                      "grid_path convert --map IN --output OUT.(yaml|map|png|pgm) [options]",
                      values))
    return 0;
  const Target target = targetOf(values);
  const CostmapOptions kernel = kernelOptions(values);
  const OccupancyGrid map = withKernel(
      readAnyMapFile(values["map"].as<std::string>(), optionsWithOrigin(values)), kernel);
  write(target, map);
  reportMap(target.file, map);
  return 0;
}

}  // namespace grid_path_planner::command_line
