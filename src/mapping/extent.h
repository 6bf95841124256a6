// Which cells the 2-D map has: those of all brick columns, or the densest part of them where they
// are more than the map may hold.
//
//   Extent extent(0.05);                         // the resolution, m
//   extent.setSensor(x, y);                      // m; what lies around it is kept
//   cells = extent.fit(cells, changed, bricks, options);
//
// Where all columns do not fit, strips of a brick's width are left out one after the other at the
// side whose strip holds the fewest columns for its length (left, right, below, above where they
// are equal), never those within projection_keep_around of the sensor: a ray that strays goes
// first. A quarter of max_cells is left to grow into, so that neither an exploring vehicle nor rays
// that stray with every scan change the geometry each time.
//
// Guaranteed: at most max_cells cells, the sensor's surroundings among them; the same calls give
// the same cells.
#pragma once

#include <cstddef>
#include <vector>

#include "grid_path_planner/grid/cell.h"
#include "grid_path_planner/mapping/occupancy_bricks.h"
#include "grid_path_planner/mapping/projection_options.h"

namespace grid_path_planner::mapping {

// Cell 0 begins at 0 m.
grid::CellRect cellsOf(BrickColumn column);

class Extent {
 public:
  explicit Extent(double resolution) : resolution_(resolution) {}

  // Where the newest scan was taken, m.
  void setSensor(double x, double y);
  // The next fit() does not begin with the cells that are there.
  void restart() { sized_ = false; }

  // The cells from now on. `present`: those so far; `changed`: columns that changed since.
  grid::CellRect fit(const grid::CellRect& present, const std::vector<BrickColumn>& changed,
                     const OccupancyBricks& bricks, const ProjectionOptions& options);

  // How many brick columns lie outside the cells, as far as fit() left them out.
  std::size_t leftOut() const { return left_out_; }

 private:
  grid::CellRect cropped(const grid::CellRect& present, const OccupancyBricks& bricks,
                         const ProjectionOptions& options);
  grid::CellRect keptBricks(const ProjectionOptions& options) const;

  double resolution_;
  int sensor_x_ = 0;  // cells
  int sensor_y_ = 0;
  bool sized_ = false;  // by columns of the tree, not only to have a cell
  std::size_t left_out_ = 0;
  grid::CellRect all_;  // cells of all columns when some were left out last
};

}  // namespace grid_path_planner::mapping
