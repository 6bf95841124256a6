// A cell of a map by column and row, a cell by its position in row-major memory, a rectangle of
// cells, and lists of these. A cell, its position and a rectangle cannot be mixed up: none converts to
// another without a geometry.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <ostream>
#include <vector>

namespace grid_path_planner::grid {

// Column grows with the map's x, row with its y, as in nav_msgs/OccupancyGrid.
struct Cell {
  int column = 0;
  int row = 0;

  friend bool operator==(Cell a, Cell b) { return a.column == b.column && a.row == b.row; }
  friend bool operator!=(Cell a, Cell b) { return !(a == b); }
  friend std::ostream& operator<<(std::ostream& out, Cell cell) {
    return out << '(' << cell.column << ", " << cell.row << ')';
  }
};

// row * width + column of one particular geometry.
class CellIndex {
 public:
  CellIndex() = default;
  explicit constexpr CellIndex(std::uint32_t value) : value_(value) {}
  constexpr std::uint32_t value() const { return value_; }

  friend constexpr bool operator==(CellIndex a, CellIndex b) { return a.value_ == b.value_; }
  friend constexpr bool operator!=(CellIndex a, CellIndex b) { return a.value_ != b.value_; }
  friend constexpr bool operator<(CellIndex a, CellIndex b) { return a.value_ < b.value_; }

 private:
  std::uint32_t value_ = 0;
};

// The cells with column in [column, column + width) and row in [row, row + height).
struct CellRect {
  int column = 0;
  int row = 0;
  int width = 0;
  int height = 0;

  bool empty() const { return width <= 0 || height <= 0; }
  bool contains(Cell cell) const {
    return cell.column >= column && cell.column < column + width && cell.row >= row &&
           cell.row < row + height;
  }
  // The cells that lie in both; width and height 0 if there are none.
  CellRect intersection(const CellRect& other) const;
  // The smallest rectangle around both; an empty one adds nothing.
  CellRect hull(const CellRect& other) const;
  // Grown by `margin` cells on every side.
  CellRect grown(int margin) const {
    return {column - margin, row - margin, width + 2 * margin, height + 2 * margin};
  }

  friend bool operator==(const CellRect& a, const CellRect& b) {
    return a.column == b.column && a.row == b.row && a.width == b.width && a.height == b.height;
  }
};

// What changed of a map is a list of rectangles. Whoever takes one takes any: rectangles that
// overlap, empty ones, none at all. These make lists that are worth their length:

constexpr std::size_t kMostRects = 256;

// Disjoint rectangles, none empty and at most kMostRects, that hold the cells of `rects`, and others
// near them where that joins rectangles: as many in the worst case as lie in the hull of all. Lists
// that are so already stay as they are. Takes time in proportion to the list.
std::vector<CellRect> disjointRects(const std::vector<CellRect>& rects);

// disjointRects() of the rectangles grown by `margin` cells on every side, of the cells in `within`.
std::vector<CellRect> grownRects(const std::vector<CellRect>& rects, int margin,
                                 const CellRect& within);

}  // namespace grid_path_planner::grid
