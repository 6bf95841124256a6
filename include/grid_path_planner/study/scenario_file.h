// MovingAI scenario files: queries on a map with their optimal costs (Sturtevant 2012).
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "grid_path_planner/base/read_limits.h"
#include "grid_path_planner/grid/grid_geometry.h"

namespace grid_path_planner::study {

struct ScenarioQuery {
  std::string map;
  int width = 0;
  int height = 0;
  grid::Cell start;
  grid::Cell goal;
  double optimum = 0.0;   // cell lengths, diagonals sqrt 2, corners not cut
  double rounding = 0.0;  // of the optimum: half a unit of the last decimal that the file prints
  int line = 0;           // in the file, from 1
};

// Throws InputError naming file and line, or the limit that the file exceeds.
std::vector<ScenarioQuery> readScenarioFile(const std::string& file,
                                            const base::ReadLimits& limits = {});

// `limit` of the queries, evenly over the file; all where it is 0 or not below their number.
std::vector<ScenarioQuery> spreadOver(const std::vector<ScenarioQuery>& queries, std::size_t limit);

// Throws InputError where the query, of `file`, is for a map of another size.
void checkScenarioQuery(const ScenarioQuery& query, const grid::GridGeometry& geometry,
                        const std::string& file);

}  // namespace grid_path_planner::study
