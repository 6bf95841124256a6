#include "layers/resampling.h"

#include <algorithm>

#include "grid/level_grid.h"

namespace grid_path_planner::layers {

using grid::Cell;
using grid::CellRect;
using grid::GridAlignment;
using grid::LevelGrid;
using grid::OccupancyGrid;

namespace {

struct Extremes {
  std::int8_t least = 100;
  std::int8_t most = -1;
};

Extremes extremesOf(const OccupancyGrid& map, const CellRect& cells) {
  Extremes found;
  for (int row = cells.row; row < cells.row + cells.height; ++row)
    for (int column = cells.column; column < cells.column + cells.width; ++column) {
      const std::int8_t value = map.row(row)[column];
      found.least = std::min(found.least, value);
      found.most = std::max(found.most, value);
    }
  return found;
}

// Of what lies on a cell, all of which is `covered` or not.
std::int8_t occupancyOf(const Extremes& found, bool covered, int occupied_min) {
  const bool known = found.least >= 0 && covered;
  return known || found.most >= occupied_min ? found.most : std::int8_t{-1};
}

template <class Visit>
void visitCells(const CellRect& rect, Visit visit) {
  for (int row = rect.row; row < rect.row + rect.height; ++row)
    for (int column = rect.column; column < rect.column + rect.width; ++column)
      visit(Cell{column, row});
}

}  // namespace

void resampleOccupancy(const OccupancyGrid& from, const GridAlignment& alignment,
                       const CellRect& rect, int occupied_min, OccupancyGrid& to) {
  visitCells(rect, [&](Cell cell) {
    const Extremes found = extremesOf(from, alignment.sources(cell));
    to[cell] = occupancyOf(found, alignment.covers(cell), occupied_min);
  });
}

OccupancyGrid levelOccupancy(const OccupancyGrid& map, int occupied_min) {
  const LevelGrid level(map.geometry());
  OccupancyGrid to(level.geometry());
  visitCells(level.geometry().rect(), [&](Cell cell) {
    Extremes found;
    const bool covered = level.sources(cell, [&](Cell source) {
      found.least = std::min(found.least, map[source]);
      found.most = std::max(found.most, map[source]);
    });
    to[cell] = occupancyOf(found, covered, occupied_min);
  });
  return to;
}

void addMask(const OccupancyGrid& mask, const GridAlignment& alignment, int occupied_min,
             OccupancyGrid& to) {
  visitCells(alignment.touched(mask.geometry().rect()), [&](Cell cell) {
    if (extremesOf(mask, alignment.sources(cell)).most >= occupied_min) to[cell] = 100;
  });
}

}  // namespace grid_path_planner::layers
