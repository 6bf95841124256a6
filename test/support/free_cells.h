// Free and blocked cells for the rectangles, from pictures and at random.
#pragma once

#include <random>
#include <string>
#include <vector>

#include "grid_path_planner/costmap/bit_maps.h"
#include "support/rectangle_survey.h"

namespace grid_path_planner::test {

// '1' or '.' free, anything else blocked; the first line is row 0.
FreeCells freeCells(const std::vector<std::string>& lines);

// The worked example of the published R-map.
FreeCells publishedExample();

// Free with the given probability; sides from 1.
FreeCells randomFreeCells(std::mt19937& random, int largest_side, double free);

// Blocks of random sizes taken out of free space, as rooms and walls are.
FreeCells randomBlocks(std::mt19937& random, int largest_side);

costmap::BitMaps bitMapsOf(const FreeCells& free);

// Precondition: `rect` lies in the map.
void fillCells(FreeCells& cells, const grid::CellRect& rect, std::uint8_t value);

// Whether every free cell lies in exactly one of the rectangles and no other does, and none of them
// is empty.
bool isPartition(const FreeCells& free, const std::vector<grid::CellRect>& rectangles);

}  // namespace grid_path_planner::test
