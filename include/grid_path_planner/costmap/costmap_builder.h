// From an occupancy map to the cost grids that are searched: classes, weights, inflation, kernel.
//
//   CostmapBuilder builder(options);
//   builder.setMap(map);
//   std::shared_ptr<const CostGrid> costs = builder.downsampled(stop);
//
// Made when asked for. After updateMap() only the cells whose class changed are computed again,
// and those that inflation reaches from where a cell became occupied or is no longer; nothing is
// done in proportion to the map (grid/double_buffered.h says when). The grids handed out stay as they
// are; a changed map gives new ones with a higher revision. The caller's map is never changed.
#pragma once

#include <memory>
#include <optional>

#include "grid_path_planner/base/stop_token.h"
#include "grid_path_planner/costmap/cost_grid.h"
#include "grid_path_planner/costmap/costmap_options.h"
#include "grid_path_planner/costmap/inflation.h"

namespace grid_path_planner::costmap {

class CostmapBuilder {
 public:
  // Throws InputError for options that cannot be used.
  explicit CostmapBuilder(const CostmapOptions& options);

  void setMap(std::shared_ptr<const grid::OccupancyGrid> map);
  // `map` has the geometry of the present one and differs from it only inside `changed`.
  void updateMap(std::shared_ptr<const grid::OccupancyGrid> map, const grid::CellRect& changed);

  // Kernel 1, inflated; and what is searched: with the kernel (the same object where it is 1). Both
  // are made together. Throw Stopped; asked again they go on. Precondition: setMap was called.
  std::shared_ptr<const CostGrid> fullResolution(const base::StopToken& stop);
  std::shared_ptr<const CostGrid> downsampled(const base::StopToken& stop);

  // The cells, and the blocks, in which fine() and searched() differ from those of the revision
  // before: everything after setMap().
  const grid::CellRect& fullResolutionChange() const { return fine_change_; }
  const grid::CellRect& downsampledChange() const { return searched_change_; }

  const CostmapOptions& options() const { return options_; }

 private:
  void bringUpToDate(const base::StopToken& stop);
  void makeAnew(const base::StopToken& stop);
  void updateFine(const base::StopToken& stop);
  void updateSearched(const base::StopToken& stop);

  CostmapOptions options_;
  std::shared_ptr<const grid::OccupancyGrid> map_;
  std::optional<Inflation> inflation_;  // for the resolution of map_
  grid::CellRect fine_dirty_;           // cells of map_ that changed since fine_ was made
  grid::CellRect searched_dirty_;       // cells of fine_ that changed since searched_ was made
  grid::CellRect fine_change_;
  grid::CellRect searched_change_;
  grid::DoubleBuffered<CostGrid, CostGrid::Change> fine_;
  grid::DoubleBuffered<CostGrid, CostGrid::Change> searched_;  // empty where the kernel is 1
  std::uint64_t revision_ = 0;
};

}  // namespace grid_path_planner::costmap
