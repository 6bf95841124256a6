// Which cells of one map lie on which of another, whose resolution and origin are others.
//
//   const GridAlignment alignment(source.geometry(), target.geometry());
//   visitCells(alignment.touched(changed), [&](Cell cell) { use(cell, alignment.sources(cell)); });
//
// Guaranteed: two cells lie on one another if and only if their interiors share more than a strip of 1e-6
// cells, so that maps whose cells are the same places stay as they are, whatever rounding does to their origins.
#pragma once

#include <vector>

#include "grid_path_planner/grid/grid_geometry.h"

namespace grid_path_planner::grid {

// Throws InputError for an origin with a yaw: nothing is resampled along slanting lines.
void checkUnrotated(const GridGeometry& geometry);

class GridAlignment {
 public:
  // Throws InputError as checkUnrotated().
  GridAlignment(const GridGeometry& from, const GridGeometry& to);

  // The cells of the target that those of the source in `rect` lie on; empty where there are none.
  CellRect touched(const CellRect& rect) const;
  // The cells of the source that lie on a cell of the target; empty where there are none.
  CellRect sources(Cell target) const {
    const Span& columns = columns_[static_cast<std::size_t>(target.column)];
    const Span& rows = rows_[static_cast<std::size_t>(target.row)];
    return {columns.first, rows.first, columns.end - columns.first, rows.end - rows.first};
  }
  // Whether the source holds all of a cell of the target.
  bool covers(Cell target) const {
    return columns_[static_cast<std::size_t>(target.column)].covered &&
           rows_[static_cast<std::size_t>(target.row)].covered;
  }

 private:
  struct Span {
    int first;
    int end;
    bool covered;
  };

  // `offset` and `scale`: from the cells of one map to those of the other.
  static Span spanOf(double first, double end, double offset, double scale, int most);
  static std::vector<Span> spansOf(int count, double offset, double scale, int most);

  std::vector<Span> columns_, rows_;  // of the source, for each of the target
  double scale_;                      // a cell of the source, in those of the target
  double column_offset_, row_offset_;
  int width_, height_;  // of the target
};

}  // namespace grid_path_planner::grid
