// Seeded random maps of the kinds that planners meet.
#pragma once

#include <random>
#include <vector>

#include "grid_path_planner/costmap/cost_grid.h"
#include "grid_path_planner/grid/occupancy.h"

namespace grid_path_planner::test {

// Occupied with probability `occupied`, unknown with `unknown`, else free; sides 1..largest_side.
grid::OccupancyGrid randomOccupancy(std::mt19937& random, int largest_side, double occupied,
                                    double unknown);

// Weights of one of five kinds, drawn anew each time: uniform, few values that tie, plateaus, rings
// and noise; a share of the cells blocked.
costmap::CostGrid randomCosts(std::mt19937& random, int largest_side,
                              const costmap::MotionModel& motion);
costmap::CostGrid randomCosts(std::mt19937& random, const grid::GridGeometry& geometry,
                              const costmap::MotionModel& motion);

// As robots have them: rectangular obstacles, inflated by a few cells with or without a decay,
// among free and unknown ground.
costmap::CostGrid randomInflated(std::mt19937& random, const grid::GridGeometry& geometry,
                                 const costmap::MotionModel& motion);

// A gentle potential over the whole map: rectangular obstacles, and weights that fall slowly with the
// distance to them, from up to 200.
costmap::CostGrid randomPotential(std::mt19937& random, const grid::GridGeometry& geometry,
                                  const costmap::MotionModel& motion);

grid::Cell randomCell(std::mt19937& random, const grid::GridGeometry& geometry);

// What may change at once: none to six rectangles of up to `largest_side` cells a side, anywhere in
// the map, at its corners or over its edges; they may overlap.
std::vector<grid::CellRect> randomRects(std::mt19937& random, const grid::GridGeometry& geometry,
                                        int largest_side);

}  // namespace grid_path_planner::test
