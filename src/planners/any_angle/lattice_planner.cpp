#include "planners/any_angle/lattice_planner.h"

#include <vector>

namespace grid_path_planner::planners {

using base::Status;
using base::StopToken;
using costmap::CostGrid;
using costmap::SegmentPoint;
using grid::Cell;
using grid::CellRect;

namespace {

// Without the points that the path passes and does not turn at, as it does along thin edges.
std::vector<LatticePoint> withoutStraight(const std::vector<LatticePoint>& points) {
  std::vector<LatticePoint> turning;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const bool end = i == 0 || i + 1 == points.size();
    if (end || cross(points[i] - turning.back(), points[i + 1] - points[i]) != 0)
      turning.push_back(points[i]);
  }
  return turning;
}

}  // namespace

LatticePlanner::LatticePlanner(const CostGrid& map, const StopToken& stop)
    : bits_(map.bitMaps(stop).rows, stop), search_(map) {}

void LatticePlanner::update(const CostGrid& map, const CellRect& changed, const StopToken& stop) {
  bits_.update(map.bitMaps(stop).rows, changed, stop);
}

SearchResult LatticePlanner::search(const CostGrid& map, const SearchRequest& request,
                                    const StopToken& stop) {
  SearchResult result;
  std::vector<Cell> expanded;
  const LatticeSearch::Answer answer =
      search_.run(map.bitMaps(stop).rows, bits_, request.start, request.goals.front(), stop,
                  result.statistics, request.record_expanded ? &expanded : nullptr);
  for (const Cell cell : expanded) result.expanded.push_back(map.geometry().index(cell));
  result.status = answer.status;
  result.statistics.search_bytes = bits_.bytes() + search_.bytes();
  if (answer.status != Status::FOUND) return result;

  constexpr auto kUnit = SegmentPoint::kUnitsPerCell;
  result.segment_cost = answer.length / double(kUnit) * map.minWeight() * map.kernel();
  for (const LatticePoint point : withoutStraight(answer.points)) {
    result.points.push_back({point.x, point.y});
    result.cells.push_back({static_cast<int>(point.x / kUnit), static_cast<int>(point.y / kUnit)});
  }
  return result;
}

std::unique_ptr<LatticePlanner> latticePlannerFor(const CostGrid& map, const StopToken& stop) {
  if (map.segmentRule() != costmap::SegmentRule::CENTRE_LATTICE) return nullptr;
  return std::make_unique<LatticePlanner>(map, stop);
}

}  // namespace grid_path_planner::planners
