// Where a map's cells lie in the world.
//
//   GridGeometry geometry(366, 362, 0.05, {-9.15, -9.05, 0.0});
//   Eigen::Vector2d centre = geometry.centre(Cell{3, 5});      // metres, map frame
//   std::optional<Cell> cell = geometry.cellAt(centre);        // Cell{3, 5}, always
//
// Cell -> world -> cell is the identity for every cell, negative origins and any yaw included. The
// origin is the corner of cell (0, 0), not its centre.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>

#include "grid_path_planner/grid/cell.h"

namespace grid_path_planner::grid {

// Pose of the corner of cell (0, 0) in the map frame: metres and radians, anticlockwise.
struct Origin {
  double x = 0.0;
  double y = 0.0;
  double yaw = 0.0;
};

class GridGeometry {
 public:
  // 0x0 cells: contains nothing.
  GridGeometry() = default;

  // `resolution`: metres, the side of a cell. Throws InputError for a width or height below 1, more
  // than 2^31 - 1 cells, a side over 2^19 cells, a resolution outside 1e-6..1e6 m, an origin
  // that is not finite or farther than 1e8 m.
  GridGeometry(int width, int height, double resolution, const Origin& origin = {});

  int width() const { return width_; }
  int height() const { return height_; }
  double resolution() const { return resolution_; }
  const Origin& origin() const { return origin_; }
  std::size_t size() const { return static_cast<std::size_t>(width_) * height_; }
  CellRect rect() const { return {0, 0, width_, height_}; }

  bool contains(Cell cell) const {
    return cell.column >= 0 && cell.column < width_ && cell.row >= 0 && cell.row < height_;
  }
  // Precondition: contains(cell).
  CellIndex index(Cell cell) const {
    return CellIndex(static_cast<std::uint32_t>(cell.row) * static_cast<std::uint32_t>(width_) +
                     static_cast<std::uint32_t>(cell.column));
  }
  Cell cell(CellIndex index) const {
    const auto width = static_cast<std::uint32_t>(width_);
    return {static_cast<int>(index.value() % width), static_cast<int>(index.value() / width)};
  }

  // World point (metres, map frame) of a point in cell units: (0, 0) is the corner of cell (0, 0),
  // (0.5, 0.5) its centre; and back. Points outside the map are converted all the same.
  Eigen::Vector2d worldFromGrid(const Eigen::Vector2d& cells) const;
  Eigen::Vector2d gridFromWorld(const Eigen::Vector2d& metres) const;

  Eigen::Vector2d centre(Cell cell) const {
    return worldFromGrid({cell.column + 0.5, cell.row + 0.5});
  }
  // The cell that holds a world point; none outside the map or for a point that is not finite.
  std::optional<Cell> cellAt(const Eigen::Vector2d& metres) const;

  // Two maps whose cells are the same places.
  friend bool operator==(const GridGeometry& a, const GridGeometry& b);
  friend bool operator!=(const GridGeometry& a, const GridGeometry& b) { return !(a == b); }

 private:
  int width_ = 0;
  int height_ = 0;
  double resolution_ = 1.0;
  Origin origin_;
  double cos_yaw_ = 1.0;
  double sin_yaw_ = 0.0;
};

}  // namespace grid_path_planner::grid
