// Occupancy values for the cells of one brick column, from its voxels inside a band of heights.
#pragma once

#include <array>
#include <cstdint>

#include "grid_path_planner/mapping/occupancy_bricks.h"

namespace grid_path_planner::mapping {

constexpr int kKeyOfZero = 32768;  // of the voxel whose lower side is 0
constexpr double kOnTheLattice =
    1e-6;  // voxels; how near to a voxel's side a bound counts as on it

// Voxels by the z of their keys, both ends included; empty where lowest > highest.
struct VoxelBand {
  int lowest = 0;
  int highest = -1;
};

// The voxels that reach into the heights between min_z and max_z, m.
VoxelBand voxelBand(double min_z, double max_z, double resolution);

// One value (-1, 0, 100) a cell; cell (x, y) of the column stands at y * 8 + x.
using ColumnValues = std::array<std::int8_t, 64>;

// The same band for all cells, or one for each.
ColumnValues columnValues(const OccupancyBricks& bricks, BrickColumn column, const VoxelBand& band);
ColumnValues columnValues(const OccupancyBricks& bricks, BrickColumn column,
                          const std::array<VoxelBand, 64>& bands);

}  // namespace grid_path_planner::mapping
