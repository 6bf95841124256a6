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
// Guaranteed: exact, and a function of the tree alone. heightsAt() looks at squares of columns that
// have a bottom, the nearest first, and into those only that may lower a height: its work depends on
// what is there, and little on the radius. Not guaranteed: a seabed that was not seen. A wall whose
// foot was never seen, with nothing else seen within the radius, counts as seabed from its lowest
// seen voxel on. One voxel below the true seabed raises obstacles around itself.
#pragma once

#include <array>
#include <cstdint>
#include <unordered_map>

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
  static constexpr int kLevels = 13;  // 2^13 brick columns are all that a tree has along a side
  // Of 2^level brick columns along x and along y; x and y count such squares.
  struct Square {
    int level = 0;
    int x = 0;
    int y = 0;
  };

  static Bottoms bottomsOf(const OccupancyBricks& bricks, BrickColumn column);
  static Square quarterOf(const Square& square, int right, int upper);
  void updateSquares(BrickColumn column);
  int leastIn(const Square& square) const;
  void lowerBy(const Bottoms& bottoms, int dx, int dy, Heights& heights) const;
  void lowerBySquare(const Square& square, BrickColumn column, Heights& heights) const;

  double radius_;  // voxels
  double max_slope_;
  int reach_;
  std::unordered_map<std::uint32_t, Bottoms> bottoms_;  // only those that have one
  // The least bottom of each square that has one, of level 1 and up.
  std::array<std::unordered_map<std::uint32_t, std::int32_t>, kLevels> squares_;
};

}  // namespace grid_path_planner::mapping
