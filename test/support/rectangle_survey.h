// The published decomposition as published: the whole map is surveyed for the largest empty
// rectangle, which is taken away, again and again. The reference of planners/decomposition.h.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "grid_path_planner/grid/grid.h"

namespace grid_path_planner::test {

// A byte a cell, not 0 where it is free.
using FreeCells = grid::Grid<std::uint8_t>;

// Of equally large ones: smallest first column, then smallest last row, then greatest width.
std::optional<grid::CellRect> largestRectangle(const FreeCells& free);

// The same by trying every rectangle of the map: for small ones.
std::optional<grid::CellRect> largestRectangleByTrying(const FreeCells& free);

// At most `count` rectangles, largest first.
std::vector<grid::CellRect> surveyRectangles(FreeCells free, std::size_t count);

}  // namespace grid_path_planner::test
