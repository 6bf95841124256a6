// What the values of other programs' maps may tell of them.
//
//   ThresholdFit fit;
//   if (const std::string& problem = fit.problem(map, thresholds, stop); !problem.empty()) warn(problem);
//   if (isInflated(map->values(), map->width())) warn(kInflated);
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "grid_path_planner/base/stop_token.h"
#include "grid_path_planner/grid/occupancy.h"

namespace grid_path_planner::grid {

// Whether the thresholds of occupancy fit the maps of a publisher. Those of cartographer have all greys: of a floor of 38 %
// and a wall of 57 % no threshold of 25 and 65 knows one from the other, and both are unknown.
class ThresholdFit {
 public:
  // A sentence where the map has values between the thresholds, and none that is free, or none that is occupied; else empty. A
  // pass over the map, but not where it is the one before, or a free and an occupied cell of that are so still. Throws Stopped.
  const std::string& problem(const std::shared_ptr<const OccupancyGrid>& map,
                             const OccupancyThresholds& thresholds,
                             const base::StopToken& stop = {});

 private:
  std::string problemOf(const OccupancyGrid& map, const base::StopToken& stop);

  std::weak_ptr<const OccupancyGrid> map_;  // the one before
  OccupancyThresholds thresholds_;
  std::string problem_;
  std::size_t free_ = 0, occupied_ = 0;  // cells of it
};

// Whether it is one of costmap_2d, whose cells beside occupied ones (100) cost 99: where the robot's centre would touch. It has
// such cells, and no other known one, beside each cell of 100.
bool isInflated(const std::vector<std::int8_t>& values, std::size_t width);

constexpr char kInflated[] =
    "it is inflated, as costmap_2d's maps are: its cells of 99 are where the robot's centre would "
    "touch, and a radius kept "
    "from them is kept twice (occupied_min 99, free_max 98 and radius 0 use it as it is)";

}  // namespace grid_path_planner::grid
