// Nothing is read of a file whose checksum is wrong, so the input is a file without its checksum.
#include <boost/crc.hpp>

#include "fuzz/fuzz_target.h"
#include "grid/formats/byte_order.h"
#include "grid/formats/rectangle_map_file.h"
#include "grid_path_planner/base/errors.h"
#include "grid_path_planner/grid/map_file.h"
#include "grid_path_planner/planners/rectangle_graph.h"

namespace grid_path_planner::fuzz {
namespace {

std::vector<std::string> seedsOfRectangles() {
  const grid::GridGeometry geometry(9, 5, 0.05, {-1.5, 2.25, 0.3});
  std::vector<std::string> seeds;
  for (const std::vector<grid::CellRect>& rectangles :
       {std::vector<grid::CellRect>{{0, 0, 4, 3}, {5, 0, 2, 3}},
        {{5, 3, 2, 2}, {0, 0, 4, 3}},
        {}}) {
    const std::string content = grid::rectangleMapContent({geometry, rectangles});
    seeds.push_back(content.substr(0, content.size() - 4));
  }
  return seeds;
}

FUZZ_TARGET(rectangle_file, seedsOfRectangles) {
  boost::crc_32_type sum;
  sum.process_bytes(input.data(), input.size());
  std::string content = input;
  grid::putInteger(content, sum.checksum(), 4);
  grid::MapFileOptions options;
  mayRefuse([&] {
    const grid::RectangleMap map = grid::parseRectangles(content, "fuzz.rectangles");
    if (map.geometry.size() < 1000000) grid::parseRectangleMap(content, "fuzz.rectangles", options);
    planners::RectangleGraph(map.geometry, map.rectangles, planners::Touching::BORDERS);
  });
}

}  // namespace
}  // namespace grid_path_planner::fuzz
