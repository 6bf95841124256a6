// How fast a vehicle may drive in each cell, as the topic speed_limit says it: 0 no limit, 1 to 100 percent of the
// vehicle's largest speed. Where several limits meet the lowest holds.
//
//   OccupancyGrid limits(geometry, 0);
//   addSlowZones(zones, 0.8, limits);
//   const OccupancyGrid others = limitsOfMask(mask, {100.0, -1.0});
//   addLimits(others, GridAlignment(mask.geometry(), geometry), limits);
#pragma once

#include "grid/grid_alignment.h"
#include "grid_path_planner/grid/occupancy.h"
#include "layers/zones.h"

namespace grid_path_planner::layers {

// Percent rounded down, so that no limit is above the zone's; none (0) for zones as fast as `max_speed` (m/s) and
// faster. Throws InputError for a zone below one percent of it, which cannot be told; so does the check alone.
void addSlowZones(const Zones& zones, double max_speed, grid::OccupancyGrid& limits);
void checkSlowZones(const Zones& zones, double max_speed);

// What the values of a mask mean, as nav2's SpeedFilter has it: percent = base + multiplier * value.
struct SpeedMaskScale {
  double base = 100.0;
  double multiplier = -1.0;
};

// The limits that a mask means, in its own grid: none for 0, unknown, and what comes to 100 percent and more.
// Throws InputError for a value that comes to less than one percent.
grid::OccupancyGrid limitsOfMask(const grid::OccupancyGrid& mask, const SpeedMaskScale& scale);

// On the grid without a yaw over them, on each cell of it that they touch. Throws InputError as LevelGrid.
grid::OccupancyGrid levelLimits(const grid::OccupancyGrid& limits);

// The limits of another grid, on each cell of `limits` that they touch.
void addLimits(const grid::OccupancyGrid& others, const grid::GridAlignment& alignment,
               grid::OccupancyGrid& limits);

}  // namespace grid_path_planner::layers
