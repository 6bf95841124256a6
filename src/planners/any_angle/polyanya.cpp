#include "planners/any_angle/polyanya.h"

#include <algorithm>

#include "grid_path_planner/planners/decomposition.h"
#include "planners/any_angle/lattice_planner.h"
#include "planners/any_angle/polyanya_search.h"
#include "planners/core/any_angle_traits.h"

namespace grid_path_planner::planners {

using base::Status, base::StopToken;
using costmap::BitMaps, costmap::CostGrid, costmap::passableCellAt, costmap::SegmentPoint,
    costmap::waypointOf;
using grid::Cell, grid::CellRect, grid::GridGeometry;

namespace {

constexpr double kUnit = SegmentPoint::kUnitsPerCell;

// A rectangle with its borders and corners, their construction and a search over all of them: 545
// measured on a map with a quarter of its cells blocked at random.
constexpr std::size_t kBytesPerRectangle = 600;

MeshPoint inMesh(SegmentPoint point) {
  return {static_cast<std::int32_t>(point.x), static_cast<std::int32_t>(point.y)};
}

SegmentPoint inUnits(MeshPoint point) {
  return {point.x, point.y};
}

std::size_t bytesForRectangles(const GridGeometry& geometry, std::size_t count) {
  return BitMaps::bytesFor(geometry) + count * kBytesPerRectangle;
}

Cell middleOf(const CellRect& rect) {
  return {rect.column + rect.width / 2, rect.row + rect.height / 2};
}

}  // namespace

PlannerTraits Polyanya::declaredTraits() {
  PlannerTraits traits = anyAngleTraits("polyanya");
  traits.cut_corners = false;
  traits.weights = false;
  traits.shortest = true;
  return traits;
}

Polyanya::Polyanya() : Planner(declaredTraits()), search_(std::make_unique<PolyanyaSearch>()) {}
Polyanya::~Polyanya() = default;

// Of a map without obstacles, the least of all maps; doPrepare() counts the runs of the map.
std::size_t Polyanya::bytesFor(const GridGeometry& geometry) const {
  return bytesForRectangles(geometry, 1);
}

std::string Polyanya::refusal(const CostGrid& map) const {
  if (std::max(map.geometry().width(), map.geometry().height()) > PolyanyaMesh::kMaxSide)
    return "plans on maps of up to " + std::to_string(PolyanyaMesh::kMaxSide) + " cells a side";
  return Planner::refusal(map);
}

void Polyanya::doPrepare(const StopToken& stop) {
  lattice_ = latticePlannerFor(map(), stop);
  if (lattice_) return;
  const BitMaps& free = map().bitMaps(stop);
  // The list of rectangles may be as long as there are runs, and doubles as it grows.
  const std::size_t list = 2 * sizeof(CellRect) * countRuns(free.rows);
  if (list > memoryLimit()) return refuseFor(list);
  rectangles_ = mergedRuns(free.rows, stop);
  const std::size_t bytes = bytesForRectangles(map().geometry(), rectangles_.size());
  if (bytes > memoryLimit()) {
    rectangles_ = {};
    return refuseFor(bytes);
  }
  index_ = RectangleIndex(rectangles_, stop);
  mesh_ = PolyanyaMesh(rectangles_, stop);
  search_ = std::make_unique<PolyanyaSearch>();
}

void Polyanya::refuseFor(std::size_t bytes) {
  refuse("needs up to " + std::to_string(bytes / 1000000 + 1) +
         " MB to cut this map into rectangles, more than the " +
         std::to_string(memoryLimit() / 1000000) + " MB that memory_limit leaves it");
}

SearchResult Polyanya::doSearch(const SearchRequest& request, const StopToken& stop) {
  const Cell start = request.start, goal = request.goals.front();
  SearchResult result;
  if (start == goal) {
    result.status = Status::FOUND;
    result.cells = {start};
    result.points = {waypointOf(map(), start)};
    return result;
  }
  if (lattice_) return lattice_->search(map(), request, stop);
  std::vector<std::uint32_t> expanded;
  const PolyanyaSearch::Answer answer =
      search_->run(mesh_, {inMesh(waypointOf(map(), start)), *index_.at(start)},
                   {inMesh(waypointOf(map(), goal)), *index_.at(goal)}, stop, result.statistics,
                   request.record_expanded ? &expanded : nullptr);
  for (const std::uint32_t rectangle : expanded)
    result.expanded.push_back(map().geometry().index(middleOf(rectangles_[rectangle])));
  result.status = answer.status;
  result.statistics.search_bytes =
      rectangles_.capacity() * sizeof(CellRect) + index_.bytes() + mesh_.bytes() + search_->bytes();
  if (answer.status != Status::FOUND) return result;

  result.segment_cost = answer.length / kUnit * map().minWeight() * map().kernel();
  for (const MeshPoint point : answer.points) {
    result.points.push_back(inUnits(point));
    result.cells.push_back(passableCellAt(map(), inUnits(point)));
  }
  result.cells.front() = start;
  result.cells.back() = goal;
  return result;
}

}  // namespace grid_path_planner::planners
