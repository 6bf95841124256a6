#include "grid_path_planner/rectangles/polyanya.h"

#include <algorithm>

#include "cone_search.h"
#include "grid_path_planner/rectangles/decomposition.h"

namespace grid_path_planner {
namespace {

constexpr double kUnit = SegmentPoint::kUnitsPerCell;

// Rectangles, borders, corners and a search over all of them: measured on random maps, where every
// run is a rectangle.
constexpr std::size_t kBytesPerRun = 1000;

Traits polyanyaTraits() {
  Traits traits;
  traits.name = "polyanya";
  traits.four_connected = false;
  traits.unit_diagonals = false;
  traits.cut_corners = false;
  traits.weights = false;
  traits.any_angle = true;
  traits.shortest = true;
  return traits;
}

MeshPoint inMesh(SegmentPoint point) {
  return {static_cast<std::int32_t>(point.x), static_cast<std::int32_t>(point.y)};
}

SegmentPoint inUnits(MeshPoint point) {
  return {point.x, point.y};
}

// At most, with a run of free cells for each of so many.
std::size_t bytesForRuns(const GridGeometry& geometry, std::size_t runs) {
  return BitMaps::bytesFor(geometry) + runs * kBytesPerRun;
}

Cell middleOf(const CellRect& rect) {
  return {rect.column + rect.width / 2, rect.row + rect.height / 2};
}

}  // namespace

Polyanya::Polyanya() : Planner(polyanyaTraits()), search_(std::make_unique<ConeSearch>()) {}
Polyanya::~Polyanya() = default;

// Of a map without obstacles, the least there is; doPrepare() looks at the map.
std::size_t Polyanya::bytesFor(const GridGeometry& geometry) const {
  return bytesForRuns(geometry, static_cast<std::size_t>(geometry.height()));
}

std::string Polyanya::refusal(const CostGrid& map) const {
  if (std::max(map.geometry().width(), map.geometry().height()) > RectangleMesh::kMaxSide)
    return "plans on maps of up to " + std::to_string(RectangleMesh::kMaxSide) + " cells a side";
  return Planner::refusal(map);
}

void Polyanya::doPrepare(const StopToken& stop) {
  const BitMaps& free = map().bitMaps(stop);
  const std::size_t bytes = bytesForRuns(map().geometry(), countRuns(free.rows));
  if (bytes > memoryLimit())
    return refuse("needs up to " + std::to_string(bytes / 1000000 + 1) +
                  " MB to cut this map into rectangles, more than its memory_limit");
  rectangles_ = mergedRuns(free.rows, stop);
  index_ = RectangleIndex(rectangles_);
  mesh_ = RectangleMesh(rectangles_, stop);
  search_ = std::make_unique<ConeSearch>();
}

PlanResult Polyanya::doPlan(const PlanRequest& request, const StopToken& stop) {
  const Cell start = request.start, goal = request.goals.front();
  PlanResult result;
  if (start == goal) {
    result.status = Status::FOUND;
    result.cells = {start};
    result.points = {waypointOf(map(), start)};
    return result;
  }
  std::vector<std::uint32_t> expanded;
  const ConeSearch::Answer answer =
      search_->run(mesh_, {inMesh(waypointOf(map(), start)), *index_.at(start)},
                   {inMesh(waypointOf(map(), goal)), *index_.at(goal)}, stop, result.statistics,
                   request.record_expanded ? &expanded : nullptr);
  for (const std::uint32_t rectangle : expanded)
    result.expanded.push_back(map().geometry().index(middleOf(rectangles_[rectangle])));
  result.status = answer.status;
  result.statistics.search_bytes =
      rectangles_.capacity() * sizeof(CellRect) + index_.bytes() + mesh_.bytes() + search_->bytes();
  if (answer.status != Status::FOUND) return result;

  result.segment_cost = answer.length / kUnit * map().cheapest() * map().kernel();
  for (const MeshPoint point : answer.points) {
    result.points.push_back(inUnits(point));
    result.cells.push_back(passableCellAt(map(), inUnits(point)));
  }
  result.cells.front() = start;
  result.cells.back() = goal;
  return result;
}

}  // namespace grid_path_planner
