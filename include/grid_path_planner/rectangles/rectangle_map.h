// A map's free space as rectangles: which one holds a cell, and which touch.
//
//   RectangleMap map(geometry, largestFirst(bits, {}, stop), Touching::BORDERS);
//   std::optional<std::uint32_t> here = map.at(cell);
//
// Constant once made. Holds the rectangles, an R-tree over them (Boost.Geometry) and their
// connections: nothing in proportion to the cells.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "grid_path_planner/grid/grid_geometry.h"
#include "grid_path_planner/rectangles/connections.h"

namespace grid_path_planner {

class RectangleIndex;

class RectangleMap {
 public:
  // No cells, no rectangles.
  RectangleMap();
  // Throws InputError naming the first rectangle that is empty, leaves the map or overlaps another.
  RectangleMap(const GridGeometry& geometry, std::vector<CellRect> rectangles, Touching touching);
  ~RectangleMap();
  RectangleMap(RectangleMap&&) noexcept;
  RectangleMap& operator=(RectangleMap&&) noexcept;

  const GridGeometry& geometry() const { return geometry_; }
  const std::vector<CellRect>& rectangles() const { return rectangles_; }
  const Connections& connections() const { return connections_; }

  // The number of the rectangle that holds the cell.
  std::optional<std::uint32_t> at(Cell cell) const;

  std::size_t freeCells() const;
  std::size_t bytes() const;

 private:
  GridGeometry geometry_;
  std::vector<CellRect> rectangles_;
  Connections connections_;
  std::unique_ptr<RectangleIndex> index_;
};

}  // namespace grid_path_planner
