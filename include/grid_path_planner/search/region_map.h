// A map in large pieces: sectors of 16x16 cells, each cut into regions whose cells are connected
// inside it (the sector abstraction of Sturtevant, "Memory-efficient abstractions for pathfinding",
// AIIDE 2007).
//
// Guaranteed: regions are joined exactly where a step leads from a cell of one to a cell of the
// other, so a way over regions exists where one over cells does, and inside them. Unlike blocks of
// a kernel, regions neither close a door nor open a wall. An edit touches the sectors of its cells.
#pragma once

#include <cstdint>
#include <vector>

#include "grid_path_planner/base/stop_token.h"
#include "grid_path_planner/search/steps.h"
#include "grid_path_planner/terrain/cost_grid.h"

namespace grid_path_planner {

class RegionMap {
 public:
  static constexpr int kShift = 4;
  static constexpr int kSide = 1 << kShift;  // cells of a sector's side

  using Id = std::uint32_t;  // sector * 256 + the region's number in it
  struct Region {
    Cell middle;  // one of its cells, near the middle of them
    float weight =
        0;  // that a path through it may have: the cheapest, and a quarter of the way to the mean
  };

  static std::size_t bytesFor(const GridGeometry& geometry);

  // Throw Stopped. `masks` are those of `map`.
  void build(const CostGrid& map, const StepMasks& masks, const StopToken& stop);
  void update(const CostGrid& map, const StepMasks& masks, const CellRect& changed,
              const StopToken& stop);

  int columns() const { return columns_; }  // of sectors
  int rows() const { return rows_; }
  std::uint32_t sectorOf(Cell cell) const {
    return static_cast<std::uint32_t>((cell.row >> kShift) * columns_ + (cell.column >> kShift));
  }

  // Precondition: the cell is passable.
  Id regionAt(const GridGeometry& geometry, Cell cell) const {
    return sectorOf(cell) << 8 | numbers_[geometry.index(cell).value()];
  }
  const Region& region(Id id) const { return regions_[id >> 8][id & 0xFFU]; }
  // Writes the regions that a step leads to into `ids`, each once, always in the same order.
  void neighbours(const GridGeometry& geometry, const StepMasks& masks, Id id,
                  std::vector<Id>& ids) const;

 private:
  CellRect cellsOf(std::uint32_t sector, const GridGeometry& geometry) const;
  void cut(const CostGrid& map, const StepMasks& masks, std::uint32_t sector);
  Region collect(const CostGrid& map, const StepMasks& masks, const CellRect& sector, Cell first,
                 std::uint8_t number);

  int columns_ = 0;
  int rows_ = 0;
  std::vector<std::uint8_t> numbers_;         // of a cell's region in its sector
  std::vector<std::vector<Region>> regions_;  // by sector
  std::vector<Cell> collected_;
};

}  // namespace grid_path_planner
