// One map of several that lie on one another: a cell has the largest value that any of them gives it, where -1,
// unknown, is less than free. So nothing that one map says is occupied is cleared by another, and a cell is
// unknown where no map knows it.
//
//   LayerStack stack;
//   stack.setBase(static_map);                       // whose grid all have
//   stack.grid(Layer::SCAN)[cell] = 100;
//   stack.merge({{cell.column, cell.row, 1, 1}});
//   for (const CellRect& rect : stack.takeChanged()) publish(stack.merged(), rect);
//
// Guaranteed: merged() is that maximum of the base and of the layers that are used, in all cells; takeChanged()
// holds each cell of merged() that differs from before, and no rectangle without one.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "grid_path_planner/grid/occupancy.h"
#include "layers/changed_cells.h"

namespace grid_path_planner::layers {

enum class Layer { LIVE, SCAN, KEEP_OUT };
constexpr std::size_t kLayers = 3;

class LayerStack {
 public:
  // Of the same geometry as the one before, of which `changed` differs; or of any: then all layers are
  // empty (-1), the whole map is new, and nothing of it is in takeChanged().
  void setBase(std::shared_ptr<const grid::OccupancyGrid> base);
  void setBase(std::shared_ptr<const grid::OccupancyGrid> base,
               const std::vector<grid::CellRect>& changed);
  bool hasBase() const { return base_ != nullptr; }

  // Whoever changes a layer calls merge() for the cells.
  grid::OccupancyGrid& grid(Layer layer) { return layers_[index(layer)].grid; }
  void merge(const std::vector<grid::CellRect>& rects);
  // Whether a layer counts; at first each does.
  void use(Layer layer, bool used);

  const grid::OccupancyGrid& merged() const { return merged_; }
  std::vector<grid::CellRect> takeChanged() { return changed_.take(); }

 private:
  struct UsedGrid {
    grid::OccupancyGrid grid;
    bool used = true;
  };

  static std::size_t index(Layer layer) { return static_cast<std::size_t>(layer); }
  void mergeRow(int row, int first, int end);

  std::shared_ptr<const grid::OccupancyGrid> base_;
  std::array<UsedGrid, kLayers> layers_;
  grid::OccupancyGrid merged_;
  std::vector<std::int8_t> row_;  // as it is merged
  ChangedCells changed_;
};

}  // namespace grid_path_planner::layers
