// A cell of a map by column and row, a cell by its position in row-major memory, and a rectangle of
// cells. The three cannot be mixed up: none converts to another without a geometry.
#pragma once

#include <cstdint>
#include <cstdlib>
#include <ostream>

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

}  // namespace grid_path_planner::grid
