#include "planners/replanning/backward_nodes.h"

#include "grid_path_planner/grid/prefetch.h"

namespace grid_path_planner::planners {

using base::ZeroedArray;
using costmap::CostGrid;
using grid::CellRect;

void BackwardNodes::prepare(const CostGrid& map, const MovePruning& moves) {
  moves_ = &moves;
  geometry_ = map.geometry();
  cell_of_ = CellOfIndex(geometry_);
  diagonal_step_ = diagonalKey(kPackedScale, map.motion().diagonal_cost);
  offsets_ = moves.offsets();
  if (words_.size() == geometry_.size()) return;
  words_ = ZeroedArray<Word>(geometry_.size());
  stamp_.restart();
}

void BackwardNodes::reset(Index root) {
  stamp_.next([this] { words_.clear(); });
  root_ = root;
  set(root, 0, 0, OPEN);
}

void BackwardNodes::prefetchRows(const CellRect& rect) const {
  if (rect.empty()) return;
  grid_path_planner::grid::prefetchRows(&words_[geometry_.index({rect.column, rect.row}).value()],
                                        static_cast<std::size_t>(geometry_.width()), rect.width,
                                        rect.height);
}

}  // namespace grid_path_planner::planners
