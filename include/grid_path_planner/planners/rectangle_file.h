// A rectangle map in a compact file, whose bytes grid/formats/rectangle_map_file.h describes.
//
//   writeRectangleFile("site.rectangles", map);
//   RectangleGraph same = readRectangleFile("site.rectangles", Touching::BORDERS);
//
// A map that is read back has the same geometry to the bit and the same rectangles in the same
// order, so their numbers, and the weights by number, are the same. Vacant numbers, which edits may
// leave, are not written: later rectangles move up. The cells' weights, and which blocked cells are
// unknown, are not in the file.
#pragma once

#include <string>

#include "grid_path_planner/planners/rectangle_graph.h"

namespace grid_path_planner::planners {

// The content of the file of `map`. Throws InputError for a map without cells.
std::string rectangleFileContent(const RectangleGraph& map);

// Throws InputError naming the file where it cannot be written; then the file is unchanged.
void writeRectangleFile(const std::string& file, const RectangleGraph& map);

// Throws InputError naming the file and the fault where it cannot be read, or where parseRectangles
// or RectangleGraph refuses its content.
RectangleGraph readRectangleFile(const std::string& file, Touching touching);

}  // namespace grid_path_planner::planners
