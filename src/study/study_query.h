// The queries of a study on one map.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "grid_path_planner/costmap/cost_grid.h"
#include "study/study.h"

namespace grid_path_planner::study {

struct StudyQuery {
  grid::Cell start;
  grid::Cell goal;
  std::string group;  // CellPair::group, "" for queries that are not pairs
  int number = 0;     // CellPair::number
  std::string note;   // which end was blocked and which cell replaced it; "" where none was
};

// The queries of `map` on `occupancy`. Ends that are occupied or too near to something that is (by
// `costmap`'s radius) are moved to the nearest free cell. Random pairs are connected, and the same
// for the same seed and map. Throws InputError for a pair outside the map, a scenario of another
// map, and a map on which no end can be placed.
std::vector<StudyQuery> studyQueries(const StudyMap& map, const grid::OccupancyGrid& occupancy,
                                     const costmap::CostmapOptions& costmap);

}  // namespace grid_path_planner::study
