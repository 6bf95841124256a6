#include "planners/astar/best_first_search.h"

namespace grid_path_planner::planners {

using base::Status, base::StopToken, base::ZeroedArray;
using costmap::CostGrid, costmap::costOfSteps;
using grid::Cell, grid::CellIndex, grid::CellRect;

void BestFirstSearch::prepare(const CostGrid& map, const StopToken& stop) {
  masks_.build(map, stop);
  if (words_.size() == map.geometry().size()) return;
  costs_ = ZeroedArray<SearchKey>(map.geometry().size());
  words_ = ZeroedArray<std::uint32_t>(map.geometry().size());
  stamp_.restart();
}

void BestFirstSearch::update(const CostGrid& map, const std::vector<CellRect>& changed,
                             const StopToken& stop) {
  for (const CellRect& rect : changed) masks_.update(map, rect, stop);
}

void BestFirstSearch::beginQuery() {
  open_.clear();
  stamp_.next([this] { words_.clear(); });
}

std::vector<Cell> BestFirstSearch::pathTo(const CostGrid& map, std::uint32_t start,
                                          std::uint32_t goal) const {
  std::vector<Cell> cells;
  for (std::uint32_t at = goal; at != start;) {
    cells.push_back(map.geometry().cell(CellIndex(at)));
    const std::uint32_t step = words_[at] >> kStepShift & 7U;
    at = static_cast<std::uint32_t>(at - masks_.offsets()[step]);
  }
  cells.push_back(map.geometry().cell(CellIndex(start)));
  std::reverse(cells.begin(), cells.end());
  return cells;
}

SearchResult BestFirstSearch::finish(const CostGrid& map, std::uint32_t start, std::uint32_t goal,
                                     SearchResult result) const {
  result.cells = pathTo(map, start, goal);
  result.cost = costOfSteps(map, result.cells);
  return withStatus(map, Status::FOUND, std::move(result));
}

SearchResult BestFirstSearch::withStatus(const CostGrid& map, Status status,
                                         SearchResult result) const {
  result.status = status;
  result.statistics.search_bytes =
      bytesFor(map.geometry()) + result.statistics.peak_open * sizeof(Entry);
  return result;
}

}  // namespace grid_path_planner::planners
