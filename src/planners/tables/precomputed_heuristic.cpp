#include "planners/tables/precomputed_heuristic.h"

namespace grid_path_planner::planners {

using base::StopToken;
using costmap::CostGrid;
using grid::CellRect, grid::GridGeometry;

PrecomputedHeuristic::PrecomputedHeuristic(const AStarOptions& options) {
  if (options.heuristic == Heuristic::LANDMARK)
    landmarks_ = std::make_unique<PrecomputedTable<LandmarkTable>>(
        [landmarks = options.landmarks](const CostGrid& map, const StopToken& stop) {
          return LandmarkTable(map, landmarks, stop);
        });
  if (options.heuristic == Heuristic::EXACT)
    exact_ = std::make_unique<PrecomputedTable<ExactTable>>(
        [](const CostGrid& map, const StopToken& stop) { return ExactTable(map, stop); });
}

std::size_t PrecomputedHeuristic::bytesFor(const AStarOptions& options,
                                           const GridGeometry& geometry) {
  if (options.heuristic == Heuristic::LANDMARK)
    return LandmarkTable::bytesFor(geometry, options.landmarks) +
           LandmarkTable::makingBytesFor(geometry, options.landmarks);
  if (options.heuristic == Heuristic::EXACT)
    return ExactTable::bytesFor(geometry) + ExactTable::makingBytesFor(geometry);
  return 0;
}

std::string PrecomputedHeuristic::lessMemoryAdvice(const AStarOptions& options) {
  if (options.heuristic == Heuristic::LANDMARK)
    return "raise it, take fewer landmarks or search with a larger kernel";
  if (options.heuristic == Heuristic::EXACT)
    return "heuristic exact holds the cost between every two cells; take landmark or octile";
  return "";
}

void PrecomputedHeuristic::prepare(std::shared_ptr<const CostGrid> map) {
  if (landmarks_)
    landmarks_->prepare(std::move(map));
  else if (exact_)
    exact_->prepare(std::move(map));
}

void PrecomputedHeuristic::update(const CostGrid& before, std::shared_ptr<const CostGrid> map,
                                  const std::vector<CellRect>& changed) {
  if (landmarks_)
    landmarks_->update(before, std::move(map), changed);
  else if (exact_)
    exact_->update(before, std::move(map), changed);
}

void PrecomputedHeuristic::wait(const StopToken& stop) const {
  if (landmarks_) landmarks_->wait(stop);
  if (exact_) exact_->wait(stop);
}

BackgroundWork PrecomputedHeuristic::work() {
  if (landmarks_) return landmarks_->work();
  if (exact_) return exact_->work();
  return {};
}

}  // namespace grid_path_planner::planners
