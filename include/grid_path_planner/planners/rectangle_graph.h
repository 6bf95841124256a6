// A map's free space as rectangles, with an index by cell and their connections.
//
//   RectangleGraph map(geometry, largestFirst(bits, {}, stop), Touching::BORDERS);
//   std::optional<std::uint32_t> here = map.at(cell);
//
//   RectangleEdit edit = map.edit(bits.rows, changed, stop);  // cells became free or blocked
//
// Holds the rectangles, an R-tree over them (Boost.Geometry) and their connections: no memory in
// proportion to the cells.
//
// edit() cuts anew the rectangles that the changed cells touch, and a few around them where that
// gives fewer rectangles. Guaranteed: the result is a partition of the free cells; all other
// rectangles keep their numbers; the time is in proportion to the rectangles that are cut anew, not
// to the map. Not guaranteed: the rectangles of a decomposition of the new map, nor as few, nor the
// order of their size. Measured (see benchmark/rectangle_repair.cpp): within 5 % of the number of
// largestFirst after 10,000 edits.
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

// The numbers whose rectangle was removed and whose was added, ascending. A number in both has
// another rectangle now.
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
  // By number. After edits some numbers may be vacant: their rectangles are empty.
  const std::vector<grid::CellRect>& rectangles() const { return rectangles_; }
  // How many there are.
  std::size_t count() const;
  const Connections& connections() const { return connections_; }

  // The number of the rectangle that holds the cell.
  std::optional<std::uint32_t> at(grid::Cell cell) const;

  // `free` is the new map, and differs from what the rectangles cover only inside `changed`. Throws
  // Stopped, after a part of the changes; a second call with the same arguments completes them.
  RectangleEdit edit(const costmap::BitMap& free, const grid::CellRect& changed,
                     const base::StopToken& stop);

  std::size_t freeCells() const;
  std::size_t bytes() const;
  // The most that the constructor takes for so many rectangles with Touching::BORDERS.
  static std::size_t bytesFor(std::size_t rectangles);

 private:
  class Replacement;

  void repair(const FreeChanges& changes, Replacement& replacement, const base::StopToken& stop);
  // The numbers of some rectangles around `changed` that are not in `touched`, ascending.
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
