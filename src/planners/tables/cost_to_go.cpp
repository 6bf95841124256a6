#include "planners/tables/cost_to_go.h"

#include <algorithm>
#include <cassert>
#include <sstream>
#include <utility>

#include "grid_path_planner/base/errors.h"
#include "planners/core/steps.h"
#include "planners/tables/tiled_dijkstra.h"

namespace grid_path_planner::planners {

using base::InputError, base::StopToken, base::ZeroedArray;
using costmap::CostGrid, costmap::ExactCost, costmap::stepAllowed;
using grid::Cell, grid::GridGeometry;

namespace {

void check(const CostGrid& map, const std::vector<Cell>& goals, int threads) {
  std::ostringstream complaint;
  if (goals.empty()) complaint << "a cost-to-go needs a goal, got none";
  for (const Cell goal : goals)
    if (!map.geometry().contains(goal) && complaint.str().empty())
      complaint << "goal " << goal << " lies outside the map of " << map.geometry().width() << "x"
                << map.geometry().height() << " cells";
  if (threads < 1) complaint << "threads must be at least 1, got " << threads;
  if (!complaint.str().empty()) throw InputError(complaint.str());
}

// Whether costs are likely to fit: a path along both sides at the mean of some of the weights.
bool narrowLikely(const CostGrid& map) {
  constexpr std::size_t kEvery = 61;
  const auto& weights = map.weights().values();
  std::size_t sum = 0, passable = 0;
  for (std::size_t i = 0; i < weights.size(); i += kEvery) {
    sum += weights[i];
    passable += weights[i] != CostGrid::kBlocked ? 1 : 0;
  }
  const std::size_t mean = sum / std::max<std::size_t>(passable, 1);
  const auto sides = static_cast<std::size_t>(map.geometry().width()) + map.geometry().height();
  return (map.uniform() ? 1 : mean) * sides / 2 <= kSmallScale.largest / kSmallScale.straight;
}

// Throws Stopped and TooExpensive.
template <class Label>
void compute(const CostGrid& map, const KeyScale& scale, const std::vector<Cell>& goals,
             int threads, const StopToken& stop, ZeroedArray<Label>& labels) {
  labels = ZeroedArray<Label>(TileLayout::tiles(map.geometry()) * TileLayout::kCells);
  TiledDijkstra<Label> search(map, labels, scale, stop);
  for (const Cell goal : goals)
    if (map.passable(goal)) search.addGoal(goal);
  search.run(threads);
}

}  // namespace

std::size_t CostToGo::bytesFor(const GridGeometry& geometry) {
  const std::size_t cells = TileLayout::tiles(geometry) * TileLayout::kCells;
  return cells * (sizeof(std::uint64_t) + 2 * sizeof(std::uint8_t) + sizeof(CostGrid::Weight));
}

CostToGo::CostToGo(std::shared_ptr<const CostGrid> map, const std::vector<Cell>& goals, int threads,
                   const StopToken& stop)
    : map_(std::move(map)),
      scale_(kSmallScale),
      factor_(map_->uniform() ? map_->minWeight() : 1),
      tiles_across_(TileLayout::along(map_->geometry().width())) {
  check(*map_, goals, threads);
  if (narrowLikely(*map_)) {
    try {
      compute(*map_, scale_, goals, threads, stop, narrow_);
      return;
    } catch (const TooExpensive&) {
      narrow_ = ZeroedArray<std::uint32_t>();
    }
  }
  scale_ = kLabelScale;
  scale_.largest /= std::max<SearchKey>(factor_, 1);
  compute(*map_, scale_, goals, threads, stop, wide_);
}

std::size_t CostToGo::positionOf(Cell cell) const {
  assert(map_->geometry().contains(cell));
  const auto column = static_cast<std::uint32_t>(cell.column);
  const auto row = static_cast<std::uint32_t>(cell.row);
  const std::size_t tile = row / TileLayout::kSide * tiles_across_ + column / TileLayout::kSide;
  return tile * TileLayout::kCells + TileLayout::insideOf(column, row);
}

std::size_t CostToGo::bytes() const {
  return narrow_.size() * sizeof(std::uint32_t) + wide_.size() * sizeof(std::uint64_t);
}

ExactCost CostToGo::inCells(Cell cell) const {
  assert(reached(cell));
  return exactCostOf(key(cell), scale_) * factor_;
}

SearchKey CostToGo::keyIn(const KeyScale& scale, Cell cell) const {
  const ExactCost cost = inCells(cell);
  return static_cast<SearchKey>(cost.straight) * scale.straight +
         static_cast<SearchKey>(cost.diagonal) * scale.diagonal;
}

ExactCost CostToGo::cost(Cell cell) const {
  return inCells(cell) * map_->kernel();
}

// Always to a neighbour whose cost and the step sum up to the cell's cost: there is one, over which
// the cell has it.
std::vector<Cell> CostToGo::pathFrom(Cell cell) const {
  assert(reached(cell));
  std::vector<Cell> path = {cell};
  while (key(path.back()) != 0) {
    const Cell at = path.back();
    for (std::size_t step = 0; step < kSteps.size(); ++step) {
      const Cell to{at.column + kSteps[step].column, at.row + kSteps[step].row};
      if (!stepAllowed(*map_, at, to)) continue;
      const SearchKey length =
          step < 4 ? scale_.straight : diagonalKey(scale_, map_->motion().diagonal_cost);
      const SearchKey weight = std::max(map_->weight(at), map_->weight(to)) / factor_;
      if (key(to) + length * weight != key(at)) continue;
      path.push_back(to);
      break;
    }
    assert(path.back() != at);
  }
  return path;
}

}  // namespace grid_path_planner::planners
