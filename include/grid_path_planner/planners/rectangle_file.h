// A rectangle map in a compact file, whose bytes grid/rectangle_map_file.h describes.
//
//   writeRectangleFile("site.rectangles", map);
//   RectangleGraph same = readRectangleFile("site.rectangles", Touching::BORDERS);
//
// What is read back has the same geometry to the bit and the same rectangles in the same order, so
// their numbers, and the weights made of them, are the same. Places without a rectangle, which
// edits may leave, are not written: later rectangles move up. What a map knows besides (weights,
// which blocked cells are unknown) is not in it.
#pragma once

#include <string>

#include "grid_path_planner/planners/rectangle_graph.h"

namespace grid_path_planner::planners {

// What the file of `map` holds. Throws InputError for a map without cells.
std::string rectangleFileContent(const RectangleGraph& map);

// Throws InputError naming the file where it cannot be written; then it is as it was.
void writeRectangleFile(const std::string& file, const RectangleGraph& map);

// Throws InputError naming the file and what is wrong where it cannot be read, or for what
// parseRectangles and RectangleGraph refuse.
RectangleGraph readRectangleFile(const std::string& file, Touching touching);

}  // namespace grid_path_planner::planners
