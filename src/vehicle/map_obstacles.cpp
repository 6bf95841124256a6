#include "vehicle/map_obstacles.h"

namespace grid_path_planner::vehicle {

using grid::Occupancy;

FootprintObstacles mapObstacles(const grid::OccupancyGrid& map,
                                const grid::OccupancyThresholds& thresholds, bool unknown) {
  FootprintObstacles obstacles;
  obstacles.outside = unknown;
  obstacles.first = [&map, thresholds, unknown](const grid::RowSpan& span) {
    const auto* row = map.row(span.row);
    int column = span.first;
    while (column < span.end && row[column] < thresholds.occupied_min &&
           !(unknown && thresholds.classify(row[column]) == Occupancy::UNKNOWN))
      ++column;
    return column;
  };
  return obstacles;
}

}  // namespace grid_path_planner::vehicle
