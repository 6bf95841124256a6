// The eight steps from a cell, by number, and which of them a map allows at every cell.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "grid_path_planner/base/stop_token.h"
#include "grid_path_planner/costmap/cost_grid.h"
#include "planners/core/simd_neighbourhood.h"

namespace grid_path_planner::planners {

// The straight ones first: a step is diagonal if its number is 4 or more.
constexpr std::array<grid::Cell, 8> kSteps = {
    grid::Cell{1, 0}, grid::Cell{0, 1},  grid::Cell{-1, 0},  grid::Cell{0, -1},
    grid::Cell{1, 1}, grid::Cell{-1, 1}, grid::Cell{-1, -1}, grid::Cell{1, -1}};

// The step in the opposite direction.
constexpr std::uint32_t oppositeStep(std::uint32_t step) {
  return step ^ 2U;
}

// The natural steps after step d where no obstacle is near and all cells have one weight, bit n for
// step n: straight on; after a diagonal step also its two straight parts.
constexpr std::array<std::uint8_t, 8> kNaturalInTheOpen = {
    1, 2, 4, 8, 1 << 4 | 1 | 2, 1 << 5 | 4 | 2, 1 << 6 | 4 | 8, 1 << 7 | 1 | 8};

// What each step adds to a cell's index.
std::array<std::ptrdiff_t, 8> stepOffsets(int width);

// The steps that a motion model allows, from eight cells together.
class StepRules {
 public:
  using Eight = SimdNeighbourhood::Eight;

  StepRules() = default;
  explicit StepRules(const costmap::MotionModel& motion);

  // Bit n for step n.
  Eight allowed(const SimdNeighbourhood& cells) const {
    const Eight east = cells.blocked(1, 0), north = cells.blocked(0, 1);
    const Eight west = cells.blocked(-1, 0), south = cells.blocked(0, -1);
    const Eight north_east = cells.blocked(1, 1) | (corners_ & (north | east));
    const Eight north_west = cells.blocked(-1, 1) | (corners_ & (north | west));
    const Eight south_west = cells.blocked(-1, -1) | (corners_ & (south | west));
    const Eight south_east = cells.blocked(1, -1) | (corners_ & (south | east));
    const Eight blocked = cells.blocked(0, 0) | (east & 1) | (north & 2) | (west & 4) |
                          (south & 8) | (north_east & 16) | (north_west & 32) | (south_west & 64) |
                          (south_east & 128);
    return steps_ & ~blocked;
  }

 private:
  Eight steps_ = {};    // of the motion model
  Eight corners_ = {};  // all bits where a blocked corner stops a diagonal step
};

// One byte a cell, bit n for step n.
class StepMasks {
 public:
  // Throws Stopped.
  void build(const costmap::CostGrid& map, const base::StopToken& stop);
  // `changed`: the cells whose weights changed since.
  void update(const costmap::CostGrid& map, const grid::CellRect& changed,
              const base::StopToken& stop);

  std::uint8_t operator[](std::size_t index) const { return masks_[index]; }
  // What step n adds to a cell's index.
  const std::array<std::ptrdiff_t, 8>& offsets() const { return offsets_; }
  std::size_t bytes() const { return masks_.size(); }

 private:
  std::vector<std::uint8_t> masks_;
  std::array<std::ptrdiff_t, 8> offsets_{};
};

}  // namespace grid_path_planner::planners
