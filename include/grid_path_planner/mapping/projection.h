// The 3-D map seen from above: what of it lies in a band of heights, as an OccupancyGrid.
//
//   Projection projection(0.05, options);  // the resolution of the map, m
//   map.insert(scan);
//   const ProjectionChange change = projection.update(map.bricks());
//   if (change.geometry) sendWhole(projection.grid());
//   else if (!change.cells.empty()) send(projection.grid(), change.cells);
//
// A cell is occupied (100) if any voxel of its column inside the band is, else free (0) if any is
// known to be free, else unknown (-1): octomap_server's rule. A voxel counts if it reaches into the
// band; one that only touches it does not.
//
// Guaranteed: after update() the grid is what a new Projection with the same geometry would make of
// the same tree, whatever the order of changes. Only brick columns that changed are projected (with
// the reference SEABED also those within seabed_radius of them). The band never changes the tree.
// The origin lies on the voxel lattice, so cells keep their places as the grid grows. The grid
// shrinks only where the tree reaches farther than a grid of max_cells: then it holds the densest
// part and the sensor's surroundings (mapping/extent.h), and columnsLeftOut() says how much it does
// not hold. A tree that was emptied gives the same geometry, all unknown.
//
// Not guaranteed: the tightest extent. It consists of whole brick columns, and a side that grows
// takes an eighth of its length (or four bricks) more than it needs, so that an exploring vehicle
// does not change the geometry with every scan.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "grid_path_planner/grid/occupancy.h"
#include "grid_path_planner/mapping/occupancy_bricks.h"
#include "grid_path_planner/mapping/projection_options.h"

namespace grid_path_planner::mapping {

class Extent;
class Seabed;

struct ProjectionChange {
  bool geometry = false;  // origin or size changed: all cells may differ
  grid::CellRect cells;   // the smallest rectangle around the cells that have a new value
};

class Projection {
 public:
  // `resolution`: the side of a voxel and of a cell, m. The grid is at first unknown: the bounds,
  // or without bounds one cell. Throws InputError for options that cannot be used.
  Projection(double resolution, const ProjectionOptions& options);
  ~Projection();
  Projection(Projection&&) noexcept;
  Projection& operator=(Projection&&) noexcept;

  // Takes effect in the next update(), which then projects every column. Throws InputError for
  // options that cannot be used; the old ones stay.
  void setOptions(const ProjectionOptions& options);
  const ProjectionOptions& options() const { return options_; }

  // The vehicle's z, m in the map frame; 0 until then. Only with the reference VEHICLE, and only
  // where it moved by more than a voxel, the next update() projects every column again.
  void setVehicleHeight(double z);

  // Where the newest scan was taken, m: what lies around it is in the grid.
  void setSensor(double x, double y);

  // Drains the changed columns of `bricks`, which are always the same ones. Where the last call failed for want of
  // memory, or a change of the bricks did, all is projected anew, and called changed.
  ProjectionChange update(OccupancyBricks& bricks);

  const grid::OccupancyGrid& grid() const { return grid_; }

  // Columns of 8x8 cells of the tree that the grid does not hold, for max_cells; 0 with bounds.
  std::size_t columnsLeftOut() const;

 private:
  void restart() noexcept;
  // A value for each of the 8x8 cells of a brick column; cell (x, y) stands at y * 8 + x.
  using ColumnValues = std::array<std::int8_t, 64>;

  void collectColumns(OccupancyBricks& bricks);
  bool fitGeometry(const OccupancyBricks& bricks);
  void setGeometry(const grid::CellRect& cells);
  void projectColumns(const OccupancyBricks& bricks, grid::CellRect& changed);
  void addSeabedNeighbours(const OccupancyBricks& bricks);
  ColumnValues valuesOf(const OccupancyBricks& bricks, BrickColumn column) const;
  ColumnValues valuesAbove(const std::array<double, 64>& seabed, const OccupancyBricks& bricks,
                           BrickColumn column) const;
  void write(BrickColumn column, const ColumnValues& values, grid::CellRect& changed);

  double resolution_;
  ProjectionOptions options_;
  double vehicle_height_ = 0.0;  // m, as the grid has it
  grid::OccupancyGrid grid_;
  grid::CellRect cells_;             // of the grid, counted from the cell that begins at (0, 0) m
  bool all_columns_pending_ = true;  // every column is to be projected
  bool restarts_ = false;            // and what the grid has is forgotten
  std::vector<BrickColumn> pending_columns_;
  std::unique_ptr<Extent> extent_;  // without bounds
  std::unique_ptr<Seabed> seabed_;  // with the reference SEABED
};

}  // namespace grid_path_planner::mapping
