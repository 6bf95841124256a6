// From an occupancy map to the cost grids that are searched: classes, weights, inflation, kernel.
//
//   Terrain terrain(options);
//   terrain.setMap(map);
//   std::shared_ptr<const CostGrid> costs = terrain.searched(stop);
//
// Made when asked for. After updateMap() only the changed rectangle, grown by what inflation
// reaches, is computed again. The grids handed out stay as they are; a changed map gives new ones
// with a higher revision. The caller's map is never changed.
#pragma once

#include <memory>

#include "grid_path_planner/base/stop_token.h"
#include "grid_path_planner/terrain/cost_grid.h"
#include "grid_path_planner/terrain/inflation.h"
#include "grid_path_planner/terrain/terrain_options.h"

namespace grid_path_planner {

class Terrain {
 public:
  // Throws InputError for options that cannot be used.
  explicit Terrain(const TerrainOptions& options);

  void setMap(std::shared_ptr<const OccupancyGrid> map);
  // `map` has the geometry of the present one and differs from it only inside `changed`.
  void updateMap(std::shared_ptr<const OccupancyGrid> map, const CellRect& changed);

  // Kernel 1, inflated; and what is searched: with the kernel (the same object where it is 1).
  // Throw Stopped; asked again they begin anew. Precondition: setMap was called.
  std::shared_ptr<const CostGrid> fine(const StopToken& stop);
  std::shared_ptr<const CostGrid> searched(const StopToken& stop);

  // The cells (blocks) in which the last searched() differs from the one before it: everything
  // after setMap().
  const CellRect& searchedChange() const { return searched_change_; }

  const TerrainOptions& options() const { return options_; }

 private:
  void makeFine(const StopToken& stop);
  void makeSearched(const StopToken& stop);

  TerrainOptions options_;
  std::shared_ptr<const OccupancyGrid> map_;
  CellRect fine_dirty_;      // cells of the map that changed since fine_ was made
  CellRect searched_dirty_;  // cells of fine_ that changed since searched_ was made
  CellRect searched_change_;
  std::shared_ptr<const CostGrid> fine_;
  std::shared_ptr<const CostGrid> searched_;
  std::uint64_t revision_ = 0;
};

}  // namespace grid_path_planner
