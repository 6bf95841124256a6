// grid_path project: an octree file to a 2-D map.
#include <iostream>
#include <string>

#include "command_line/arguments.h"
#include "command_line/commands.h"
#include "command_line/report_map.h"
#include "grid_path_planner/base/files.h"
#include "grid_path_planner/grid/map_file.h"
#include "grid_path_planner/mapping/octree_map.h"
#include "grid_path_planner/mapping/projection.h"

namespace grid_path_planner::command_line {

using base::choiceFromName, base::extensionOf, base::InputError;
using grid::OccupancyGrid, grid::writeImageFile, grid::writeMapServerFile;
using mapping::checkProjectionOptions, mapping::OctreeMap, mapping::OctreeOptions,
    mapping::Projection, mapping::ProjectionOptions, mapping::ProjectionReference;

namespace {

namespace po = boost::program_options;

constexpr int kMostCells = 1 << 28;

po::options_description projectOptions() {
  po::options_description known("Options");
  known.add_options()("octree", po::value<std::string>()->required(), "octree file, .bt or .ot")(
      "map", po::value<std::string>()->required(), "OUT.yaml, with OUT-….pgm beside it")(
      "min-z", po::value<std::string>()->required(), "lower end of the band [m]")(
      "max-z", po::value<std::string>()->required(), "upper end of the band [m]")(
      "reference", po::value<std::string>(),
      "what the heights are measured from (fixed|vehicle|seabed); default fixed")(
      "vehicle-z", po::value<std::string>(), "the vehicle's z for the reference vehicle [m]")(
      "seabed-radius", po::value<std::string>(),
      "how far around a cell the seabed is looked for [m]; default 1")(
      "seabed-max-slope", po::value<std::string>(),
      "steepest seabed that is no obstacle, metres up per metre along; default 0.5")(
      "bounds", po::value<std::string>(),
      "MIN_X,MIN_Y,MAX_X,MAX_Y of the map [m]; default: all of the tree")(
      "image", po::value<std::string>(), "write a picture too, OUT.png or OUT.pgm");
  return known;
}

double numberOf(const po::variables_map& values, const std::string& name, double fallback) {
  return values.count(name) == 0 ? fallback
                                 : numbersOf(name, values[name].as<std::string>(), 1, 1)[0];
}

ProjectionOptions optionsOf(const po::variables_map& values) {
  ProjectionOptions options;
  options.min_z = numberOf(values, "min-z", 0.0);
  options.max_z = numberOf(values, "max-z", 0.0);
  options.seabed_radius = numberOf(values, "seabed-radius", options.seabed_radius);
  options.seabed_max_slope = numberOf(values, "seabed-max-slope", options.seabed_max_slope);
  if (values.count("reference") != 0)
    options.reference =
        choiceFromName<ProjectionReference>("--reference", values["reference"].as<std::string>());
  if (values.count("bounds") != 0) {
    const auto sides = numbersOf("bounds", values["bounds"].as<std::string>(), 4, 4);
    options.bounds = {sides[0], sides[1], sides[2], sides[3]};
  }
  const bool vehicle = options.reference == ProjectionReference::VEHICLE;
  if (vehicle != (values.count("vehicle-z") != 0))
    throw InputError("--vehicle-z and --reference vehicle go together");
  options.max_cells = kMostCells;
  checkProjectionOptions(options);
  return options;
}

// Checked before the octree is read.
void checkEndings(const po::variables_map& values) {
  const std::string map = values["map"].as<std::string>();
  if (extensionOf(map) != "yaml" && extensionOf(map) != "yml")
    throw InputError("--map must end in .yaml, got '" + map + "'");
  if (values.count("image") == 0) return;
  const std::string image = values["image"].as<std::string>();
  if (extensionOf(image) != "png" && extensionOf(image) != "pgm")
    throw InputError("--image must end in .png or .pgm, got '" + image + "'");
}

OccupancyGrid projected(const po::variables_map& values) {
  const ProjectionOptions options = optionsOf(values);
  OctreeMap octree{OctreeOptions{}};
  octree.load(values["octree"].as<std::string>());
  Projection projection(octree.options().resolution, options);
  projection.setVehicleHeight(numberOf(values, "vehicle-z", 0.0));
  projection.update(octree.bricks());
  if (projection.columnsLeftOut() > 0)
    throw InputError("the tree reaches farther than a map of " + std::to_string(kMostCells) +
                     " cells: give --bounds");
  return projection.grid();
}

}  // namespace

int runProject(int argc, char** argv) {
  po::variables_map values;
  if (!parseArguments(
          argc, argv, projectOptions(),
          "grid_path project --octree FILE --min-z Z --max-z Z --map OUT.yaml [options]", values))
    return 0;
  checkEndings(values);
  const OccupancyGrid map = projected(values);
  const std::string file = values["map"].as<std::string>();
  writeMapServerFile(file, map);
  if (values.count("image") != 0) writeImageFile(values["image"].as<std::string>(), map);
  reportMap(file, map);
  return 0;
}

}  // namespace grid_path_planner::command_line
