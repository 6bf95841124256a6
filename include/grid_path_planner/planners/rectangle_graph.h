// A map's free space as rectangles: which one holds a cell, and which touch.
//
//   RectangleGraph map(geometry, largestFirst(bits, {}, stop), Touching::BORDERS);
//   std::optional<std::uint32_t> here = map.at(cell);
//
//   RectangleEdit edit = map.edit(bits.rows, changed, stop);  // cells became free or blocked
//
// Holds the rectangles, an R-tree over them (Boost.Geometry) and their connections: nothing in
// proportion to the cells.
//
// edit() redoes the rectangles that the changed cells touch, and a few around them where that keeps
// their number down. Guaranteed: the result is again a partition of the free cells; the others keep
// their numbers; the time follows what is redone, not the map. Not guaranteed: the rectangles of a
// decomposition of the new map, nor as few, nor the order of their size. Measured (see
// benchmark/rectangle_repair.cpp): within 5 % of the number of largestFirst after 10,000 edits.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "grid_path_planner/base/stop_token.h"
#include "grid_path_planner/costmap/bit_maps.h"
#include "grid_path_planner/grid/grid_geometry.h"
#include "grid_path_planner/planners/connections.h"

namespace grid_path_planner::planners {

class RectangleIndex;
struct FreeChanges;

// The numbers whose rectangle went and whose came, ascending. A number in both has another
// rectangle now.
struct RectangleEdit {
  std::vector<std::uint32_t> removed;
  std::vector<std::uint32_t> added;
};

class RectangleGraph {
 public:
  // No cells, no rectangles.
  RectangleGraph();
  // Throws InputError naming the first rectangle that is empty, leaves the map or overlaps another,
  // and Stopped.
  RectangleGraph(const grid::GridGeometry& geometry, std::vector<grid::CellRect> rectangles,
                 Touching touching, const base::StopToken& stop = base::StopToken());
  ~RectangleGraph();
  RectangleGraph(RectangleGraph&&) noexcept;
  RectangleGraph& operator=(RectangleGraph&&) noexcept;

  const grid::GridGeometry& geometry() const { return geometry_; }
  // By number. After edits some numbers may be vacant: theirs are empty, until they are used again.
  const std::vector<grid::CellRect>& rectangles() const { return rectangles_; }
  // How many there are.
  std::size_t count() const;
  const Connections& connections() const { return connections_; }

  // The number of the rectangle that holds the cell.
  std::optional<std::uint32_t> at(grid::Cell cell) const;

  // `free` is the map as it is now, and differs from what the rectangles cover only inside
  // `changed`. Throws Stopped, and has changed nothing or a part of it then: it may be called
  // again.
  RectangleEdit edit(const costmap::BitMap& free, const grid::CellRect& changed,
                     const base::StopToken& stop);

  std::size_t freeCells() const;
  std::size_t bytes() const;
  // The most that a map of so many rectangles that border each other takes while it is made.
  static std::size_t bytesFor(std::size_t rectangles);

 private:
  class Replacement;

  void repair(const FreeChanges& changes, Replacement& replacement, const base::StopToken& stop);
  // Some that lie around `changed` and are not touched, ascending.
  std::vector<std::uint32_t> nearby(const grid::CellRect& changed,
                                    const std::vector<std::uint32_t>& touched) const;

  grid::GridGeometry geometry_;
  Touching touching_ = Touching::BORDERS;
  std::vector<grid::CellRect> rectangles_;
  std::vector<std::uint32_t> vacant_;
  Connections connections_;
  std::unique_ptr<RectangleIndex> index_;
};

}  // namespace grid_path_planner::planners
