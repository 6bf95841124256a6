// Where the classes of a map's cells differ from those of the map before.
//
//   const ClassChanges changes(map, thresholds, changed, costs.classes(), stop);
//   for (const CellRect& rect : changes.vacated) use(rect);
//
// Classes are compared sixteen at a time. What differs is kept by squares of kSide cells, so that a map
// whose cells change here and there costs what is around these cells, and not what lies between them.
#pragma once

#include <vector>

#include "grid_path_planner/base/stop_token.h"
#include "grid_path_planner/grid/occupancy.h"

namespace grid_path_planner::costmap {

void classify(const grid::OccupancyGrid& map, const grid::OccupancyThresholds& thresholds,
              const grid::CellRect& rect, grid::Grid<grid::Occupancy>& classes,
              const base::StopToken& stop);

struct ClassChanges {
  static constexpr int kSide = 16;

  ClassChanges() = default;
  // `changed`: disjoint rectangles in the map that hold all changes. Throws Stopped.
  ClassChanges(const grid::OccupancyGrid& map, const grid::OccupancyThresholds& thresholds,
               const std::vector<grid::CellRect>& changed,
               const grid::Grid<grid::Occupancy>& before, const base::StopToken& stop);

  // The smallest rectangles around the changed cells of each square: all of them, and those of a kind.
  std::vector<grid::CellRect> all;
  std::vector<grid::CellRect> filled;   // occupied now
  std::vector<grid::CellRect> vacated;  // occupied before
  std::vector<grid::CellRect> other;    // neither
};

// Fewer rectangles that hold the cells of `rects`, where that makes the sum of their cells less, with
// `margin` more on every side. They may overlap.
std::vector<grid::CellRect> joinedRects(std::vector<grid::CellRect> rects, int margin);

}  // namespace grid_path_planner::costmap
