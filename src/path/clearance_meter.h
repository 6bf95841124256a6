// The clearances of one path after another over the same map, as clearanceOf() of metrics.h has them.
//
//   ClearanceMeter meter(map, thresholds);
//   const double metres = meter.clearanceOf(path);
//
// What one path had looked for in the map is not looked for again by the next. Used by one thread at a time.
#pragma once

#include <memory>

#include "grid_path_planner/grid/occupancy.h"
#include "grid_path_planner/path/path.h"
#include "path/occupied_cells.h"

namespace grid_path_planner::path {

class ClearanceMeter {
 public:
  // Precondition: there is a map.
  ClearanceMeter(std::shared_ptr<const grid::OccupancyGrid> map,
                 const grid::OccupancyThresholds& thresholds);

  bool isOfMap(const std::shared_ptr<const grid::OccupancyGrid>& map) const { return map == map_; }
  bool isOf(const std::shared_ptr<const grid::OccupancyGrid>& map,
            const grid::OccupancyThresholds& thresholds) const;

  // In metres; infinity where no cell is occupied, or for a path without poses. Poses are in the map's frame.
  double clearanceOf(const Path& path);

 private:
  const std::shared_ptr<const grid::OccupancyGrid> map_;
  const grid::OccupancyThresholds thresholds_;
  OccupiedCells occupied_;
};

}  // namespace grid_path_planner::path
