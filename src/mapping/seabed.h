// The height of the seabed under every column of the 3-D map, by a slope filter (Vosselman 2000).
//
//   Seabed seabed(1.0, 0.5, 0.05);  // radius, max_slope, resolution
//   for (BrickColumn column : changed) seabed.update(bricks, column);
//   const Seabed::Heights heights = seabed.heightsAt(column);
//
// The seabed at column c is the least of bottom(c') + max_slope * distance(c, c') over the columns
// c' within `radius`, where bottom(c') is the lowest occupied voxel. So ground that rises by at most
// max_slope is seabed throughout, and objects standing on it are not. A lowest voxel under which
// free space was seen hangs over the ground (a hull) and is no bottom.
//
// Guaranteed: exact, and a function of the tree alone. Not guaranteed: a seabed that was not seen.
// A wall whose foot was never seen, with nothing else seen within the radius, counts as seabed from
// its lowest seen voxel on. One voxel below the true seabed raises obstacles around itself.
#pragma once

#include <array>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "grid_path_planner/mapping/occupancy_bricks.h"

namespace grid_path_planner::mapping {

class Seabed {
 public:
  // `radius` in m, `max_slope` in metres up per metre along, `resolution`: a voxel's side, m.
  Seabed(double radius, double max_slope, double resolution);

  // Reads a brick column again. Returns whether the bottom of one of its columns changed; then
  // heights within reach() brick columns of it may have changed.
  bool update(const OccupancyBricks& bricks, BrickColumn column);

  // In brick columns along x and y.
  int reach() const { return reach_; }

  // For each cell of a brick column (y * 8 + x) the seabed's height: the z of a voxel's key, with
  // fractions; kNone where no bottom was seen within the radius.
  using Heights = std::array<double, 64>;
  static constexpr double kNone = 1e9;
  Heights heightsAt(BrickColumn column) const;

 private:
  static constexpr int kNoBottom = 1 << 20;
  struct Bottoms {
    std::array<std::int32_t, 64> z;  // keys, or kNoBottom
    std::int32_t least = kNoBottom;
  };
  struct Neighbour {
    int dx = 0;  // columns from the brick column asked about to this one
    int dy = 0;
    const Bottoms* bottoms = nullptr;
  };

  static Bottoms bottomsOf(const OccupancyBricks& bricks, BrickColumn column);
  double heightAt(int x, int y, const std::vector<Neighbour>& neighbours) const;
  std::vector<Neighbour> neighboursOf(BrickColumn column) const;

  double radius_;  // voxels
  double max_slope_;
  int reach_;
  std::unordered_map<std::uint32_t, Bottoms> bottoms_;  // only those that have one
};

}  // namespace grid_path_planner::mapping
