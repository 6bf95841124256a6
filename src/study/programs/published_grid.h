// A costmap as the original study's programs see it: rows, columns and one value a cell.
//
// The original's map has 366 rows and 362 columns, ours 366 columns and 362 rows: its row is our
// column and its column our row. Only this class knows; everything else that the programs do is
// written in the original's rows and columns. A cell's index is row * columns + column, so the order
// of indices is the original's order "by row, then by column".
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "grid_path_planner/planners/planner.h"

namespace grid_path_planner::study {

class PublishedGrid {
 public:
  using Index = std::uint32_t;
  static constexpr Index kNone = static_cast<Index>(-1);

  static std::size_t bytesFor(const grid::GridGeometry& geometry) {
    return geometry.size() * (sizeof(costmap::CostGrid::Weight) + sizeof(std::uint8_t));
  }
  // Why the programs cannot search `map`, "" where they can: they know eight neighbours, diagonals
  // as long as straights, and corners that are cut.
  static std::string refusal(const costmap::CostGrid& map);

  void build(const costmap::CostGrid& map);

  std::size_t size() const { return values_.size(); }
  int row(Index cell) const { return static_cast<int>(cell) / columns_; }
  int column(Index cell) const { return static_cast<int>(cell) % columns_; }
  Index index(grid::Cell cell) const { return at(cell.column, cell.row); }
  grid::Cell cell(Index cell) const { return {row(cell), column(cell)}; }

  bool blocked(Index cell) const { return values_[cell] == costmap::CostGrid::kBlocked; }
  bool occupied(Index cell) const { return occupied_[cell] != 0; }
  int value(Index cell) const { return values_[cell]; }
  int largerValue(Index a, Index b) const { return std::max(value(a), value(b)); }

  // Calls visit(neighbour) in the original's order N, S, E, W, NE, NW, SE, SW (north: the row
  // before, east: the next column) for those that are in the map and not blocked, until one call
  // returns true. Whether one did.
  template <class Visit>
  bool anyNeighbour(Index cell, Visit&& visit) const {
    for (const auto& [rows, columns] : kNeighbours) {
      const int to_row = row(cell) + rows, to_column = column(cell) + columns;
      if (to_row < 0 || to_row >= rows_ || to_column < 0 || to_column >= columns_) continue;
      const Index to = at(to_row, to_column);
      if (!blocked(to) && visit(to)) return true;
    }
    return false;
  }

  // `result` as FOUND, with the path that `parents` lead back from `goal` to `start` and its cost by
  // the map's own rule.
  planners::SearchResult pathBetween(const costmap::CostGrid& map,
                                     const std::vector<Index>& parents, Index start, Index goal,
                                     planners::SearchResult result) const;

 private:
  static constexpr std::array<std::array<int, 2>, 8> kNeighbours = {
      {{-1, 0}, {1, 0}, {0, 1}, {0, -1}, {-1, 1}, {-1, -1}, {1, 1}, {1, -1}}};

  Index at(int row, int column) const { return static_cast<Index>(row * columns_ + column); }

  int rows_ = 0;
  int columns_ = 1;
  std::vector<costmap::CostGrid::Weight> values_;
  std::vector<std::uint8_t> occupied_;
};

}  // namespace grid_path_planner::study
