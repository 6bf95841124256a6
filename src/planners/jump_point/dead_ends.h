// Dead branches: steps after which the natural steps all end within a few steps
// (planners/jump_point/weighted_jump_map.h says what they are good for).
#pragma once

#include <cstdint>
#include <vector>

#include "grid_path_planner/grid/cell.h"
#include "planners/core/natural_moves.h"

namespace grid_path_planner::planners {

// Bit d: no step of `steps` is natural after step d.
constexpr unsigned deadAfter(NaturalMoves steps) {
  constexpr std::uint64_t kLow = 0x7F7F7F7F7F7F7F7FU;
  const std::uint64_t filled = (((steps & kLow) + kLow) | steps) & ~kLow;
  return static_cast<unsigned>(((~filled & ~kLow) >> 7) * 0x0102040810204080U >> 56);
}

// The steps at every cell that do not begin a dead branch, a bit for each. `natural`: the natural
// steps of a window of cells, row by row. A branch is dead if every sequence of natural steps that
// begins with it ends inside the window after at most `depth` further steps.
std::vector<std::uint8_t> liveSteps(const std::vector<NaturalMoves>& natural, int width, int height,
                                    int depth);

}  // namespace grid_path_planner::planners
