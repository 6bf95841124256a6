#include "grid_path_planner/planners/rectangle_file.h"

#include <utility>

#include "grid/formats/rectangle_map_file.h"
#include "grid_path_planner/base/errors.h"
#include "grid_path_planner/base/files.h"
#include "grid_path_planner/grid/map_file.h"

namespace grid_path_planner::planners {

using base::InputError, base::ReadLimits, base::readWholeFile, base::readWithin,
    base::writeFileAtomically;
using grid::kLargestMapFile, grid::parseRectangles, grid::RectangleMap, grid::rectangleMapContent;

std::string rectangleFileContent(const RectangleGraph& map) {
  return rectangleMapContent({map.geometry(), map.rectangles()});
}

void writeRectangleFile(const std::string& file, const RectangleGraph& map) {
  writeFileAtomically(file, rectangleFileContent(map));
}

RectangleGraph readRectangleFile(const std::string& file, Touching touching) {
  return readWithin(file, {}, [&](ReadLimits& limits) {
    RectangleMap map = parseRectangles(readWholeFile(file, kLargestMapFile, limits), file, limits);
    limits.check(file, RectangleGraph::bytesFor(map.rectangles.size()));
    try {
      return RectangleGraph(map.geometry, std::move(map.rectangles), touching);
    } catch (const InputError& error) {
      throw InputError(file, error.what());
    }
  });
}

}  // namespace grid_path_planner::planners
