// Maps as pictures. The first line is row 0, as in a MovingAI file.
//
//   AsciiMap picture({"S.#",
//                     "..G"});
//
// '.' free, '#' occupied, '?' unknown, 'S' start (free), 'G' goal (free).
#pragma once

#include <string>
#include <vector>

#include "grid_path_planner/grid/occupancy.h"

namespace grid_path_planner::test {

struct AsciiMap {
  // Throws std::invalid_argument for lines of different lengths and other letters.
  explicit AsciiMap(const std::vector<std::string>& lines, double resolution = 1.0,
                    const grid::Origin& origin = {});

  grid::OccupancyGrid map;
  grid::Cell start;
  grid::Cell goal;
};

}  // namespace grid_path_planner::test
