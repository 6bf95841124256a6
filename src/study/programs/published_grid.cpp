#include "study/programs/published_grid.h"

#include <algorithm>

namespace grid_path_planner::study {

using base::Status;
using costmap::Connectivity, costmap::CostGrid, costmap::DiagonalCost, costmap::MotionModel;
using grid::Occupancy;
using planners::SearchResult;

std::string PublishedGrid::refusal(const CostGrid& map) {
  const MotionModel& motion = map.motion();
  const bool as_published = motion.connectivity == Connectivity::EIGHT &&
                            motion.diagonal_cost == DiagonalCost::UNIT && motion.cut_corners;
  return as_published
             ? ""
             : "plans only with connectivity 8, diagonal_cost unit and cut_corners, as the "
               "original study did";
}

void PublishedGrid::build(const CostGrid& map) {
  rows_ = map.geometry().width();
  columns_ = map.geometry().height();
  values_.resize(map.geometry().size());
  occupied_.resize(values_.size());
  for (Index i = 0; i < values_.size(); ++i) {
    values_[i] = map.weight(cell(i));
    occupied_[i] = map.occupancy(cell(i)) == Occupancy::OCCUPIED ? 1 : 0;
  }
}

SearchResult PublishedGrid::pathBetween(const CostGrid& map, const std::vector<Index>& parents,
                                        Index start, Index goal, SearchResult result) const {
  for (Index at = goal; at != start; at = parents[at]) result.cells.push_back(cell(at));
  result.cells.push_back(cell(start));
  std::reverse(result.cells.begin(), result.cells.end());
  result.cost = costOfSteps(map, result.cells);
  result.status = Status::FOUND;
  return result;
}

}  // namespace grid_path_planner::study
