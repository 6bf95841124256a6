// The eight steps from a cell, by number, and which of them a map allows at every cell.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "grid_path_planner/base/stop_token.h"
#include "grid_path_planner/terrain/cost_grid.h"

namespace grid_path_planner {

// The straight ones first: a step is diagonal if its number is 4 or more.
constexpr std::array<Cell, 8> kSteps = {Cell{1, 0}, Cell{0, 1},  Cell{-1, 0},  Cell{0, -1},
                                        Cell{1, 1}, Cell{-1, 1}, Cell{-1, -1}, Cell{1, -1}};

// What each step adds to a cell's index.
std::array<std::ptrdiff_t, 8> stepOffsets(int width);

// The steps that are allowed from the middle of a 3x3, by its nine bits (neighbourhoods.h).
class NeighbourhoodMasks {
 public:
  NeighbourhoodMasks() = default;
  explicit NeighbourhoodMasks(const MotionModel& motion);
  std::uint8_t operator[](unsigned bits) const { return masks_[bits]; }

 private:
  std::array<std::uint8_t, 512> masks_{};
};

// One byte a cell, bit n for step n.
class StepMasks {
 public:
  // Throws Stopped.
  void build(const CostGrid& map, const StopToken& stop);
  // `changed`: the cells whose weights changed since.
  void update(const CostGrid& map, const CellRect& changed, const StopToken& stop);

  std::uint8_t operator[](std::size_t index) const { return masks_[index]; }
  // What step n adds to a cell's index.
  const std::array<std::ptrdiff_t, 8>& offsets() const { return offsets_; }
  std::size_t bytes() const { return masks_.size(); }

 private:
  std::vector<std::uint8_t> masks_;
  std::array<std::ptrdiff_t, 8> offsets_{};
};

// The cells that can be reached from `start` by steps, start included if it is passable: a byte a
// cell, not 0 where reached. Throws Stopped.
std::vector<std::uint8_t> reachableFrom(const CostGrid& map, Cell start, const StopToken& stop);

}  // namespace grid_path_planner
