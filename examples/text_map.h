// Small maps for the examples, read from text and printed as text. The first line is the upper one.
//
//   '.' free   '#' occupied   '?' unknown
#pragma once

#include <iostream>
#include <string>
#include <vector>

#include "grid_path_planner/grid/occupancy.h"
#include "grid_path_planner/path/path.h"

namespace examples {

// Cells of 1 m; the lower left corner of the map is (0, 0).
inline grid_path_planner::grid::OccupancyGrid mapOf(const std::vector<std::string>& lines) {
  const int height = static_cast<int>(lines.size());
  grid_path_planner::grid::OccupancyGrid map({static_cast<int>(lines[0].size()), height, 1.0});
  for (int row = 0; row < map.height(); ++row)
    for (int column = 0; column < map.width(); ++column) {
      const char letter = lines[height - 1 - row][column];
      map[{column, row}] = letter == '#' ? 100 : letter == '?' ? -1 : 0;
    }
  return map;
}

// The same letters, and 'o' where a pose of the path lies.
inline void print(const grid_path_planner::grid::OccupancyGrid& map,
                  const grid_path_planner::path::Path& path) {
  std::vector<std::string> lines(map.height(), std::string(map.width(), '.'));
  for (int row = 0; row < map.height(); ++row)
    for (int column = 0; column < map.width(); ++column) {
      const int value = map[{column, row}];
      if (value != 0) lines[row][column] = value < 0 ? '?' : '#';
    }
  for (const auto& pose : path.poses)
    if (const auto cell = map.geometry().cellAt(pose.position.head<2>()))
      lines[cell->row][cell->column] = 'o';
  for (int row = map.height() - 1; row >= 0; --row) std::cout << "  " << lines[row] << '\n';
}

}  // namespace examples
