#include "grid_path_planner/search/goal_labels.h"

#include "grid_path_planner/grid/touch.h"

namespace grid_path_planner {

static_assert(kSteps[oppositeStep(0)].column == -kSteps[0].column &&
              kSteps[oppositeStep(1)].row == -kSteps[1].row &&
              kSteps[oppositeStep(4)].column == -kSteps[4].column &&
              kSteps[oppositeStep(5)].column == -kSteps[5].column);

void GoalLabels::prepare(const CostGrid& map, const Moves& moves) {
  moves_ = &moves;
  geometry_ = map.geometry();
  cell_of_ = CellOfIndex(geometry_);
  diagonal_step_ = diagonalKey(kPackedScale, map.motion().diagonal_cost);
  offsets_ = moves.offsets();
  if (words_.size() == geometry_.size()) return;
  words_ = ZeroedArray<Word>(geometry_.size());
  tree_ = 0;
}

void GoalLabels::begin(Index root) {
  if (++tree_ == Word{1} << (64 - kTreeShift)) {
    words_.clear();
    tree_ = 1;
  }
  root_ = root;
  set(root, 0, 0, OPEN);
}

void GoalLabels::touch(const CellRect& rect) const {
  if (rect.empty()) return;
  grid_path_planner::touch(&words_[geometry_.index({rect.column, rect.row}).value()],
                           static_cast<std::size_t>(geometry_.width()), rect.width, rect.height);
}

}  // namespace grid_path_planner
