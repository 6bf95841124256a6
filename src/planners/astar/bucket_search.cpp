#include "planners/astar/bucket_search.h"

namespace grid_path_planner::planners {

using base::Statistics, base::Status, base::StopToken;
using costmap::CostGrid, costmap::costOfSteps;
using grid::Cell, grid::CellIndex, grid::CellRect;

void BucketSearch::prepare(const CostGrid& map, const StopToken& stop) {
  moves_.build(map, stop);
  if (packedMaySuffice(map))
    makeNodes(packed_, map);
  else
    makeNodes(wide_, map);
}

void BucketSearch::update(const CostGrid& map, const std::vector<CellRect>& changed,
                          const StopToken& stop) {
  for (const CellRect& rect : changed) moves_.update(map, rect, stop);
}

// A winding path may still cost more.
bool BucketSearch::packedMaySuffice(const CostGrid& map) {
  const auto sides = static_cast<SearchKey>(map.geometry().width()) + map.geometry().height();
  return sides * map.maxWeight() <= kPackedScale.largest / kPackedScale.straight;
}

// About three eighths of a straight step at the minimum weight. Narrower buckets separate cells that
// are neighbours in memory, wider ones cause more re-openings.
unsigned BucketSearch::bucketShift(const CostGrid& map, const KeyScale& scale) {
  const SearchKey width = scale.straight * std::max<SearchKey>(map.minWeight(), 1) / 2;
  return 63U - static_cast<unsigned>(__builtin_clzll(width));
}

template <class Nodes>
void BucketSearch::makeNodes(Nodes& nodes, const CostGrid& map) {
  if (nodes.size() == map.geometry().size()) return;
  nodes = Nodes();
  nodes = Nodes(map.geometry().size());
}

template <class Nodes>
void BucketSearch::finish(const Nodes& nodes, const CostGrid& map, Cell start, std::uint32_t goal,
                          SearchResult& result) const {
  Statistics& counts = result.statistics;
  counts.search_bytes = map.geometry().size() * (Nodes::kBytes + sizeof(std::uint8_t)) +
                        counts.peak_open * sizeof(BucketQueue::Index);
  if (goal == kNone || goal == kTooExpensive) return;
  const std::uint32_t first = map.geometry().index(start).value();
  for (std::uint32_t at = goal;;) {
    result.cells.push_back(map.geometry().cell(CellIndex(at)));
    if (at == first) break;
    at = static_cast<std::uint32_t>(at - moves_.offsets()[__builtin_ctz(nodes.steps(at))]);
  }
  std::reverse(result.cells.begin(), result.cells.end());
  result.cost = costOfSteps(map, result.cells);
  result.status = Status::FOUND;
}

template void BucketSearch::makeNodes(PackedNodes&, const CostGrid&);
template void BucketSearch::makeNodes(WideNodes&, const CostGrid&);
template void BucketSearch::finish(const PackedNodes&, const CostGrid&, Cell, std::uint32_t,
                                   SearchResult&) const;
template void BucketSearch::finish(const WideNodes&, const CostGrid&, Cell, std::uint32_t,
                                   SearchResult&) const;

}  // namespace grid_path_planner::planners
