#include "layers/layer_stack.h"

#include <algorithm>
#include <utility>

namespace grid_path_planner::layers {

using grid::CellRect;
using grid::OccupancyGrid;

void LayerStack::setBase(std::shared_ptr<const OccupancyGrid> base) {
  base_ = std::move(base);
  for (UsedGrid& layer : layers_) layer.grid = OccupancyGrid(base_->geometry(), -1);
  merged_ = *base_;
  row_.resize(static_cast<std::size_t>(merged_.width()));
  changed_.clear();
}

void LayerStack::setBase(std::shared_ptr<const OccupancyGrid> base,
                         const std::vector<CellRect>& changed) {
  base_ = std::move(base);
  merge(changed);
}

void LayerStack::merge(const std::vector<CellRect>& rects) {
  for (const CellRect& rect : rects)
    for (int row = rect.row; row < rect.row + rect.height; ++row)
      mergeRow(row, rect.column, rect.column + rect.width);
}

void LayerStack::use(Layer layer, bool used) {
  UsedGrid& changed = layers_[index(layer)];
  if (std::exchange(changed.used, used) != used && hasBase()) merge({merged_.geometry().rect()});
}

void LayerStack::mergeRow(int row, int first, int end) {
  std::copy(base_->row(row) + first, base_->row(row) + end, row_.begin() + first);
  for (const UsedGrid& layer : layers_) {
    if (!layer.used) continue;
    const std::int8_t* values = layer.grid.row(row);
    for (int column = first; column < end; ++column)
      row_[static_cast<std::size_t>(column)] =
          std::max(row_[static_cast<std::size_t>(column)], values[column]);
  }
  std::int8_t* merged = merged_.row(row);
  for (int column = first; column < end; ++column) {
    const std::int8_t value = row_[static_cast<std::size_t>(column)];
    if (std::exchange(merged[column], value) != value) changed_.add({column, row});
  }
}

}  // namespace grid_path_planner::layers
