// The occupied cells of a map, for the distances of points and straight pieces to the nearest one.
//
//   OccupiedCells occupied(map, thresholds);
//   const double cells = occupied.distanceTo(point, 100.0);
//
// All lengths are in cells, places in the frame of the grid. A question looks at squares of 64x64 cells, nearest first; whether
// one holds any occupied cell is found out when it is first asked for, and kept: the first question may cost the map once,
// later ones little more than the squares in reach.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <cstring>
#include <vector>

#include "grid/segment.h"
#include "grid_path_planner/grid/occupancy.h"

namespace grid_path_planner::path {

class OccupiedCells {
 public:
  static constexpr double kSlack = 1e-6;  // cells, above all rounding of distances

  // `map` outlives this and does not change.
  OccupiedCells(const grid::OccupancyGrid& map, const grid::OccupancyThresholds& thresholds);

  // `limit` where no occupied cell is nearer.
  double distanceTo(const grid::Segment& segment, double limit);
  double distanceTo(const Eigen::Vector2d& point, double limit);

 private:
  static constexpr int kSide = 64;  // of a square: a row of it is a cache line
  enum class Square : std::uint8_t { NOT_ASKED_YET, EMPTY, HOLDS_ANY };

  static grid::CellSpan cellsOf(int square,
                                int count);  // its rows or columns, of a map with `count` of them
  bool holdsAny(int across, int up);
  bool looksLikeAny(int across, int up) const;
  void lowerInSquare(const grid::Segment& segment, int across, int up, double& least);
  void lowerInRow(const grid::Segment& segment, int row, const grid::CellSpan& square,
                  double& least) const;
  int nextIn(int row, int column, int end) const;
  // Not 0 where one of eight cells is occupied, all looked at as one number: adding 128 - threshold
  // to a byte that is not negative sets its sign from the threshold on.
  std::uint64_t signs(const std::int8_t* cells) const {
    std::uint64_t word;
    std::memcpy(&word, cells, sizeof word);
    return ((word & ~kSigns) + carry_) & ~word & kSigns;
  }

  static constexpr std::uint64_t kOnes = 0x0101010101010101;
  static constexpr std::uint64_t kSigns = kOnes << 7;

  const grid::OccupancyGrid& map_;
  const grid::OccupancyThresholds thresholds_;
  std::uint64_t carry_;
  bool any_;         // even negative numbers count as occupied
  int across_, up_;  // squares
  std::vector<Square> squares_;
};

}  // namespace grid_path_planner::path
