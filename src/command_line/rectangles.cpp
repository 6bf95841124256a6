// grid_path rectangles: a map's free space as rectangles.
#include <iostream>

#include "command_line/arguments.h"
#include "command_line/commands.h"
#include "command_line/rectangles_output.h"
#include "command_line/rectangles_request.h"
#include "command_line/rectangles_result.h"
#include "grid_path_planner/planners/rectangle_file.h"
#include "grid_path_planner/ros/bag.h"

namespace grid_path_planner::command_line {

using grid::OccupancyGrid;
using nodes::readAnyMapFile;
using planners::writeRectangleFile;

int runRectangles(int argc, char** argv) {
  boost::program_options::variables_map values;
  if (!parseArguments(argc, argv, describeRectangles(), "grid_path rectangles --map FILE [options]",
                      values))
    return 0;
  const RectanglesRequest request = rectanglesRequestFrom(values);
  const OccupancyGrid map = readAnyMapFile(request.map, request.reading);
  const RectanglesResult result = cutIntoRectangles(request, map);
  if (values.count("image") != 0) draw(values["image"].as<std::string>(), request, result, map);
  if (values.count("output") != 0)
    writeRectangleFile(values["output"].as<std::string>(), result.map);
  if (values.count("json") != 0)
    std::cout << jsonOf(request, result).dump() << '\n';
  else
    print(request, result);
  return 0;
}

}  // namespace grid_path_planner::command_line
