// grid_path convert: a map file from one format to another.
#include <iostream>
#include <string>

#include "arguments.h"
#include "commands.h"
#include "grid_path_planner/grid/map_format.h"
#include "grid_path_planner/ros/bag.h"

namespace grid_path_planner::tools {
namespace {

namespace po = boost::program_options;

po::options_description describe() {
  po::options_description known("Options");
  known.add_options()("map", po::value<std::string>()->required(),
                      "map_server YAML, MovingAI .map, image, rostopic echo dump or bag")(
      "output", po::value<std::string>()->required(),
      "OUT.yaml (with OUT.pgm beside it), OUT.map, OUT.png or OUT.pgm")(
      "mode", po::value<std::string>(),
      "trinary: free, unknown and occupied survive; raw: every value does; default trinary")(
      "resolution", po::value<std::string>(), "side of a cell instead of the map's own [m]")(
      "origin", po::value<std::string>(),
      "X,Y,YAW of the corner of cell (0, 0) instead of the map's own [m, rad]");
  return known;
}

MapFileOptions readingOptions(const po::variables_map& values) {
  MapFileOptions options;
  options.warn = [](const std::string& warning) { std::cerr << "warning: " << warning << '\n'; };
  if (values.count("resolution") != 0)
    options.resolution = numbersOf("resolution", values["resolution"].as<std::string>(), 1, 1)[0];
  if (values.count("origin") != 0) {
    const auto numbers = numbersOf("origin", values["origin"].as<std::string>(), 3, 3);
    options.origin = Origin{numbers[0], numbers[1], numbers[2]};
  }
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

void write(const Target& target, const OccupancyGrid& map) {
  if (target.extension == "map")
    writeMovingAiFile(target.file, map);
  else if (target.extension == "png" || target.extension == "pgm")
    writeImageFile(target.file, map, target.mode);
  else
    writeMapServerFile(target.file, map, target.mode);
}

void report(const std::string& file, const OccupancyGrid& map) {
  std::size_t counts[3] = {};
  for (const std::int8_t value : map.values())
    ++counts[static_cast<int>(OccupancyThresholds().classify(value))];
  const Origin& origin = map.geometry().origin();
  std::cout << file << ": " << map.width() << "x" << map.height() << " cells of "
            << map.geometry().resolution() << " m, origin " << origin.x << ", " << origin.y
            << " m, yaw " << origin.yaw << " rad; free "
            << counts[static_cast<int>(Occupancy::FREE)] << ", unknown "
            << counts[static_cast<int>(Occupancy::UNKNOWN)] << ", occupied "
            << counts[static_cast<int>(Occupancy::OCCUPIED)] << '\n';
}

}  // namespace

int runConvert(int argc, char** argv) {
  po::variables_map values;
  if (!parseArguments(argc, argv, describe(),
                      "grid_path convert --map IN --output OUT.(yaml|map|png|pgm) [options]",
                      values))
    return 0;
  const Target target = targetOf(values);
  const OccupancyGrid map = readAnyMapFile(values["map"].as<std::string>(), readingOptions(values));
  write(target, map);
  report(target.file, map);
  return 0;
}

}  // namespace grid_path_planner::tools
