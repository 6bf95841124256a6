// MovingAI scenario files: queries on a map with their optimal costs (Sturtevant 2012).
#pragma once

#include <string>
#include <vector>

#include "grid_path_planner/grid/cell.h"

namespace grid_path_planner::tools {

struct Query {
  std::string map;
  int width = 0;
  int height = 0;
  Cell start;
  Cell goal;
  double optimum = 0.0;  // cell lengths, diagonals sqrt 2, corners not cut
  int line = 0;          // in the file, from 1
};

// Throws InputError naming file and line.
std::vector<Query> readScenarioFile(const std::string& file);

}  // namespace grid_path_planner::tools
