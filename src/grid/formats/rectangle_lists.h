// Disjoint rectangles as lists of small numbers, which deflate well: the body of a rectangle file.
// grid/rectangle_map_file.h says how they are counted.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "grid_path_planner/grid/cell.h"
#include "grid_path_planner/grid/grid_geometry.h"

namespace grid_path_planner::grid {

// How the rectangles are ordered; the values are written to files.
enum class RectangleOrder { LARGEST_FIRST = 0, BY_POSITION = 1, AS_LISTED = 2 };

// The first of them that the rectangles are in.
RectangleOrder orderOf(const std::vector<CellRect>& rectangles);

// Rows, columns, widths, heights, and in the order AS_LISTED numbers: each list with a number for
// every rectangle, by position. Precondition: the rectangles are disjoint, none is empty, all lie
// in the map.
std::vector<std::string> listsOf(const std::vector<CellRect>& rectangles,
                                 const GridGeometry& geometry, RectangleOrder order);
std::size_t numberOfLists(RectangleOrder order);

// The bytes of a list's longest number. The shortest takes one.
constexpr std::size_t kLongestNumber = 5;

// In the order in which they were given to listsOf. Throws InputError saying what is wrong where a
// list ends early or goes on, or where they hold what no rectangles in that map make; overlapping
// ones are not noticed. Precondition: there are numberOfLists(order) lists.
std::vector<CellRect> rectanglesOf(const std::vector<std::string>& lists, std::size_t count,
                                   const GridGeometry& geometry, RectangleOrder order);

}  // namespace grid_path_planner::grid
