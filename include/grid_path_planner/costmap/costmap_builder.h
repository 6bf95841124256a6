// Builds the costmaps that are searched from an occupancy map: classes, weights, inflation, kernel.
//
//   CostmapBuilder builder(options);
//   builder.setMap(map);
//   std::shared_ptr<const CostGrid> costmap = builder.downsampled(stop);
//
// Costmaps are computed when they are needed. After updateMap() only the cells whose class changed
// are computed again, and those that inflation reaches from cells that became occupied or stopped
// being occupied; nothing takes time in proportion to the map (but for what
// grid/double_buffered.h says). A returned costmap does not change; a changed map gives a new one
// with a higher revision, and what changed since an earlier one is told. The caller's map is never
// changed.
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "grid_path_planner/base/stop_token.h"
#include "grid_path_planner/costmap/cost_grid.h"
#include "grid_path_planner/costmap/costmap_options.h"

namespace grid_path_planner::costmap {

struct ClassChanges;
struct Inflations;

class CostmapBuilder {
 public:
  // Throws InputError for options that cannot be used.
  explicit CostmapBuilder(const CostmapOptions& options);

  // Memory that the costmaps of a map of this geometry take, each of them so many times (twice as long
  // as no reader keeps old ones, double_buffered.h).
  static std::size_t bytesFor(const grid::GridGeometry& geometry, int kernel,
                              std::size_t buffers = 2);

  void setMap(std::shared_ptr<const grid::OccupancyGrid> map);
  // `map` has the geometry of the current one and differs from it only inside `changed`.
  void updateMap(std::shared_ptr<const grid::OccupancyGrid> map,
                 const std::vector<grid::CellRect>& changed);

  // The inflated costmap before the kernel, and the one that the kernel makes of it (the same object
  // where the kernel is 1). Each call computes both. Throw Stopped; the next call goes on.
  // Precondition: setMap was called.
  std::shared_ptr<const CostGrid> fullResolution(const base::StopToken& stop);
  std::shared_ptr<const CostGrid> downsampled(const base::StopToken& stop);

  // Whoever has time does now what the first change after setMap() would do of the whole map: copies the
  // costmaps that were made. Throws Stopped; then nothing of it is kept.
  void makeReadyForChanges(const base::StopToken& stop);

  // What changed in each of the two from revision to revision: nothing is known of the time before
  // setMap() and of other builders' costmaps.
  const CostChanges& fullResolutionChanges() const { return full_.changes(); }
  const CostChanges& downsampledChanges() const {
    return (options_.kernel == 1 ? full_ : downsampled_).changes();
  }

  const CostmapOptions& options() const { return options_; }

 private:
  void bringUpToDate(const base::StopToken& stop);
  void build(const base::StopToken& stop);
  std::unique_ptr<CostGrid> buildDownsampled(const CostGrid& full,
                                             const base::StopToken& stop) const;
  void updateFullResolution(const base::StopToken& stop);
  // The cells whose weights were written.
  std::vector<grid::CellRect> rewriteWeights(const ClassChanges& changes,
                                             const base::StopToken& stop);
  void updateDownsampled(const base::StopToken& stop);

  CostmapOptions options_;
  std::shared_ptr<const grid::OccupancyGrid> map_;
  std::shared_ptr<const Inflations> inflations_;  // for the resolution of map_
  std::vector<grid::CellRect> full_dirty_;        // cells of map_ that changed since full_
  std::vector<grid::CellRect>
      downsampled_dirty_;  // cells of full_ that did since downsampled_, if any
  grid::DoubleBuffered<CostGrid, CostGrid::Change> full_;
  grid::DoubleBuffered<CostGrid, CostGrid::Change> downsampled_;  // empty where the kernel is 1
};

}  // namespace grid_path_planner::costmap
