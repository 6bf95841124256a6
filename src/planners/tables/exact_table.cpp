#include "planners/tables/exact_table.h"

#include <algorithm>

#include "planners/tables/shortest_path_tree.h"

namespace grid_path_planner::planners {

using base::StopToken;
using costmap::CostGrid;
using grid::GridGeometry;

std::size_t ExactTable::bytesFor(const GridGeometry& geometry) {
  return geometry.size() * (geometry.size() * sizeof(Entry) + sizeof(CompactCostUnit));
}

std::size_t ExactTable::makingBytesFor(const GridGeometry& geometry) {
  return bytesFor(geometry) + ShortestPathTree::bytesFor(geometry);
}

ExactTable::ExactTable(const CostGrid& map, const StopToken& stop)
    : cells_(map.geometry().size()), costs_(cells_ * cells_), units_(cells_) {
  ShortestPathTree from(map, stop);
  for (std::size_t goal = 0; goal < cells_; ++goal) {
    if (map.weights().values()[goal] == CostGrid::kBlocked) continue;
    try {
      from.run(static_cast<std::uint32_t>(goal));
    } catch (const TooExpensive&) {
      continue;  // the row stays 0
    }
    if (write(from.costs(), goal)) continue;
    SearchKey longest = 0;
    for (const SearchKey cost : from.costs())
      if (cost != kInfiniteKey) longest = std::max(longest, cost);
    units_[goal] = CompactCostUnit::rounding(longest);
    write(from.costs(), goal);
  }
}

bool ExactTable::write(const std::vector<SearchKey>& costs, std::size_t goal) {
  for (std::size_t i = 0; i < cells_; ++i) {
    Entry& entry = costs_[goal * cells_ + i];
    entry = units_[goal].entryOf(costs[i]);
    if (entry == kNoCompactCost && costs[i] != kInfiniteKey) return false;
  }
  return true;
}

}  // namespace grid_path_planner::planners
