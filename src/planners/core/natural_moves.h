// Natural moves: the steps that remain after pruning. A step is left out where another path to its
// end costs no more and comes first in the canonical order: the pruning of jump point search, here
// for cells of any weight.
//
// Of all paths between two cells the canonical one costs least; of several that do, it is the one
// whose sequence of steps comes first, diagonal steps before straight ones. Step e is natural after
// step d into cell x if <d, e> is the canonical path between its ends inside the 3x3 cells around
// x.
//
//   const NaturalMoves moves = naturalMoves(window);  // nine weights, row by row, x in the middle
//   use(naturalAfter(moves, 1U << d));                // a bit for every step natural after d
//
// Guaranteed: a search that takes only natural steps, at every cell those of all steps that reached
// it at its least cost, finds the least cost to every cell: a canonical path consists of natural
// steps, since a part that is not canonical could be replaced. This holds for diagonals of length
// sqrt 2 that cut no corners. Where every cell has the same weight it is jump point search's own
// pruning (Harabor & Grastien 2011; for weights: Carlson et al. 2023, with another cost rule).
#pragma once

#include <array>
#include <cstdint>

#include "grid_path_planner/costmap/cost_grid.h"

namespace grid_path_planner::planners {

// Byte d: bit e is set where step e (planners/steps.h) is natural after step d. 0 in byte d where the
// cell cannot be entered by d.
using NaturalMoves = std::uint64_t;

using Window = std::array<costmap::CostGrid::Weight, 9>;

NaturalMoves naturalMoves(const Window& window);

// The weights around a cell; outside the map is blocked.
Window windowAt(const costmap::CostGrid& map, grid::Cell cell);

namespace natural_moves_detail {

constexpr std::array<std::uint64_t, 256> bytesOfBits() {
  std::array<std::uint64_t, 256> bytes{};
  for (unsigned mask = 0; mask < 256; ++mask)
    for (unsigned bit = 0; bit < 8; ++bit)
      if ((mask >> bit & 1U) != 0) bytes[mask] |= std::uint64_t{255} << (8 * bit);
  return bytes;
}

inline constexpr std::array<std::uint64_t, 256> kBytesOfBits = bytesOfBits();

}  // namespace natural_moves_detail

// The steps that are natural after any of the steps of `reached`, a bit for every step.
inline unsigned naturalAfter(NaturalMoves moves, unsigned reached) {
  std::uint64_t chosen = moves & natural_moves_detail::kBytesOfBits[reached];
  chosen |= chosen >> 32;
  chosen |= chosen >> 16;
  chosen |= chosen >> 8;
  return static_cast<unsigned>(chosen & 255);
}

}  // namespace grid_path_planner::planners
