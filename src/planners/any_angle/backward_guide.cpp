#include "planners/any_angle/backward_guide.h"

#include <algorithm>

namespace grid_path_planner::planners {

using base::Status, base::StopToken;
using costmap::CostGrid;
using grid::Cell, grid::CellRect, grid::GridGeometry;

std::size_t BackwardGuide::bytesFor(const GridGeometry& geometry) {
  return BucketSearch::bytesFor(geometry) + BlockBounds::bytesFor(geometry, kBlock);
}

void BackwardGuide::prepare(const CostGrid& map, const StopToken& stop) {
  search_.prepare(map, stop);
  blocks_.prepare(map, stop);
}

void BackwardGuide::update(const CostGrid& map, const std::vector<CellRect>& changed,
                           const StopToken& stop) {
  search_.update(map, changed, stop);
  blocks_.update(map, changed);
}

SearchResult BackwardGuide::search(const CostGrid& map, const SearchRequest& request,
                                   const StopToken& stop) {
  const Cell goal = request.goals.front();
  const std::uint32_t start = map.geometry().index(request.start).value();
  BlockBound& bound = blocks_.to(request.start);
  SearchResult result;
  result.status = Status::UNREACHABLE;
  if (BlockEstimate(bound, kWideScale, stop)(goal) == kInfiniteKey) return result;
  const auto isStart = [start](std::uint32_t index) { return index == start; };
  const auto estimateIn = [&](const KeyScale& scale) {
    return [estimate = BlockEstimate(bound, scale, stop)](Cell cell, std::uint32_t) {
      return estimate(cell);
    };
  };
  result = search_.run(map, goal, isStart, estimateIn, request.record_expanded, stop);
  result.statistics.search_bytes += BlockBounds::bytesFor(map.geometry(), kBlock);
  std::reverse(result.cells.begin(), result.cells.end());
  return result;
}

}  // namespace grid_path_planner::planners
