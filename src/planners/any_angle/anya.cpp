#include "planners/any_angle/anya.h"

#include <cmath>

#include "planners/any_angle/anya_search.h"
#include "planners/any_angle/lattice_planner.h"
#include "planners/core/any_angle_traits.h"

namespace grid_path_planner::planners {

using base::Status, base::StopToken;
using costmap::BitMaps, costmap::passableCellAt, costmap::SegmentPoint, costmap::waypointOf;
using grid::Cell, grid::CellRect, grid::GridGeometry;

namespace {

// Measured on maps with a quarter of their cells blocked at random.
constexpr std::size_t kBytesPerCell = 12;

constexpr double kUnit = SegmentPoint::kUnitsPerCell;

AnyaPoint inCells(SegmentPoint point) {
  return {double(point.x) / kUnit, double(point.y) / kUnit};
}

SegmentPoint inUnits(AnyaPoint point) {
  return {std::llround(point.x * kUnit), std::llround(point.y * kUnit)};
}

}  // namespace

PlannerTraits Anya::declaredTraits() {
  PlannerTraits traits = anyAngleTraits("anya");
  traits.cut_corners = false;
  traits.weights = false;
  traits.shortest = true;
  traits.repairs = true;
  return traits;
}

Anya::Anya() : Planner(declaredTraits()), search_(std::make_unique<AnyaSearch>()) {}
Anya::~Anya() = default;

std::size_t Anya::bytesFor(const GridGeometry& geometry) const {
  return BitMaps::bytesFor(geometry) + LatticePlanner::bytesFor(geometry) +
         geometry.size() * kBytesPerCell;
}

void Anya::doPrepare(const StopToken& stop) {
  rows_ = &map().bitMaps(stop).rows;
  lattice_ = latticePlannerFor(map(), stop);
}

void Anya::doUpdate(const std::vector<CellRect>& changed, const StopToken& stop) {
  rows_ = &map().bitMaps(stop).rows;
  if (!lattice_) return;
  for (const CellRect& rect : changed) lattice_->update(map(), rect, stop);
}

SearchResult Anya::doSearch(const SearchRequest& request, const StopToken& stop) {
  const Cell start = request.start, goal = request.goals.front();
  const SegmentPoint from = waypointOf(map(), start), to = waypointOf(map(), goal);
  SearchResult result;
  if (start == goal) {
    result.status = Status::FOUND;
    result.cells = {start};
    result.points = {from};
    return result;
  }
  if (lattice_) return lattice_->search(map(), request, stop);
  std::vector<Cell> expanded;
  const AnyaSearch::Answer answer =
      search_->run(*rows_, inCells(from), inCells(to), stop, result.statistics,
                   request.record_expanded ? &expanded : nullptr);
  for (const Cell cell : expanded) result.expanded.push_back(map().geometry().index(cell));
  result.status = answer.status;
  result.statistics.search_bytes = search_->bytes();
  if (answer.status != Status::FOUND) return result;

  result.segment_cost = answer.length * map().minWeight() * map().kernel();
  for (const AnyaPoint& point : answer.points) {
    result.points.push_back(inUnits(point));
    result.cells.push_back(passableCellAt(map(), result.points.back()));
  }
  result.cells.front() = start;
  result.cells.back() = goal;
  return result;
}

}  // namespace grid_path_planner::planners
